"""The largest bending moment at leading order: against many digits, against the wave itself, limits."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from theory import SelfSimilarWave, contact_parameters, peak_moment


@pytest.mark.parametrize("ratio", [1e-6, 1e-3, 0.03, 0.2, 0.59, 0.9, 0.999])
def test_moment_ahead_in_many_digits(ratio: float) -> None:
    """B from λ₀ and the slow motion alone, the extremum by a root search of E‴."""
    found = peak_moment(ratio)
    with mp.workdps(60):
        turn, x = mp.exp(-1j * mp.pi / 4) / 2, mp.mpf(contact_parameters(ratio).lambda0)

        def waves(x: mp.mpf) -> tuple[mp.mpc, mp.mpc, mp.mpc]:
            z = turn * x
            gauss = mp.exp(-(z**2)) / mp.sqrt(mp.pi)
            return gauss - z * mp.erfc(z), mp.erfc(z), gauss

        first, second, _ = waves(x)
        rows = [[mp.re(c), -mp.im(c)] for c in (-turn * first, turn**2 * second)]
        b = mp.matrix([-mp.mpf(ratio) * x, -mp.mpf(ratio)])
        amplitude = mp.mpc(*mp.lu_solve(mp.matrix(rows), b))
        place = mp.findroot(lambda y: mp.re(amplitude * turn**3 * waves(y)[2]), mp.mpf(found.place))
        moment = mp.re(amplitude * turn**2 * waves(place)[1])
    # λ₀ itself is known to a rounding only, hence not 1e-15
    assert found.place == pytest.approx(float(place), rel=1e-10)
    assert found.ahead == pytest.approx(float(moment), rel=1e-10)


@given(st.floats(1e-4, 3.0))
def test_nowhere_is_the_curvature_larger(ratio: float) -> None:
    parameters, found = contact_parameters(ratio), peak_moment(ratio)
    x = parameters.lambda0 + np.geomspace(1e-6, 50.0, 4000)
    bending = SelfSimilarWave(parameters).curvature(x)
    assert np.max(bending) <= found.ahead * (1.0 + 1e-12)
    assert np.max(np.abs(bending)) <= found.largest * (1.0 + 1e-12)
    assert SelfSimilarWave(parameters).curvature(found.place) == pytest.approx(found.ahead, rel=1e-11)


def test_one_point_bends_by_the_velocity_however_curved_the_beam_is() -> None:
    found = peak_moment([1.0, 2.0, 1e4], nu=3.0)
    np.testing.assert_array_equal(found.largest, 3.0)
    np.testing.assert_array_equal(found.place_of_largest, 0.0)
    np.testing.assert_allclose(found.place, np.sqrt(2.0 * np.pi), rtol=1e-14)


def test_limits() -> None:
    # a nearly straight beam bends as much as one that touches in a point: 1 − (π/2)κ/ν
    assert peak_moment(1e-7).largest == pytest.approx(1.0 - np.pi / 2.0 * 1e-7, abs=1e-12)
    nearly, point = peak_moment(1.0 - 1e-12), peak_moment(1.0)
    assert nearly.largest == pytest.approx(point.largest, rel=1e-11)
    assert nearly.ahead == pytest.approx(point.ahead, rel=1e-11)
    assert peak_moment(0.597).place_of_largest > 0.0 == peak_moment(0.6).place_of_largest
