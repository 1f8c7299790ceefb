"""One impact by Exudyn, from the problem to its history.

    μ y_tt + EI y_xxxx = EI q₀ + μ a₀ − r,   0 ≤ r ⊥ −y ≥ 0                       (thesis 2.1.1–2)

The beam is modelled in the units of :mod:`exudyn_models.scaling`, with the initial shape, velocity field and load for
which, without contact, y₀ of :class:`bent_beam.Impact` is the motion.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from bent_beam import Impact, ImpactHistory, SimulationError
from bent_beam.checks import MOST_INSTANTS, affordable, whole
from bent_beam.fields import describe
from bent_beam.meshes import NodesMesh, checked_nodes, mirrored, snapped
from exudyn_models.arrays import Array
from exudyn_models.assembly import assemble, stable_step
from exudyn_models.composition import Composition
from exudyn_models.contacts import ContactRun
from exudyn_models.geometry import Shape
from exudyn_models.recording import Recorder
from exudyn_models.resolution import Chosen, choose
from exudyn_models.scaling import Scaling, front_bound
from exudyn_models.settling import Settling
from exudyn_models.solvers import quiet
from exudyn_models.stepping import Stepping, Until
from exudyn_models.viewer import open_viewer, wait_until_closed
from exudyn_models.warnings_of_run import warnings_of_run

__all__ = ["simulate"]

MOST_NODES = 200_000  # Exudyn takes 10 kB for each: 2 GB
MOST_WORK = 2e9  # steps x nodes: about an hour


def simulate(
    impact: Impact,
    *,
    end_time: float | None = None,
    save: int | Sequence[float] | Array = 200,
    view: bool = False,
    progress: Callable[[float], object] | None = None,
    until: Until | None = None,
    **parts: Any,
) -> ImpactHistory:
    """Simulate one impact with Exudyn.

    Parameters
    ----------
    impact : the problem (SI).
    end_time : s; None: 0.1 t*, but 0.01 T* at most.
    save : number of saved instants after t = 0, spread evenly in √t, or their times, s; snapped to steps.
    view : watch the run in Exudyn's viewer, until its window is told to go on (Q or Escape); without a display a line
        on standard error says so.
    progress : called with the fraction stepping.
    until : asked at every saved instant; the run ends with the first at which it says so.
    parts : mesh, element and so on, the fields of :class:`exudyn_models.composition.Composition`.

    Returns
    -------
    ImpactHistory with the fields of :mod:`bent_beam.history` in SI units. Sums (energies,
    ``total_impulse``) are of both halves of the modelled beam; a half model's ``impulse`` is that of x ≥ 0, half of
    the total.

    Raises
    ------
    ValueError : parts that cannot work together, an unstable explicit step, a beam that cannot be laid out.
    TypeError : a part of an unknown name.
    SimulationError : Exudyn's solver failed, contact states did not settle, or the state stopped being finite; carries
        the history up to there.
    """
    end = impact.checked_end_time(end_time)
    targets = _targets(save, end)
    composition = Composition(**parts)
    reason = composition.refuses(impact)
    if reason:
        raise ValueError(reason)
    began = clock.perf_counter()
    chosen, full_beam = choose(composition, impact, end), composition.full_beam or impact.off_centre
    layout = _lay_out(impact, end, chosen, full_beam)
    with quiet():
        stepping = _build(layout, chosen, not full_beam, targets)
        stepping.progress, stepping.until = progress, until
        _solve(stepping, view)
    if stepping.failure is not None and not stepping.run.record["time"]:
        raise SimulationError(stepping.failure, time=0.0, step=0, advice=stepping.advice)
    settings = {"end_time": end, "save": np.asarray(save).tolist(), "full_beam": full_beam}
    settings |= _described(layout, chosen, stepping)
    settings["wall_seconds"] = clock.perf_counter() - began
    history = _history(impact, layout, stepping, settings, mesh_given=composition.mesh is not None)
    if stepping.failure is not None:
        raise SimulationError(
            stepping.failure, time=float(history.time[-1]), step=stepping.steps, advice=stepping.advice, history=history
        )
    return history


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


@dataclass(frozen=True)
class _Layout:
    """The beam at the first contact.

    half_length : modelled, m; places : nodes of the half beam, Λ, shape (nodes of the half beam,);
    shape : of all modelled nodes.
    """

    half_length: float
    places: Array
    scaling: Scaling
    shape: Shape


def _lay_out(impact: Impact, end: float, chosen: Chosen, full_beam: bool) -> _Layout:
    mesh, geometry, half_length = chosen.mesh, chosen.geometry, impact.half_length
    if isinstance(mesh, NodesMesh) and mesh.places[-1] <= half_length * (1.0 + 1e-9):
        half_length = mesh.places[-1]
    unscaled = Scaling.of(impact, end)
    places = checked_nodes(snapped(mesh.nodes(half_length), impact.wall_span)) / unscaled.length
    scaling = Scaling.of(impact, end, geometry.amplitude_of(unscaled, float(places[-1])))
    nodes = mirrored(places) if full_beam else places
    return _Layout(half_length, places, scaling, geometry.shape(nodes, scaling, chosen.contact.wall_share(geometry)))


def _build(layout: _Layout, chosen: Chosen, half: bool, targets: Array) -> Stepping:
    """Beam, contact, steps and solver. Raises ``ValueError`` for more work than one run takes."""
    scaling, integrator, nodes = layout.scaling, chosen.integrator, layout.shape.s.size
    if nodes > MOST_NODES:
        raise ValueError(f"mesh: {nodes} nodes on the Exudyn path, {MOST_NODES} are the most (memory); larger elements")
    beam, contact = assemble(layout.shape, scaling, chosen.element, chosen.contact, integrator, half, chosen.plastic)
    run = Recorder(beam, contact, scaling, half, integrator.averages())
    stable = stable_step(beam, contact, integrator) if integrator.explicit else math.inf
    crossing = min(0.01, (layout.places[1] / front_bound(scaling.kappa)) ** 2)
    segments = integrator.segments(crossing, scaling.end_time, stable)
    affordable("exudyn.integrator and mesh", sum(s.steps for s in segments), nodes, targets.size, MOST_WORK)
    settings = chosen.solver.settings(scaling.amplitude, max(contact.round_off, beam.round_off(scaling.amplitude)))
    integrator.configure(settings)
    solver = integrator.solver()
    settling = None if integrator.explicit else _settling(contact, chosen, settings, solver)
    return Stepping(run, segments, stable, settings, solver, settling, targets)


def _settling(contact: ContactRun, chosen: Chosen, settings: Any, solver: Any) -> Settling | None:
    """The judge of the contact states of an implicit run (``None``: Exudyn does not repeat steps for them)."""
    if not contact.iterated:
        return None
    judged = settings.timeIntegration.discontinuous
    return Settling(
        contact, solver, judged.maxIterations, judged.iterationTolerance, must_settle=chosen.solver.contact_must_settle
    )


def _solve(stepping: Stepping, view: bool) -> None:
    """Take all steps, watched where asked for. The Exudyn system is given up at the end."""
    mbs = stepping.run.beam.mbs
    container = mbs.variables["container"]
    viewing = view and open_viewer(container)
    try:
        stepping.through()
        if viewing:
            wait_until_closed(container)
    finally:
        if viewing:
            container.renderer.Stop()
        mbs.SetPostNewtonUserFunction(0)
        mbs.variables.clear()  # the container holds the system: break the circle


def _described(layout: _Layout, chosen: Chosen, stepping: Stepping) -> dict[str, Any]:
    """The parts and what was chosen with them, JSON-ready; times in s, lengths in m."""
    run, scaling, end = stepping.run, layout.scaling, layout.scaling.end_time
    settings: dict[str, Any] = {name: describe(getattr(chosen, name)) for name in Composition.PARTS}
    settings["contact"] |= run.contact.settings()
    settings |= {
        "hold": run.hold(),
        "nodes": int(layout.shape.s.size),
        "modelled_half_length": float(layout.half_length),
        "amplitude": scaling.amplitude,
        "amplitude_of_the_real_beam": scaling.true_amplitude,
        "ends": "moment and shear of the free motion" if any(scaling.loads.terms.values()) else "free",
        "first_step": stepping.segments[0].length * end,
        "last_step": stepping.segments[-1].length * end,
    }
    if math.isfinite(stepping.stable):
        settings["stable_step"] = stepping.stable * end
    if stepping.settling is not None:
        settings |= {"contact_cycles": stepping.settling.cycles, "unsettled_steps": stepping.settling.unsettled}
    return settings


def _history(
    impact: Impact, layout: _Layout, stepping: Stepping, settings: dict[str, Any], *, mesh_given: bool
) -> ImpactHistory:
    return stepping.run.history(
        impact=impact,
        warnings=warnings_of_run(
            stepping.run,
            layout.places,
            layout.half_length,
            given=mesh_given,
            last_step=stepping.segments[-1].length,
            settling=stepping.settling,
        ),
        steps=stepping.steps,
        seconds=stepping.seconds,
        completed=stepping.failure is None,
        settings=settings,
    )
