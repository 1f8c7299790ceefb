"""λ₀, r₀, λ₁, r₁ against 110 digits of a derivation without φ functions, their regimes and ranges."""

from functools import lru_cache

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from many_digits import phi_pair, row, wave

from theory import contact_parameters

COEFFICIENTS = st.integers(-1000, 1000).map(lambda n: n / 100.0)
DIGITS = 110


@lru_cache(maxsize=256)
def front(ratio: float) -> mp.mpf:
    """λ₀ by bisection of φ_κ/φ_ν in log λ, seeded by nothing but the limits."""
    with mp.workdps(DIGITS):
        target = mp.mpf(ratio)

        def mismatch(log_lam: mp.mpf) -> mp.mpf:
            nu, kappa = phi_pair(mp.exp(log_lam))
            return mp.log((nu - kappa) / kappa) - mp.log(1 / target - 1)

        low = mp.log(min(mp.sqrt(1 / target - 1), 1 / target - 1)) - 1
        return mp.exp(mp.findroot(mismatch, (low, low + 3), solver="anderson", tol=1e-40, maxsteps=80))


def patched_waves(ratio: float, alpha: float, psi: float, chi: float, axial: float) -> tuple[float, ...]:
    """(λ₁, r₁, residual of λ₀, r₀), ν = 1, from waves B iⁿerfc(z), z = e^{−iπ/4}x/2, patched at the front.

    η₀ = τ Re[B₀ i²erfc] and η₁ = τ² Re[B₁ i⁴erfc − (in/2)B₀ i²erfc] solve the beam equation outside the front. There
    η₀, its slope and curvature are those of the slow motion and its third derivative jumps by √(2/π)r₀. At first order
    the front has moved by ελ₁τ, which that jump turns into a jump λ₁√(2/π)r₀ of the curvature, and so on. Continuous:
    inside, η₁ is the slow motion. Detached: inside, η₁ = aτ² + bξ²τ − aξ⁴/12 − nκτ²/2, and it touches at the front
    with the slow motion's deflection and slope. No integral and no φ function is involved.
    """
    with mp.workdps(DIGITS):
        x, kappa = front(ratio), mp.mpf(ratio)
        first = [wave(2)(x, m) for m in range(5)]
        # leading order: slope and curvature fix B₀; deflection and third derivative give r₀ and a check
        b0 = mp.mpc(*mp.lu_solve(mp.matrix([row(first[1]), row(first[2])]), mp.matrix([-kappa * x, -kappa])))
        deflection, _, _, third, fourth = (mp.re(b0 * w) for w in first)
        residual, r0 = deflection - (1 - kappa * x**2 / 2), third / mp.sqrt(2 / mp.pi)
        outside = [row(wave(4)(x, m)) for m in range(4)]
        of_axial = [mp.mpf(axial) * mp.im(b0 * w) / 2 for w in first[:4]]
        slow = [psi * x**4 / 24 + chi * x**2 / 2 + mp.mpf(alpha) / 2, psi * x**3 / 6 + chi * x]
        slow += [psi * x**2 / 2 + chi, psi * x]
        jump = [[0, 0], [0, 0], [third, 0], [fourth, -mp.sqrt(2 / mp.pi)]]  # by λ₁ and r₁
        detached = alpha + axial * ratio + psi < 0
        inside = [[1 - x**4 / 12, x**2], [-(x**3) / 3, 2 * x], [-(x**2), 2], [-2 * x, 0]] if detached else 4 * [[]]
        # unknowns Re B₁, Im B₁, where detached a, b, then λ₁, r₁
        matrix = [[*o, *(-v for v in i), *j] for o, i, j in zip(outside, inside, jump)]
        right = [m - of for m, of in zip([-axial * kappa / 2, 0, 0, 0] if detached else slow, of_axial)]
        if detached:  # the front moves along the wall, so that η₀ adds nothing to deflection and slope
            matrix += [[*outside[i], 0, 0, 0, 0] for i in (0, 1)]
            right += [slow[i] - of_axial[i] for i in (0, 1)]
        *_, lambda1, r1 = mp.lu_solve(mp.matrix(matrix), mp.matrix(right))
        return float(lambda1), float(r1), float(residual), float(r0)


