"""A damped point is the inverse of its Laplace transforms."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp

from theory import damped_point


@pytest.mark.parametrize("m", [0, 1, 2])
def test_a_damped_point_is_the_inverse_of_its_laplace_transform_at_every_age(m: int) -> None:
    """(1 + s)^{1/4} s^{−1/2−m} over s^{1/4−1/2−m}·…: the ratio to η = 0 is found by numerical inversion."""
    ratios = (damped_point.reaction_ratio, damped_point.impulse_ratio, damped_point.impulse_ratio_of_acceleration)
    for age in (1e-3, 0.1, 1.0, 7.0, 60.0):
        with mp.workdps(30):
            found = mp.invertlaplace(lambda s: (1 + s) ** 0.25 * s ** (-0.5 - m), age, method="talbot")
            undamped = mp.mpf(age) ** (m - 0.5) / mp.gamma(m + 0.5)
        assert float(ratios[m](age)) == pytest.approx(float(found / undamped), rel=1e-8)


def test_the_moment_of_a_damped_point_and_the_age_at_which_a_zone_spreads() -> None:
    for age in (1e-4, 0.1, 3.0, 50.0):
        with mp.workdps(30):
            moment = mp.invertlaplace(lambda s: (1 + s) ** 0.5 / s, age, method="talbot")
        assert float(damped_point.moment_ratio(age)) == pytest.approx(float(moment), rel=1e-8)
    for kappa in (1e-3, 0.5, 1.0 - 1e-10):
        assert np.sqrt(damped_point.age_of_spreading(kappa)) == pytest.approx(float(mp.erfinv(kappa)), rel=1e-9)
    assert damped_point.age_of_spreading(1.0) == damped_point.age_of_spreading(3.0) == np.inf
