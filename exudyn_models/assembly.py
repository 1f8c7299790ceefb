"""The Exudyn system of one impact: beam, loads, supports and contact; and how long a step it bears.

The ends carry the moment EI(q₀x²/2 + c₀t) and the shear EI q₀x of y₀ (nothing when ψ = χ = 0: a free end), so that
without contact y₀ of :class:`bent_beam.Impact` is the motion. A hinge holds y of the end's node where it is at the
first touch, a clamp y and the rotation, by Exudyn's ``CoordinateConstraint``. Along the beam every end is free:
supports that held both would make a string of it.
"""

import math
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import exudyn.graphics as graphics
import exudyn.itemInterface as items
import numpy as np

from bent_beam import Impact
from bent_beam.errors import InputError
from bent_beam.impact import BEFORE_WAVES_RETURN
from bent_beam.meshes import Mesh, checked_nodes, mirrored, node_at, snapped
from exudyn_models.contacts import Contact, ContactRun, Wall
from exudyn_models.elements import Beam, Element
from exudyn_models.elements.beam import VISCOSITY, VISCOSITY_EXPLICIT, VISCOSITY_SHEARED
from exudyn_models.geometry import STEEPEST, Array, Geometry, Scaling, Shape, Units, element_times, supports_or_plate
from exudyn_models.integrators import Integrator
from exudyn_models.resolution import THIN, lasts_until_waves_return, modelled_half_length, reachable
from exudyn_models.solvers import NewtonSolver

MODELLED = ("acceleration", "curvature_rate", "fourth_derivative", "axial_force", "rotation", "shear_stiffness",
            "wall_stiffness", "wall_damping", "wall_from", "wall_to", "left_end", "right_end")  # fmt: skip
"""The loads and other features that are modelled here."""

STRETCH = 1e-4  # largest strain under the axial force in the linear limit: lengths are then right to as much
TAUT = 1e4  # EAΛ²/EI under it: the stretch then moves the front by 7e-4 of what the force itself does (κ/ν = 0.5)
STRETCH_LATER = 1e-6  # likewise once waves are back: with 1e-4 the impulse is 8e-4 off, with 1e-7 round-off shows
NEAR = 1e-9  # of the half length: a place so near the end lies there
GREY = [0.35, 0.35, 0.35, 1.0]


@dataclass(frozen=True)
class Chosen:
    """The parts of one run, none of them open.

    plastic : share of the damping that takes rebounds at a thin front, 0 to 1; mesh_given : whether somebody
        asked for the mesh.
    """

    mesh: Mesh
    element: Element
    integrator: Integrator
    contact: Contact
    geometry: Geometry
    solver: NewtonSolver
    full_beam: bool
    plastic: float
    mesh_given: bool


@dataclass(frozen=True)
class Layout:
    """The beam at the first contact.

    half_length : modelled, m; places : nodes of the half beam, Λ, shape (nodes of the half beam,);
    shape : of all modelled nodes.
    """

    half_length: float
    places: Array
    scaling: Scaling
    shape: Shape

    @property
    def ends_follow(self) -> bool:
        """Whether the ends bear the moment and shear of the free motion y₀: where the model cuts the beam, and in runs
        that end before waves from the beam's own ends have time to return."""
        free = lasts_until_waves_return(self.scaling.impact, self.scaling.end_time)  # of a beam that is not cut
        return any(self.scaling.loads.terms.values()) and not free


def lay_out(impact: Impact, end: float, chosen: Chosen) -> Layout:
    """The beam of the chosen mesh and geometry. Raises ``ValueError`` for a mesh or a geometry that does not fit."""
    geometry, half_length, unscaled = chosen.geometry, modelled_half_length(chosen.mesh, impact), Scaling(impact, end)
    if half_length < impact.half_length * (1.0 - NEAR) and lasts_until_waves_return(impact, end):
        raise InputError(
            f"mesh.places must end at the half length {impact.half_length!r} in a run that lasts until waves are back "
            f"from the ends (got {half_length!r})"
        )
    places = checked_nodes(snapped(chosen.mesh.nodes(half_length), impact.places)) / unscaled.length
    scaling = Scaling(impact, end, geometry.amplitude_of(unscaled, float(places[-1])))
    nodes = mirrored(places) if chosen.full_beam else places
    return Layout(half_length, places, scaling, geometry.shape(nodes, scaling, chosen.contact.wall_share(geometry)))


