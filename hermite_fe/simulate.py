"""One call from an impact to its history."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory, SimulationError
from bent_beam.impact import Impact
from bent_beam.meshes import Mesh
from bent_beam.parts import describe
from hermite_fe import auto
from hermite_fe.contacts import Contact
from hermite_fe.far_fields import FarField
from hermite_fe.integrators import Integrator
from hermite_fe.masses import Mass
from hermite_fe.model import BeamModel, beam_model
from hermite_fe.run import Stepper, Trajectory, integrate

__all__ = ["refusal", "simulate"]


def refusal(impact: Impact) -> str | None:
    """Which field of ``impact`` a run from here cannot take (``None``: it takes all of them)."""
    for name in ("rotation", "first_touch", "opposite_wall"):
        if getattr(impact, name):
            value = getattr(impact, name)
            return f"{name} is not part of this model: a symmetric beam and one wall (got {value!r})"
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
    refine: float = 1.0,
    save: int | Sequence[float] | NDArray[np.float64] = 200,
    progress: Callable[[float], None] | None = None,
    until: Callable[[BeamModel, Stepper], bool] | None = None,
) -> ImpactHistory:
    """Simulate the impact on a Hermite beam; every part left out is chosen from the problem
    (:mod:`hermite_fe.auto`).

    end_time : s (0.1 t* by default). full_beam : model both halves instead of one with a symmetry support.
    refine : elements and steps so many times finer than the parts say.
    save : number of saved instants, spread evenly in √t, or their times, s; snapped to steps.
    progress : called with the finished fraction now and then.
    until : asked at every saved instant; the run ends with the first at which it says so.

    Raises ``ValueError`` for bad input, :class:`bent_beam.SimulationError` (with the partial history) when a
    run cannot finish.
    """
    reason = refusal(impact)
    if reason is not None:
        raise ValueError(reason)
    end = impact.checked_end_time(0.1 * impact.time_scale if end_time is None else end_time)
    choice = auto.choose(impact, end, mesh, integrator, contact, far_field, mass, refine=refine)
    model = beam_model(impact, choice.nodes, choice.contact, choice.far_field, full=full_beam, mass=choice.mass)
    check_start(model)
    trajectory = integrate(
        model.system,
        model.displacement,
        model.velocity,
        choice.integrator,
        end,
        restitution=choice.contact.restitution,
        hold=choice.contact.hold or 0,
        hold_until=choice.contact.hold_until or 0.0,
        save=save,
        progress=progress,
        until=None if until is None else functools.partial(until, model),
    )
    settings = {
        "end_time": end,
        "full_beam": full_beam,
        "save": np.asarray(save).tolist(),
        **{name: describe(getattr(choice, name)) for name in ("mesh", "integrator", "contact", "far_field", "mass")},
    }
    settings["mean_iterations"] = trajectory.mean_iterations
    settings["most_iterations"] = trajectory.most_iterations
    history = history_of(impact, model, trajectory, settings, choice.warnings)
    if trajectory.failure:
        raise SimulationError(
            trajectory.failure,
            time=trajectory.failure_time,
            step=trajectory.steps,
            advice="a smaller integrator.time_step or growth, more damping at grid scale "
            '(far_field.viscosity), or integrator.kind = "moreau_jean"',
            history=history,
        )
    return history


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


def history_of(
    impact: Impact, model: BeamModel, run: Trajectory, settings: dict[str, Any], warnings: Sequence[str]
) -> ImpactHistory:
    """The record of a run: fields of the model, sums of the whole beam."""
    copies = model.copies
    rows = model.system.contacts
    fields: dict[str, tuple[Sequence[str], NDArray[Any]]] = {
        "gap": (("time", "x"), -(run.q[:, 0::2] + model.facing[0::2])),
        "velocity": (("time", "x"), run.v[:, 0::2]),
        "slope": (("time", "x"), run.q[:, 1::2] + model.natural[1::2]),
        "impulse": (("time", "contact"), run.impulse),
        "in_contact": (("time", "contact"), run.closed),
        "total_impulse": (("time",), copies * run.impulse.sum(axis=1)),
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
    return ImpactHistory.build(
        impact=impact,
        path="hermite",
        symmetry="full" if model.full else "half",
        settings=settings,
        time=run.time,
        x=model.beam.nodes,
        contact_x=rows.places,
        fields=fields,
        warnings=warnings,
        steps=run.steps,
        seconds=run.seconds,
        completed=not run.failure,
    )
