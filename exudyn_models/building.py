"""The impact as an Exudyn system in SI units, to be integrated by Exudyn alone: ``build``.

    model = exudyn_models.build(Impact.dimensionless(0.5))
    model.mbs.SolveDynamic(model.settings)
    model.mbs.PlotSensor(model.sensors["impulse"])

What :func:`exudyn_models.simulate` does on top of the same items, and what each buys:

- the contact state of a step is judged by what its solution assumed (:mod:`exudyn_models.settling`): a dashpot that
  never pulls. λ₀ and r₀ do not need it; the energy of a whole impact closes to 4e-10 instead of 3e-3;
- steps grow with the time since impact, elements with the distance from the middle: a thousand steps for any number of
  decades. Here both are equal, which resolves the last decade and what it needs of those before;
- steps of a damped whole beam off the wall grow with its gap: its impact takes a quarter of the time;
- captured nodes are held for the first hundredth of the run, or by ``hold`` elements: here D = 40 quiets them;
- dashpots of a damped wall act on the length that is covered: here on all of a node's share, 2.4 % more force at
  ζ = 1 on elements of 0.08 ℓ_k;
- constraints are switched between steps, which no item of Exudyn does: here ``Rigid`` is refused;
- model units, in which one tolerance fits a beam of any size; energies, moments and their balances; warnings.
"""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import exudyn.itemInterface as items
import numpy as np

from bent_beam.checks import MOST_INSTANTS, affordable, between, whole
from bent_beam.errors import InputError
from bent_beam.impact import Impact, checked_impact
from bent_beam.meshes import NodesMesh, ScaleFreeMesh
from exudyn_models.assembly import Chosen, assemble, lay_out, settings_of, stable_step
from exudyn_models.contacts import ContactRun, Penalty, Rigid
from exudyn_models.elements import Beam
from exudyn_models.geometry import Array, Scaling, supports_or_plate
from exudyn_models.integrators import Implicit
from exudyn_models.method import ExudynModel
from exudyn_models.resolution import GROWTH_OF_WAVES, chosen_half_length, lasts_until_waves_return
from exudyn_models.segments import Segment
from exudyn_models.stepping import MOST_WORK

ELEMENTS_OF_ZONE = 100.0  # equal elements up to the front's bound, …
BEYOND_ZONE = 1.2  # … and so much further. With D = 40 r₀ is within 0.03 % for κ/ν from 0.1 to 0.9
EQUAL_STEPS = 1500
SETTLED = 5  # repetitions of a step, Exudyn's default: by its judgement hundreds would not settle more
QUIET = Penalty(relative_damping=40.0, hold_start=0.0)


@dataclass(frozen=True)
class Built:
    """An Exudyn system of one impact, assembled, and what integrates it.

    mbs, settings : for ``mbs.SolveDynamic(settings)``; container : the ``SystemContainer``, for the renderer.
    scale : deflections, velocities and forces in ``mbs`` over those of the impact. 1 with the true geometry; small in
        the linear limit, whose slopes must be. The sensors are of the impact itself.
    sensors : numbers by name: ``force`` (N) and, with free ends, ``impulse`` (N s) of the wall on the whole beam,
        ``midpoint`` (m towards the wall, m/s), ``energy`` (J: kinetic, strain, of the contact's springs). They read
        parts and loads as they were built: another contact is another ``build``; beside a load of your own ``force``
        alone is the wall's. ``container.Reset()`` frees what a system holds, some MB.
    nodes, bodies, contacts : Exudyn's item numbers, from the middle (or the left end) on.
    """

    mbs: Any
    settings: Any
    container: Any
    scale: float
    sensors: dict[str, int]
    nodes: list[Any]
    bodies: list[Any]
    contacts: list[Any]


def build(
    impact: Impact, *, end_time: float | None = None, save: int = 200, file: str | None = None, **parts: Any
) -> Built:
    """Lay ``impact`` out in Exudyn's items, in SI units, for plain ``SolveDynamic``.

    end_time : s; None: 0.1 t*, but 0.01 T* at most.
    save : values of each sensor, evenly spread.
    file : where Exudyn writes its solution, for its ``SolutionViewer``; None: nowhere.
    parts : as those of :func:`exudyn_models.simulate`. What is left out has equal elements and steps; in a run that
        lasts until waves are back from the ends it is that of the whole beam.

    Raises ``ValueError`` as :func:`exudyn_models.simulate`, and for what only its stepping can do.
    """
    end, method = checked_impact(impact).checked_end_time(end_time), ExudynModel(**parts)
    between("save", whole("save", save, 1), 1, MOST_INSTANTS)
    if reason := method.refuses(impact) or _refused(method):
        raise InputError(reason)
    chosen = _chosen(method, impact, end)
    layout = lay_out(impact, end, chosen)
    beam, contact = assemble(layout, chosen, si=True)
    settings = _settings(chosen, beam, contact, save)
    affordable("exudyn.integrator and mesh", settings.timeIntegration.numberOfSteps, len(beam.nodes), save, MOST_WORK)
    if file is not None:
        settings.solution.file.write, settings.solution.file.name = True, file
    sensors = _sensors(beam, contact, 1.0 if chosen.full_beam else 2.0)
    beam.mbs.Assemble()  # what was added since
    return Built(
        mbs=beam.mbs,
        settings=settings,
        container=beam.mbs.variables["container"],
        scale=layout.scaling.amplitude / layout.scaling.true_amplitude,
        sensors=sensors,
        nodes=beam.nodes,
        bodies=beam.bodies,
        contacts=contact.connectors,
    )