def assemble(layout: Layout, chosen: Chosen, *, si: bool = False) -> tuple[Beam, ContactRun]:
    """The Exudyn system: beam, loads, symmetry, supports, contact. Numbers of its items are in model units, or SI."""
    shape, scaling, explicit = layout.shape, layout.scaling, chosen.integrator.explicit
    container = exu.SystemContainer()
    system = container.AddSystem()
    system.variables["container"] = container  # the system must not outlive it
    factor: Any = chosen.element.viscosity
    if factor is None:
        implicit = np.where(shape.lengths < scaling.shear_length, VISCOSITY_SHEARED, VISCOSITY)
        factor = VISCOSITY_EXPLICIT if explicit else implicit
    viscosity = factor * element_times(shape.lengths, scaling.shear_length)
    axial_stiffness = _axial_stiffness(chosen.element.axial_stiffness, shape.slender, scaling)
    newtons = scaling.impact.bending_stiffness / scaling.length**2
    units = Units(scaling.length, scaling.end_time, newtons) if si else Units()
    beam = chosen.element.beam(system, shape, scaling, axial_stiffness, viscosity, units)
    hold = beam.hold_by_inertia if explicit else beam.fix
    across, turning = beam.vertical_coordinate, beam.rotation_coordinate
    held = {"free": (), "hinged": (across,), "clamped": (across, turning)}
    ends = [(shape.s.size - 1, 1.0, scaling.impact.right_end)]
    if chosen.full_beam:
        ends.insert(0, (0, -1.0, scaling.impact.left_end))
    else:
        hold(0, beam.horizontal_coordinate, turning)
    for node, _, end in ends:
        if held[end]:
            hold(node, *held[end])
    if scaling.load:
        beam.load_uniformly(scaling.load * scaling.amplitude)
    share = 1.0 if chosen.full_beam else 0.5  # half a beam takes half of a force in the middle
    for place, force in scaling.impact.forces:
        node = node_at(shape.s * scaling.length, place)
        beam.load_node(node, across, share * force * scaling.end_time / scaling.impulse)
    for node, sign, _ in reversed(ends):
        _load_end(beam, node, sign, follows=layout.ends_follow)
    run = chosen.contact.attach(beam, _wall(beam, chosen))
    x = np.linspace(min(0.0, float(shape.x[0])), float(shape.x[-1]), 200)
    wall = shape.wall_curvature * (x - shape.first_touch) ** 2 / 2
    line = np.stack([x, wall, np.zeros_like(x)], axis=1) * units.length
    seen = items.VObjectGround(graphicsData=[graphics.Lines(line.tolist(), color=GREY)])
    system.AddObject(items.ObjectGround(visualization=seen))
    system.Assemble()
    assert system.GetNodeODE2Index(beam.nodes[-1]) == beam.horizontal[-1]  # numbered node by node
    return beam, run


def _axial_stiffness(asked: float | None, true: bool, scaling: Scaling) -> float:
    """EA in EI/Λ². In the linear limit it matters under an axial force only."""
    if asked is not None:
        return asked * scaling.length**2 / scaling.impact.bending_stiffness
    if true:
        return 12.0 * (scaling.length / scaling.impact.section_height) ** 2
    if not scaling.axial_force:
        # in proportion to the amplitude, like the tolerance of forces: this stays above the round-off of strains
        return min(1.0, scaling.amplitude / STEEPEST)
    later = lasts_until_waves_return(scaling.impact, scaling.end_time)
    return max(TAUT, abs(scaling.axial_force) / (STRETCH_LATER if later else STRETCH))


