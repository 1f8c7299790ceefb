"""What is read off a run at an instant between two saved ones."""

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.measure.instant import instant
from hermite_fe import HermiteFE


def test_the_largest_until_a_time_between_saved_instants_is_that_of_the_steps_until_then() -> None:
    """Moment, force, penetration and pressure on a wall that gives way still grow at 0.03 T*."""
    impact = Impact.whole_beam(1.0, relative_damping=1e-2).replace(wall_stiffness=100.0)
    fine, coarse = (
        HermiteFE().for_whole_beam(impact).simulate(impact, end_time=0.04, save=np.linspace(0.0, 0.04, n)[1:])
        for n in (401, 21)
    )
    for time in (0.0301, 0.031, 0.0319):  # 0.03 and 0.032 are saved
        exact, found = instant(fine, time), instant(coarse, time)
        for name in ("peak_moment", "peak_force", "peak_penetration", "peak_pressure"):
            assert getattr(found, name) == pytest.approx(getattr(exact, name), rel=2e-3), name
        assert max(found.peak_moment_time, found.peak_force_time) <= time


def test_the_largest_moment_of_the_first_instants_is_not_interpolated_from_before_the_impact() -> None:
    """It is there at once, V₀√(EIμ) of one point, and does not grow from 0 to the first saved instant."""
    impact = Impact.whole_beam(2.0)
    fine, coarse = (HermiteFE().simulate(impact, end_time=0.004, save=n) for n in (400, 3))
    early = 0.5 * float(coarse.time[1])
    assert instant(coarse, early).peak_moment == pytest.approx(instant(fine, early).peak_moment, rel=0.03)
    assert instant(coarse, early).peak_moment > 0.9
