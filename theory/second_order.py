r"""The second order in the loads and the axial force: how far the first order is off (new, not in the thesis).

    λ_c = √τ(λ₀ + λ₁τ + λ₂τ²),   R̃ = 2√(2/π)(r₀ + r₁τ + r₂τ²)/√τ,   ε = 1 (α stands for εα and so on)

Outside the front η is a decaying wave, inside it is the free motion w₀ (continuous) or what leaves the middle free
(detached). With z = e^{−iπ/4}x/2 and ∂⁴ − n∂² = (∂² − n/2 − (n²/8)∂⁻² …)²,

    η/τ = Re{B₀i²erfc z + τ[B₁i⁴erfc z − (in/2)B₀i²erfc z]
            + τ²[B₂i⁶erfc z − (in/2)B₁i⁴erfc z − (n²/8)B₀i²erfc z + (n²/2)B₀i⁴erfc z]},
    w₀/τ = ν − κx²/2 + τ(α/2 + χx²/2 + ψx⁴/24) + τ²n(χ/6 + ψx²/4),
    middle, detached: the first two terms of w₀/τ + τ[a₁(1 − x⁴/12) + b₁x² − nκ/2]
            + τ²[a₂(1 − x⁴/4) + b₂(x² − x⁶/180) + n(b₁/3 − a₁x²/2)].

At x = λ₀ + λ₁τ + λ₂τ² both sides have deflection and slope of w₀, the same curvature, and third derivatives that
differ by √(2/π)(r₀ + r₁τ + r₂τ²): linear equations, order by order. The last term of w₀ is what the axial force makes
of the loads' own free motion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from theory._fresnel import TURN, FloatArray, scaled_erfc
from theory.contact import DETACHED, ContactParameters

_SLOPE = float(np.sqrt(2.0 / np.pi))
_NEAR = 1.0  # |z| below which the recurrence of iⁿerfc may run upwards
_LAST, _LAST_NEAR = 30, 220.0  # n from which it runs downwards: _LAST + _LAST_NEAR/|z|²


@dataclass(frozen=True)
class SecondOrder:
    """λ₂ and r₂ of one impact, and its λ₁ and r₁ once more, found on the way without any φ.

    opening: rate at which the loads change the curvature of the gap at the front, in τ; one point, whose gap has
        κ − ν at first, spreads once it is gone.
    """

    lambda1: float
    r1: float
    lambda2: float
    r2: float
    opening: float


def second_order(parameters: ContactParameters) -> SecondOrder:
    """λ₂ and r₂ of one impact (scalar parameters, ν = 1); relative error about 1e-6, for λ₀ < 100.

    Raises:
        ValueError: parameters of several impacts, or ν ≠ 1.
    """
    p = parameters
    if np.ndim(p.lambda0):
        raise ValueError("parameters must be those of one impact (got arrays)")
    if p.nu != 1.0:
        raise ValueError(f"nu must be 1 (got {p.nu!r})")
    return _Front(p).solve()


def _scaled(x: float) -> dict[int, complex]:
    """e^{z²} iⁿerfc(z) for n = −3…6 at z = e^{−iπ/4}x/2, x ≥ 0, to rounding.

    The recurrence 2n iⁿerfc = iⁿ⁻²erfc − 2z iⁿ⁻¹erfc loses digits upwards, where iⁿerfc is its minimal solution; so
    their ratios r_n = iⁿ/iⁿ⁻¹ are taken downwards, r_{n−1} = 1/(2z + 2n r_n), from where the start is forgotten.
    """
    z = complex(TURN * x)
    gauss = 2.0 / np.sqrt(np.pi)
    values: dict[int, complex] = {-1: complex(gauss)}
    values[-2] = 2.0 * z * values[-1]
    values[-3] = 2.0 * z * values[-2] - 2.0 * values[-1]
    if abs(z) < _NEAR:
        values[0] = complex(scaled_erfc(x))
        for n in range(1, 7):
            values[n] = (values[n - 2] - 2.0 * z * values[n - 1]) / (2.0 * n)
        return values
    last = _LAST + int(_LAST_NEAR / abs(z) ** 2)
    ratio = 1.0 / (z + np.sqrt(z * z + 2.0 * last))
    ratios = {}
    for n in range(last, 0, -1):
        ratio = 1.0 / (2.0 * z + 2.0 * n * ratio)
        ratios[n - 1] = ratio
    for n in range(7):
        values[n] = values[n - 1] * ratios[n]
    return values


class _Front:
    """Values and derivatives at x = λ₀ of everything above, and the two linear systems."""

    def __init__(self, p: ContactParameters) -> None:
        self.p, self.x, self.n = p, float(p.lambda0), float(p.axial)
        self.erfc = _scaled(self.x)

    def wave(self, order: int) -> list[complex]:
        """i^{order}erfc and its derivatives in x, per amplitude at the front."""
        return [(-TURN) ** m * self.erfc[order - m] for m in range(6)]

    def free(self, order: int) -> list[float]:
        """Derivatives 0…4 of the free motion's term in τ^{order}, at the front."""
        p, x, n = self.p, self.x, self.n
        if order == 1:
            return [
                p.alpha / 2.0 + p.chi * x**2 / 2.0 + p.psi * x**4 / 24.0,
                p.chi * x + p.psi * x**3 / 6.0,
                p.chi + p.psi * x**2 / 2.0,
                p.psi * x,
                p.psi,
            ]
        return [n * (p.chi / 6.0 + p.psi * x**2 / 4.0), n * p.psi * x / 2.0, n * p.psi / 2.0, 0.0, 0.0]

    def solve(self) -> SecondOrder:
        x, n, p = self.x, self.n, self.p
        jump = _SLOPE * p.r0
        b0 = self._amplitude()
        w0, w1, w2 = (np.array(self.wave(order)) for order in (2, 4, 6))
        fifth = (b0 * w0[5]).real  # E₀⁗ vanishes at the front

        # first order: D₁ = known₁ + Re[B₁w₁] − free₁
        known = (-0.5j * n * b0 * w0).real[:5]
        rest = known - np.array(self.free(1))
        if p.regime == DETACHED:
            quartic = np.array([1.0 - x**4 / 12.0, -(x**3) / 3.0, -(x**2), -2.0 * x, -2.0])
            square = np.array([x**2, 2.0 * x, 2.0, 0.0, 0.0])
            inside = np.array([-n * p.kappa / 2.0, 0.0, 0.0, 0.0, 0.0]) - np.array(self.free(1))
            a1, b1 = np.linalg.solve(np.array([quartic[:2], square[:2]]).T, -inside[:2])
            g1 = inside + a1 * quartic + b1 * square
        else:
            a1 = b1 = 0.0
            g1 = np.zeros(5)
        amplitude1, lambda1, r1 = self._system(w1, rest[:4] - g1[:4], jump)
        d1 = rest + (amplitude1 * w1[:5]).real

        # second order
        known2 = (-0.5j * n * amplitude1 * w1 - n**2 / 8.0 * b0 * w0 + n**2 / 2.0 * b0 * w1).real[:5]
        rest2 = known2 - np.array(self.free(2))
        moved = np.array(
            [
                0.0,
                lambda1 * d1[2] + 0.5 * lambda1**2 * jump,
                lambda1 * (d1[3] - g1[3]),
                lambda1 * (d1[4] - g1[4]) + 0.5 * lambda1**2 * fifth,
            ]
        )
        g2 = np.zeros(5)
        if p.regime == DETACHED:
            sextic = np.array([x**2 - x**6 / 180.0, 2.0 * x - x**5 / 30.0, 2.0 - x**4 / 6.0, -2.0 * x**3 / 3.0, 0.0])
            quartic = np.array([1.0 - x**4 / 4.0, -(x**3), -3.0 * x**2, -6.0 * x, 0.0])
            inside = np.array([n * (b1 / 3.0 - a1 * x**2 / 2.0), -n * a1 * x, -n * a1, 0.0, 0.0])
            inside -= np.array(self.free(2))
            moving = np.array([0.0, lambda1 * g1[2]])
            a2, b2 = np.linalg.solve(np.array([quartic[:2], sextic[:2]]).T, -(inside[:2] + moving))
            g2 = inside + a2 * quartic + b2 * sextic
            g2[:2] = 0.0  # the wave meets the free motion, not the middle, in deflection and slope
        _, lambda2, r2 = self._system(w2, rest2[:4] + moved - g2[:4], jump)
        return SecondOrder(lambda1, r1, lambda2, r2, float(d1[2]))

    def _amplitude(self) -> complex:
        """B₀ at the front: slope and third derivative for one point, curvature and third derivative for a zone."""
        p, w = self.p, self.wave(2)
        row, value = (w[2], -p.kappa) if p.lambda0 > 0.0 else (w[1], 0.0)
        matrix = np.array([[row.real, -row.imag], [w[3].real, -w[3].imag]])
        real, imaginary = np.linalg.solve(matrix, [value, _SLOPE * p.r0])
        return complex(real, imaginary)

    def _system(self, w: FloatArray, rest: FloatArray, jump: float) -> tuple[complex, float, float]:
        """(B, λ, r) with Re[B w] + rest = 0, 0, −λ·jump, √(2/π) r for derivatives 0…3; λ = 0 for one point."""
        rows = [[w[m].real, -w[m].imag] for m in range(4)]
        real, imaginary = np.linalg.solve(np.array(rows[:2]), -rest[:2])
        amplitude = complex(real, imaginary)
        second, third = (float((amplitude * w[m]).real + rest[m]) for m in (2, 3))
        return amplitude, -second / jump if self.p.lambda0 > 0.0 else 0.0, third / _SLOPE