def _wall(beam: Beam, chosen: Chosen) -> Wall:
    scaling, s, explicit = beam.scaling, beam.shape.s, chosen.integrator.explicit
    impact = scaling.impact
    centre, before = int(np.argmin(np.abs(s))), impact.before_wall(s * scaling.length)
    free = before & ((s > s[0]) | (s[0] == 0.0) | (impact.left_end == "free"))
    free &= (s < s[-1]) | (impact.right_end == "free")
    lengths = np.where(before[1:] & before[:-1], np.diff(s), 0.0)
    waves_return = BEFORE_WAVES_RETURN * impact.slow_time_scale / scaling.end_time
    # a material that damps waves at grid scale makes hits plastic itself: more would stop nodes ahead of the wall
    damped = scaling.material_damping > VISCOSITY * element_times(beam.lengths, scaling.shear_length).min()
    thin = scaling.kappa < THIN and not supports_or_plate(impact) and not damped
    opposite, stiffness = impact.opposite_wall, impact.wall_stiffness
    unit = impact.bending_stiffness / scaling.length ** (4 if lengths.any() else 3)
    return Wall(
        nodes=np.intersect1d(reachable(s, scaling, centre), np.flatnonzero(free)),
        lengths=lengths,
        centre=centre,
        half=not chosen.full_beam,
        waves_return=waves_return,
        plastic=chosen.plastic if thin and waves_return >= 1.0 and not explicit else 0.0,
        lifts=impact.lifts or beam.shears or impact.damping > 0.0 or impact.kappa_over_nu >= 1.0,
        explicit=explicit,
        opposite=None if opposite is None else -opposite / scaling.deflection,
        stiffness=None if stiffness is None else stiffness / unit,
        damping=impact.wall_damping / (unit * scaling.end_time),
    )


def _load_end(beam: Beam, node: int, sign: float, *, follows: bool) -> None:
    """The moment and shear of the free motion y₀ if the end ``follows`` it, and the axial force: along x at the end of
    the beam itself unless it follows the bow, along the bow where the model cuts the beam."""
    scaling, x = beam.scaling, float(beam.shape.s[node])
    loads, a, force = scaling.loads, scaling.amplitude, scaling.axial_force
    impact, angle = scaling.impact, float(beam.shape.angle[node])  # of the beam's own end
    shear = turning = 0.0
    if follows:
        bending_rate = a * float(loads(x, by_x=2, by_t=1))
        # bending at a rate also takes the moment of the viscosity
        moment = a * float(loads(x, by_x=2) + scaling.shear_length**2 * loads(x, by_x=4))
        moment += beam.viscosity[node if node == 0 else -1] * bending_rate
        beam.load_node(node, beam.rotation_coordinate, sign * moment, sign * bending_rate)
        shear, turning = a * float(loads(x, by_x=3)), a * float(loads(x, by_x=1, by_t=1))
    if impact.tension_direction == "axis" and abs(x) * scaling.length >= impact.half_length * (1.0 - NEAR):
        angle = turning = 0.0
    beam.load_node(node, beam.horizontal_coordinate, sign * force * math.cos(angle))
    beam.load_node(node, beam.vertical_coordinate, sign * (force * math.sin(angle) - shear), sign * force * turning)


def settings_of(chosen: Chosen, beam: Beam, contact: ContactRun) -> Any:
    """Exudyn's settings of a run in model units, but for its steps; no tolerance is below round-off."""
    amplitude = beam.scaling.amplitude
    round_off = max(contact.round_off, beam.round_off(amplitude))
    settings = chosen.solver.settings(amplitude, round_off, beam.axial_round_off())
    chosen.integrator.configure(settings)
    return settings


def stable_step(beam: Beam, contact: ContactRun, integrator: Integrator) -> float:
    """limit/ω, ω the largest eigenvalue of any element with its contact closed: a bound for the whole mesh. Implicit
    integrators have none."""
    if not integrator.explicit:
        return math.inf
    mass, stiffness, damped = beam.element_matrices()
    damping = beam.viscosity[:, None, None] * damped
    k, d = contact.stiffness_and_damping()
    for end in (0, 1):
        node = slice(end, beam.lengths.size + end)
        share = beam.lengths / 2 / beam.tributary[node]
        stiffness[:, 2 * end, 2 * end] += k[node] * share
        damping[:, 2 * end, 2 * end] += d[node] * share
    state = np.zeros((len(mass), 8, 8))
    state[:, :4, 4:] = np.eye(4)
    state[:, 4:, :4], state[:, 4:, 4:] = -np.linalg.solve(mass, stiffness), -np.linalg.solve(mass, damping)
    largest = float(np.abs(np.linalg.eigvals(state)).max())
    # of a free cubic element, 170.1; a linear one: 12
    axial = math.sqrt(171.0 * beam.axial_stiffness) / beam.lengths.min()
    return float(integrator.limit / max(largest, axial))
