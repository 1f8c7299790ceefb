"""λ₀, r₀, λ₁, r₁, λ₂, r₂ against 110 digits of a derivation without φ functions, their regimes and ranges."""

import itertools
from functools import cache
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from many_digits import row, wave

from theory import contact_parameters
from theory.second_order import second_order

COEFFICIENTS = st.integers(-1000, 1000).map(lambda n: n / 100.0)
DIGITS = 110


@cache
def front(ratio: float) -> mp.mpf:
    """λ₀, at which the wave with slope and curvature of the free motion has its deflection, too; 0 for one point."""
    kappa, near = mp.mpf(ratio), contact_parameters(ratio).lambda0

    def left(x: mp.mpf) -> mp.mpf:
        deflection, slope, curvature = (wave(2)(x, m) for m in range(3))
        amplitude = mp.lu_solve(mp.matrix([row(slope), row(curvature)]), mp.matrix([-kappa * x, -kappa]))
        return mp.re(mp.mpc(*amplitude) * deflection) - (1 - kappa * x**2 / 2)

    with mp.workdps(DIGITS):
        return mp.findroot(left, (near, near * (1 + 1e-10)), tol=1e-80) if near else mp.mpf(0)


def even(x: mp.mpf, *coefficients: Any) -> Any:
    """c₀ + c₁x² + c₂x⁴ + … and its derivatives up to the fifth."""
    powers = [(c, 2 * k) for k, c in enumerate(coefficients)]
    return np.array([mp.fsum(c * mp.ff(p, m) * x ** (p - m) for c, p in powers if p >= m) for m in range(6)])


def patched_waves(ratio: float, loads: tuple[float, ...], last: int = 1) -> tuple[list[mp.mpf], list[mp.mpf]]:
    """λ₀, λ₁ … and r₀, r₁ …, ν = 1, from the expansions of theory/second_order.py.

    At the front, λ₀ + λ₁τ + λ₂τ², waves B iⁿerfc(z), z = e^{−iπ/4}x/2, have deflection and slope of the free motion,
    the curvature of what is inside and a third derivative larger by √(2/π)(r₀ + r₁τ + r₂τ²). Inside is the free motion,
    or, detached, what leaves the middle free, with deflection and slope of the free motion at the front. That is
    solved order by order for amplitudes, λ and r. No integral and no φ function is involved.
    """
    with mp.workdps(DIGITS):
        (alpha, psi, chi, n), kappa, x, one = map(mp.mpf, loads), mp.mpf(ratio), front(ratio), mp.mpf(1)
        detached = ratio < 1.0 and alpha + n * kappa + psi < 0
        waves = [np.array([wave(2 * k + 2)(x, m) for m in range(6)]) for k in range(last + 1)]
        i2, i4 = waves[:2]
        free = [even(x, 1, -kappa / 2), even(x, alpha / 2, chi / 2, psi / 24), even(x, n * chi / 6, n * psi / 4)]
        first = [even(x, 1, 0, -one / 12), even(x, 0, 1)]
        shapes = [[], first, [even(x, 1, 0, -one / 4), even(x, 0, 1, 0, -one / 180)]]
        tension, real, nothing = mp.j * n / 2, np.vectorize(mp.re), np.zeros(4)
        lambdas, forces, b, middle, outside, inside = [x, 0, 0], [], [0, 0, 0], [0, 0], [], []

        def conditions(outer: Any, across: Any, inner: Any) -> list[mp.mpf]:
            """Deflection and slope outside, curvature, unless that of one point, and third derivative, both inside."""
            return [*outer[:2], *across[2 if ratio < 1.0 else 3 : 4], *(inner[:2] if detached else [])]

        def at_front(fields: list[Any], others: list[Any]) -> Any:
            """Of the last order, in τ; λ of that order is still 0."""
            apart = [one - other for one, other in zip(fields, others)]
            return sum(lambdas[1] ** j / mp.factorial(j) * f[j : j + 4] for j, f in enumerate(reversed(apart)))

        for k, fresh in enumerate(waves):
            second = tension**2 / 2 * b[0] * (i2 - 4 * i4) - tension * b[1] * i4
            outside.append(real([0 * i2, -tension * b[0] * i2, second][k]))
            resting = [free[0], even(x, -n * kappa / 2), even(x, n * middle[1] / 3, -n * middle[0] / 2)]
            inside.append(resting[k] if detached else free[k])
            known = conditions(at_front(outside, free), at_front(outside, inside), at_front(inside, free))
            columns = [conditions(part, part, nothing) for part in (real(fresh), real(mp.j * fresh))]
            columns += [conditions(nothing, -shape, shape) for shape in shapes[k] if detached]
            jump = (outside[0] - free[0])[1:5]  # by which the front's motion changes each of them
            columns += [conditions(jump, jump, nothing)] if k and ratio < 1.0 else []
            columns += [conditions(nothing, -mp.sqrt(2 / mp.pi) * np.eye(4)[3], nothing)]
            found = list(mp.lu_solve(mp.matrix(columns).T, -mp.matrix(known)))
            b[k] = mp.mpc(*found[:2])
            outside[k] = outside[k] + real(b[k] * fresh)
            if k and detached:
                middle = found[2:4]
                inside[k] = inside[k] + sum(part * shape for part, shape in zip(middle, shapes[k]))
            if k and ratio < 1.0:
                lambdas[k] = found[-2]
            forces.append(found[-1])
        return lambdas[: last + 1], forces


