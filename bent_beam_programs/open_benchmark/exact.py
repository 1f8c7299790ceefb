"""Exact references from the theory, for bent_beam_programs.open_benchmark.release and for problems of other parameters.

The infinite beam: ``theory.contact``. The ladder: ``theory.ladder``, whose J(t) is polynomial between
impacts, at most quadratic. The stopped beam: ``theory.stopped_beam``, as a cubic spline over τ^¼. Walls and stops that
give way: ``theory.elastic_wall``, ``theory.elastic_stop``, with error bars. A whole impact has no closed form: Hermite
elements, with what other elements, steps and another contact law change as error bar.
"""

from itertools import pairwise
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from bent_beam_programs.open_benchmark.problem import Problem
from theory import contact_parameters
from theory.elastic_stop import MODES, SwungBeam
from theory.elastic_wall import peak_force
from theory.ladder import BouncingBall, DroppedBar, FlyingBar, ReleasedBar, StringOnObstacle
from theory.stopped_beam import StoppedBeam

PEAK_TIME = 0.01  # to which the theory finds when the force of an elastic wall is largest
SAMPLE = 100  # elements of half a beam, where a whole impact is confirmed or has no stored reference
NUMBERS = ("restitution", "last_contact", "midspan_moment")
KNOTS = 300  # of the stopped beam's spline: its J is within 1e-6 of the closed form


def computed(asked: Problem) -> dict[str, Any]:
    """The references of a problem, as they stand in ``references.json``."""
    if asked.is_front:
        return {"values": _front(asked)}
    if asked.kind.startswith("elastic"):
        return _largest_force(asked)
    if asked.kind == "stopped-beam":
        return {"impulse": _stopped_beam(asked)}
    return {"impulse": _rung(asked)}


def _front(asked: Problem) -> dict[str, float]:
    alpha, psi, chi, axial = asked.loads
    found = contact_parameters(asked.kappa_over_nu, alpha, psi, chi, **({"axial": axial} if axial else {}))
    names = ("lambda0", "r0", "lambda1", "r1") if asked.kind == "first" else ("lambda0", "r0")
    return {name: float(getattr(found, name)) for name in names}


def _largest_force(asked: Problem) -> dict[str, Any]:
    """Of a wall that gives way, by a Volterra equation; of a stop, by modes: the bar is what half of them change."""
    if asked.kind == "elastic-wall":
        peak = peak_force(asked.kappa_over_nu, asked.given["wall_damping"] / 2.0)
        values, errors = (peak.value, peak.time), (peak.error, PEAK_TIME * peak.time)
    else:
        values, few = (SwungBeam(**asked.given, modes=n).peak_force(asked.end_time) for n in (MODES, MODES // 2))
        errors = abs(values[0] - few[0]), abs(values[1] - few[1])
    names = ("peak_force", "peak_time")
    return {"values": dict(zip(names, values)), "errors": dict(zip(names, errors))}


def _stopped_beam(asked: Problem) -> dict[str, Any]:
    roots = np.linspace(0.0, asked.end_time**0.25, KNOTS)
    impulse = np.concatenate([[0.0], StoppedBeam(asked.damping).impulse(roots[1:] ** 4)])
    return _pieces("fourth root of time", roots, CubicSpline(roots, impulse).c.T)


def _rung(asked: Problem) -> dict[str, Any]:
    """J between the instants at which its formula changes: the parabola through three points of each piece."""
    given, end = asked.given, asked.end_time
    if "restitution" in given and "mass" in given:
        ball = BouncingBall(**{name: given[name] for name in ("height", "velocity", "gravity", "restitution")})
        events, impulse = [*ball.impact_time(np.arange(1, 60)), ball.rest], lambda t: given["mass"] * ball.impulse(t)
    elif asked.kind == "bar":
        bar = FlyingBar(stiffness=given["axial_stiffness"], velocity=given["velocity"], gap=given["gap"])
        events, impulse = list(bar.contact), bar.impulse
    elif asked.kind == "bouncing-bar":
        dropped = DroppedBar(given["length"], given["axial_stiffness"], 1.0, given["gravity"], given["gap"])
        landings = dropped.flight / 2.0 + (dropped.contact + dropped.flight) * np.arange(5)
        events, impulse = [*landings, *(landings + dropped.contact)], dropped.impulse
    elif asked.kind == "released-bar":
        events, impulse = [float(t) for t in range(1, 10)], ReleasedBar().impulse
    else:
        # the impulse per length of a parabola is piecewise linear in x with a break in the middle: midpoints are exact
        x = (np.arange(64) + 0.5)[:, None] / 64.0
        events, impulse = [0.5, 1.5, 2.5, 3.5], lambda t: StringOnObstacle().impulse(x, t[None, :]).mean(axis=0)
    breaks = np.unique([0.0, *(t for t in events if t < end), end])
    return _pieces("time", breaks, np.array([_parabola(impulse, a, b) for a, b in pairwise(breaks)]))


def _parabola(impulse: Any, start: float, stop: float) -> Any:
    """Coefficients in t − start, the highest first."""
    t = (stop - start) * np.array([0.25, 0.5, 0.75])
    return np.linalg.solve(np.vander(t, 3), impulse(start + t))


def _pieces(variable: str, breaks: Any, coefficients: Any) -> dict[str, Any]:
    return {"variable": variable, "breaks": breaks.tolist(), "coefficients": coefficients.tolist()}


def whole_impact(asked: Problem, elements: int = SAMPLE) -> dict[str, Any]:
    """One whole impact: number → [value, error bar], the parts of the bar of e, and its settings and cost."""
    from bent_beam.meshes import UniformMesh
    from comparison.bouncing import bounce
    from comparison.bouncing import problem as beam
    from hermite_fe import HermiteFE

    method = HermiteFE(mesh=UniformMesh(element_length=1.0 / elements))
    found = bounce(beam(asked.kappa_over_nu, asked.damping), method)
    return {
        "kappa_over_nu": asked.kappa_over_nu,
        "damping": asked.damping,
        **{name: [found.numbers[name].value, found.numbers[name].bar] for name in NUMBERS},
        "error_parts": dict(getattr(found.numbers["restitution"], "parts", {})),
        "settings": found.settings,
        "steps": found.runs.run.steps,
        "seconds": found.seconds,
    }
