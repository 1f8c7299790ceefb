"""The prediction in SI units: scales, the direct link to α, and its own validity."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from bent_beam import Impact
from theory import contact_parameters, predict

PIPE = Impact(
    bending_stiffness=4.0e6, mass_per_length=29.0, length=2000.0, curvature=1.0 / 600.0, velocity=2.0
)


def test_the_thesis_case_follows_from_the_acceleration_itself() -> None:
    # a₀ = ±700 m/s², V₀ = 3.5 m/s, K = 0.35 1/m: ελ₁V₀² = 300.0 and −280.6 m/s^{3/2}
    for acceleration, expected in ((700.0, 300.007351675), (-700.0, -280.567140089)):
        found = predict(Impact(1.0, 1.0, 50.0, 0.35, 3.5, acceleration=acceleration))
        assert found.kappa_over_nu == pytest.approx(0.1)
        assert found.epsilon_alpha == pytest.approx(math.copysign(16.326530612, acceleration))
        assert found.epsilon * found.lambda1 * 3.5**2 == pytest.approx(expected, rel=1e-9)


def test_groups_and_parameters_are_those_of_the_dimensionless_problem() -> None:
    impact = PIPE.replace(acceleration=0.3, curvature_rate=-1e-4, fourth_derivative=1e-8)
    found = predict(impact)
    solved = contact_parameters(found.kappa_over_nu, found.alpha, found.psi, found.chi)
    for name in ("lambda0", "r0", "lambda1", "r1"):
        assert getattr(found, name) == pytest.approx(getattr(solved, name), rel=1e-12)
    assert found.regime == solved.regime
    assert found.epsilon == pytest.approx(found.time_scale / found.slow_time_scale)


@pytest.mark.parametrize("acceleration", [0.0, 0.02, -0.02])
@pytest.mark.parametrize("curvature", [1.0 / 600.0, 0.02])
def test_impulse_is_the_time_integral_of_the_reaction(acceleration: float, curvature: float) -> None:
    impact = PIPE.replace(acceleration=acceleration, curvature=curvature)
    end = 0.4
    total, _ = quad(
        lambda root: 2.0 * root * predict(impact, root**2).times[0].reaction,
        0.0,
        math.sqrt(end),
        epsrel=1e-12,
    )
    assert predict(impact, end).times[0].impulse == pytest.approx(total, rel=1e-11)


def test_contact_length_and_reaction_in_plain_units() -> None:
    found = predict(PIPE, [0.09])
    row = found.times[0]
    root = (PIPE.bending_stiffness / PIPE.mass_per_length) ** 0.25
    assert row.half_contact_length == pytest.approx(root * 0.3 * found.lambda0, rel=1e-13)
    expected = 2.0 * math.sqrt(2.0 / math.pi) * PIPE.mass_per_length * PIPE.velocity * root * found.r0 / 0.3
    assert row.reaction == pytest.approx(expected, rel=1e-13)
    assert row.contact_force_per_length == 0.0


def test_the_uniform_reaction_is_the_inertia_of_the_load() -> None:
    # a decelerating force a₀ on every part of a beam in contact is carried by the wall: μ a₀
    found = predict(PIPE.replace(acceleration=0.05), [0.01])
    assert found.times[0].contact_force_per_length == pytest.approx(29.0 * 0.05, rel=1e-13)


def test_units_do_not_matter() -> None:
    # millimetres, tonnes and seconds: lengths × 1000, masses / 1000, hence EI × 1e6
    a = PIPE.replace(acceleration=0.05)
    b = Impact(4.0e6 * 1e6, 29.0e-6, 500e3, 1e-3 / 600.0, 2000.0, acceleration=50.0)
    one, other = predict(a, 0.05).times[0], predict(b, 0.05).times[0]
    assert other.half_contact_length == pytest.approx(1e3 * one.half_contact_length, rel=1e-12)
    assert other.reaction == pytest.approx(one.reaction, rel=1e-12)
    assert other.impulse == pytest.approx(one.impulse, rel=1e-12)


def test_only_products_with_epsilon_matter_to_the_contact() -> None:
    impact = PIPE.replace(acceleration=0.05)
    one, other = predict(impact, 0.05), predict(impact.replace(length=900.0), 0.05)
    assert one.epsilon != other.epsilon and one.alpha != other.alpha
    assert one.times[0].reaction == other.times[0].reaction
    assert one.epsilon * one.lambda1 == pytest.approx(other.epsilon * other.lambda1, rel=1e-13)


def test_the_first_instant_has_no_reaction_but_a_contact() -> None:
    row = predict(PIPE, 0.0).times[0]
    assert row.reaction is None
    assert (row.half_contact_length, row.impulse) == (0.0, 0.0)


def test_an_expansion_that_has_broken_down_returns_nothing() -> None:
    found = predict(Impact(1.0, 1.0, 50.0, 0.35, 3.5, acceleration=-700.0), [1e-5, 0.1])
    early, late = found.times
    assert early.valid and early.reaction is not None
    assert not late.valid
    assert late.half_contact_length is late.reaction is late.impulse is None
    assert "says nothing here" in found.summary()


@pytest.mark.parametrize(
    ("impact", "time", "name", "value"),
    [
        (PIPE.replace(velocity=0.4), 1e-3, "epsilon", 0.8621),
        (PIPE.replace(acceleration=1.0), 0.5, "contact_length_correction", None),
        (PIPE.replace(acceleration=1.0), 0.5, "reaction_correction", None),
        (PIPE.replace(length=60.0), 0.5, "contact_length_over_half_length", None),
        (PIPE.replace(length=60.0), 1.0, "time_over_slow_time_scale", 0.4127),
    ],
)
def test_every_check_can_fail_and_says_why(
    impact: Impact, time: float, name: str, value: float | None
) -> None:
    found = predict(impact, time)
    check = next(c for c in (*found.checks, *found.times[0].checks) if c.name == name)
    assert not check.ok
    assert check.value > check.limit
    assert not found.valid
    assert check.message in found.summary()
    if value is not None:
        assert check.value == pytest.approx(value, rel=1e-3)


def test_a_good_case_passes_every_check() -> None:
    found = predict(PIPE, [0.01, 0.1])
    assert found.valid
    assert all(c.ok for c in (*found.checks, *found.times[0].checks, *found.times[1].checks))
    assert "Within the theory's range." in found.summary()


@pytest.mark.parametrize("acceleration", [0.0, 5.0, -5.0])
@pytest.mark.parametrize("curvature", [1e-4, 1.0])
def test_dictionary_is_strict_json(acceleration: float, curvature: float) -> None:
    impact = PIPE.replace(acceleration=acceleration, curvature=curvature)
    text = json.dumps(predict(impact, np.linspace(0.0, 5.0, 4)).to_dict(), allow_nan=False)
    restored = json.loads(text)
    assert restored["regime"] in ("discrete", "continuous", "detached")
    assert len(restored["times"]) == 4
    assert restored["times"][0]["reaction"] is None


def test_refusals_say_why() -> None:
    with pytest.raises(ValueError, match="lambda0 is infinite"):
        predict(PIPE.replace(curvature=0.0))
    for bad, why in ((-1.0, "not be negative"), (math.nan, "finite"), (math.inf, "finite"), (1e300, "not exceed")):
        with pytest.raises(ValueError, match=f"times must .*{why}"):
            predict(PIPE, [0.1, bad])


@given(st.floats(), st.floats(-1e3, 1e3))
def test_any_time_has_a_finite_prediction_or_a_refusal(time: float, acceleration: float) -> None:
    impact = PIPE.replace(acceleration=acceleration)
    try:
        found = predict(impact, [time])
    except ValueError as error:
        assert "times" in str(error) or "acceleration" in str(error)
        return
    json.dumps(found.to_dict(), allow_nan=False)
