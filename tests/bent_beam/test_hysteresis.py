"""hysteretic_loss: a material whose loss hardly depends on the frequency, by Maxwell branches."""

import math

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.hysteresis import branches_of, converges, first_mode


def lossy(loss: float, times: float = 1.0) -> Impact:
    """The free–free beam in units of its half length, its loss stated at ``times`` the first mode."""
    beam = Impact.whole_beam(2.0)
    return beam.replace(hysteretic_loss=loss, loss_frequency=times * first_mode(beam))


def test_a_steel_rod_of_20_mm_and_2_m_sounds_at_23_hertz() -> None:
    """f = (4.730²/2π) √(EI/μ)/L² of a free–free beam; √(E/ρ) d/4 = 25.86 m²/s."""
    rod = Impact(1649.34, 2.46615, 2.0, 0.0, 1.0)
    assert first_mode(rod) == pytest.approx(4.73004**2 / (2.0 * math.pi) * 25.8609 / 4.0, rel=1e-5)


@pytest.mark.parametrize("loss", [1e-4, 0.1, 0.3, 1.0])
@pytest.mark.parametrize("times", [1.1e-3, 1.0, 9e5])
def test_the_loss_is_constant_within_3_percent_over_its_range_and_holds_with_the_modulus_where_it_is_asked(loss, times):
    impact = lossy(loss, times)
    branches = branches_of(impact)
    assert np.all(branches.shares >= 0.0)
    assert branches.lowest <= min(0.1 * first_mode(impact), impact.loss_frequency) * 1.000001
    assert branches.highest >= 1e6 * first_mode(impact) and branches.times.size <= 20
    at = 2.0 * math.pi * np.append(np.geomspace(branches.lowest, branches.highest, 997), impact.loss_frequency)
    wt = at[:, None] * branches.times
    storage = branches.relaxed * (1.0 + (branches.shares * wt**2 / (1.0 + wt**2)).sum(axis=1))
    lost = branches.relaxed * (branches.shares * wt / (1.0 + wt**2)).sum(axis=1)
    assert np.abs(lost / storage / loss - 1.0).max() == pytest.approx(branches.deviation, rel=0.05)
    assert branches.deviation < (0.01 if loss <= 0.1 else 0.03)
    assert storage[-1] == pytest.approx(1.0, rel=1e-6) and lost[-1] == pytest.approx(loss, rel=1e-3)


def test_contradictions_are_named() -> None:
    for message, change in {
        r"loss_frequency must say where .* \(got None\)": {"loss_frequency": None},
        r"loss_frequency must say where .* \(got 1e-09\)": {"loss_frequency": 1e-9},
        "loss_frequency has no effect without hysteretic_loss": {"hysteretic_loss": 0.0},
        r"hysteretic_loss .*1.5": {"hysteretic_loss": 1.5},
        "damping = 0.001 and hysteretic_loss = 0.1": {"damping": 1e-3},
        r"fourth_derivative must be 0 with hysteretic_loss.*0.1": {"fourth_derivative": 0.1},
    }.items():
        with pytest.raises(ValueError, match=message):
            lossy(0.1).replace(**change)


def test_the_range_of_the_loss_reaches_the_first_instants_of_a_fast_impact() -> None:
    """10⁴/t* where that is above 10⁶ of the first mode; the slow one has the latter."""
    slow, fast = lossy(0.1), lossy(0.1).replace(velocity=100.0 * lossy(0.1).velocity)
    reached = [branches_of(impact).highest for impact in (slow, fast)]
    assert reached == pytest.approx([1e6 * first_mode(slow), 1e4 / (2.0 * math.pi * fast.time_scale)])


def test_a_whole_impact_has_numbers_with_damping_or_a_loss_of_some_size_or_on_a_soft_wall() -> None:
    beams = (Impact.whole_beam(2.0), Impact.whole_beam(2.0, relative_damping=1e-6), lossy(0.0499), lossy(0.05))
    assert [converges(beam) for beam in beams] == [False, True, False, True]
    for beam, power in ((beams[0], -4), (beams[0].replace(wall_from=0.0, wall_to=0.0), -3)):
        walls = [beam.replace(wall_stiffness=share * 0.05**power) for share in (0.99, 1.01)]
        assert [converges(one) for one in walls] == [True, False]
