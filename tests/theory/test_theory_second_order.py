"""λ₂, r₂: first order found again without any φ, the error of first order as simulated, scaling, the border."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comparison.validity import measured
from theory import contact_parameters
from theory.second_order import second_order

LOADS = st.tuples(*[st.integers(-20, 20).map(lambda n: n / 10.0)] * 4)


@given(ratio=st.floats(1e-3, 3.0), loads=LOADS)
def test_the_first_order_on_the_way_is_that_of_the_phi_functions(ratio: float, loads: tuple[float, ...]) -> None:
    alpha, psi, chi, axial = loads
    parameters = contact_parameters(ratio, alpha, psi, chi, axial=axial)
    found = second_order(parameters)
    scale = max(1.0, parameters.lambda0) ** 6
    assert found.lambda1 == pytest.approx(parameters.lambda1, rel=1e-8, abs=1e-11 * scale)
    assert found.r1 == pytest.approx(parameters.r1, rel=1e-8, abs=1e-11 * scale)


@pytest.mark.parametrize("regime", ["continuous", "detached"])
def test_it_is_what_simulation_finds_the_first_order_to_lack(regime: str) -> None:
    # measured on the self-similar path for a load α where it changes λ or r by 30 %; third order is below 0.12·0.3³
    corrections = measured()["corrections"]
    for row in measured()["regimes"][regime]:
        parameters = contact_parameters(row["kappa_over_nu"], 1.0 if regime == "continuous" else -1.0)
        found = second_order(parameters)
        slope = max(abs(parameters.r1) / parameters.r0, abs(parameters.lambda1) / parameters.lambda0)
        tau = corrections[-1] / slope
        length = abs(found.lambda2) * tau**2 / (parameters.lambda0 + parameters.lambda1 * tau)
        force = abs(found.r2) * tau**2 / (parameters.r0 + parameters.r1 * tau)
        assert max(length, force) == pytest.approx(row["error"][-1], abs=0.12 * corrections[-1] ** 3)


def test_tension_at_a_tenth_and_a_fifth() -> None:
    # finite elements with geometric stiffness, κ/ν = 0.5: λ_c off by 0.3, R by 0.9 % at nτ = 0.1, 1.2 and 4 % at 0.2
    parameters = contact_parameters(0.5, -0.5, axial=1.0)
    found = second_order(parameters)
    for tau, length, force in ((0.1, 0.003, 0.009), (0.2, 0.012, 0.04)):
        assert found.lambda2 * tau**2 / parameters.lambda0 == pytest.approx(-length, rel=0.25)
        assert found.r2 * tau**2 / (parameters.r0 + parameters.r1 * tau) == pytest.approx(force, rel=0.1)


@pytest.mark.parametrize("ratio", [0.05, 0.4, 0.95])
def test_the_border_of_the_regimes_and_the_square_of_the_loads(ratio: float) -> None:
    on = second_order(contact_parameters(ratio, 1.0, -1.0, 0.3))
    below = second_order(contact_parameters(ratio, 1.0, -1.0 - 1e-9, 0.3))
    assert below.lambda2 == pytest.approx(on.lambda2, rel=1e-5)
    assert below.r2 == pytest.approx(on.r2, rel=1e-5)
    twice = second_order(contact_parameters(ratio, 2.0, -2.0, 0.6))
    assert (twice.lambda2, twice.r2) == pytest.approx((4.0 * on.lambda2, 4.0 * on.r2), rel=1e-10)


def test_one_point_without_tension_is_a_linear_problem() -> None:
    found = second_order(contact_parameters(2.0, 1.0, -3.0, 2.0))
    assert (found.lambda2, found.r2) == pytest.approx((0.0, 0.0), abs=1e-13)


def test_refusals() -> None:
    with pytest.raises(ValueError, match="one impact"):
        second_order(contact_parameters([0.5, 0.6]))
    with pytest.raises(ValueError, match="nu must be 1"):
        second_order(contact_parameters(0.5, nu=2.0))