@pytest.mark.parametrize("count", [1, pytest.param(4, marks=pytest.mark.verify)])
def test_parameters_are_exact_from_flat_to_nearly_one_point(count: int) -> None:
    """λ₁ and r₁ to 1e-12 of the largest contribution of a single load: first order is linear in (α, ψ, χ, N)."""
    rng = np.random.default_rng(11)
    curved, near_one = 10.0 ** rng.uniform(-8, 0, 5 * count), 1.0 - 10.0 ** rng.uniform(-9, -1, 3 * count)
    ratios = (1e-8, *curved, *near_one, 1.0 - 2.0**-40)
    cases = [(ratio, (*rng.normal(size=3) * 10.0 ** rng.uniform(-2, 2), 0.0)) for ratio in ratios]
    signs = ((1, 0, 0, 0), (1, 1, -2, 0), (0, 2, 1, 1), (-1, -1, 0, 0), (-2, 1, 1, -1), (0, -1, 3, 2))
    cases += itertools.product((40.0, 0.9, 0.5, 0.1, 0.01), signs)  # the first is one point
    for ratio, loads in cases:
        found, x = contact_parameters(ratio, *loads[:3], axial=loads[3]), front(ratio)
        (_, lambda1), (r0, r1) = patched_waves(ratio, loads)
        assert abs(mp.mpf(found.lambda0) - x) <= 1e-12 * x and found.r0 == pytest.approx(float(r0), rel=1e-12)
        singles = []
        for k in range(4):
            *part, pull = np.where(np.arange(4) == k, loads, 0.0)
            sign = 1.0 if contact_parameters(ratio, *part, axial=pull).regime == found.regime else -1.0
            singles.append(contact_parameters(ratio, *(sign * load for load in part), axial=sign * pull))
        for name, exact in (("lambda1", float(lambda1)), ("r1", float(r1))):
            scale = max(abs(exact), *(abs(getattr(single, name)) for single in singles))
            assert getattr(found, name) == pytest.approx(exact, rel=0.0, abs=1e-12 * scale), (ratio, loads, name)


@pytest.mark.parametrize("ratio", [1e-10, 1e-8, 3e-5, 0.01, 0.15, 0.38, 0.39, 0.7, 0.9999, 1 - 1e-6, 1 - 1e-9, 40.0])
def test_tension_in_free_flight_is_exact(ratio: float) -> None:
    found = contact_parameters(ratio, axial=1.0)
    (_, lambda_axial), (_, r_axial) = patched_waves(ratio, (-ratio, 0.0, 0.0, 1.0))
    assert found.lambda_axial == pytest.approx(float(lambda_axial), rel=1e-12, abs=0.0)
    assert found.r_axial == pytest.approx(float(r_axial), rel=1e-12, abs=0.0)
    flight = contact_parameters(ratio, alpha=-ratio, axial=1.0)  # tension's own part is all there is
    assert (flight.lambda1, flight.r1) == pytest.approx((found.lambda_axial, found.r_axial), rel=1e-9)


