"""Simulate an impact and return its history."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.errors import InputError, SimulationError
from bent_beam.fields import describe
from bent_beam.history import ImpactHistory
from bent_beam.hysteresis import branches_of
from bent_beam.impact import WAVES_FELT, Impact, checked_impact
from bent_beam.loads import UNSHEARED, unmodelled
from bent_beam.method import Progress
from hermite_fe import resolution
from hermite_fe.compiled import Array, recompiling
from hermite_fe.contacts import Contact, NodeContact
from hermite_fe.elastic_wall import PEAKS
from hermite_fe.model import MODELLED, BeamModel, beam_model
from hermite_fe.run import Stepper, Trajectory, integrate
from hermite_fe.stepping import ENERGIES
from hermite_fe.warnings_of_run import end_warnings, lift_warnings, resolution_warnings, rounds_warnings
from hermite_fe.whole_beam import begins

SHARED = {*ENERGIES, "kinetic_energy", "strain_energy", "branch_energy", "contact_energy", "peak_force"}
"""Sums that are the model's share of the whole beam's."""


def refusal(impact: Impact, contact: Contact | None) -> str | None:
    """The reason why ``impact`` cannot be simulated with ``contact``, naming the field (``None``: it can)."""
    speed = impact.velocity + impact.rotation * impact.first_touch
    if speed <= 0.0:
        return (
            f"rotation must not take the first touch off the wall: the beam moves there at {speed:.6g} m/s "
            f"(got {impact.rotation!r})"
        )
    if impact.shear_stiffness is not None:
        if impact.hysteretic_loss:
            return f"hysteretic_loss is not modelled with shear (got {impact.hysteretic_loss!r}){UNSHEARED}"
        if contact is not None and impact.wall_stiffness is None and not isinstance(contact, NodeContact):
            got = f"(got {type(contact).__name__}){UNSHEARED}"
            return f'hermite.contact.kind must be "node" or "alternate" with shear {got}'
    return unmodelled(impact, MODELLED)


def spreads(impact: Impact) -> bool:
    """Whether a front spreads from the middle, on a wall all along a beam without supports."""
    alone = impact.opposite_wall is None and not impact.off_centre
    return alone and not impact.supported and not impact.wall_in_part


def simulate(
    impact: Impact,
    *,
    end_time: float | None = None,
    save: int | Sequence[float] | Array = 200,
    progress: Progress | None = None,
    until: Callable[[BeamModel, Stepper], bool] | None = None,
    **parts: Any,
) -> ImpactHistory:
    """Simulate the impact on a Hermite beam.

    end_time : s (by default 0.1 t*, but 0.01 T* at most).
    save : number of saved instants, spread evenly in √t, or their times, s; snapped to steps.
    progress : called with the finished fraction at every saved instant.
    until : called at every saved instant; the run ends with the first at which it returns True.
    parts : mesh, integrator and so on, the fields of :class:`hermite_fe.resolution.Composition`; what is left out is
        chosen for the problem. An impact that is not symmetric is always modelled on the full beam.

    Raises ``ValueError`` for bad input, ``TypeError`` for a part of an unknown name,
    :class:`bent_beam.SimulationError` (with the partial history) when a run cannot finish.
    """
    composition = resolution.Composition(**parts)
    if reason := refusal(checked_impact(impact), composition.contact):
        raise InputError(reason)
    full_beam = composition.full_beam or impact.off_centre
    end = impact.checked_end_time(end_time)
    choice = resolution.choose(impact, end, composition)
    model = recompiling(
        lambda: beam_model(impact, choice.nodes, choice.contact, choice.far_field, full=full_beam, mass=choice.mass)
    )
    check_start(model)
    run = integrate(
        model.system,
        model.displacement,
        model.velocity,
        choice.integrator,
        end,
        law=choice.contact.checked_law(model.system.contacts, WAVES_FELT * impact.slow_time_scale),
        save=save,
        progress=progress,
        until=None if until is None else lambda run: until(model, run),
    )
    ended = until is not None and not run.failure
    settings = {
        "end_time": float(run.time[-1]) if ended else end,
        "full_beam": full_beam,
        "domain": composition.domain,
        "save": run.time[1:].tolist() if ended else np.asarray(save).tolist(),
        **settings_of_run(impact, choice, run),
    }
    history = history_of(impact, model, run, settings)
    warnings = rounds_warnings(run.most_iterations)
    if until is None and spreads(impact):
        warnings += resolution_warnings(impact, end, choice.nodes, choice.integrator)
        warnings += end_warnings(impact, end, choice.nodes, choice.far_field)
    if until is None and (spreads(impact) or (begins(impact, end) and not impact.supported)):
        warnings += lift_warnings(impact, model, history)
    history = history.with_warnings(warnings)
    if run.failure:
        raise SimulationError(
            run.failure,
            time=run.failure_time,
            step=run.steps,
            advice="a smaller hermite.integrator.time_step or growth"
            + (", more damping at grid scale (hermite.far_field.viscosity)" if choice.integrator.damped else "")
            + (", more hermite.integrator.contact_rounds" if hasattr(choice.integrator, "contact_rounds") else "")
            + ("" if impact.wall_stiffness else ', or hermite.integrator.kind = "moreau_jean"'),
            history=history,
        )
    return history


def settings_of_run(impact: Impact, choice: resolution.Choice, run: Trajectory) -> dict[str, Any]:
    """The parts of a run as text, what was held, and how many rounds the active set took."""
    branches = branches_of(impact)
    return {
        **({} if branches is None else {"hysteretic_loss": {"loss": impact.hysteretic_loss, **branches.about}}),
        **{name: part and describe(part) for name, part in choice.parts().items()},
        "hold": hold_report(run),
        "mean_iterations": run.mean_iterations,
        "most_iterations": run.most_iterations,
    }


def hold_report(run: Trajectory) -> dict[str, float | None] | None:
    """``{"until": s, "pull": largest pull over largest push}`` of a contact point between two saved instants, pull
    ``None`` without a push; ``None`` where nothing ever pulled."""
    pull = -float(np.diff(run.held_impulse, axis=0).min(initial=0.0))
    push = float(np.diff(run.impulse, axis=0).max(initial=0.0))
    if pull == 0.0:
        return None
    end, law = float(run.time[-1]), run.law
    held = min(end if law.hold else law.hold_until, end, law.hold_ends)
    return {"until": end if np.any(law.strength) else held, "pull": pull / push if push > 0.0 else None}


def check_start(model: BeamModel) -> None:
    """``ValueError`` when the beam starts inside the wall."""
    rows = model.system.contacts
    gaps = rows.gaps(model.displacement)
    worst = int(np.argmin(gaps))
    if gaps[worst] < -1e-12 * float(np.abs(gaps).max()):
        raise InputError(
            f"fourth_derivative bends the beam into the wall before the impact: the gap at "
            f"x = {float(rows.places[worst]):.6g} m is {float(gaps[worst]):.6g} m; shorten the beam"
        )


def turnings_of(impact: Impact, model: BeamModel, run: Trajectory) -> dict[str, tuple[Sequence[str], NDArray[Any]]]:
    """The second dof of the nodes: the slope, with shear the section's angle, its rate and the bending moment."""
    turned, where = run.q[:, 1::2] + model.natural[1::2], ("time", "x")
    if impact.shear_stiffness is None:
        return {"slope": (where, turned)}
    moment = model.bending_moments(run.q)
    return {"angle": (where, turned), "angular_velocity": (where, run.v[:, 1::2]), "bending_moment": (where, moment)}


