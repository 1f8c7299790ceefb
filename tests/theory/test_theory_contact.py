"""λ₀, r₀, λ₁, r₁ against multiprecision, against a derivation without φ functions, and in their limits."""

from __future__ import annotations

from functools import lru_cache

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from theory import contact_parameters, phi

PARAMETERS = ("lambda0", "r0", "lambda1", "r1")
COEFFICIENTS = st.integers(-1000, 1000).map(lambda n: n / 100.0)
DIGITS = 110


def phi_pair(lam: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
    x, phase = lam / mp.sqrt(2 * mp.pi), lam**2 / 4
    s, c = mp.fresnels(x), mp.fresnelc(x)
    sine, cosine = mp.sin(phase), mp.cos(phase)
    return cosine * (1 - 2 * s) - sine * (1 - 2 * c), cosine * (1 - 2 * c) + sine * (1 - 2 * s)


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


def multiprecision(ratio: float, alpha: float, psi: float, chi: float, nu: float) -> dict[str, mp.mpf]:
    """The thesis's systems (2.7.40), (2.7.71) with its closed forms (A.5) as they stand."""
    with mp.workdps(DIGITS):
        k, a, p, c, v = map(mp.mpf, (ratio, alpha, psi, chi, nu))
        if k >= 1:
            return dict(zip(PARAMETERS, (mp.mpf(0), v, mp.mpf(0), 2 * a), strict=True))
        x = front(ratio)
        n, g = phi_pair(x)
        root, q2 = mp.sqrt(2 * mp.pi), mp.sqrt(2 / mp.pi)
        r0, kappa = v / n, k * v
        if a + p >= 0:
            alpha_, p_, pdot = n - x**2 / 2 * g, mp.sqrt(mp.pi / 8) * x * n, x * g
            lambda_ = 3 * x**2 / 4 * g - x**3 / 2 / root + x**4 / 8 * n
            kappadot = g - q2 * x + x**2 / 2 * n
            lambdadot = 4 * x * q2 - 3 * x**2 * n + x**4 / 2 * g
            matrix = [[alpha_, -2 * r0 * lambda_ / x], [-2 * kappadot, r0 * lambdadot / x]]
            right = [2 * a - 2 * (a + p) * p_, 4 * c + root * (a + p) * pdot]
        else:
            q = q2 * x**3 + (x**6 - 36 * x**2) / 24 * g + (12 - 7 * x**4) / 12 * n
            r = x**3 * (x**4 - 84) / 192 * n + x * (3 * x**4 - 44) / 32 * g - x**2 * (x**4 - 60) / 48 / root
            s = x**2 * (36 - x**4) / 48 * n + (4 - x**4) / 4 * g + x * (x**4 - 24) / 12 / root
            t = x**3 / 3 * n + x * (12 - x**4) / 24 * g - x**2 / root
            matrix = [[q / 4, r0 * r + kappa * x], [-t, kappa - r0 * s]]
            right = [p * x**4 / 24 + c * x**2 / 2 + a / 2, p * x**3 / 6 + c * x]
        r1, lambda1 = mp.lu_solve(mp.matrix(matrix), mp.matrix(right))
        return dict(zip(PARAMETERS, (x, r0, lambda1, r1), strict=True))


def assert_exact(ratio: float, alpha: float, psi: float, chi: float, nu: float = 1.0) -> None:
    found, reference = (
        contact_parameters(ratio, alpha, psi, chi, nu),
        multiprecision(ratio, alpha, psi, chi, nu),
    )
    # first order is linear in (α, ψ, χ): an error is measured by the largest of the three contributions
    same = "continuous" if alpha + psi >= 0.0 else "detached"
    parts = [(alpha, 0.0, 0.0), (0.0, psi, 0.0), (0.0, 0.0, chi)]
    for name in PARAMETERS:
        scale = abs(float(reference[name]))
        if name in ("lambda1", "r1"):
            for part in parts:
                sign = 1.0 if contact_parameters(ratio, *part, nu).regime in (same, "discrete") else -1.0
                value = getattr(contact_parameters(ratio, *(sign * v for v in part), nu), name)
                scale = max(scale, abs(value))
        error = abs(float(mp.mpf(getattr(found, name)) - reference[name]))
        assert error <= 1e-12 * scale, (name, getattr(found, name), float(reference[name]))


def test_parameters_are_exact_from_flat_to_strongly_curved() -> None:
    rng = np.random.default_rng(11)
    ratios = [
        *10.0 ** rng.uniform(-8, 0, 25),
        *(1.0 - 10.0 ** rng.uniform(-9, -1, 15)),
        *10.0 ** rng.uniform(0, 4, 4),
    ]
    for ratio in ratios:
        assert_exact(ratio, *rng.normal(size=3), 10.0 ** rng.uniform(-2, 2))


@pytest.mark.parametrize("ratio", [1e-8, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.999999])
@pytest.mark.parametrize("index", [0, 1, 2])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_every_coefficient_of_first_order_is_exact_on_its_own(ratio: float, index: int, sign: float) -> None:
    loads = [0.0, 0.0, 0.0]
    loads[index] = sign
    found, reference = contact_parameters(ratio, *loads), multiprecision(ratio, *loads, 1.0)
    for name in PARAMETERS:
        assert getattr(found, name) == pytest.approx(float(reference[name]), rel=1e-11)


@pytest.mark.parametrize(
    ("ratio", "lambda0", "r0"),
    [
        (1 / 1600, 56.5684099145, 35.4490354773),
        (0.05, 6.23692857563, 3.93727884942),
        (0.1, 4.25760478009, 2.74499113477),
        (0.25, 2.26148623298, 1.66800147203),
        (0.5, 1.01886591389, 1.17721208090),
        (0.8, 0.296846693037, 1.01915199895),
    ],
)
def test_leading_order_table(ratio: float, lambda0: float, r0: float) -> None:
    found = contact_parameters(ratio)
    assert (found.lambda0, found.r0) == pytest.approx((lambda0, r0), rel=5e-12)
    assert (found.lambda1, found.r1, found.regime) == (0.0, 0.0, "continuous")


@pytest.mark.parametrize(
    ("ratio", "loads", "r1", "lambda1"),
    [
        (0.5, (4, 0, 0), 10.6928065607, 5.66465632402),
        (0.5, (1, 1, 0), 1.83706066099, 2.44897173395),
        (0.5, (0, 2, 0), -1.67228195835, 2.06561530589),
        (0.5, (-1, -1, 0), -4.18053010088, -1.77288819407),
        (0.3, (-1, -1, 1), 5.30283507602, 3.58296616170),
        (0.1, (1, 0, 0), 5.26139050270, 1.50003675838),
        (0.1, (-1, 0, 0), -5.44939483102, -1.40283570044),
    ],
)
def test_first_order_table(ratio: float, loads: tuple[int, int, int], r1: float, lambda1: float) -> None:
    found = contact_parameters(ratio, *loads)
    assert (found.r1, found.lambda1) == pytest.approx((r1, lambda1), rel=5e-12)


@given(ratio=st.floats(1e-6, 1.0, exclude_max=True), alpha=COEFFICIENTS, chi=COEFFICIENTS)
def test_both_first_order_systems_agree_without_uniform_reaction(
    ratio: float, alpha: float, chi: float
) -> None:
    from theory.contact import _continuous, _detached

    found = contact_parameters(ratio)
    at = phi.Argument.of(np.array([found.lambda0]))
    arguments = [at, *(np.array([v]) for v in (found.r0, alpha, -alpha, chi, 0.0))]
    with_zone, without = _continuous(*arguments), _detached(*arguments)
    for one, other, index in zip(with_zone, without, (0, 1), strict=True):
        scale = max(
            abs(_continuous(*arguments[:2], *map(np.array, part))[index])
            for part in (
                ([alpha], [0.0], [0.0], [alpha]),
                ([0.0], [-alpha], [0.0], [-alpha]),
                ([0.0], [0.0], [chi], [0.0]),
            )
        )
        assert abs(one - other) <= 1e-11 * scale


def iterated_erfc(z: mp.mpc, order: int) -> list[mp.mpc]:
    values = [mp.erfc(z), mp.exp(-(z**2)) / mp.sqrt(mp.pi) - z * mp.erfc(z)]
    for n in range(2, order + 1):
        values.append((values[-2] - 2 * z * values[-1]) / (2 * n))
    return values


def without_phi(ratio: float, alpha: float, psi: float, chi: float) -> tuple[float, ...]:
    """(λ₁, r₁, residual of λ₀ and r₀) from waves B iⁿerfc(z), z = e^{−iπ/4}x/2, patched at the front.

    η₀ = τ Re[B₀ i²erfc], η₁ = τ² Re[B₁ i⁴erfc] solve the beam equation outside the front. There η₀, its slope
    and curvature are those of the slow motion and its third derivative jumps by √(2/π)r₀. At first order the
    front has moved by ελ₁τ, which that jump turns into a jump λ₁√(2/π)r₀ of the curvature, and so on.
    Continuous: inside, η₁ is the slow motion. Detached: inside, η₁ = aτ² + bξ²τ − aξ⁴/12, and it touches at
    the front with the slow motion's deflection and slope. No integral and no φ function is involved.
    """
    with mp.workdps(60):
        x, step = front(ratio), mp.exp(-1j * mp.pi / 4) / 2
        e = iterated_erfc(step * x, 4)
        first = -2 * step / mp.sqrt(mp.pi) * mp.exp(-((step * x) ** 2))  # d erfc/dx
        second = -2 * step**2 * x * first  # d² erfc/dx²
        row = lambda c: [mp.re(c), -mp.im(c)]  # noqa: E731
        # leading order: slope and curvature fix B₀; deflection and third derivative give r₀ and a check
        b0 = mp.lu_solve(
            mp.matrix([row(-step * e[1]), row(step**2 * e[0])]), mp.matrix([-ratio * x, -mp.mpf(ratio)])
        )
        b0 = mp.mpc(b0[0], b0[1])
        residual = mp.re(b0 * e[2]) - (1 - ratio * x**2 / 2)
        third, fourth = mp.re(b0 * step**2 * first), mp.re(b0 * step**2 * second)
        r0 = third / mp.sqrt(2 / mp.pi)
        outside = [row(e[4]), row(-step * e[3]), row(step**2 * e[2]), row(-(step**3) * e[1])]
        slow = [
            psi * x**4 / 24 + chi * x**2 / 2 + mp.mpf(alpha) / 2,
            psi * x**3 / 6 + chi * x,
            psi * x**2 / 2 + chi,
            psi * x,
        ]
        q2 = mp.sqrt(2 / mp.pi)
        if alpha + psi >= 0:
            # unknowns Re B₁, Im B₁, λ₁, r₁
            matrix = [
                [*outside[0], 0, 0],
                [*outside[1], 0, 0],
                [*outside[2], third, 0],
                [*outside[3], fourth, -q2],
            ]
            solution = mp.lu_solve(mp.matrix(matrix), mp.matrix(slow))
            lambda1, r1 = solution[2], solution[3]
        else:
            # unknowns Re B₁, Im B₁, a, b, λ₁, r₁; the front moves along the wall, so that η₀ adds nothing
            # to deflection and slope
            inside = [
                [1 - x**4 / 12, x**2],
                [-(x**3) / 3, 2 * x],
                [-(x**2), 2],
                [-2 * x, 0],
            ]
            matrix = [[*outside[0], 0, 0, 0, 0], [*outside[1], 0, 0, 0, 0]]
            right = [*slow[:2], 0, 0, 0, 0]
            extra = [[0, 0], [0, 0], [third, 0], [fourth, -q2]]
            for i in range(4):
                matrix.append([*outside[i], *(-v for v in inside[i]), *extra[i]])
            solution = mp.lu_solve(mp.matrix(matrix), mp.matrix(right))
            lambda1, r1 = solution[4], solution[5]
        return float(lambda1), float(r1), float(residual), float(r0)


@pytest.mark.parametrize("ratio", [0.9, 0.5, 0.1, 0.01])
@pytest.mark.parametrize("loads", [(1, 0, 0), (1, 1, -2), (0, 2, 1), (-1, -1, 0), (-2, 1, 1), (0, -1, 3)])
def test_patched_waves_give_the_same_solution_without_any_phi(
    ratio: float, loads: tuple[float, float, float]
) -> None:
    found = contact_parameters(ratio, *loads)
    lambda1, r1, residual, r0 = without_phi(ratio, *loads)
    assert residual == pytest.approx(0.0, abs=1e-20)
    assert found.r0 == pytest.approx(r0, rel=1e-12)
    assert found.lambda1 == pytest.approx(lambda1, rel=1e-11)
    assert found.r1 == pytest.approx(r1, rel=1e-11)


def test_flat_beam_limit() -> None:
    found = contact_parameters(1e-8)
    assert found.lambda0 == pytest.approx(np.sqrt(2e8), rel=1e-7)
    assert found.r0 == pytest.approx(np.sqrt(np.pi / 8.0) * found.lambda0, rel=1e-7)


def test_limit_of_one_point() -> None:
    found = contact_parameters(1.0 - 2.0**-40, alpha=3.0, psi=-1.0, chi=2.0)
    assert found.lambda0 == pytest.approx(np.sqrt(np.pi / 2.0) * 2.0**-40, rel=1e-11)
    assert (found.r0, found.r1) == pytest.approx((1.0, 6.0), rel=1e-11)
    assert found.lambda1 == pytest.approx(np.sqrt(np.pi / 2.0) * 5.0, rel=1e-11)


def test_regimes_and_their_borders() -> None:
    assert contact_parameters(1.0).regime == "discrete"
    assert contact_parameters(np.nextafter(1.0, 0.0)).regime == "continuous"
    assert contact_parameters(0.5, 1.0, -1.0).regime == "continuous"
    assert contact_parameters(0.5, 1.0, -1.0 - 1e-12).regime == "detached"
    found = contact_parameters(7.0, alpha=-1.5, psi=4.0, chi=2.0, nu=3.0)
    assert (found.lambda0, found.r0, found.lambda1, found.r1) == (0.0, 3.0, 0.0, -3.0)


def test_uniform_reaction_exists_in_the_continuous_regime_only() -> None:
    found = contact_parameters([0.5, 0.5, 2.0], alpha=[1.0, -1.0, 1.0], psi=0.25)
    np.testing.assert_array_equal(found.uniform_reaction, [1.25, 0.0, 0.0])
    assert contact_parameters(0.5, 1.0).uniform_reaction == 1.0


@given(
    ratio=st.floats(1e-6, 1e4),
    loads=st.tuples(COEFFICIENTS, COEFFICIENTS, COEFFICIENTS),
    nu=st.floats(1e-2, 1e2),
)
def test_first_order_is_linear_and_scales_with_velocity(
    ratio: float, loads: tuple[float, float, float], nu: float
) -> None:
    one, other = contact_parameters(ratio, *loads), contact_parameters(ratio, *loads, nu)
    assert other.lambda0 == one.lambda0
    assert other.r0 == pytest.approx(nu * one.r0, rel=1e-14)
    assert other.r1 == pytest.approx(one.r1, rel=1e-12, abs=1e-300)
    assert other.lambda1 == pytest.approx(one.lambda1 / nu, rel=1e-12, abs=1e-300)
    twice = contact_parameters(ratio, *(2.0 * v for v in loads))
    assert (twice.r1, twice.lambda1) == pytest.approx((2.0 * one.r1, 2.0 * one.lambda1), rel=1e-12)


@given(low=st.floats(1e-9, 0.999), factor=st.floats(1.001, 10.0))
def test_flatter_beams_spread_faster_and_press_harder(low: float, factor: float) -> None:
    found = contact_parameters([low, low * factor])
    assert found.lambda0[0] > found.lambda0[1]
    assert found.r0[0] > found.r0[1]


@settings(max_examples=30)
@given(shape=st.sampled_from([(), (1,), (4,), (2, 3), (0,)]))
def test_arguments_broadcast(shape: tuple[int, ...]) -> None:
    found = contact_parameters(np.full(shape, 0.5), alpha=1.0)
    assert np.shape(found.lambda0) == np.shape(found.regime) == np.shape(found.chi) == shape
    if not shape:
        assert isinstance(found.lambda0, float) and isinstance(found.regime, str)


def test_arrays_equal_scalars() -> None:
    ratio, alpha, psi = np.meshgrid([1e-5, 0.02, 0.6, 3.0], [-1.0, 0.0, 2.0], [-0.5, 1.0])
    found = contact_parameters(ratio, alpha, psi, 0.3)
    for index in np.ndindex(ratio.shape):
        single = contact_parameters(ratio[index], alpha[index], psi[index], 0.3)
        assert found.regime[index] == single.regime
        for name in PARAMETERS:
            assert getattr(found, name)[index] == pytest.approx(getattr(single, name), rel=1e-13)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"kappa_over_nu": 0.0}, r"kappa_over_nu must be positive and finite \(got 0.0\)"),
        ({"kappa_over_nu": -0.5}, r"kappa_over_nu must be positive and finite \(got -0.5\)"),
        ({"kappa_over_nu": np.nan}, r"kappa_over_nu must be positive and finite \(got nan\)"),
        ({"kappa_over_nu": [0.5, np.inf]}, r"kappa_over_nu must be positive and finite \(got inf\)"),
        ({"kappa_over_nu": 1e-80}, r"kappa_over_nu must be at least 1e-60 \(got 1e-80\)"),
        ({"kappa_over_nu": 1e308}, r"kappa_over_nu must not exceed 1e\+100 in size \(got 1e\+308\)"),
        ({"kappa_over_nu": 0.5, "alpha": -1e200}, r"alpha must not exceed 1e\+100 in size \(got -1e\+200\)"),
        ({"kappa_over_nu": 0.5, "nu": 0.0}, r"nu must be positive and finite \(got 0.0\)"),
        ({"kappa_over_nu": 0.5, "alpha": np.nan}, r"alpha must be finite \(got nan\)"),
        ({"kappa_over_nu": 0.5, "psi": -np.inf}, r"psi must be finite \(got -inf\)"),
        ({"kappa_over_nu": 0.5, "chi": np.inf}, r"chi must be finite \(got inf\)"),
    ],
)
def test_bad_input_is_named(arguments: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        contact_parameters(**arguments)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("ratio", [1e-60, 0.5, 1e100])
def test_nothing_overflows_up_to_the_largest_arguments(ratio: float) -> None:
    for sign in (1.0, -1.0):
        found = contact_parameters(ratio, sign * 1e100, -1e100, sign * 1e100, axial=-sign * 1e100)
        assert np.isfinite(found.r_axial)
        if ratio > 1e-20:
            assert np.isfinite(found.r1) and np.isfinite(found.lambda1)
