"""One impact by Exudyn, from the problem to its history.

    μ y_tt + EI y_xxxx = EI q₀ + μ a₀ − r,   0 ≤ r ⊥ −y ≥ 0                       (thesis 2.1.1–2)

The beam is modelled in the units of :mod:`exudyn_models.scaling`, with the initial shape, velocity field and load for
which, without contact, y₀ of :class:`bent_beam.Impact` is the motion; the ends carry the moment EI(q₀x²/2 + c₀t) and
the shear EI q₀x of y₀ (nothing when ψ = χ = 0: a free end). Exudyn runs in segments of a few equal steps; between
them its state vectors are read, which costs some microseconds where a callback a step would cost the run.

The total impulse is what the momentum of the modelled beam lacks: it is exact, whatever happens within a step. The
impulse of each contact point is the trapezoidal sum of its force, corrected to that total.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
from numpy.typing import NDArray

from bent_beam import Impact, ImpactHistory, SimulationError
from bent_beam.checks import affordable, positive, whole
from bent_beam.meshes import Mesh, NodesMesh, ScaleFreeMesh, checked_nodes, mirrored
from bent_beam.parts import describe
from exudyn_models.contacts import Contact, ContactRun, Penalty, Rigid, SegmentFriction, Wall
from exudyn_models.elements import ANCFCable, Beam, Element
from exudyn_models.elements.beam import Section
from exudyn_models.geometry import GEOMETRIES, Geometry, LinearLimit, Shape
from exudyn_models.integrators import GeneralizedAlpha, Integrator, Newmark
from exudyn_models.scaling import Scaling, front_estimate
from exudyn_models.solvers import NewtonSolver, silence
from exudyn_models.viewer import open_viewer

__all__ = ["chosen_half_length", "chosen_mesh", "simulate"]

Array = NDArray[np.float64]

DEFAULT_DURATION = 0.1  # τ, the longest time that the thesis computes
GROWTH = 0.01  # neighbours of the chosen mesh: 5 elements over the front's bending length at κ/ν = 0.05, 20 at 0.2
LARGEST_STEP = 0.05  # of the end time: the front then moves by a fortieth of the contact length in one
MOST_INSTANTS = 1_000_000
MOST_WORK = 2e9  # steps x nodes: about an hour
SEGMENT = 4  # steps between two readings of the state


# what is chosen from the problem ----------------------------------------------------------------------------------
def _far_field(scaling: Scaling) -> float:
    """Half length to model, in units of Λ, when the beam is longer: what the end would send back stays out of the
    picture.

    Waves of the front's length 2/λ₀ travel ~ 2λ₀ by the end and longer ones less; beyond 12 the kernel H has decayed.
    """
    kappa = scaling.kappa
    reach = 12.0 + 8.0 * math.sqrt(2.0 / max(kappa, 2e-3))
    # a growing velocity (χ > 0) or an upward bent end (ψ > 0) would bring the far field to the wall: stay well inside
    spread = kappa - max(scaling.chi, 0.0)
    if scaling.psi > 0.0 and spread > 0.0:
        reach = min(reach, 0.6 * math.sqrt(12.0 * spread / scaling.psi))
    return reach


def chosen_half_length(impact: Impact, end_time: float | None = None) -> float:
    """The half length, m, modelled when no mesh is given: the beam's, or less where nothing returns in time."""
    scaling = Scaling(impact, _end_time(impact, end_time), 1.0)
    return min(impact.half_length, _far_field(scaling) * scaling.length)


def chosen_mesh(
    impact: Impact, end_time: float | None = None, *, explicit: bool = False, coarsen: float = 1.0
) -> NodesMesh:
    """The mesh that ``simulate`` lays when none is given (half beam), to lay the same under several impacts.

    coarsen : factor on every element's length.
    """
    positive("coarsen", coarsen)
    scaling = Scaling(impact, _end_time(impact, end_time), 1.0)
    front = front_estimate(scaling.kappa)
    if explicit:
        rule = ScaleFreeMesh(max(front, 0.5) / 25 * scaling.length * coarsen, 1.0 + 0.02 * coarsen)
    else:
        # the smallest element: 1/200 of the front's way, 1/30 of the length over which the beam bends ahead of it
        smallest = min(front / 200, (2.0 / front) / 30)
        rule = ScaleFreeMesh(smallest * scaling.length * coarsen, 1.0 + GROWTH * coarsen)
    nodes = rule.nodes(chosen_half_length(impact, end_time))
    return NodesMesh(places=tuple(float(place) for place in nodes))


