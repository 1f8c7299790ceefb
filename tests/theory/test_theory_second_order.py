"""λ₂, r₂, and λ₁, r₁ found again without any φ: both sides of the front meet, term by term in many digits."""

from collections.abc import Callable, Sequence

import pytest
from many_digits import wave
from mpmath import mp, mpf

from theory import contact_parameters
from theory.second_order import second_order

Term = Callable[[mpf, mpf, int], mpf]  # of x, τ and the order of the derivative in x


def even(*coefficients: mpf) -> Callable[[mpf, int], mpf]:
    """Derivatives of c₀ + c₁x² + c₂x⁴ + …"""

    def value(x: mpf, m: int) -> mpf:
        return mp.fsum(c * mp.ff(2 * k, m) * x ** (2 * k - m) for k, c in enumerate(coefficients) if 2 * k >= m)

    return value


def matched(ratio: float, loads: Sequence[float]) -> tuple[mpf, list[mpf]]:
    """What is left of the conditions at the front with λ₀, λ₁, λ₂ as found, and the r₀, r₁, r₂ that go with them.

    The module's expansions, term by term at 40 digits; all amplitudes from Taylor series in τ at x = λ₀ + λ₁τ + λ₂τ².
    """
    alpha, psi, chi, n = (mpf(load) for load in loads)
    parameters = contact_parameters(ratio, *loads[:3], axial=loads[3])
    found = second_order(parameters)
    lambdas, kappa = (mpf(float(parameters.lambda0)), mpf(found.lambda1), mpf(found.lambda2)), mpf(ratio)
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
        left, (r0, r1, r2) = matched(ratio, loads)
        assert left < 1e-9
        assert float(r0) == pytest.approx(float(parameters.r0), rel=1e-9)
        assert (found.lambda1, found.r1) == pytest.approx((parameters.lambda1, parameters.r1), rel=1e-8)
        assert (float(r1), float(r2)) == pytest.approx((found.r1, found.r2), rel=1e-7)
