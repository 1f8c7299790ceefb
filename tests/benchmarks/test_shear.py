"""Timoshenko's beam: statics and waves that follow by hand."""

import pytest

from benchmarks.shear import late, peak, run
from theory.elastic_wall import flat_limit, peak_force


def test_shear_waves_of_one_point_take_their_momentum() -> None:
    """κ/ν → ∞: before bending matters one point sends waves of V₀√(κ_sGAμ) each way."""
    done = run(1e4, 0.1, 1e-3, 0.3)
    assert done.force[done.time > 0.05] == pytest.approx(2.0, rel=0.02)


def test_force_acts_where_euler_and_bernoulli_have_it_and_the_rim_is_a_shear_length_ahead() -> None:
    """Behind the rim the angle decays as e^{x/ℓ_s}, and so does the pressure: the beam ahead starts one ℓ_s later."""
    found = late(0.5, 40.0, 0.1, 0.3)
    assert found["place"] == pytest.approx(0.0, abs=0.01) and found["impulse"] == pytest.approx(0.0, abs=0.002)
    assert found["rim"] == pytest.approx(1.0, abs=0.1)


def test_wall_rules_the_largest_force_between_its_two_limits() -> None:
    """Stiff: no section feels its neighbours (κ/ν → 0, whatever κ/ν is). Soft: the force of Euler and Bernoulli."""
    f = peak_force(5.0)
    stiff = flat_limit(0.0)[0] / 5.0**0.5 / f.value
    assert peak(5.0, f, 0.05, 0.012, 0.2)[0] == pytest.approx(stiff, rel=3e-3)
    assert peak(5.0, f, 40.0, 0.2, 0.2)[0] == pytest.approx(1.0, rel=6e-3)
