"""λ₀, r₀, λ₁, r₁ against 110 digits of a derivation without φ functions, their regimes and ranges; λ₂, r₂: both sides
of the front meet, term by term in many digits."""

from collections.abc import Callable
from functools import lru_cache

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from many_digits import phi_pair, row, wave
from mpmath import mpf

from theory import contact_parameters
from theory.contact import ContactParameters
from theory.second_order import SecondOrder, second_order

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
    """And by a tension, which acts on the wave alone when the load keeps the bow from accelerating."""
    point = contact_parameters(40.0, alpha=-1.5, psi=4.0, chi=2.0, axial=0.5)
    assert (point.lambda0, point.r0, point.lambda1, point.lambda_axial, point.r1) == (0.0, 1.0, 0.0, 0.0, -2.75)
    assert point.r_axial == pytest.approx(0.5 - 80.0, rel=1e-15)


@pytest.mark.parametrize("ratio", [1e-10, 1e-8, 3e-5, 0.01, 0.15, 0.38, 0.39, 0.7, 0.9999, 1 - 1e-6, 1 - 1e-9])
def test_tension_in_free_flight_is_exact(ratio: float) -> None:
    found = contact_parameters(ratio, axial=1.0)
    lambda_axial, r_axial, _, _ = patched_waves(ratio, -ratio, 0.0, 0.0, 1.0)
    assert found.lambda_axial == pytest.approx(lambda_axial, rel=1e-12, abs=0.0)
    assert found.r_axial == pytest.approx(r_axial, rel=1e-12, abs=0.0)
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


Term = Callable[[mpf, mpf, int], mpf]  # of x, τ and the order of the derivative in x


def even(*coefficients: mpf) -> Callable[[mpf, int], mpf]:
    """Derivatives of c₀ + c₁x² + c₂x⁴ + …"""

    def value(x: mpf, m: int) -> mpf:
        return mp.fsum(c * mp.ff(2 * k, m) * x ** (2 * k - m) for k, c in enumerate(coefficients) if 2 * k >= m)

    return value


def matched(parameters: ContactParameters, found: SecondOrder) -> tuple[mpf, list[mpf]]:
    """What is left of the conditions at the front with λ₀, λ₁, λ₂ as found, and the r₀, r₁, r₂ that go with them.

    The module's expansions, term by term at 40 digits; all amplitudes from Taylor series in τ at x = λ₀ + λ₁τ + λ₂τ².
    """
    p = parameters
    alpha, psi, chi, n, kappa = (mpf(float(part)) for part in (p.alpha, p.psi, p.chi, p.axial, p.kappa_over_nu))
    lambdas = [mpf(float(part)) for part in (p.lambda0, found.lambda1, found.lambda2)]
    i2, i4, i6 = wave(2), wave(4), wave(6)
    outside: list[Term] = [
        lambda x, t, m: (1 - mp.j * n * t / 2 - (n * t) ** 2 / 8) * i2(x, m) + (n * t) ** 2 / 2 * i4(x, m),
        lambda x, t, m: t * (1 - mp.j * n * t / 2) * i4(x, m),
        lambda x, t, m: t**2 * i6(x, m),
    ]
    flight: Term = lambda x, t, m: (  # noqa: E731
        even(1 + t * alpha / 2 + t**2 * n * chi / 6, (t * chi - kappa) / 2 + t**2 * n * psi / 4, t * psi / 24)(x, m)
    )
    lifted: Term = lambda x, t, m: even(1 - t * n * kappa / 2, -kappa / 2)(x, m)  # noqa: E731
    middle: list[Term] = [
        lambda x, t, m: t * even(1, 0, -mpf(1) / 12)(x, m) - t**2 * n * even(0, mpf(1) / 2)(x, m),
        lambda x, t, m: t * even(t * n / 3, 1)(x, m),
        lambda x, t, m: t**2 * even(1, 0, -mpf(1) / 4)(x, m),
        lambda x, t, m: t**2 * even(0, 1, 0, -mpf(1) / 180)(x, m),
    ]
    detached = parameters.regime == "detached"
    base = lifted if detached else flight
    orders = (0, 1, 2, 3) if parameters.lambda0 > 0.0 else (0, 1, 3)  # one point: its curvature is free

    def at_front(term: Term, m: int) -> list[mpf]:
        return list(mp.taylor(lambda t: term(lambdas[0] + lambdas[1] * t + lambdas[2] * t**2, t, m), 0, 2))

    def conditions(outer: Term, inner: Term) -> list[mpf]:
        """Deflection and slope outside; what is left of curvature and third derivative across; both inside."""
        rows = [at_front(outer if m < 2 else lambda x, t, m: outer(x, t, m) - inner(x, t, m), m) for m in orders]
        rows += [at_front(inner, m) for m in (0, 1) if detached]
        return [c for row in rows for c in row]

    nothing: Term = lambda x, t, m: mpf(0)  # noqa: E731
    columns = [
        conditions(lambda x, t, m, u=u, part=part: mp.re(part * u(x, t, m)), nothing)
        for u in outside
        for part in (1, mp.j)
    ]
    columns += [conditions(nothing, u) for u in middle] if detached else []
    third = 3 * orders.index(3)
    columns += [[-mp.sqrt(2 / mp.pi) * (row == third + k) for row in range(len(columns[0]))] for k in range(3)]
    known = [c for m in orders for c in at_front(flight if m < 2 else base, m)]
    for m in (0, 1) if detached else ():
        known += [a - b for a, b in zip(at_front(flight, m), at_front(base, m))]
    matrix = mp.matrix(columns).T
    solution = mp.lu_solve(matrix, mp.matrix(known))
    return mp.norm(matrix * solution - mp.matrix(known), mp.inf), list(solution)[-3:]


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
    parameters = contact_parameters(ratio, *loads[:3], axial=loads[3])
    found = second_order(parameters)
    with mp.workdps(40):
        left, (r0, r1, r2) = matched(parameters, found)
        assert left < 1e-9
        assert float(r0) == pytest.approx(float(parameters.r0), rel=1e-9)
        assert (found.lambda1, found.r1) == pytest.approx((parameters.lambda1, parameters.r1), rel=1e-8)
        assert (float(r1), float(r2)) == pytest.approx((found.r1, found.r2), rel=1e-7)
