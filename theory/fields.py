r"""Deflection, slope, curvature and velocity of the beam during the impact, by convolution with the kernel.

    η(ξ,τ) = ½ ∫₀^τ R̃(s) [K(ξ−λ_c(s), τ−s) + K(ξ+λ_c(s), τ−s)] ds
           + r̃ ∫₀^τ ∫_{−λ_c(s)}^{λ_c(s)} K(ξ−ξ̄, τ−s) dξ̄ ds                      (2.7.3), (2.7.43)
    w(ξ,τ) = τ − κξ²/2 + ε(ψξ⁴/24 + χξ²τ/2 + ατ²/2) − η(ξ,τ)                    (2.2.41)

with λ_c, R̃ of `theory.contact` and r̃ = ε(α′+ψ) in the continuous regime, 0 otherwise. ε = 0 is the
leading order (2.6.36), (2.6.37). w > 0 is in the wall: the gap is −w. An axial force n changes the kernel of the
concentrated reactions to √(t/2π)[H(β) + nt H_N(β)], t = τ−s; in r̃, itself of first order, n is left out.

With x = |ξ|/√τ, √s = √τ tanh u and Λ(u) = λ₀ + ελ₁τ tanh²u, the kernel's argument is β_∓ = x cosh u ∓ Λ sinh u. H is
the real part of an entire function, an iterated complementary error function of z = e^{−iπ/4}β/2 (for β < 0 of −β):

    H″ = Re[−(1+i)/2 e^{−z²}],     H′ = Re[i√(π/2) erfc z],     H − βH′ = Re[(1−i) e^{−z²}],
    H  = Re[√(2π) e^{−iπ/4} ierfc z],     √(π/2) − P = Re[2√(2π) i²erfc z],
    H_N = Re[√(2π) e^{iπ/4}(2 i³erfc z − ½ ierfc z)].

So the path may leave the real axis, downwards where |β| falls and upwards where |β| grows, and e^{iβ²/4} decays on all
of it (docs/theory.md, section 8); it comes back to the axis only at the least |β|.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from bent_beam.checks import non_negative, positive
from bent_beam.loads import FreeMotion
from theory._fresnel import TURN, ComplexArray, FloatArray, scaled_iterated_erfc
from theory.contact import DISCRETE, ContactParameters

# At the front itself the least |β| is at u = ∞; what lies beyond is e^{-18}, and integrated all the same.
_FARTHEST = 18.0


@dataclass(frozen=True)
class FieldValues:
    """A field of the beam at (ξ, τ) and its derivatives; arrays of the broadcast shape."""

    deflection: FloatArray
    slope: FloatArray
    curvature: FloatArray
    velocity: FloatArray

    def __sub__(self, other: FieldValues) -> FieldValues:
        return FieldValues(*(mine - its for mine, its in zip(vars(self).values(), vars(other).values())))


@dataclass(frozen=True)
class ImpactFields:
    """The solution of the fast layer at a given ε, dimensionless.

    parameters : contact parameters of one impact (scalars).
    epsilon : ε ≥ 0; 0 for the leading order.
    tolerance : largest absolute error of η/τ, η_ξ/√τ, η_ξξ and η_τ that the quadrature aims at, but for the rounding of
        the phase, 1e-15 r₀ max(λ₀, |ξ|/√τ).

    All methods raise ValueError for τ < 0, for ξ or τ not finite, and for a τ so large that the first-order
    correction would turn the front back (λ₀ + 3ελ₁τ ≤ 0), where the expansion says nothing; the fields raise
    ArithmeticError if the quadrature does not reach its tolerance.
    """

    parameters: ContactParameters
    epsilon: float = 0.0
    tolerance: float = 1e-11

    def __post_init__(self) -> None:
        if np.ndim(self.parameters.lambda0):
            raise ValueError("parameters must be those of one impact (got arrays)")
        non_negative("epsilon", self.epsilon)
        positive("tolerance", self.tolerance)

    def half_contact_length(self, tau: ArrayLike) -> FloatArray:
        """λ_c(τ) = √τ(λ₀ + ελ₁τ) (2.7.6)."""
        time = self._times(tau)
        p = self.parameters
        return np.sqrt(time) * (p.lambda0 + self.epsilon * p.lambda1 * time)

    @property
    def uniform_reaction(self) -> float:
        """r̃ = ε(α′+ψ) on |ξ| < λ_c in the continuous regime, 0 in the others (2.7.5)."""
        return self.epsilon * float(self.parameters.uniform_reaction)

    def slow_motion(self, xi: ArrayLike, tau: ArrayLike) -> FieldValues:
        """The motion without the wall (2.2.41), (2.2.43), (2.2.45); ξ and τ broadcast."""
        x, t = np.broadcast_arrays(_finite("xi", xi), self._times(tau))
        p, e = self.parameters, self.epsilon
        loads = {(0, 2): e * p.alpha, (2, 1): e * p.chi, (4, 0): e * p.psi}
        motion = FreeMotion({(0, 1): 1.0, (2, 0): -p.kappa_over_nu} | loads)
        return FieldValues(motion(x, t), motion(x, t, by_x=1), motion(x, t, by_x=2), motion(x, t, by_t=1))

    def fast_layer(self, xi: ArrayLike, tau: ArrayLike) -> FieldValues:
        """η, η_ξ, η_ξξ, η_τ: what the reactions do to the beam; ξ and τ broadcast. Before contact (τ = 0) all are 0. At
        ξ = ±λ_c the curvature of the first order jumps with the expansion's O(ε²); at ξ = 0, discrete regime, η_ξξξ
        jumps but nothing returned here does."""
        x, t = np.broadcast_arrays(_finite("xi", xi), self._times(tau))
        values = np.zeros((4, x.size))
        live = t.ravel() > 0.0
        if np.any(live):
            values[:, live] = self._convolve(np.abs(x.ravel()[live]), t.ravel()[live])
        eta, slope, curvature, velocity = (v.reshape(x.shape) for v in values)
        return FieldValues(eta, np.copysign(1.0, x) * slope, curvature, velocity)

    def beam(self, xi: ArrayLike, tau: ArrayLike) -> FieldValues:
        """Deflection w = y/(εy*), slope, curvature and velocity of the beam: slow motion less fast layer."""
        return self.slow_motion(xi, tau) - self.fast_layer(xi, tau)

    def complementarity_residual(self, a: ArrayLike, tau: ArrayLike) -> FloatArray:
        """Beam deflection at ξ = aλ_c(τ), a ∈ [−1, 1]: 0 wherever there is contact. That is the whole of [−1, 1] in the
        continuous regime (2.6.31–32), (2.7.41–42), a = ±1 in the detached regime (2.7.44–45), and ξ = 0 in the discrete
        one. Up to the quadrature's tolerance at ε = 0, O(ε²) at first order."""
        position, time = np.broadcast_arrays(_finite("a", a), self._times(tau))
        if np.any(np.abs(position) > 1.0):
            raise ValueError(f"a must lie in [-1, 1] (got {a!r})")
        return self.beam(position * self.half_contact_length(time), time).deflection

    def _times(self, tau: ArrayLike) -> FloatArray:
        time = _finite("tau", tau)
        if np.any(time < 0.0):
            raise ValueError(f"tau must not be negative (got {tau!r})")
        p = self.parameters
        if p.regime != DISCRETE and np.any(p.lambda0 + 3.0 * self.epsilon * p.lambda1 * time <= 0.0):
            raise ValueError(
                f"tau must be below {p.lambda0 / (-3.0 * self.epsilon * p.lambda1):.6g}, where the "
                f"first-order correction turns the front back (got {np.max(time):.6g})"
            )
        return time

    def _convolve(self, xi: FloatArray, tau: FloatArray) -> FloatArray:
        """(η, η_ξ, η_ξξ, η_τ) of shape (4, n) at ξ ≥ 0 and τ > 0 of shape (n,)."""
        from scipy.integrate import quad_vec  # slow to load

        p, e = self.parameters, self.epsilon
        path = _Path(
            x=xi / np.sqrt(tau),
            lambda0=p.lambda0,
            change=e * p.lambda1 * tau,
            r0=p.r0,
            growth=e * p.r1 * tau,
            uniform=self.uniform_reaction * tau,
            axial=e * float(p.axial) * tau,
        )
        # the phase x²/4 is known to a rounding of its size, over a stretch of u that shrinks like 1/x
        rounding = 4.0 * np.finfo(float).eps * p.r0 * max(1.0, float(np.max(path.x)), p.lambda0)
        epsabs = max(self.tolerance, rounding)
        values, error, info = quad_vec(
            path.integrand, 0.0, 1.0, epsabs=epsabs, epsrel=0.0, norm="max", limit=500, full_output=True
        )
        if info.status == 1:
            raise ArithmeticError(
                f"the convolution did not reach its tolerance {self.tolerance:.3g} (error about "
                f"{error:.3g}): ask for points nearer the contact zone, or a larger tolerance"
            )
        return values * np.stack([tau, np.sqrt(tau), np.ones_like(tau), np.ones_like(tau)])