def _end_time(impact: Impact, end_time: float | None) -> float:
    return impact.checked_end_time(DEFAULT_DURATION * impact.time_scale if end_time is None else end_time)


def _targets(save: int | Sequence[float] | Array, end: float) -> Array:
    """The times to save in units of ``end``, ascending, after 0; the last is the end itself."""
    if isinstance(save, (int, np.integer)):
        if whole("save", int(save), 1) > MOST_INSTANTS:
            raise ValueError(f"save must be at most {MOST_INSTANTS} instants (got {save})")
        return np.asarray((np.arange(1, save + 1) / save) ** 2)
    times = np.unique(np.asarray(save, float)) / end
    if times.ndim != 1 or not np.isfinite(times).all() or (times < 0.0).any() or (times > 1.0 + 1e-9).any():
        raise ValueError(f"save must be a number of instants or times from 0 to the end time {end:.6g} s")
    return np.append(times[(times > 0.0) & (times < 1.0 - 1e-9)], 1.0)


def _reachable(x: Array, scaling: Scaling, centre: int) -> NDArray[np.int64]:
    """Nodes that may touch: half as far again as the free motion would carry the beam into the wall."""
    times = np.linspace(0.05, 1.0, 20)[:, None]
    inside = (scaling.free_deflection(x[None, :], times) > 0.0).any(axis=0)
    reach = 1.5 * np.abs(x[inside]).max(initial=0.0)
    wide = np.abs(x) <= reach
    wide[max(0, centre - 20) : centre + 21] = True
    return np.flatnonzero(wide)


# recording --------------------------------------------------------------------------------------------------------
@dataclass
class _Record:
    """What is read between segments; everything in model units."""

    time: list[float] = field(default_factory=list)
    y: list[Array] = field(default_factory=list)
    v: list[Array] = field(default_factory=list)
    slope: list[Array] = field(default_factory=list)
    impulse: list[Array] = field(default_factory=list)
    active: list[NDArray[np.bool_]] = field(default_factory=list)
    total: list[float] = field(default_factory=list)
    kinetic: list[float] = field(default_factory=list)
    strain: list[float] = field(default_factory=list)
    work: list[float] = field(default_factory=list)
    contact_loss: list[float] = field(default_factory=list)
    viscous_loss: list[float] = field(default_factory=list)
    held: list[float] = field(default_factory=list)


