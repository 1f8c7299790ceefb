"""What ``predict`` says of a real beam against the whole beam: errors of half length, force and impulse over time.

The whole beam is simulated with its own damping, ends and loads, strictly unilateral, on elements that resolve what
damping smooths over; half length and force come from moments of the impulse (:mod:`comparison.whole_impact.ends`), the
uniform pressure of the zone taken out. A point contact must stay shorter than two elements of a two-hundredth of the
half length.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.impact import Impact
from comparison.whole_impact.damped import shortened
from comparison.whole_impact.ends import law_of, reached
from theory import predict
from theory.contact import contact_parameters

__all__ = ["PredictionErrors", "prediction_errors", "random_problem"]

Array = NDArray[np.float64]
DAMPING = 1e-3  # η/T*
EARLIEST, LATEST = 1.5e-3, 0.06  # T*: the ends are felt before the latest
EARLIER = 10  # instants from an earlier limit on
ELEMENTS = 0.02, 0.01  # of what damping smooths over; below THIN, where the front is thin, the second
THIN = 0.25  # κ/ν
WINDOW = 0.15  # of fitted times, ± in ln t
POINT_LENGTH = 2.0 / 200.0  # of the half length


@dataclass(frozen=True)
class PredictionErrors:
    """One problem: what predict says, and how it fares. Times in T*; errors relative.

    at_limit : the largest of the three errors at valid_until (``None`` where nothing is valid).
    largest_within : the largest between valid_from (or :data:`EARLIEST`) and valid_until; lengths that are both below
        :data:`POINT_LENGTH` are those of one point there: relative errors of a zone that begins to spread say nothing.
    first_wrong : when the largest error first reaches 2 % from valid_from on (``None``: not before LATEST).
    """

    impact: Impact
    valid_from: float
    valid_until: float
    limited_by: str
    at_limit: float | None
    largest_within: float | None
    first_wrong: float | None
    times: Array
    errors: Array


def random_problem(random: np.random.Generator) -> Impact:
    """κ/ν from 0.05 to 3 (even in its logarithm), η/T* = 1e-3, and of five loads each with even chances of being there:
    a uniform pressure, a tension or compression, c₀ and q₀, that change force or length by some per cent within the
    time of interest.
    """
    kappa = math.exp(random.uniform(math.log(0.05), math.log(3.0)))
    pressure, force, rate, fourth = (
        random.uniform(-1.0, 1.0) * size if random.random() < 0.5 else 0.0
        for size in (2.0, 3.0, min(kappa, 1.0), min(kappa, 1.0))
    )
    return Impact.whole_beam(kappa, relative_damping=DAMPING).replace(
        acceleration=pressure - force * kappa - fourth,  # a₀ is that of the true free motion
        axial_force=force,
        curvature_rate=rate,
        fourth_derivative=fourth,
    )


def prediction_errors(impact: Impact, *, tolerance: float = 0.02) -> PredictionErrors:
    """Run the whole beam and hold predict against it."""
    unit = impact.slow_time_scale
    said = predict(impact)
    begin, until = said.valid_from / unit, said.valid_until / unit
    times = np.geomspace(EARLIEST, LATEST, 90)
    if EARLIEST < until < LATEST:
        times = np.sort(np.append(times, until))
    elif 0.0 < until < EARLIEST:
        times = np.concatenate([np.geomspace(until, EARLIEST, EARLIER, endpoint=False), times])
    errors, short = errors_of(impact, times)
    largest = errors.max(axis=1)
    at_limit = within = None
    if until > 0.0:
        at_limit = float(largest[int(np.argmin(np.abs(times - until)))])
        inside = (times >= begin) & (times <= until)
        resolved = np.where(short[:, None] & (np.arange(3) == 0), 0.0, errors)[inside]
        within = float(resolved.max()) if inside.any() else at_limit
    later = times >= begin
    wrong = reached(times[later], largest[later], tolerance)
    return PredictionErrors(impact, begin, until, said.limited_by, at_limit, within, wrong, times, errors)


def errors_of(impact: Impact, times: Array) -> tuple[Array, NDArray[np.bool_]]:
    """|half length|, |force|, |impulse| of predict over the simulation's, less one, at ``times`` (T*), shape
    (times, 3); for one point, half lengths over :data:`POINT_LENGTH`: no error, or infinity. And whether both half
    lengths are below that."""
    unit = impact.slow_time_scale
    element = ELEMENTS[impact.kappa_over_nu < THIN] * shortened(impact.kappa_over_nu)
    found = law_of(impact, times * unit, element=element, window=WINDOW)
    rows = predict(impact, times * unit).times
    exact = contact_parameters(impact.kappa_over_nu)
    errors, short = np.full((times.size, 3), math.inf), np.zeros(times.size, dtype=bool)
    for i, row in enumerate(rows):
        if row.half_contact_length is None or row.reaction is None or row.impulse is None:
            continue
        length, force, impulse = (float(values[i]) for values in found)
        short[i] = max(length, row.half_contact_length) < POINT_LENGTH * impact.half_length
        errors[i, 1:] = abs(2.0 * force / row.reaction - 1.0), abs(2.0 * impulse / row.impulse - 1.0)
        if exact.lambda0 > 0.0 and row.half_contact_length > 0.0:
            errors[i, 0] = abs(length / row.half_contact_length - 1.0)
        else:
            errors[i, 0] = 0.0 if length < POINT_LENGTH * impact.half_length else math.inf
    return errors, short
