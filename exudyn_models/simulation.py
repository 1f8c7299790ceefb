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
from bent_beam.meshes import NodesMesh, checked_nodes, mirrored
from bent_beam.parts import describe
from exudyn_models.arrays import Array
from exudyn_models.assembly import assemble, stable_step
from exudyn_models.composition import Chosen, Composition
from exudyn_models.contacts import ContactRun
from exudyn_models.geometry import Shape
from exudyn_models.integrators.base import Segment
from exudyn_models.recording import Recorder
from exudyn_models.scaling import Scaling, front_bound
from exudyn_models.settling import Settling
from exudyn_models.solvers import quiet
from exudyn_models.stepping import Stepping, Until
from exudyn_models.viewer import open_viewer, wait_until_closed
from exudyn_models.warnings_of_run import warnings_of_run

__all__ = ["simulate"]

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
    progress : called with the fraction done.
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
    chosen = composition.chosen(impact, end)
    layout = _lay_out(impact, end, chosen, composition.full_beam)
    with quiet():
        system = _build(layout, chosen, not composition.full_beam, targets.size)
        done = _solve(system, targets, view, progress, until)
    if done.failure is not None and not system.run.record["time"]:
        raise SimulationError(done.failure, time=0.0, step=0, advice=done.advice)
    settings = {"end_time": end, "save": np.asarray(save).tolist(), "full_beam": composition.full_beam}
    settings |= _described(layout, chosen, system, end)
    settings["wall_seconds"] = clock.perf_counter() - began
    history = _history(impact, layout, system, done, settings, mesh_given=composition.mesh is not None)
    if done.failure is not None:
        raise SimulationError(
            done.failure, time=float(history.time[-1]), step=done.steps, advice=done.advice, history=history
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
    places = checked_nodes(mesh.nodes(half_length)) / unscaled.length
    scaling = Scaling.of(impact, end, geometry.amplitude_of(unscaled, float(places[-1])))
    nodes = mirrored(places) if full_beam else places
    return _Layout(half_length, places, scaling, geometry.shape(nodes, scaling, chosen.contact.wall_share(geometry)))


@dataclass(frozen=True)
class _System:
    """An Exudyn system with its solver. stable : the largest stable step of an explicit integrator, model units."""

    run: Recorder
    segments: list[Segment]
    stable: float
    settings: Any
    stepper: Any
    settling: Settling | None


def _build(layout: _Layout, chosen: Chosen, half: bool, instants: int) -> _System:
    """Beam, contact, steps and solver. Raises ``ValueError`` for more work than one run takes."""
    scaling, integrator, nodes = layout.scaling, chosen.integrator, layout.shape.s.size
    beam, contact = assemble(layout.shape, scaling, chosen.element, chosen.contact, integrator, half)
    run = Recorder(beam, contact, scaling, half, integrator.averages())
    stable = stable_step(beam, contact, integrator) if integrator.explicit else math.inf
    crossing = min(0.01, (layout.places[1] / front_bound(scaling.kappa)) ** 2)
    segments = integrator.segments(crossing, scaling.end_time, stable)
    affordable("exudyn.integrator and mesh", sum(s.steps for s in segments), nodes, instants, MOST_WORK)
    settings = chosen.solver.settings(scaling.amplitude, contact.round_off)
    integrator.configure(settings)
    stepper = integrator.solver()
    settling = None if integrator.explicit else _settling(contact, chosen, settings, stepper)
    return _System(run, segments, stable, settings, stepper, settling)


def _settling(contact: ContactRun, chosen: Chosen, settings: Any, stepper: Any) -> Settling | None:
    """The judge of the contact states of an implicit run (``None``: Exudyn does not repeat steps for them)."""
    if not contact.iterated:
        return None
    judged = settings.timeIntegration.discontinuous
    return Settling(
        contact, stepper, judged.maxIterations, judged.iterationTolerance, must_settle=chosen.solver.contact_must_settle
    )


def _solve(
    system: _System, targets: Array, view: bool, progress: Callable[[float], object] | None, until: Until | None
) -> Stepping:
    """Run all steps, watched where asked for. The Exudyn system is given up at the end."""
    mbs = system.run.beam.mbs
    container = mbs.variables["container"]
    done = Stepping(system.run, targets, system.settling, progress, until)
    viewing = view and open_viewer(container)
    try:
        done.through(system.segments, system.settings, system.stepper)
        if viewing:
            wait_until_closed(container)
        return done
    finally:
        if viewing:
            container.renderer.Stop()
        mbs.SetPostNewtonUserFunction(0)
        mbs.variables.clear()  # the container holds the system: break the circle


def _described(layout: _Layout, chosen: Chosen, system: _System, end: float) -> dict[str, Any]:
    """The parts and what was chosen with them, JSON-ready; times in s, lengths in m."""
    run, scaling = system.run, layout.scaling
    settings: dict[str, Any] = {name: describe(getattr(chosen, name)) for name in Composition.PARTS}
    settings["contact"] |= run.contact.settings()
    settings |= {
        "hold": run.hold(),
        "nodes": int(layout.shape.s.size),
        "modelled_half_length": float(layout.half_length),
        "amplitude": scaling.amplitude,
        "amplitude_of_the_real_beam": scaling.true_amplitude,
        "ends": "moment and shear of the free motion" if scaling.psi or scaling.chi else "free",
        "first_step": system.segments[0].length * end,
        "last_step": system.segments[-1].length * end,
    }
    if math.isfinite(system.stable):
        settings["stable_step"] = system.stable * end
    if system.settling is not None:
        settings |= {"contact_cycles": system.settling.cycles, "unsettled_steps": system.settling.unsettled}
    return settings


def _history(
    impact: Impact, layout: _Layout, system: _System, done: Stepping, settings: dict[str, Any], *, mesh_given: bool
) -> ImpactHistory:
    return system.run.history(
        impact=impact,
        warnings=warnings_of_run(
            system.run,
            layout.places,
            layout.half_length,
            given=mesh_given,
            last_step=system.segments[-1].length,
            settling=system.settling,
        ),
        steps=done.steps,
        seconds=done.seconds,
        completed=done.failure is None,
        settings=settings,
    )
