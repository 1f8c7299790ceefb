r"""The beam under a unit impulse: ∂²K/∂τ² + ∂⁴K/∂ξ⁴ = δ(τ)δ(ξ).

    K(ξ,τ) = √(τ/2π) H(|ξ|/√τ)                                                       (2.3.2)
    H(β)   = √(π/2) β [S − C](β/√2π) + √2 sin((π+β²)/4)                              (2.3.3)
    H′ = √(π/2)[S − C],   H″ = ½[sin − cos](β²/4),   H‴ = (β/4)[cos + sin](β²/4)
    P(β)   = ∫₀^β H = βH/2 + √(π/2)[S + C]                                           (2.7.12)

H, H″, K are even, H′, H‴, P odd. (2.3.3) cancels for large β; there, with the moments I_k(β²/4) of
`theory._fresnel` and c, s = cos, sin(β²/4),

    H  = √(π/8) β [(c+s) I₂ + (c−s) I₁],        H′ = −√(π/8) [(c+s) I₀ − (c−s) I₁],
    S + C = 1 − ½[(c+s) I₁ + (c−s) I₀].

Under an axial force n the kernel is √(τ/2π)[H(β) + nτ H_N(β)] to first order in n, z = e^{−iπ/4}|β|/2,

    H_N(β) = √(2π) Re[e^{iπ/4}(2 i³erfc z − ½ ierfc z)],   H_N(0) = −1/6             (new: docs/theory.md)

Relative error below 1e-13 of the value, next to a zero of the envelope, for |β| to 1e6 and beyond.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import fresnel

from theory._fresnel import SWITCH, TURN, FloatArray, scaled_iterated_erfc, scaled_moments

# Past it β³ would overflow; H, H′ and P − √(π/2) are zero to double precision long before.
_LARGEST = 1e100
_SPLIT = 2.0**27 + 1.0


def _phase(beta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """cos and sin of β²/4 with β² taken exactly. Rounding β² alone would shift the phase by 3e-5 at β = 1e6: the
    rounded-off part of the square (Dekker's product) is put back by the addition theorem."""
    square = beta * beta
    high = _SPLIT * beta - (_SPLIT * beta - beta)
    low = beta - high
    rest = ((high * high - square) + 2.0 * high * low) + low * low
    c, s = np.cos(square / 4.0), np.sin(square / 4.0)
    dc, ds = np.cos(rest / 4.0), np.sin(rest / 4.0)
    return c * dc - s * ds, s * dc + c * ds


def _size(beta: ArrayLike) -> FloatArray:
    return np.asarray(np.minimum(np.abs(np.asarray(beta, dtype=np.float64)), _LARGEST))


def _evaluate(beta: ArrayLike, closed: Callable[..., FloatArray], reduced: Callable[..., FloatArray]) -> FloatArray:
    """A function of |β| by closed(|β|, S, C) near 0, by reduced(|β|, q, scaled moments, c, s) beyond."""
    b = _size(beta)
    near, result = b < SWITCH, np.empty_like(b)
    x = b[near]
    result[near] = closed(x, *fresnel(x / np.sqrt(2.0 * np.pi)))
    x = b[~near]
    q = x**2 / 4.0
    result[~near] = reduced(x, q, scaled_moments(q), *_phase(x))
    return result


def H(beta: ArrayLike) -> FloatArray | float:
    """Shape of the deflection under an impulse (2.3.3); β of any shape, H(0) = 1, even."""
    return _evaluate(
        beta,
        lambda x, S, C: np.sqrt(np.pi / 2.0) * x * (S - C) + np.cos(x**2 / 4.0) + np.sin(x**2 / 4.0),
        # √(π/8) β q^{-3/2} = √(π/2)/q
        lambda x, q, m, c, s: np.sqrt(np.pi / 2.0) / q * ((c + s) * m[2] / q + (c - s) * m[1]),
    )[()]


def H1(beta: ArrayLike) -> FloatArray | float:
    """H′, odd; β of any shape."""
    size = _evaluate(
        beta,
        lambda x, S, C: np.sqrt(np.pi / 2.0) * (S - C),
        lambda x, q, m, c, s: np.sqrt(np.pi / 2.0) / x * ((c - s) * m[1] / q - (c + s) * m[0]),
    )
    return (np.copysign(1.0, beta) * size)[()]


def H2(beta: ArrayLike) -> FloatArray | float:
    """H″, even, which oscillates without decay; β of any shape."""
    c, s = _phase(_size(beta))
    return (0.5 * (s - c))[()]


def H3(beta: ArrayLike) -> FloatArray | float:
    """H‴, odd, which oscillates and grows like β; β of any shape."""
    c, s = _phase(_size(beta))
    return (np.asarray(beta, dtype=np.float64) / 4.0 * (c + s))[()]


def P(beta: ArrayLike) -> FloatArray | float:
    """∫₀^β H (2.7.12), odd, P(∞) = √(π/2); β of any shape."""
    both = _evaluate(
        beta,
        lambda x, S, C: S + C,
        lambda x, q, m, c, s: 1.0 - 0.5 * ((c + s) * m[1] / q + (c - s) * m[0]) / np.sqrt(q),
    )
    return (np.copysign(1.0, beta) * (0.5 * _size(beta) * H(beta) + np.sqrt(np.pi / 2.0) * both))[()]


def H_axial(beta: ArrayLike) -> FloatArray | float:
    """H_N, even: what an axial force nτ = 1 adds to H; β of any shape, absolute error below 1e-15."""
    b = np.atleast_1d(_size(beta))
    _, first, _, third = scaled_iterated_erfc(TURN * b)
    c, s = _phase(b)
    wave = np.exp(0.25j * np.pi) * (c + 1j * s) * (2.0 * third - 0.5 * first)
    return (np.sqrt(2.0 * np.pi) * wave.real).reshape(np.shape(beta))[()]


def K(xi: ArrayLike, tau: ArrayLike) -> FloatArray | float:
    """Deflection at (ξ, τ) under a unit impulse at (0, 0) (2.3.2); ξ and τ ≥ 0 broadcast, K = 0 at τ = 0."""
    position, time = np.broadcast_arrays(np.asarray(xi, dtype=np.float64), np.asarray(tau, dtype=np.float64))
    if not np.all(time >= 0.0):
        raise ValueError(f"tau must not be negative or NaN (got {tau!r})")
    root = np.sqrt(time)
    beta = np.divide(position, root, out=np.zeros(position.shape), where=root > 0.0)
    return (root / np.sqrt(2.0 * np.pi) * H(beta))[()]
