"""What ``predict`` says of a real beam against the whole beam: errors of half length, force and impulse over time.

Half length and force come from moments of the impulse of a run with the beam's own damping, ends and loads; a point
contact has no half length. Problems are drawn at random over κ/ν, load and tension in units of the beam.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.impact import Impact
from bent_beam.meshes import UniformMesh
from bent_beam.method import method_from_tables
from comparison.estimators import moments
from comparison.whole_impact.ends import reached
from theory import contact_parameters, predict

__all__ = ["Verdict", "random_problem", "verdict"]

Array = NDArray[np.float64]
WINDOW = 0.11  # of fits, ± in ln t
DAMPING = 1e-3  # η/T*
LATEST = 0.045  # T*: the ends are felt before


@dataclass(frozen=True)
class Verdict:
    """One problem: what predict says, and how it fares. Times in T*; errors relative.

    at_limit : the largest of the three errors at valid_until (``None`` where nothing is valid).
    first_wrong : when the largest error, once it has been below 2 %, first reaches them (``None``: not before LATEST).
    """

    impact: Impact
    valid_from: float
    valid_until: float
    limited_by: str
    at_limit: float | None
    first_wrong: float | None
    times: Array
    errors: Array


def random_problem(random: np.random.Generator) -> Impact:
    """κ/ν from 0.05 to 3 (even in its logarithm), a uniform load and a tension of either sign that change force or
    length by some per cent within the time of interest, η/T* = 1e-3.

    Only these: q₀ and c₀ need moments at the ends, without which waves start there at once.
    """
    kappa = math.exp(random.uniform(math.log(0.05), math.log(3.0)))
    load, force = random.uniform(-2.0, 2.0), random.uniform(-1.5, 3.0)
    return Impact.whole_beam(kappa, relative_damping=DAMPING).replace(
        acceleration=load - force * kappa,  # a₀ is that of the true free motion, which tension bends
        axial_force=force,
    )


def verdict(impact: Impact, *, elements: int = 200, tolerance: float = 0.02) -> Verdict:
    """Run the whole beam and hold predict against it."""
    unit = impact.slow_time_scale
    said = predict(impact)
    until = said.valid_until / unit
    times = np.geomspace(2e-3, LATEST, 60)
    if 2e-3 < until < LATEST:
        times = np.sort(np.append(times, until))
    errors = _errors(impact, times, elements)
    begin = said.valid_from / unit
    at_limit = None
    if until > 0.0:
        at_limit = float(errors[int(np.argmin(np.abs(times - until)))].max())
    largest = errors.max(axis=1)
    good = np.flatnonzero(largest < tolerance)
    wrong = None
    if good.size:
        later = slice(int(good[0]), None)
        wrong = reached(times[later], largest[later], tolerance)
    return Verdict(impact, begin, until, said.limited_by, at_limit, wrong, times, errors)


def _errors(impact: Impact, times: Array, elements: int) -> Array:
    """|half length|, |force|, |impulse| over the prediction's, less one, shape (times, 3)."""
    unit = impact.slow_time_scale
    made = method_from_tables("hermite", {"mesh": {"kind": "uniform", "element_length": impact.half_length / elements}})
    method = made.for_whole_beam(impact)
    assert isinstance(method.mesh, UniformMesh)
    end = float(times[-1]) * math.exp(WINDOW) * unit
    saved = np.unique(np.concatenate([np.linspace(0.0, end, 900)[1:], end * np.linspace(0.05, 1.0, 300) ** 2]))
    history = method.simulate(impact, end_time=end, save=saved)
    pressed = contact_parameters(
        impact.kappa_over_nu,
        impact.epsilon_alpha,
        impact.epsilon_psi,
        impact.epsilon_chi,
        axial=impact.epsilon_axial,
    )
    loaded = pressed.uniform_reaction > 0.0
    found = moments(history, uniform=loaded)
    time = history.time
    total = history.array("total_impulse")
    rows = predict(impact, times * unit).times
    errors = np.zeros((times.size, 3))
    for i, (t, row) in enumerate(zip(times * unit, rows)):
        inside = (time > t * math.exp(-WINDOW)) & (time < t * math.exp(WINDOW))
        root = np.sqrt(time[inside]) - math.sqrt(t)
        impulse = np.polyfit(root, total[inside], 2)
        force = impulse[1] / (2.0 * math.sqrt(t))
        if row.reaction is None or row.impulse is None:
            errors[i] = math.inf
            continue
        errors[i, 1:] = abs(force / row.reaction - 1.0), abs(impulse[2] / row.impulse - 1.0)
        if impact.kappa_over_nu < 1.0 and row.half_contact_length:
            side, turn = (np.polyfit(root, values[inside], 2)[1] for values in (found.impulse, found.moment))
            length = turn / side * impact.length_scale if side > 0.0 else 0.0
            errors[i, 0] = abs(length / row.half_contact_length - 1.0)
    return errors