class _Run:
    """One beam in one Exudyn system, stepped and read."""

    def __init__(self, beam: Beam, contact: ContactRun, scaling: Scaling, half: bool, newer: float) -> None:
        self.newer = newer  # share of the newer force in the impulse between two readings
        self.beam, self.contact, self.scaling, self.half = beam, contact, scaling, half
        shape, a = beam.shape, scaling.amplitude
        self.load = scaling.load * a
        self.wall_y = shape.wall_curvature * shape.s**2 / 2
        # constant forces along y: the uniform load and the end shears, −q₀x at +x and +q₀x at −x
        length = float(beam.lengths.sum())
        self.shear = a * scaling.psi * shape.s[-1]
        self.force = self.load * length - self.shear * (1.0 if half else 2.0)
        self.record = _Record()
        self.impulse = np.zeros(contact.contact_s.size)
        self.previous: tuple[Array, Array, float, float] | None = None
        self.contact_loss = self.viscous_loss = self.held = self.work = 0.0
        self.total = 0.0
        self.start_momentum = math.nan
        self.deepest = 0.0
        self.fastest = float(np.abs(shape.velocity_y).max())

    def read(self, t: float, dt: float) -> tuple[Array, Array]:
        """Take the state at ``t``, ``dt`` after the last one, and integrate what is integrated over time."""
        data = self.beam.mbs.systemData
        q, v = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
        if not (np.isfinite(q).all() and np.isfinite(v).all()):
            raise FloatingPointError("the state is no longer finite")
        if np.abs(v[self.beam.vertical]).max() > 1e3 * self.fastest:
            raise FloatingPointError("velocities have grown a thousandfold: the integration is unstable")
        force, active = self.contact.forces(q, v)
        momentum = self.beam.momentum(v)
        viscous = self.beam.viscous_power(q, v)
        power = self._load_power(t, q, v)
        points = self.contact.velocity(q, v)
        if self.previous is None:
            self.start_momentum = momentum
        else:
            old_force, old_velocity, old_viscous, old_power = self.previous
            gain = ((1.0 - self.newer) * old_force + self.newer * force) * dt
            total = self.start_momentum + self.force * t - momentum
            weight = np.abs(gain)
            missing = total - self.total - gain.sum()
            if not weight.any():  # what acted within the segment only: at the deepest point
                weight[np.argmax(self.contact.depth(q))] = 1.0
            gain = gain + missing * weight / weight.sum()
            self.impulse += gain
            self.total = total
            self.held -= np.minimum(gain, 0.0).sum()
            self.contact_loss += float((force * points + old_force * old_velocity).sum() * dt / 2)
            self.viscous_loss += (viscous + old_viscous) * dt / 2
            self.work += (power + old_power) * dt / 2
        self.previous = (force, points, viscous, power)
        self.active = active
        y = self.beam.deflection(q) - self.wall_y
        self.deepest = max(self.deepest, float(y.max()) / max(t, 1e-300)) if t > 0.01 else self.deepest
        return q, v

    def _load_power(self, t: float, q: Array, v: Array) -> float:
        beam, scaling = self.beam, self.scaling
        power = self.load * beam.momentum(v) / beam.section.mass_per_length
        moment = scaling.amplitude * (scaling.psi * beam.shape.s[-1] ** 2 / 2 + scaling.chi * t)
        power += -self.shear * v[beam.vertical[-1]] + moment * v[beam.rotation[-1]]
        if not self.half:
            power += -self.shear * v[beam.vertical[0]] - moment * v[beam.rotation[0]]
        return float(power)

    def save(self, t: float, q: Array, v: Array) -> None:
        r, beam = self.record, self.beam
        r.time.append(t)
        r.y.append(beam.deflection(q) - self.wall_y)
        r.v.append(v[beam.vertical].copy())
        r.slope.append(beam.slope(q) - beam.shape.wall_curvature * beam.shape.s)
        r.impulse.append(self.impulse.copy())
        r.active.append(self.active.copy())
        r.total.append(self.total)
        r.kinetic.append(beam.kinetic_energy(v))
        r.strain.append(beam.strain_energy(q))
        r.work.append(self.work)
        r.contact_loss.append(self.contact_loss)
        r.viscous_loss.append(self.viscous_loss)
        r.held.append(self.held)

    def history(self, **about: Any) -> ImpactHistory:
        """The record in SI units, of the whole beam where it is a sum."""
        r, s = self.record, self.scaling
        both = 2.0 if self.half else 1.0
        energy = both * s.energy
        kinetic, strain, work = (np.array(values) * energy for values in (r.kinetic, r.strain, r.work))
        impact_loss, viscous_loss = np.array(r.contact_loss) * energy, np.array(r.viscous_loss) * energy
        balance = kinetic[0] + strain[0] + work - kinetic - strain
        fields = {
            "gap": (("time", "x"), -np.array(r.y) * s.deflection),
            "velocity": (("time", "x"), np.array(r.v) * s.velocity),
            "slope": (("time", "x"), np.array(r.slope) * s.slope),
            "impulse": (("time", "contact"), np.array(r.impulse) * s.impulse),
            "in_contact": (("time", "contact"), np.array(r.active)),
            "total_impulse": (("time",), np.array(r.total) * both * s.impulse),
            "held_impulse": (("time",), np.array(r.held) * both * s.impulse),
            "kinetic_energy": (("time",), kinetic),
            "strain_energy": (("time",), strain),
            "work_of_loads": (("time",), work),
            "loss_impact": (("time",), impact_loss),
            "loss_artificial": (("time",), viscous_loss),
            "loss_integration": (("time",), balance - impact_loss - viscous_loss),
        }
        place = np.interp(self.contact.contact_s, self.beam.shape.s, self.beam.shape.x)
        return ImpactHistory.build(
            path="exudyn",
            symmetry="half" if self.half else "full",
            time=np.array(r.time) * s.end_time,
            x=self.beam.shape.x * s.length,
            contact_x=place * s.length,
            fields=fields,
            **about,
        )


