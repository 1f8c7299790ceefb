r"""Contact zone and reactions: λ_c = √τ(λ₀ + ελ₁τ), R̃ = 2√(2/π)(r₀ + εr₁τ)/√τ (2.7.6), (2.7.7).

    φ_κ(λ₀)/φ_ν(λ₀) = κ/ν,   r₀ = 1/φ_ν(λ₀)                              (2.6.21), (2.6.22)

continuous, κ/ν < 1, α+ψ ≥ 0                                                    (2.7.40)
    [ φ_α      −2r₀φ_λ/λ₀ ] [r₁]   [ 2α − 2(α+ψ)φ_p       ]
    [ −2φ_κ̇     r₀φ_λ̇/λ₀  ] [λ₁] = [ 4χ + √(2π)(α+ψ)φ_ṗ  ]
detached, κ/ν < 1, α+ψ < 0                                                      (2.7.71)
    [ φ_q/4     r₀φ_r + κλ₀ ] [r₁]   [ ψλ₀⁴/24 + χλ₀²/2 + α/2 ]
    [ −φ_t      κ − r₀φ_s   ] [λ₁] = [ ψλ₀³/6 + χλ₀           ]
discrete, κ/ν ≥ 1: λ₀ = λ₁ = 0, r₀ = 1, r₁ = 2α                        (2.6.23), (2.7.8)

in units of velocity, ν = 1. (At given κ/ν and loads r₀ ∝ ν, and what loads ν times as large do to λ₁ does not change.)

With an axial force N, tension positive, n = N/(μV₀²) = ε·axial (docs/theory.md, "Axial force"; not in the thesis)

    α′ = α + axial·κ decides the regime and takes the place of α above,
    λ_c = √τ(λ₀ + (ελ₁ + nλ_N)τ),   r₀ + (εr₁ + nr_N)τ.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from theory import phi
from theory._fresnel import FloatArray

#: Below it λ₁ and r₁, which grow like (κ/ν)^{−5/2}, need intermediate numbers beyond double precision.
FLATTEST_SOLVABLE = 1e-60

#: Products of three arguments stay below the largest double.
_LARGEST = 1e100

#: α′+ψ is known to so many of its terms: a few roundings each on the way from SI units.
_ROUNDING = 16.0 * float(np.finfo(float).eps)

DISCRETE = "discrete"
CONTINUOUS = "continuous"
DETACHED = "detached"


@dataclass(frozen=True)
class ContactParameters:
    """The solution of the fast layer in the contact point; all dimensionless.

    Floats and a string when every argument was a scalar, arrays of the broadcast shape otherwise.

    kappa_over_nu, alpha, psi, chi : what was asked for.
    regime : "discrete", "continuous" or "detached".
    lambda0, lambda1 : half contact length √τ(λ₀ + ελ₁τ), the axial force's part of λ₁ included.
    r0, r1 : concentrated reactions, in total 2√(2/π)(r₀ + εr₁τ)/√τ, the axial force's part of r₁ included.
    axial : axial force n/ε, tension positive.
    lambda_axial, r_axial : λ_N and r_N, what a unit of `axial` adds to λ₁ and r₁ when α′ = α + axial·κ is kept.
    uniform_reaction : r̃₁, the reaction per length ε r̃₁ in the contact zone: α′+ψ if continuous, else 0 (2.7.5).
    """

    kappa_over_nu: Any
    alpha: Any
    psi: Any
    chi: Any
    regime: Any
    lambda0: Any
    r0: Any
    lambda1: Any
    r1: Any
    axial: Any
    lambda_axial: Any
    r_axial: Any
    uniform_reaction: Any


def contact_parameters(
    kappa_over_nu: ArrayLike, alpha: ArrayLike = 0.0, psi: ArrayLike = 0.0, chi: ArrayLike = 0.0, axial: ArrayLike = 0.0
) -> ContactParameters:
    """λ₀, r₀ (leading order) and λ₁, r₁ (first order) of the impact.

    kappa_over_nu : curvature over velocity κ/ν > 0.
    alpha, psi, chi : acceleration, fourth derivative and rate of curvature of the slow motion (2.2.34)–(2.2.36), with
        what an axial force does to it; first order is linear in them.
    axial : axial force N/(μV₀²)/ε, tension positive. A bow free of stress under tension alone is α = −axial·κ.

    All arguments broadcast. Relative error below 1e-12 for κ/ν in 1e-12…1e12, of r₁ and λ₁ relative to
    the largest contribution of α, ψ, χ and the axial force. α′+ψ that is 0 but for rounding counts as 0.

    Raises ``ValueError`` for κ/ν not positive and finite, κ/ν < 1e-60, α, ψ, χ or the axial force not finite, any
    beyond 1e100.

    >>> from theory import contact_parameters
    >>> found = contact_parameters(0.5, alpha=4.0)
    >>> found.regime, round(found.lambda0, 4), round(found.r0, 4), round(found.lambda1, 3)
    ('continuous', 1.0189, 1.1772, 5.665)
    """
    arrays = _checked(kappa_over_nu=kappa_over_nu, alpha=alpha, psi=psi, chi=chi, axial=axial)
    shape = np.broadcast_shapes(*(v.shape for v in arrays.values()))
    ratio, a, p, c, axial = (np.ascontiguousarray(v).ravel() for v in np.broadcast_arrays(*arrays.values()))

    spreads = ratio < 1.0
    wave = axial * ratio  # the zone is flat, so the axial force does not act there: α′ = α + axial·κ
    pushed = (a + wave) + p
    pushed[np.abs(pushed) <= _ROUNDING * (np.abs(a) + np.abs(wave) + np.abs(p))] = 0.0
    rests = spreads & (pushed >= 0.0)
    lifts = spreads & ~rests
    regime = np.full(ratio.shape, DISCRETE, dtype="<U10")
    regime[rests], regime[lifts] = CONTINUOUS, DETACHED
    # discrete: 2α′ + axial(½ − 2κ)
    lambda0, r0, lambda1, r1 = np.zeros_like(ratio), np.ones_like(ratio), np.zeros_like(ratio), 2.0 * a + axial / 2.0
    lambda_axial, r_axial = np.zeros_like(ratio), 0.5 - 2.0 * ratio
    lambda0[spreads] = _lambda0(ratio[spreads])
    at = phi.Argument.of(lambda0[spreads])
    r0[spreads] = 1.0 / phi.phi_nu(at)
    lambda_axial[spreads], r_axial[spreads] = _axial(at, r0[spreads])
    for here, solve in ((rests, _continuous), (lifts, _detached)):
        loads = (v[here] for v in (a + wave, p, c, pushed))
        r1[here], lambda1[here] = solve(phi.Argument.of(lambda0[here]), r0[here], *loads)
    r1[spreads] += axial[spreads] * r_axial[spreads]
    lambda1[spreads] += axial[spreads] * lambda_axial[spreads]
    uniform = np.where(rests, pushed, 0.0)

    def shaped(values: NDArray[Any]) -> Any:
        return values.reshape(shape) if shape else values[0].item()

    return ContactParameters(
        *map(shaped, (ratio, a, p, c, regime, lambda0, r0, lambda1, r1, axial, lambda_axial, r_axial, uniform))
    )


def _checked(**given: ArrayLike) -> dict[str, FloatArray]:
    """The arguments as arrays. Raises ``ValueError`` for one out of range."""
    arrays: dict[str, FloatArray] = {}
    for name, value in given.items():
        if np.asarray(value).dtype.kind in "bSU":
            raise ValueError(f"{name} must be a number, or an array of numbers (got {value!r})")
        arrays[name] = values = np.asarray(value, dtype=np.float64)
        positive = name == "kappa_over_nu"
        good = np.isfinite(values) & (values > (0.0 if positive else -np.inf))
        if not np.all(good):
            need = "positive and finite" if positive else "finite"
            raise ValueError(f"{name} must be {need} (got {values[~good][0]})")
        if np.any(large := np.abs(values) > _LARGEST):
            raise ValueError(f"{name} must not exceed {_LARGEST:g} in size (got {values[large][0]:g})")
    if np.any(arrays["kappa_over_nu"] < FLATTEST_SOLVABLE):
        raise ValueError(
            f"kappa_over_nu must be at least {FLATTEST_SOLVABLE:g} (got {np.min(arrays['kappa_over_nu'])}): "
            "so flat a beam touches over its whole length at once"
        )
    return arrays


_SLOPE = float(np.sqrt(2.0 / np.pi))
# Newton's step after which the error, about its square, is below round-off.
_LAST_STEP = 1e-8


def _lambda0(ratio: FloatArray) -> FloatArray:
    """Root of (2.6.21) for 0 < κ/ν < 1. In log λ the logarithm of (φ_ν − φ_κ)/φ_κ = ν/κ − 1 is nearly a straight line,
    of slope 1 for small λ (√(2/π)λ) and 2 for large λ (λ²/2). Newton's method starts from the sum of the two limits,
    and neither limit loses digits."""
    target = (1.0 - ratio) / ratio
    log_lam = np.log(2.0 * target / (_SLOPE + np.sqrt(_SLOPE**2 + 2.0 * target)))
    for _ in range(30):
        lam = np.exp(log_lam)
        at = phi.Argument.of(lam)
        difference, kappa = phi.phi_nu_minus_kappa(at), phi.phi_kappa(at)
        # φ_ν′ = −(λ/2)φ_κ and −φ_κ′ = √(2/π)(1 − φ_p)
        fall = _SLOPE * phi.one_minus_phi_p(at)
        slope = lam * ((fall - lam / 2.0 * kappa) / difference + fall / kappa)
        step = np.log(difference / (target * kappa)) / slope
        log_lam = log_lam - step
        if np.all(np.abs(step) <= _LAST_STEP):
            return np.exp(log_lam)
    raise ArithmeticError(f"lambda0 did not converge for nu/kappa - 1 = {target[np.abs(step) > _LAST_STEP][0]!r}")


# Cramer's rule below: with the φ combinations reduced no determinant cancels (their terms differ in sign
# or in order of λ), and rows of very different size do no harm, as they would to pivoting.


def _continuous(
    at: phi.Argument, r0: FloatArray, alpha: FloatArray, psi: FloatArray, chi: FloatArray, pushed: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """(r₁, λ₁) of (2.7.40), with `pushed` = α+ψ."""
    lam = at.lam
    phi_nu, phi_kappa = phi.phi_nu(at), phi.phi_kappa(at)
    phi_alpha, phi_kappadot = phi.phi_alpha(at), phi.phi_kappadot(at)
    phi_lambda, phi_lambdadot = phi.phi_lambda(at), phi.phi_lambdadot(at)
    # 2α − 2(α+ψ)φ_p in the form that does not cancel: φ_p → 0 for small λ, → 1 for large λ
    deflection = np.where(
        lam < 1.0, 2.0 * alpha - 2.0 * pushed * phi.phi_p(at), 2.0 * pushed * phi.one_minus_phi_p(at) - 2.0 * psi
    )
    curvature = 4.0 * chi + np.sqrt(2.0 * np.pi) * pushed * phi.phi_pdot(at)
    # φ_α·curvature + 2φ_κ̇·deflection; for small λ the parts linear in λ of the uniform reaction's
    # terms cancel, √(2π)φ_ṗφ_α − 4φ_pφ_κ̇ = 2λ²φ_ν − √(π/2)λ³(φ_κ² + φ_ν²)
    spread = np.where(
        lam < 1.0,
        4.0 * alpha * phi_kappadot
        + 4.0 * chi * phi_alpha
        + pushed * lam**2 * (2.0 * phi_nu - np.sqrt(np.pi / 2.0) * lam * (phi_kappa**2 + phi_nu**2)),
        phi_alpha * curvature + 2.0 * phi_kappadot * deflection,
    )
    determinant = phi_alpha * phi_lambdadot - 4.0 * phi_lambda * phi_kappadot
    r1 = (phi_lambdadot * deflection + 2.0 * phi_lambda * curvature) / determinant
    return r1, lam / r0 * spread / determinant


def _detached(
    at: phi.Argument, r0: FloatArray, alpha: FloatArray, psi: FloatArray, chi: FloatArray, pushed: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """(r₁, λ₁) of (2.7.71) divided by r₀ in its second column, with κ = r₀φ_κ (2.7.69)."""
    lam = at.lam
    phi_q, phi_t = phi.phi_q(at) / 4.0, phi.phi_t(at)
    column = phi.phi_r_plus_lambda_phi_kappa(at), phi.phi_kappa_minus_s(at)
    deflection = psi * lam**4 / 24.0 + chi * lam**2 / 2.0 + alpha / 2.0
    slope = psi * lam**3 / 6.0 + chi * lam
    determinant = phi_q * column[1] + phi_t * column[0]
    r1 = (column[1] * deflection - column[0] * slope) / determinant
    return r1, (phi_q * slope + phi_t * deflection) / (determinant * r0)


def _axial(at: phi.Argument, r0: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(λ_N, r_N) of a spreading contact, the same in both regimes (docs/theory.md, "Axial force"). They are the answer
    to χ_N = −√(2/π)(r₀/λ₀)(1 − φ_p) of a beam without load, and 1/λ₀ on top of λ_N; for small λ₀, where the two parts
    of λ_N cancel, the same written out."""
    slope, near = _SLOPE, at.near
    lambda_axial, r_axial = np.empty_like(r0), np.empty_like(r0)
    x, (a, b) = at.lam[near], at.integrals
    size = a**2 + b**2  # of the wave
    determinant = slope * (4.0 * a + 2.0 * x**2 * b + x**4 * a - slope * x**3) - size * (3.0 * x + x**5 / 4.0)
    lambda_axial[near] = (
        slope * x * (4.0 * b + x**2 * a - slope * x) - a**2 - 3.0 * b**2 - x**2 * a * b - x**4 * size / 4.0
    ) / determinant
    r_axial[near] = r0[near] * (x * a - 2.0 * slope) * (6.0 * b - 2.0 * slope * x + x**2 * a) / (2.0 * determinant)

    far, reaction = phi.Argument.of(at.lam[~near]), r0[~near]
    x = far.lam
    rate = -slope * (reaction / x) * phi.one_minus_phi_p(far)
    none = np.zeros_like(x)
    r_axial[~near], lambda_axial[~near] = _continuous(far, reaction, none, none, rate, none)
    lambda_axial[~near] += 1.0 / x
    return lambda_axial, r_axial