def assert_exact(ratio: float, loads: tuple[float, ...]) -> None:
    """λ₁ and r₁ to 1e-12 of the largest contribution of a single load: first order is linear in (α, ψ, χ, N)."""
    alpha, psi, chi, axial = loads
    found, x = contact_parameters(ratio, alpha, psi, chi, axial=axial), front(ratio)
    lambda1, r1, residual, r0 = patched_waves(ratio, *loads)
    assert residual == pytest.approx(0.0, abs=1e-20)
    assert abs(mp.mpf(found.lambda0) - x) <= 1e-12 * x and found.r0 == pytest.approx(r0, rel=1e-12)
    for name, exact in (("lambda1", lambda1), ("r1", r1)):
        scale = abs(exact)
        for k in range(4):
            *part, pull = np.where(np.arange(4) == k, loads, 0.0)
            sign = 1.0 if contact_parameters(ratio, *part, axial=pull).regime == found.regime else -1.0
            single = contact_parameters(ratio, *(sign * load for load in part), axial=sign * pull)
            scale = max(scale, abs(getattr(single, name)))
        assert getattr(found, name) == pytest.approx(exact, rel=0.0, abs=1e-12 * scale), (ratio, loads, name)


@pytest.mark.parametrize("count", [1, pytest.param(4, marks=pytest.mark.verify)])
def test_parameters_are_exact_from_flat_to_nearly_one_point(count: int) -> None:
    rng = np.random.default_rng(11)
    curved, near_one = 10.0 ** rng.uniform(-8, 0, 5 * count), 1.0 - 10.0 ** rng.uniform(-9, -1, 3 * count)
    for ratio in (1e-8, *curved, *near_one, 1.0 - 2.0**-40):
        assert_exact(ratio, (*rng.normal(size=3) * 10.0 ** rng.uniform(-2, 2), 0.0))
    for ratio in (0.9, 0.5, 0.1, 0.01):
        for loads in ((1, 0, 0, 0), (1, 1, -2, 0), (0, 2, 1, 1), (-1, -1, 0, 0), (-2, 1, 1, -1), (0, -1, 3, 2)):
            assert_exact(ratio, loads)


def test_one_point_is_pushed_by_the_acceleration_alone() -> None:
    for ratio in (1.0, 7.0, 1e4):
        point = contact_parameters(ratio, alpha=-1.5, psi=4.0, chi=2.0)
        assert (point.lambda0, point.r0, point.lambda1, point.r1) == (0.0, 1.0, 0.0, -3.0)
    # the tension acts on the wave alone when the load keeps the bow from accelerating
    point = contact_parameters(40.0, axial=0.5)
    assert (point.lambda1, point.lambda_axial, point.r1) == (0.0, 0.0, 0.25)
    assert point.r_axial == pytest.approx(0.5 - 80.0, rel=1e-15)


@pytest.mark.parametrize("ratio", [1e-10, 1e-8, 3e-5, 0.01, 0.15, 0.38, 0.39, 0.7, 0.9999, 1 - 1e-6, 1 - 1e-9])
def test_tension_in_free_flight_is_exact(ratio: float) -> None:
    found = contact_parameters(ratio, axial=1.0)
    lambda_axial, r_axial, _, _ = patched_waves(ratio, -ratio, 0.0, 0.0, 1.0)
    assert found.lambda_axial == pytest.approx(lambda_axial, rel=1e-12, abs=0.0)
    assert found.r_axial == pytest.approx(r_axial, rel=1e-12, abs=0.0)
    # a stress-free bow in flight: tension's own part is all there is, and the zone rests without reaction
    flight = contact_parameters(ratio, alpha=-ratio, axial=1.0)
    assert (flight.lambda1, flight.r1) == pytest.approx((found.lambda_axial, found.r_axial), rel=1e-9)
    assert (flight.regime, flight.uniform_reaction) == ("continuous", 0.0)


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