def _assemble(
    shape: Shape, scaling: Scaling, element: Element, contact: Contact, integrator: Integrator, half: bool
) -> tuple[Beam, ContactRun]:
    """The Exudyn system: beam, loads, symmetry, contact."""
    container = exu.SystemContainer()
    system = container.AddSystem()
    system.variables["container"] = container  # the system must not outlive it
    true = shape.slender
    axial = element.axial_stiffness
    if axial is None:
        axial_stiffness = 12.0 * (scaling.length / scaling.impact.section_height) ** 2 if true else 1.0
    else:
        axial_stiffness = axial * scaling.length**2 / scaling.impact.bending_stiffness
    factor = element.viscosity
    if factor is None:
        factor = 0.003 if integrator.explicit else 0.3
    beam = element.build(system, shape, Section(axial_stiffness=axial_stiffness), factor * shape.lengths**2)
    last, centre = shape.s.size - 1, int(np.argmin(np.abs(shape.s)))
    if half:
        hold = beam.burden if integrator.explicit else beam.fix
        hold(0, beam.horizontal_coordinate, beam.rotation_coordinate)
    if scaling.load:
        beam.load_uniformly(scaling.load * scaling.amplitude)
    ends = [(last, 1.0)] if half else [(last, 1.0), (0, -1.0)]
    for node, sign in ends:
        _load_end(beam, node, sign, scaling)
    wall = Wall(
        nodes=_reachable(shape.s, scaling, centre),
        centre=centre,
        half=half,
        pulled_off=scaling.load < 0.0,
        point_contact=scaling.kappa >= 1.0,
        explicit=integrator.explicit,
        curvature=-shape.curvature,
        stiffness_unit=scaling.stiffness_per_length,
        damping_unit=scaling.damping_per_length,
    )
    run = contact.attach(beam, wall)
    system.Assemble()
    beam.locate()
    return beam, run


def _load_end(beam: Beam, node: int, sign: float, scaling: Scaling) -> None:
    """The moment and shear that the free motion y₀ has at an end of the modelled beam."""
    amplitude, end = scaling.amplitude, beam.shape.s[-1]
    # bending at the rate χ also takes the moment ηχ of the viscosity
    constant = amplitude * (scaling.psi * end**2 / 2 + beam.viscosity[node if node == 0 else -1] * scaling.chi)
    rate = amplitude * scaling.chi
    if scaling.psi:
        beam.mbs.AddLoad(
            items.LoadCoordinate(
                markerNumber=beam.marker(node, beam.vertical_coordinate), load=-amplitude * scaling.psi * end
            )
        )
    if scaling.psi or scaling.chi:
        marker = beam.marker(node, beam.rotation_coordinate)
        if rate:
            beam.mbs.AddLoad(
                items.LoadCoordinate(
                    markerNumber=marker, loadUserFunction=lambda mbs, t, load: sign * (constant + rate * t)
                )
            )
        else:
            beam.mbs.AddLoad(items.LoadCoordinate(markerNumber=marker, load=sign * constant))