def _refused(method: ExudynModel) -> str | None:
    contact = method.contact
    for name in ("relative_step", "flight_step"):
        if (grows := getattr(method.integrator, name, None)) is not None:
            return f"exudyn.integrator.{name}: steps of build are equal, give time_step (got {grows!r})"
    if isinstance(contact, Rigid):
        return "exudyn.contact.kind rigid is switched between steps: use simulate, or take penalty to build"
    if isinstance(contact, Penalty) and (contact.hold or contact.hold_start):
        return "exudyn.contact.hold and hold_start are switched between steps: use simulate, or leave them out to build"
    repeated, must = (getattr(method.solver, f"contact_{name}", None) for name in ("iterations", "must_settle"))
    if must is not None or (repeated or 0) > SETTLED:
        return (
            f"exudyn.solver: build repeats a step {SETTLED} times at most and judges none: leave contact_must_settle "
            f"and larger contact_iterations out (got {method.solver!r})"
        )
    return None


def _chosen(method: ExudynModel, impact: Impact, end: float) -> Chosen:
    """The parts, none open; steps are equal."""
    if supports_or_plate(impact) or lasts_until_waves_return(impact, end):
        return method.for_whole_beam(impact).chosen(impact, end)
    if impact.wall_stiffness is not None:
        return method.chosen(impact, end)
    explicit = method.integrator is not None and method.integrator.explicit
    mesh = method.mesh if explicit else method.mesh or _equal_elements(impact, end)
    contact = method.contact or (Penalty(hold_start=0.0) if explicit or impact.shear_stiffness is not None else QUIET)
    integrator = method.integrator or contact.integrator
    if isinstance(integrator, Implicit) and integrator.is_open:
        integrator = dataclasses.replace(integrator, time_step=end / EQUAL_STEPS)
    return dataclasses.replace(method, mesh=mesh, integrator=integrator, contact=contact).chosen(impact, end)


def _equal_elements(impact: Impact, end: float) -> NodesMesh:
    scaling = Scaling(impact, end)
    front = scaling.front * scaling.length
    rule = ScaleFreeMesh(front / ELEMENTS_OF_ZONE, 1.0, zone=BEYOND_ZONE * front, growth_outside=1.0 + GROWTH_OF_WAVES)
    return NodesMesh(tuple(rule.nodes(chosen_half_length(impact, end)).tolist()))


def _settings(chosen: Chosen, beam: Beam, contact: ContactRun, save: int) -> Any:
    """Exudyn's settings: steps, integrator, and tolerances that are forces, as small as the deflections are."""
    units, end = beam.units, beam.scaling.end_time
    settings = settings_of(chosen, beam, contact)
    time, stable = settings.timeIntegration, stable_step(beam, contact, chosen.integrator)
    Segment(0.0, end, chosen.integrator.segments(1.0, end, stable)[0].steps).lay(time)
    time.newton.absoluteTolerance *= units.force * max(1.0, units.length)  # some residuals are moments
    time.discontinuous.iterationTolerance *= units.force
    time.discontinuous.maxIterations = min(SETTLED, time.discontinuous.maxIterations)
    settings.solution.sensors.active = True
    settings.solution.sensors.writePeriod = settings.solution.file.writePeriod = end / save
    return settings


def _sensors(beam: Beam, contact: ContactRun, copies: float) -> dict[str, int]:
    """Sensors of the real impact, each a function of the system's state."""
    mbs, units, scaling = beam.mbs, beam.units, beam.scaling
    lengths = np.ones(beam.size)  # of each coordinate: slopes have none
    lengths[beam.horizontal] = lengths[beam.vertical] = units.length
    middle = beam.vertical[int(np.argmin(np.abs(beam.shape.s)))]

    def state() -> tuple[Array, Array]:
        q, v = mbs.systemData.GetODE2Coordinates(), mbs.systemData.GetODE2Coordinates_t()
        return q[: beam.size] / lengths, v[: beam.size] * units.time / lengths

    at_first = float(state()[1] @ beam.momentum)

    def force() -> list[float]:
        return [float(contact.plain_forces(*state()).sum()) * copies * scaling.impulse / scaling.end_time]

    def impulse() -> list[float]:
        t = mbs.systemData.GetTime() / units.time
        of_loads = beam.loads(np.array([0.0, t])).mean(axis=0) @ beam.upward * t  # linear in time
        return [float(at_first + of_loads - state()[1] @ beam.momentum) * copies * scaling.impulse]

    def midpoint() -> list[float]:
        q, v = state()
        return [float(q[middle]) * scaling.deflection, float(v[middle]) * scaling.velocity]

    def energy() -> list[float]:
        q, v = state()
        found = beam.kinetic_energy(v), beam.strain_energy(q), contact.stored_energy(q)
        return [float(one) * copies * scaling.energy for one in found]

    def sensor(read: Callable[[], list[float]]) -> int:
        asked: dict[str, Any] = {"name": read.__name__, "sensorUserFunction": lambda *_: read(), "storeInternal": True}
        return int(mbs.AddSensor(items.SensorUserFunction(**asked)))

    reads = (force, midpoint, energy) if scaling.impact.supported else (force, impulse, midpoint, energy)
    return {read.__name__: sensor(read) for read in reads}
