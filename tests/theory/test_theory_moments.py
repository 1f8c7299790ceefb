"""The moment ahead of a damped point."""

import math

import mpmath as mp
import numpy as np
import pytest

from bent_beam import Impact
from theory import damped_point, peak_moment, predict


def test_the_moment_ahead_of_a_damped_point_has_no_number_in_its_first_75_damping_times() -> None:
    # at first 0.24 of that at the contact, in the end 0.56 of it: where it may be the largest nothing is said
    for elastic, known in ((0.0, True), (0.4, False), (1.0, False), (-3.0, True)):  # curvature of the bow, of 2
        point = Impact.whole_beam(2.0, relative_damping=1e-5).replace(natural_curvature=2.0 - elastic)
        touch, early, late = predict(point, [0.0, 7.4e-4, 7.6e-4]).times
        assert touch.peak_moment == pytest.approx(abs(elastic))  # before it
        assert (early.peak_moment is not None, early.peak_moment_place is not None) == (known, known)
        undamped = predict(point.replace(damping=0.0), 7.6e-4).times[0]
        assert late.peak_moment == pytest.approx(undamped.peak_moment, rel=1e-12)
    (spread,) = predict(Impact.whole_beam(0.3, relative_damping=1e-5), 6e-4).times  # no point any more: as without
    assert spread.peak_moment == pytest.approx(peak_moment(0.3).largest, rel=1e-12) and not spread.valid


@pytest.mark.parametrize(
    ("age", "near", "share"), [(1e-3, 12.25, 0.24), (damped_point.AHEAD_FROM, 2.5, 0.98 * 0.5597868)]
)
def test_the_elastic_moment_ahead_of_a_damped_point_becomes_that_without_damping(age, near, share) -> None:
    """Over that at the contact; times in η, places in √(cη), the largest near a multiple of the root of the age. The
    inverse of e^{−aX}(cos aX − sin aX)/(s√(1 + s))."""

    def moment(place: float) -> float:
        def transform(s: mp.mpc) -> mp.mpc:
            a = place * mp.sqrt(s / 2) / (1 + s) ** 0.25
            return mp.exp(-a) * (mp.cos(a) - mp.sin(a)) / (s * mp.sqrt(1 + s))

        return float(mp.invertlaplace(transform, age, method="talbot"))

    with mp.workdps(20):
        ahead = max(-moment(place) for place in np.linspace(0.7, 1.3, 7) * near * math.sqrt(age))
    assert ahead / float(damped_point.elastic_moment_ratio(age)) == pytest.approx(share, rel=5e-3)