def _stable_step(beam: Beam, contact: ContactRun, integrator: Integrator) -> float:
    """limit/ω, ω the largest eigenvalue of any element with its contact closed: a bound for the whole mesh."""
    mass, stiffness, damping = beam.element_matrices()
    k, d = contact.stiffness_and_damping()
    share = beam.lengths / 2
    for end in (0, 1):
        node = slice(end, beam.lengths.size + end)
        part = share / beam.tributary[node]
        stiffness[:, 2 * end, 2 * end] += k[node] * part
        damping[:, 2 * end, 2 * end] += d[node] * part
    solved_k, solved_d = np.linalg.solve(mass, stiffness), np.linalg.solve(mass, damping)
    count = mass.shape[0]
    state = np.zeros((count, 8, 8))
    state[:, :4, 4:] = np.eye(4)
    state[:, 4:, :4], state[:, 4:, 4:] = -solved_k, -solved_d
    largest = float(np.abs(np.linalg.eigvals(state)).max())
    return float(integrator.limit / max(largest, beam.axial_frequency()))  # type: ignore[attr-defined]


ADVICE = (
    "a smaller exudyn.integrator.relative_step (or time_step), a smaller spectral_radius, more contact damping "
    "(exudyn.contact.relative_damping), or a larger exudyn.solver.absolute_tolerance"
)


