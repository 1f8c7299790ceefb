r"""The beam under a unit impulse: ∂²K/∂τ² + ∂⁴K/∂ξ⁴ = δ(τ)δ(ξ).

    K(ξ,τ) = √(τ/2π) H(|ξ|/√τ)                                                       (2.3.2)
    H(β)   = √(π/2) β [S − C](β/√2π) + √2 sin((π+β²)/4)                              (2.3.3)
    H′ = √(π/2)[S − C],   H″ = ½[sin − cos](β²/4),   H‴ = (β/4)[cos + sin](β²/4)
    P(β)   = ∫₀^β H                                                                  (2.7.12)

H, H″, K are even, H′, H‴, P odd. (2.3.3) cancels for large β; there, with the moments I_k(β²/4) of
`theory._fresnel` and c, s = cos, sin(β²/4),

    H  = √(π/8) β [(c+s) I₂ + (c−s) I₁],        H′ = −√(π/8) [(c+s) I₀ − (c−s) I₁],
    P  = √(π/2) {1 + ½(s−c)(2q I₃ − I₂) + ½(s+c)(2q I₂ − I₁)},   q = β²/4.

Under an axial force n the kernel is √(τ/2π)[H(β) + nτ H_N(β)] to first order in n, z = e^{−iπ/4}|β|/2,

    H_N(β) = √(2π) Re[e^{iπ/4}(2 i³erfc z − ½ ierfc z)],   H_N(0) = −1/6             (new: docs/theory.md)

Relative error below 1e-13 of the value, next to a zero of the envelope, for |β| to 1e6 and beyond.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from theory._fresnel import SWITCH, TURN, FloatArray, fresnel_integrals, scaled_iterated_erfc, scaled_moments

# Past it β³ would overflow; H, H′ and P − √(π/2) are zero to double precision long before.
_LARGEST = 1e100
_SPLIT = 2.0**27 + 1.0


def _phase(beta: FloatArray) -> tuple[FloatArray, FloatArray]:
    """cos and sin of β²/4 with β² taken exactly.

    Rounding β² alone would shift the phase by 3e-5 at β = 1e6: the rounded-off part of the square
    (Dekker's product) is put back by the addition theorem.
    """
    square = beta * beta
    high = _SPLIT * beta - (_SPLIT * beta - beta)
    low = beta - high
    rest = ((high * high - square) + 2.0 * high * low) + low * low
    c, s = np.cos(square / 4.0), np.sin(square / 4.0)
    dc, ds = np.cos(rest / 4.0), np.sin(rest / 4.0)
    return c * dc - s * ds, s * dc + c * ds


def _prepare(beta: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    values = np.asarray(beta, dtype=np.float64)
    flat = values.ravel()
    return flat, np.minimum(np.abs(flat), _LARGEST), np.empty_like(flat)


def _finish(result: FloatArray, beta: ArrayLike) -> FloatArray | float:
    shape = np.shape(beta)
    return result.reshape(shape) if shape else float(result[0])


def H(beta: ArrayLike) -> FloatArray | float:
    """Shape of the deflection under an impulse (2.3.3); β of any shape, H(0) = 1, even."""
    _, b, result = _prepare(beta)
    near = b < SWITCH
    x = b[near]
    s_integral, c_integral = fresnel_integrals(x)
    result[near] = (
        np.sqrt(np.pi / 2.0) * x * (s_integral - c_integral) + np.cos(x**2 / 4.0) + np.sin(x**2 / 4.0)
    )
    x = b[~near]
    q = x**2 / 4.0
    m = scaled_moments(q)
    c, s = _phase(x)
    # √(π/8) β q^{-3/2} = √(π/2)/q
    result[~near] = np.sqrt(np.pi / 2.0) / q * ((c + s) * m[2] / q + (c - s) * m[1])
    return _finish(result, beta)


def H1(beta: ArrayLike) -> FloatArray | float:
    """H′, odd; β of any shape."""
    signed, b, result = _prepare(beta)
    near = b < SWITCH
    s_integral, c_integral = fresnel_integrals(b[near])
    result[near] = np.sqrt(np.pi / 2.0) * (s_integral - c_integral)
    x = b[~near]
    q = x**2 / 4.0
    m = scaled_moments(q)
    c, s = _phase(x)
    result[~near] = np.sqrt(np.pi / 2.0) / x * ((c - s) * m[1] / q - (c + s) * m[0])
    return _finish(np.copysign(1.0, signed) * result, beta)


def H2(beta: ArrayLike) -> FloatArray | float:
    """H″, even, which oscillates without decay; β of any shape."""
    _, b, _ = _prepare(beta)
    c, s = _phase(b)
    return _finish(0.5 * (s - c), beta)


def H3(beta: ArrayLike) -> FloatArray | float:
    """H‴, odd, which oscillates and grows like β; β of any shape."""
    signed, b, _ = _prepare(beta)
    c, s = _phase(b)
    return _finish(signed / 4.0 * (c + s), beta)


def P(beta: ArrayLike) -> FloatArray | float:
    """∫₀^β H (2.7.12), odd, P(∞) = √(π/2); β of any shape."""
    signed, b, result = _prepare(beta)
    near = b < SWITCH
    x = b[near]
    s_integral, c_integral = fresnel_integrals(x)
    half = x**2 / 2.0
    result[near] = np.sqrt(np.pi / 2.0) * (
        (half + 1.0) * s_integral - (half - 1.0) * c_integral
    ) + x / 2.0 * (np.sin(x**2 / 4.0) + np.cos(x**2 / 4.0))
    x = b[~near]
    q = x**2 / 4.0
    m = scaled_moments(q)
    c, s = _phase(x)
    result[~near] = np.sqrt(np.pi / 2.0) * (
        1.0 + 0.5 * ((s - c) * (2.0 * m[3] - m[2]) / q + (s + c) * (2.0 * m[2] - m[1])) / (q * np.sqrt(q))
    )
    return _finish(np.copysign(1.0, signed) * result, beta)


def H_axial(beta: ArrayLike) -> FloatArray | float:
    """H_N, even: what an axial force nτ = 1 adds to H; β of any shape, absolute error below 1e-15."""
    _, b, _ = _prepare(beta)
    turn = np.exp(0.25j * np.pi)
    _, first, _, third = scaled_iterated_erfc(TURN * b)
    c, s = _phase(b)
    return _finish(np.sqrt(2.0 * np.pi) * (turn * (c + 1j * s) * (2.0 * third - 0.5 * first)).real, beta)


def K(xi: ArrayLike, tau: ArrayLike) -> FloatArray | float:
    """Deflection at (ξ, τ) under a unit impulse at (0, 0) (2.3.2); ξ and τ ≥ 0 broadcast, K = 0 at τ = 0."""
    position, time = np.broadcast_arrays(np.asarray(xi, dtype=np.float64), np.asarray(tau, dtype=np.float64))
    if not np.all(time >= 0.0):
        raise ValueError(f"tau must not be negative or NaN (got {tau!r})")
    root = np.sqrt(time)
    beta = np.divide(position, root, out=np.zeros(position.shape), where=root > 0.0)
    values = root / np.sqrt(2.0 * np.pi) * H(beta)
    return np.asarray(values) if position.ndim else float(values)