@given(ratio=st.floats(1e-8, 1.0, exclude_max=True), axial=COEFFICIENTS, psi=COEFFICIENTS)
def test_a_zone_at_rest_without_reaction_is_continuous_whatever_the_rounding(ratio, axial, psi):
    alpha = -(psi + axial * ratio) * (1.0 + 4.0 * np.finfo(float).eps)
    found = contact_parameters(ratio, alpha, psi, axial=axial)
    assert (found.regime, found.uniform_reaction) == ("continuous", 0.0)


def test_regimes_their_borders_and_the_uniform_reaction_of_the_continuous_one() -> None:
    ratios, psis = [1.0, np.nextafter(1.0, 0.0), 0.5, 0.5, 0.5], [0.0, 0.0, -1.0, -1.0 - 1e-12, 0.25]
    found = contact_parameters(ratios, [0.0, 0.0, 1.0, 1.0, 1.0], psis)
    assert list(found.regime) == ["discrete", "continuous", "continuous", "detached", "continuous"]
    np.testing.assert_array_equal(found.uniform_reaction, [0.0, 0.0, 0.0, 0.0, 1.25])


def test_arguments_broadcast_and_arrays_equal_scalars() -> None:
    for shape in ((), (2, 3), (0,)):
        found = contact_parameters(np.full(shape, 0.5), alpha=1.0)
        assert np.shape(found.lambda0) == np.shape(found.regime) == np.shape(found.chi) == shape
    ratio, alpha, psi = np.meshgrid([1e-5, 0.02, 0.6, 3.0], [-1.0, 0.0, 2.0], [-0.5, 1.0])
    found = contact_parameters(ratio, alpha, psi, 0.3)
    for index in np.ndindex(ratio.shape):
        single = contact_parameters(ratio[index], alpha[index], psi[index], 0.3)
        assert isinstance(single.lambda0, float) and found.regime[index] == single.regime
        for name in ("lambda0", "r0", "lambda1", "r1"):
            assert getattr(found, name)[index] == pytest.approx(getattr(single, name), rel=1e-13)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("ratio", [1e-60, 0.5, 1e100])
def test_nothing_overflows_up_to_the_largest_arguments(ratio: float) -> None:
    for sign in (1.0, -1.0):
        found = contact_parameters(ratio, sign * 1e100, -1e100, sign * 1e100, axial=-sign * 1e100)
        assert np.isfinite(found.r_axial)
        if ratio > 1e-20:
            assert np.isfinite(found.r1) and np.isfinite(found.lambda1)


@pytest.mark.parametrize(
    ("ratio", "loads"),
    [
        (0.4, (0.7, -0.3, 0.5, 0.6)),  # the middle stays
        (0.4, (-0.7, 0.3, 0.5, -0.6)),  # it lifts off
        (0.2, (1.0, -1.7, 0.3, 0.8)),
        (0.95, (1.0, -1.0, 0.3, 0.0)),  # on the border of the regimes
        (0.95, (2.0, -2.0 - 1e-9, 0.6, 0.0)),  # just beyond it, loads twice as large
        (2.0, (1.0, 0.4, -0.3, 0.7)),  # one point
        (0.005, (1e-3, 3e-4, 2e-4, 5e-4)),  # λ₀ = 20
    ],
)
def test_both_sides_of_the_front_meet_to_second_order(ratio: float, loads: tuple[float, ...]) -> None:
    found = second_order(contact_parameters(ratio, *loads[:3], axial=loads[3]))
    (_, lambda1, lambda2), (_, r1, r2) = patched_waves(ratio, loads, 2)
    assert (found.lambda1, found.r1) == pytest.approx((float(lambda1), float(r1)), rel=1e-8)
    assert (found.lambda2, found.r2) == pytest.approx((float(lambda2), float(r2)), rel=1e-7)
