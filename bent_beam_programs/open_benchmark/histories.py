"""A history of this project as a result of the open benchmark: the same numbers that any adapter hands in."""

import numpy as np

from bent_beam.history import ImpactHistory
from bent_beam.loads import beyond_first_order
from bent_beam.measure.moments import one_side
from bent_beam_programs.open_benchmark.problem import Problem, first_order_problem
from bent_beam_programs.open_benchmark.result import Array, Result, ResultError

SNAPSHOTS = 400
#: Fields of an impact that the exact solution of the infinite beam does not know, and why.
UNKNOWN = {
    "damping": "the exact solution has none; `bentbeam bounce` gives a damped beam's whole impact",
    "rotation": "the exact solution is symmetric",
    "first_touch": "the exact solution is symmetric",
    "opposite_wall": "the exact solution knows one wall",
}


def result_from_history(history: ImpactHistory, asked: Problem | None = None) -> Result:
    """A history as a result.

    asked : the problem that it answers; ``None`` reads it off the history's impact.
    Raises :class:`ResultError` for an impact that is none of the infinite beam's: no exact solution knows of it.
    """
    impact = history.impact
    asked = asked or _problem_of(history)
    length, time = impact.length_scale, impact.time_scale
    impulse = impact.mass_per_length * impact.velocity * length
    energy = impulse * impact.velocity
    tau = history.time / time
    series = {"J_minus": _tensile_impulse(history) / impulse}
    if "position" not in history:  # a mesh that expands takes in energy with the beam that it takes in
        sources = {"E_kin": "kinetic_energy", "E_el": "strain_energy"}
        series |= {name: history.array(source) / energy for name, source in sources.items() if source in history}
    keep = np.unique(np.linspace(0, tau.size - 1, min(tau.size, SNAPSHOTS)).round().astype(int))
    keep = keep[tau[keep] > 0.0]
    places = np.array([history.positions(int(k)) for k in keep]) / length
    nodes = np.sort(np.abs(places[-1]))
    model = {
        "time_step": _last_step(history) / time,
        "half_length": float(nodes[-1]),
        "smallest_element": float(np.diff(np.unique(nodes)).min()),
        "theory": "Euler-Bernoulli",
    }
    metadata = {
        "tool": f"bent-beam-impact, {history.path}",
        "version": history.versions.get("bent-beam-impact", ""),
        "seconds": history.seconds,
        "steps": history.steps,
        "settings": history.settings,
        "model": model,
    }
    still = "contact_position" not in history
    return Result(
        "completed" if history.completed else "diverged",
        "" if history.completed else f"{tau[-1]:g}",
        asked,
        metadata,
        tau,
        history.array("total_impulse") / impulse,
        one_side(history)[1] / (impulse * length),
        series,
        places,
        tau[keep],
        history.array("gap", keep) / length,
        history.array("velocity", keep) / impact.velocity if "velocity" in history else None,
        history.contact_positions(0) / length if still else None,
        history.array("impulse") / impulse if still else None,
        pull_is_read_off=False,
    )


def _problem_of(history: ImpactHistory) -> Problem:
    impact = history.impact
    if impact.curvature <= 0.0:
        raise ResultError("curvature must be positive: a straight beam has no isolated first touch")
    for name, why in UNKNOWN.items():
        if getattr(impact, name):
            raise ResultError(f"{name} is {getattr(impact, name):g}: {why}")
    reason = beyond_first_order(impact)
    if reason is not None:
        raise ResultError(reason.replace("this method", "the exact solution"))
    loads = (impact.alpha, impact.psi, impact.chi, impact.axial)
    end = float(history.time[-1]) / impact.time_scale
    return first_order_problem(impact.kappa_over_nu, loads, impact.epsilon, end)


def _last_step(history: ImpactHistory) -> float:
    """The last step, s: as the settings say, or the mean one."""
    end = float(history.time[-1])
    table = history.settings.get("integrator")
    sizes = [table.get("time_step"), (table.get("growth") or 0.0) * end] if isinstance(table, dict) else []
    given = [float(size) for size in sizes if isinstance(size, int | float) and size > 0.0]
    return max(given, default=end / max(history.steps, 1))


def _tensile_impulse(history: ImpactHistory) -> Array:
    """Size of the tensile impulse so far of the whole wall, N s: as the solver adds it up, else point by point."""
    if "held_impulse" in history:
        return np.maximum.accumulate(np.abs(history.array("held_impulse")))
    tensile = np.minimum(np.diff(history.array("impulse"), axis=0), 0.0).sum(axis=1)
    return 2.0 / history.sides * np.concatenate([[0.0], np.cumsum(-tensile)])