def simulate(
    impact: Impact,
    *,
    end_time: float | None = None,
    mesh: Mesh | None = None,
    element: Element | None = None,
    integrator: Integrator | None = None,
    contact: Contact | None = None,
    geometry: Geometry | str | None = None,
    solver: NewtonSolver | None = None,
    full_beam: bool = False,
    save: int | Sequence[float] | Array = 200,
    view: bool = False,
    progress: Callable[[float], object] | None = None,
) -> ImpactHistory:
    """Simulate one impact with Exudyn.

    Parameters
    ----------
    impact : the problem (SI).
    end_time : s; None: τ = 0.1.
    mesh : of the half beam, laid over the whole half length (a ``NodesMesh`` may end short of it); None: elements in
        proportion to the distance from the centre, as far out as waves travel (:func:`chosen_mesh`).
    element, integrator, contact, geometry, solver : parts of :data:`exudyn_models.REGISTRIES`; None: ANCF cable,
        generalised-α, nodal penalty, the linear limit, modified Newton. ``geometry`` may be "linear" or "true".
    full_beam : model both halves instead of x ≥ 0 with the slope fixed at x = 0.
    save : number of saved instants after t = 0, spread evenly in √t, or their times, s; snapped to steps.
    view : watch the run in Exudyn's viewer; without a display a line on standard error says so.
    progress : called with the fraction done.

    Returns
    -------
    ImpactHistory with the fields of :mod:`bent_beam.history` in SI units. Sums (energies,
    ``total_impulse``) are of both halves of the modelled beam; a half model's ``impulse`` is that of x ≥ 0, half of
    the total.

    Raises
    ------
    ValueError : parts that cannot work together, an unstable explicit step, a beam that cannot be laid out.
    SimulationError : Exudyn's solver failed or the state stopped being finite; carries the history up to there.
    """
    end = _end_time(impact, end_time)
    targets = _targets(save, end)
    element = ANCFCable() if element is None else element
    contact = Penalty() if contact is None else contact
    if integrator is None:
        integrator = Newmark() if isinstance(contact, Rigid) else GeneralizedAlpha()
    if isinstance(contact, SegmentFriction):
        geometry = contact.geometry() if geometry is None else geometry
        solver = contact.solver() if solver is None else solver
    solver = NewtonSolver() if solver is None else solver
    if geometry is None or isinstance(geometry, str):
        if geometry is not None and geometry not in GEOMETRIES:
            raise ValueError(f"geometry must be one of {', '.join(GEOMETRIES)} (got {geometry!r})")
        geometry = LinearLimit() if geometry is None else GEOMETRIES[geometry]()
    refusal = contact.refuses(element, integrator)
    if refusal:
        raise ValueError(refusal)

    began = clock.perf_counter()
    true = Scaling(impact, end, 1.0).true_amplitude
    scaling = Scaling(impact, end, geometry.amplitude_of(true))
    laid = chosen_mesh(impact, end, explicit=integrator.explicit) if mesh is None else mesh
    half_length = impact.half_length
    if isinstance(laid, NodesMesh) and laid.places[-1] <= half_length * (1.0 + 1e-9):
        half_length = laid.places[-1]
    places = checked_nodes(laid.nodes(half_length)) / scaling.length
    nodes = mirrored(places) if full_beam else places
    share = contact.wall_share(geometry) if isinstance(contact, SegmentFriction) else 0.0
    if share and scaling.kappa == 0.0:
        raise ValueError("exudyn.contact.kind segment_friction needs a bent beam (got curvature 0)")
    shape = geometry.shape(nodes, scaling, share)
    half = not full_beam

    with silence():
        beam, contact_run = _assemble(shape, scaling, element, contact, integrator, half)
        # Newmark's rule weighs the newer multiplier by γ: where a contact is read every step, its impulses are exact
        newer = integrator.gamma if isinstance(integrator, Newmark) and contact_run.longest_segment == 1 else 0.5
        run = _Run(beam, contact_run, scaling, half, newer)
        stable = _stable_step(beam, contact_run, integrator) if integrator.explicit else math.inf
        crossing = min(0.01, (places[1] / front_estimate(scaling.kappa)) ** 2)
        per_segment = SEGMENT if contact_run.longest_segment is None else contact_run.longest_segment
        segments = integrator.segments(crossing, per_segment, end, stable)
        affordable("exudyn.integrator and mesh", sum(s.steps for s in segments), nodes.size, targets.size, MOST_WORK)
        settings = solver.settings(scaling.amplitude)
        integrator.configure(settings)
        container = beam.mbs.variables["container"]
        viewing = view and open_viewer(container, beam.mbs)
        try:
            steps, seconds, failure = _step(run, segments, settings, integrator.solver(), targets, progress)
        finally:
            if viewing:
                container.renderer.Stop()
            beam.mbs.variables.clear()  # the container holds the system: break the circle

    warnings = _warnings(run, places, half_length, scaling, mesh is not None, impact)
    last_step = (segments[-1].end - segments[-1].start) / segments[-1].steps
    if last_step > LARGEST_STEP:
        warnings.append(f"time steps of {last_step:.2g} end_time cannot follow the front; {LARGEST_STEP:g} is the most")
    about: dict[str, Any] = {
        "impact": impact,
        "warnings": warnings,
        "steps": steps,
        "seconds": seconds,
        "completed": failure is None,
        "settings": {
            "end_time": end,
            "save": np.asarray(save).tolist(),
            "mesh": describe(laid),
            "element": describe(element),
            "integrator": describe(integrator),
            "contact": describe(contact) | contact_run.settings(),
            "geometry": describe(geometry),
            "solver": describe(solver),
            "full_beam": full_beam,
            "nodes": int(nodes.size),
            "modelled_half_length": float(half_length),
            "amplitude": scaling.amplitude,
            "amplitude_of_the_real_beam": true,
            "ends": "moment and shear of the free motion" if scaling.psi or scaling.chi else "free",
            "first_step": segments[0].end / segments[0].steps * end,
            "last_step": last_step * end,
            "wall_seconds": clock.perf_counter() - began,
        },
    }
    if math.isfinite(stable):
        about["settings"]["stable_step"] = stable * end
    history = run.history(**about)
    if failure is not None:
        raise SimulationError(failure, time=float(history.time[-1]), step=steps, advice=ADVICE, history=history)
    return history