def _finite(name: str, values: ArrayLike) -> FloatArray:
    array = np.asarray(values, dtype=np.float64)
    if not np.all(np.isfinite(array)):
        raise ValueError(f"{name} must be finite (got {values!r})")
    return array


@dataclass(frozen=True)
class _Path:
    """The convolution integrals of n points, each on its own path in u, mapped to one t ∈ [0, 1]. Places x (n,) and,
    times the power of τ that makes them functions of x alone, λ₁, r₁, r̃ and n."""

    x: FloatArray
    lambda0: float
    change: FloatArray
    r0: float
    growth: FloatArray
    uniform: FloatArray
    axial: FloatArray

    @cached_property
    def front(self) -> FloatArray:
        return self.lambda0 + self.change

    @cached_property
    def ahead(self) -> FloatArray:
        return np.where(self.x >= self.front, 1.0, -1.0)

    @cached_property
    def lowest(self) -> FloatArray:
        """u where |β_−| is least: its zero behind the front, its stationary point ahead of it; β_+ grows from u = 0. In
        y = tanh u these are roots of polynomials that change sign on [0, 1]; a bisection will do, for the path may turn
        anywhere near."""
        low, high = np.zeros_like(self.x), np.full_like(self.x, np.tanh(_FARTHEST))
        for _ in range(40):
            y = 0.5 * (low + high)
            before = np.where(
                self.ahead > 0.0,
                self.x * y - self.front + self.change * (1.0 - y**2) * (1.0 - 2.0 * y**2) < 0.0,
                y * (self.lambda0 + self.change * y**2) < self.x,
            )
            low, high = np.where(before, y, low), np.where(before, high, y)
        return np.arctanh(low)

    def integrand(self, t: float) -> FloatArray:
        """d(η/τ, η_ξ/√τ, η_ξξ, η_τ)/dt, shape (4, n)."""
        # downwards and back: b = −(π/4) tanh(a(L−a)/L), 0 ≤ a ≤ L
        length = self.lowest
        bend = np.tanh(length * t * (1.0 - t))
        u = length * t - 0.25j * np.pi * bend
        du = length * (1.0 - 0.25j * np.pi * (1.0 - bend**2) * (1.0 - 2.0 * t))
        total = self._element(u, du, -1.0, np.ones_like(length))
        # upwards: b = (π/4) tanh a, 0 ≤ a < ∞; e^{-a} = 1 − t makes the integrand bounded
        if t < 1.0:
            a = -np.log1p(-t)
            rise = 0.25j * np.pi * np.tanh(a)
            step = (1.0 + 0.25j * np.pi / np.cosh(a) ** 2) / (1.0 - t)
            total += self._element(length + a + rise, step, -1.0, self.ahead)
            total += self._element(np.full_like(length, a) + rise, step, 1.0, np.ones_like(length))
        return total

    def _element(self, u: ComplexArray, du: ComplexArray | complex, side: float, branch: FloatArray) -> FloatArray:
        """Integrand of one reaction, β = x cosh u + side Λ sinh u, on the branch of sign(β) → branch."""
        sech, tanh = 1.0 / np.cosh(u), np.tanh(u)
        sinh_sech2 = tanh * sech
        beta = branch * (self.x / sech + side * (self.front * tanh / sech - self.change * sinh_sech2))
        z = TURN * beta
        wave = np.exp(-(z**2))
        erfc, ierfc, i2erfc, i3erfc = (wave * values for values in scaled_iterated_erfc(z))
        h2 = -0.5 * (1.0 + 1.0j) * wave
        h1 = branch * (1j * np.sqrt(np.pi / 2.0)) * erfc
        h = np.sqrt(2.0 * np.pi) * np.exp(-0.25j * np.pi) * ierfc
        force = 2.0 / np.pi * (self.r0 + self.growth * tanh**2) * sech * du
        values = np.stack([force * sech**2 * h, force * sech * h1, force * h2, 1j * force * h2])
        if np.any(self.axial):
            hn = np.sqrt(2.0 * np.pi) * np.exp(0.25j * np.pi) * (2.0 * i3erfc - 0.5 * ierfc)
            hn1 = -np.sqrt(np.pi / 2.0) * branch * (2.0 * i2erfc - 0.5 * erfc)
            hn2 = np.sqrt(np.pi / 8.0) * np.exp(-0.25j * np.pi) * (2.0 * ierfc - wave / np.sqrt(np.pi))
            stretch = self.axial * sech**2 * force
            rate = 0.5 * (3.0 * hn - beta * branch * hn1)  # against ½(H − βH′) for H
            values += np.stack([stretch * sech**2 * hn, stretch * sech * hn1, stretch * hn2, stretch * rate])
        if np.any(self.uniform):
            rest = 2.0 * np.sqrt(2.0 * np.pi) * i2erfc
            p = branch * (np.sqrt(np.pi / 2.0) - rest)
            push = side * self.uniform * np.sqrt(2.0 / np.pi) * tanh * sech**2 * du
            rate = p - 0.5 * branch * beta * h
            values += np.stack([push * sech**2 * p, push * sech * h, push * h1, push * rate])
        return np.real(values)
