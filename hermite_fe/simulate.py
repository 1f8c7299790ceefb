"""Simulate an impact and return its history."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import positive
from bent_beam.errors import SimulationError
from bent_beam.history import ImpactHistory
from bent_beam.impact import FIRST_SPREAD, Impact
from bent_beam.meshes import Mesh
from bent_beam.parts import describe
from hermite_fe import resolution
from hermite_fe.contacts import Contact
from hermite_fe.far_fields import FarField, GridViscosity
from hermite_fe.integrators import Integrator
from hermite_fe.masses import Mass
from hermite_fe.model import BeamModel, beam_model
from hermite_fe.run import Stepper, Trajectory, integrate

__all__ = ["refusal", "simulate"]

LARGEST_LIFT = 1e-2  # of V₀t; r₀ may be too large by as much (docs/numerics.md)


def refusal(impact: Impact) -> str | None:
    """The reason why ``impact`` cannot be simulated, naming the field (``None``: it can)."""
    if impact.velocity + impact.rotation * impact.first_touch <= 0.0:
        return (
            f"rotation must not take the first touch off the wall: the beam moves there at "
            f"{impact.velocity + impact.rotation * impact.first_touch:.6g} m/s (got {impact.rotation!r})"
        )
    return None


def simulate(
    impact: Impact,
    *,
    end_time: float | None = None,
    mesh: Mesh | None = None,
    integrator: Integrator | None = None,
    contact: Contact | None = None,
    far_field: FarField | None = None,
    mass: Mass | None = None,
    full_beam: bool = False,
    domain: float | None = None,
    refine: float = 1.0,
    save: int | Sequence[float] | NDArray[np.float64] = 200,
    progress: Callable[[float], None] | None = None,
    until: Callable[[BeamModel, Stepper], bool] | None = None,
) -> ImpactHistory:
    """Simulate the impact on a Hermite beam; parts that are not given are chosen for the problem
    (:mod:`hermite_fe.resolution`).

    end_time : s (by default 0.1 t*, but 0.01 T* at most).
    full_beam : model both halves instead of one with a symmetry support; always so where the impact is not symmetric.
    domain : half length to model, m; the cut ends of a longer beam follow the free motion (by default all of it).
    refine : elements and steps are divided by this.
    save : number of saved instants, spread evenly in √t, or their times, s; snapped to steps.
    progress : called with the finished fraction at every saved instant.
    until : called at every saved instant; the run ends with the first at which it returns True.

    Raises ``ValueError`` for bad input, :class:`bent_beam.SimulationError` (with the partial history) when a
    run cannot finish.
    """
    reason = refusal(impact)
    if reason is not None:
        raise ValueError(reason)
    full_beam = full_beam or impact.off_centre
    end = impact.checked_end_time(end_time)
    modelled = cut(impact, domain)
    if domain is not None and far_field is None:
        far_field = GridViscosity(end="following")
    choice = resolution.choose(modelled, end, mesh, integrator, contact, far_field, mass, refine=refine)
    if domain is not None and choice.far_field.end != "following":
        raise ValueError(
            f'domain cuts the beam where it goes on: far_field.end must be "following" (got {choice.far_field.end!r})'
        )
    model = beam_model(modelled, choice.nodes, choice.contact, choice.far_field, full=full_beam, mass=choice.mass)
    check_start(model)
    run = run_of(impact, model, choice, end, save, progress, until)
    ended = until is not None and not run.failure
    settings = {
        "end_time": float(run.time[-1]) if ended else end,
        "full_beam": full_beam,
        "domain": domain,
        "save": run.time[1:].tolist() if ended else np.asarray(save).tolist(),
        **settings_of_run(impact, choice, run),
    }
    history = history_of(impact, model, run, settings)
    if until is None and impact.opposite_wall is None and not impact.off_centre:  # a front spreads from the middle
        history = history.with_warnings([*choice.warnings, *lift_warnings(impact, model, history)])
    if run.failure:
        raise SimulationError(
            run.failure,
            time=run.failure_time,
            step=run.steps,
            advice="a smaller integrator.time_step or growth, more damping at grid scale "
            '(far_field.viscosity), or integrator.kind = "moreau_jean"',
            history=history,
        )
    return history


def run_of(
    impact: Impact,
    model: BeamModel,
    choice: resolution.Choice,
    end: float,
    save: int | Sequence[float] | NDArray[np.float64],
    progress: Callable[[float], None] | None,
    until: Callable[[BeamModel, Stepper], bool] | None,
) -> Trajectory:
    """The steps from the start of ``model`` to ``end``, s."""
    return integrate(
        model.system,
        model.displacement,
        model.velocity,
        choice.integrator,
        end,
        restitution=choice.contact.restitution,
        hold=choice.contact.hold or 0,
        hold_until=choice.contact.hold_until or 0.0,
        hold_ends=FIRST_SPREAD * impact.slow_time_scale,
        save=save,
        progress=progress,
        until=None if until is None else lambda run: until(model, run),
    )


def settings_of_run(impact: Impact, choice: resolution.Choice, run: Trajectory) -> dict[str, Any]:
    """The parts of a run as text, what was held, and how many rounds the active set took."""
    parts = ("mesh", "integrator", "contact", "far_field", "mass")
    return {
        **{name: describe(getattr(choice, name)) for name in parts},
        "hold": hold_report(impact, choice.contact, run),
        "mean_iterations": run.mean_iterations,
        "most_iterations": run.most_iterations,
    }


def cut(impact: Impact, domain: float | None) -> Impact:
    """``impact`` of a beam of half length ``domain``; ``ValueError`` when that is longer than the beam."""
    if domain is None:
        return impact
    if positive("domain", domain) > impact.half_length:
        raise ValueError(f"domain must not exceed the half length {impact.half_length!r} of the beam (got {domain!r})")
    return impact.replace(length=2.0 * domain)


def hold_report(impact: Impact, contact: Contact, run: Trajectory) -> dict[str, float | None] | None:
    """``{"until": s, "pull": largest pull over largest push}`` of a contact point between two saved instants, pull
    ``None`` without a push; ``None`` where nothing ever pulled."""
    pull = -float(np.diff(run.held_impulse, axis=0).min(initial=0.0))
    push = float(np.diff(run.impulse, axis=0).max(initial=0.0))
    if pull == 0.0:
        return None
    end = float(run.time[-1])
    stated = end if contact.hold else contact.hold_until or 0.0
    until = min(float(stated), end, FIRST_SPREAD * impact.slow_time_scale)
    return {"until": until, "pull": pull / push if push > 0.0 else None}


def lift_warnings(impact: Impact, model: BeamModel, history: ImpactHistory) -> list[str]:
    """A warning where the zone leaves the wall though no load lifts it, and waves from the ends cannot (0.005 T*)."""
    time = history.time
    end = time[-1]
    if impact.zone_pressure < 0.0 or end > FIRST_SPREAD * impact.slow_time_scale:
        return []
    places, worst = np.abs(model.system.contacts.places), 0.0
    nodes = np.abs(model.beam.nodes)
    instants = np.flatnonzero(time > 0.1 * end)[1:]
    for k in instants:
        before = history.array("impulse", int(np.searchsorted(time, 0.9 * time[k]) - 1))
        inside = nodes < 0.8 * np.max(places[history.array("impulse", k) > before], initial=0.0)
        lift = np.max(history.array("gap", k)[inside], initial=0.0)
        worst = max(worst, float(lift) / (impact.velocity * time[k]))
    if worst <= LARGEST_LIFT:
        return []
    return [
        f"the contact zone lifts off the wall by up to {worst:.2g} V₀t in the last decade of time (numbers good to "
        f"1 % need {LARGEST_LIFT:g}): impacts of the unresolved start, or the contact law, have thrown it off; use "
        "finer elements at the centre, a later end time, or Signorini's condition at the new position with contact "
        "at nodes (signorini_position, node)"
    ]


def check_start(model: BeamModel) -> None:
    """``ValueError`` when the beam starts inside the wall."""
    rows = model.system.contacts
    gaps = rows.gaps(model.displacement)
    worst = int(np.argmin(gaps))
    if gaps[worst] < -1e-12 * float(np.abs(gaps).max()):
        raise ValueError(
            f"fourth_derivative bends the beam into the wall before the impact: the gap at "
            f"x = {float(rows.places[worst]):.6g} m is {float(gaps[worst]):.6g} m; shorten the beam"
        )


def history_of(impact: Impact, model: BeamModel, run: Trajectory, settings: dict[str, Any]) -> ImpactHistory:
    """The record of a run: fields of the model, sums of the whole beam; of two walls the impulses apart, their sum with
    its sign."""
    copies, front, behind = model.copies, ~model.behind, model.behind
    rows = model.system.contacts
    towards = np.where(behind, -1.0, 1.0)
    closed = run.closed[:, front] | run.closed[:, behind] if np.any(behind) else run.closed
    fields: dict[str, tuple[Sequence[str], NDArray[Any]]] = {
        "gap": (("time", "x"), -(run.q[:, 0::2] + model.facing[0::2])),
        "velocity": (("time", "x"), run.v[:, 0::2]),
        "slope": (("time", "x"), run.q[:, 1::2] + model.natural[1::2]),
        "impulse": (("time", "contact"), run.impulse[:, front]),
        "in_contact": (("time", "contact"), closed),
        "total_impulse": (("time",), copies * run.impulse @ towards),
        "held_impulse": (("time",), copies * run.held_impulse.sum(axis=1)),
        "kinetic_energy": (("time",), copies * run.kinetic),
        "strain_energy": (("time",), copies * run.strain),
        "work_of_loads": (("time",), copies * run.work),
        "loss_impact": (("time",), copies * run.impact),
        "loss_algorithmic": (("time",), copies * run.algorithmic),
        "loss_viscous": (("time",), copies * run.viscous),
        "loss_material": (("time",), copies * run.material),
        "loss_absorbed": (("time",), copies * run.absorbed),
        "smallest_gap": (("time",), run.gap.min(axis=1)),
        "smallest_reaction": (("time",), run.smallest_reaction),
        "complementarity_product": (("time",), run.product),
    }
    if np.any(behind):
        fields["opposite_impulse"] = (("time", "contact"), run.impulse[:, behind])
    return ImpactHistory.build(
        impact=impact,
        path="hermite",
        symmetry="full" if model.full else "half",
        settings=settings,
        time=run.time,
        x=model.beam.nodes,
        contact_x=rows.places[front],
        fields=fields,
        warnings=(),
        steps=run.steps,
        seconds=run.seconds,
        completed=not run.failure,
    )