def _step(
    run: _Run,
    segments: list[Any],
    settings: Any,
    solver: Any,
    targets: Array,
    progress: Callable[[float], object] | None,
) -> tuple[int, float, str | None]:
    """Run all segments; returns steps taken, seconds inside Exudyn and, if it failed, what failed."""
    mbs, time = run.beam.mbs, settings.timeIntegration
    steps, seconds = 0, 0.0
    q, v = None, None
    try:
        first = segments[0]
        time.startTime, time.endTime, time.numberOfSteps = first.start, first.end, first.steps
        began = clock.perf_counter()
        if not solver.InitializeSolver(mbs, settings):
            return 0, 0.0, "Exudyn could not initialise"
        seconds += clock.perf_counter() - began
        q, v = run.read(0.0, 0.0)
        run.save(0.0, q, v)
        run.contact.between(0.0, q, v)
        saved = 0
        for segment in segments:
            size = (segment.end - segment.start) / segment.steps
            time.startTime, time.endTime, time.numberOfSteps = segment.start, segment.end, segment.steps
            time.minimumStepSize = size * 1e-3
            it = solver.it
            it.startTime, it.endTime, it.numberOfSteps = segment.start, segment.end, segment.steps
            it.currentStepSize = it.initialStepSize = it.maxStepSize = size
            it.minStepSize = size * 1e-3
            began = clock.perf_counter()
            done = solver.SolveSteps(mbs, settings)
            seconds += clock.perf_counter() - began
            if not done:
                return steps, seconds, "Exudyn's solver failed: " + " ".join(str(solver.GetErrorString()).split())[:200]
            steps += segment.steps
            q, v = run.read(segment.end, segment.end - segment.start)
            if saved < targets.size and segment.end >= targets[saved] * (1.0 - 1e-9):
                run.save(segment.end, q, v)
                saved = int(np.searchsorted(targets, segment.end * (1.0 + 1e-9), side="right"))
                if progress is not None:
                    progress(segment.end)
            if run.contact.between(segment.end, q, v):
                mbs.solverSignalJacobianUpdate = True
    except FloatingPointError as error:
        return steps, seconds, str(error)
    except SystemError as error:  # what was raised while Exudyn ran, an interrupt by the user above all
        raise (error.__cause__ or error) from None
    except (exu.ExudynError, RuntimeError) as error:
        return steps, seconds, "Exudyn's solver failed: " + " ".join(str(error).split())[:200]
    return steps, seconds, None


def _warnings(run: _Run, places: Array, half_length: float, scaling: Scaling, given: bool, impact: Impact) -> list[str]:
    """What a reader of the result should know."""
    found = []
    amplitude = scaling.amplitude
    penetration = run.deepest / amplitude
    if penetration > 0.01:
        found.append(
            f"the beam enters the wall by up to {penetration:.2%} of V0 t; take a stiffer penalty or smaller steps"
        )
    front = front_estimate(scaling.kappa)
    if scaling.kappa < 1.0 and len(run.record.time) > 1:
        bending = 2.0 / front
        for part in (1.0, 0.1):
            at = front * math.sqrt(part)
            k = min(int(np.searchsorted(places, at)), places.size - 2)
            per = bending * math.sqrt(part) / (places[k + 1] - places[k])
            if per < 3.0:
                found.append(
                    f"under-resolved front: {per:.1f} elements (want 3) over its bending length at {part:g} end_time"
                )
                break
    if given:
        growth = places[2:] - places[1:-1]
        growth = growth / (places[1:-1] - places[:-2])
        if growth.max() > 1.021:
            found.append(f"the mesh grows by {growth.max() - 1:.0%} an element: above 2 % it reflects waves back")
    reach = half_length / scaling.length
    if reach < 0.5 * _far_field(scaling):
        found.append(
            f"the end lies at {reach:.3g} sqrt(sqrt(EI/mu) T): waves reflected there come back before the end time"
        )
    if run.record.y:
        untouchable = np.ones(run.beam.shape.s.size, bool)
        near = np.searchsorted(run.beam.shape.s, run.contact.contact_s)
        untouchable[max(0, near.min() - 1) : near.max() + 2] = False
        if (run.record.y[-1][untouchable] > 0.0).any():
            found.append("the beam enters the wall outside the zone given contact points")
    slope = max((float(np.abs(s).max()) for s in run.record.slope), default=0.0)
    if run.beam.shape.slender and slope > 0.1:
        found.append(f"slopes up to {slope:.2g}: linear theory no longer describes this beam, only its first instants")
    elif slope > 0.1:
        found.append(
            f"slopes of the model up to {slope:.2g}: its elements leave their linear range; kappa/nu "
            f"= {scaling.kappa:.3g} is too large, or the beam too long, for this geometry.amplitude"
        )
    return found
