"""One impact by Exudyn, from the problem to its history.

    μ y_tt + EI y_xxxx = EI q₀ + μ a₀ − r,   0 ≤ r ⊥ −y ≥ 0                       (thesis 2.1.1–2)

The beam is modelled in the units of :mod:`exudyn_models.scaling`, with the initial shape, velocity field and load for
which, without contact, y₀ of :class:`bent_beam.Impact` is the motion.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from bent_beam import Impact, ImpactHistory, SimulationError
from bent_beam.checks import MOST_INSTANTS, affordable, one_of, whole
from bent_beam.meshes import Mesh, NodesMesh, checked_nodes, mirrored
from bent_beam.parts import describe
from exudyn_models.assembly import assemble, stable_step
from exudyn_models.contacts import Contact, Penalty
from exudyn_models.elements import ANCFCable, Element
from exudyn_models.geometry import GEOMETRIES, Geometry
from exudyn_models.integrators import Integrator
from exudyn_models.recording import Recorder
from exudyn_models.resolution import refined_choice
from exudyn_models.scaling import Scaling, front_bound
from exudyn_models.settling import Settling
from exudyn_models.solvers import NewtonSolver, quiet
from exudyn_models.stepping import step_through
from exudyn_models.viewer import open_viewer, wait_until_closed
from exudyn_models.warnings_of_run import warnings_of_run

__all__ = ["refusal", "simulate"]

Array = NDArray[np.float64]

MOST_WORK = 2e9  # steps x nodes: about an hour


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


def refusal(impact: Impact, full_beam: bool) -> str | None:
    """Why the model cannot take an impact (``None``: it can)."""
    asymmetry = next((name for name in ("rotation", "first_touch") if getattr(impact, name)), None)
    if asymmetry is None:
        return None
    if not full_beam:
        return f"{asymmetry} needs exudyn.full_beam = true (got {getattr(impact, asymmetry)!r})"
    for name in ("curvature_rate", "fourth_derivative", "axial_force"):
        if getattr(impact, name):
            return f"{name} is not modelled together with {asymmetry} (got {getattr(impact, name)!r})"
    return None


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
    refine: float = 1.0,
    save: int | Sequence[float] | Array = 200,
    view: bool = False,
    progress: Callable[[float], object] | None = None,
    until: Callable[[Recorder, float, Array, Array], bool] | None = None,
) -> ImpactHistory:
    """Simulate one impact with Exudyn.

    Parameters
    ----------
    impact : the problem (SI).
    end_time : s; None: 0.1 t*, but 0.01 T* at most.
    mesh : of the half beam, laid over the whole half length (a ``NodesMesh`` may end short of it); None: elements in
        proportion to the distance from the centre, as far out as waves travel, or uniform ones where waves are back
        from the ends before the end time (:func:`chosen_mesh`).
    element, integrator, contact, geometry, solver : parts of :class:`exudyn_models.ExudynModel`; None: ANCF cable,
        generalised-α, nodal penalty, the linear limit, modified Newton. ``geometry`` may be "linear" or "true".
    full_beam : model both halves instead of x ≥ 0 with the slope fixed at x = 0.
    refine : elements and steps so many times finer than the parts say.
    save : number of saved instants after t = 0, spread evenly in √t, or their times, s; snapped to steps.
    view : watch the run in Exudyn's viewer, until its window is told to go on (Q or Escape); without a display a line
        on standard error says so.
    progress : called with the fraction done.
    until : asked at every saved instant; the run ends with the first at which it says so.

    Returns
    -------
    ImpactHistory with the fields of :mod:`bent_beam.history` in SI units. Sums (energies,
    ``total_impulse``) are of both halves of the modelled beam; a half model's ``impulse`` is that of x ≥ 0, half of
    the total.

    Raises
    ------
    ValueError : parts that cannot work together, an unstable explicit step, a beam that cannot be laid out.
    SimulationError : Exudyn's solver failed, contact states did not settle, or the state stopped being finite; carries
        the history up to there.
    """
    end = impact.checked_end_time(end_time)
    targets = _targets(save, end)
    element = ANCFCable() if element is None else element
    contact = Penalty() if contact is None else contact
    open_steps = integrator is None
    integrator = contact.integrator() if integrator is None else integrator
    solver = contact.solver() if solver is None else solver
    if geometry is None:
        geometry = contact.geometry()
    elif isinstance(geometry, str):
        geometry = cast(Geometry, GEOMETRIES[one_of("geometry", geometry, GEOMETRIES)]())
    reason = refusal(impact, full_beam) or contact.refuses(impact, element, integrator)
    if not reason and geometry.true and impact.off_centre:
        reason = "exudyn.geometry.kind true knows the symmetric bow only: with rotation or first_touch take linear"
    if reason:
        raise ValueError(reason)

    began = clock.perf_counter()
    laid, integrator = refined_choice(mesh, integrator, impact, end, open_steps=open_steps, refine=refine)
    half_length = impact.half_length
    if isinstance(laid, NodesMesh) and laid.places[-1] <= half_length * (1.0 + 1e-9):
        half_length = laid.places[-1]
    unscaled = Scaling(impact, end, 1.0)
    places = checked_nodes(laid.nodes(half_length)) / unscaled.length
    scaling = Scaling(impact, end, geometry.amplitude_of(unscaled, float(places[-1])))
    nodes = mirrored(places) if full_beam else places
    shape = geometry.shape(nodes, scaling, contact.wall_share(geometry))
    half = not full_beam

    with quiet():
        beam, contact_run = assemble(shape, scaling, element, contact, integrator, half)
        run = Recorder(beam, contact_run, scaling, half, integrator.averages())
        stable = stable_step(beam, contact_run, integrator) if integrator.explicit else math.inf
        crossing = min(0.01, (places[1] / front_bound(scaling.kappa)) ** 2)
        segments = integrator.segments(crossing, end, stable)
        affordable("exudyn.integrator and mesh", sum(s.steps for s in segments), nodes.size, targets.size, MOST_WORK)
        settings = solver.settings(scaling.amplitude, contact_run.round_off)
        integrator.configure(settings)
        container, time_stepper = beam.mbs.variables["container"], integrator.solver()
        settling = None
        if contact_run.iterated and not integrator.explicit:
            judged = settings.timeIntegration.discontinuous
            settling = Settling(
                contact_run,
                time_stepper,
                judged.maxIterations,
                judged.iterationTolerance,
                must_settle=solver.contact_must_settle,
            )
        viewing = view and open_viewer(container)
        try:
            done = step_through(run, segments, settings, time_stepper, settling, targets, progress, until)
            if viewing:
                wait_until_closed(container)
        finally:
            if viewing:
                container.renderer.Stop()
            beam.mbs.SetPostNewtonUserFunction(0)
            beam.mbs.variables.clear()  # the container holds the system: break the circle

    if done.failure is not None and not run.record.time:
        raise SimulationError(done.failure, time=0.0, step=0, advice=done.advice)
    last_step = segments[-1].length
    about: dict[str, Any] = {
        "impact": impact,
        "warnings": warnings_of_run(run, places, half_length, scaling, mesh is not None, last_step, settling),
        "steps": done.steps,
        "seconds": done.seconds,
        "completed": done.failure is None,
        "settings": {
            "end_time": end,
            "save": np.asarray(save).tolist(),
            "mesh": describe(laid),
            "element": describe(element),
            "integrator": describe(integrator),
            "contact": describe(contact) | contact_run.settings(),
            "geometry": describe(geometry),
            "solver": describe(solver),
            "hold": run.hold(),
            "full_beam": full_beam,
            "nodes": int(nodes.size),
            "modelled_half_length": float(half_length),
            "amplitude": scaling.amplitude,
            "amplitude_of_the_real_beam": scaling.true_amplitude,
            "ends": "moment and shear of the free motion" if scaling.psi or scaling.chi else "free",
            "first_step": segments[0].length * end,
            "last_step": last_step * end,
            "wall_seconds": clock.perf_counter() - began,
        },
    }
    if math.isfinite(stable):
        about["settings"]["stable_step"] = stable * end
    if settling is not None:
        about["settings"]["contact_cycles"] = settling.cycles
        about["settings"]["unsettled_steps"] = settling.unsettled
    history = run.history(**about)
    if done.failure is not None:
        raise SimulationError(
            done.failure, time=float(history.time[-1]), step=done.steps, advice=done.advice, history=history
        )
    return history