def history_of(impact: Impact, model: BeamModel, run: Trajectory, settings: dict[str, Any]) -> ImpactHistory:
    """The record of a run: fields of the model, sums of the whole beam; of two walls the impulses apart, their sum with
    its sign."""
    copies, front, behind = model.copies, ~model.behind, model.behind
    towards = np.where(behind, -1.0, 1.0)
    shared = SHARED | {"peak_pressure"} if model.system.springs.stop >= 0 else SHARED
    sums = {name: copies * values if name in shared else values for name, values in run.sums.items()}
    tension = copies * model.work_of_tension(run.q)  # a load's work, which the stiffness matrix holds as energy
    sums["strain_energy"] += tension
    sums["work_of_loads"] += tension - tension[0]
    sums["largest_moment_place"] = model.beam.nodes[sums.pop("largest_moment_node").astype(int)]
    if impact.wall_stiffness is None:
        sums = {name: values for name, values in sums.items() if name not in (*PEAKS, "loss_wall")}
    else:
        sums["contact_energy"] -= sums["contact_energy"][0]
    fields: dict[str, tuple[Sequence[str], NDArray[Any]]] = {
        "gap": (("time", "x"), model.gap(run.q)),
        "velocity": (("time", "x"), run.v[:, 0::2]),
        **turnings_of(impact, model, run),
        "impulse": (("time", "contact"), run.impulse[:, front]),
        "in_contact": (("time", "contact"), run.closed[:, front]),
        "total_impulse": (("time",), copies * run.impulse @ towards),
        "held_impulse": (("time",), copies * run.held_impulse.sum(axis=1)),
        "smallest_gap": (("time",), run.gap.min(axis=1)),
        **{name: (("time",), values) for name, values in sums.items()},
    }
    if np.any(behind):
        fields["in_contact"] = (("time", "contact"), run.closed[:, front] | run.closed[:, behind])
        fields["opposite_impulse"] = (("time", "contact"), run.impulse[:, behind])
    return ImpactHistory.build(
        impact=impact,
        path="hermite",
        symmetry="full" if model.full else "half",
        settings=settings,
        time=run.time,
        x=model.beam.nodes,
        contact_x=model.system.contacts.places[front],
        fields=fields,
        warnings=(),
        steps=run.steps,
        seconds=run.seconds,
        completed=not run.failure,
    )
