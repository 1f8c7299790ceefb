r"""A beam stopped at its middle: exact for κ/ν ≥ 1 until the wall first lets go (not in the thesis).

The middle of a free–free beam is held from t = 0 on, both halves moving at V₀ and damped by Kelvin and Voigt's law,
M = EI(∂²y + η∂²∂_t y). In units ℓ = EI = μ = V₀ = 1 (ℓ = L/2, so T* = 1) each half is a cantilever with modes φ_j:

    y = Σ c_j q_j(t) φ_j(x),   q̈ + ηω²q̇ + ω²q = 0,   q(0) = 0, q̇(0) = 1,   cos b cosh b = −1, ω = b²,
    c_j = ∫φ_j = 2σ_j/b_j,     σ_j = (cosh b + cos b)/(sinh b + sin b),     φ_j″(0) = 2b²,

    J(t) = 2(1 − Σc_j²q̇_j),   R(t) = J̇ = 2Σc_j²ω_j²(q_j + ηq̇_j),   M(0,t) = Σ2c_jω_j(q_j + ηq̇_j).

The bow does not enter: the wall stops a straight or a curved beam alike once it holds one point. Modes of ω > 2/η
are overdamped, each adding 8e^{−t/η}/(η²b⁶) to J; the others decay as e^{−ηω²t/2}. The sum goes on until these are
negligible; the overdamped rest is added by Hurwitz's zeta function. Before anything can have been at the ends and
back the beam has no ends: `theory.damped_point`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import zeta

from theory import damped_point
from theory._fresnel import FloatArray

_DEAD = 40.0  # e^{−40} of what a mode began with
_MOST_MODES = 400_000
_AT_ONCE = 2_000_000  # modes times instants at once


@dataclass(frozen=True)
class Release:
    """First sign change of the reaction: `time` t_s in T* and `impulse` J(t_s) in μℓV₀ until then."""

    time: float
    impulse: float


@dataclass(frozen=True)
class StoppedBeam:
    """The beam stopped at its middle, in units ℓ = EI = μ = V₀ = 1; times t ≥ 0 of any shape.

    damping : η/T* > 0, Kelvin and Voigt's time in units of T* = ℓ²√(μ/EI).

    Raises ``ValueError`` without damping, or with so little (below about 1e-16) that the sum would take more than
    400,000 modes; for a time that is negative or not finite, or 0 where the reaction or the moment is asked for.
    """

    damping: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.damping) and self.damping > 0.0):
            raise ValueError(
                f"damping must be positive and finite (got {self.damping!r}): without it the reaction of a stopped "
                "beam is a divergent series that changes sign arbitrarily early, and there is no first release"
            )
        if (modes := self._modes(self._without_ends)) > _MOST_MODES:
            raise ValueError(f"damping must be larger (got {self.damping!r}): the sum would take {modes} modes")

    def impulse(self, times: ArrayLike) -> FloatArray:
        """J(t), μℓV₀: what the wall has given; absolute error below 1e-12."""
        return self._evaluate(times, "impulse")

    def reaction(self, times: ArrayLike) -> FloatArray:
        """R(t) = J̇, μℓV₀/T*; it starts like t^{−3/4}. Error below 1e-10 of the largest |R| from then on."""
        return self._evaluate(times, "reaction")

    def midspan_moment(self, times: ArrayLike) -> FloatArray:
        """Bending moment at the middle, viscous part included, V₀√(EIμ): it starts like t^{−1/2}, then 1."""
        return self._evaluate(times, "moment")

    def release(self) -> Release:
        """The first sign change of the reaction, relative error 1e-10. Steps of an eighth of the shortest period still
        alive look for it; a dip between them that stays positive on the grid is searched for its lowest point.
        ``ArithmeticError``: none before 20 T* (a beam so damped that it only creeps)."""
        from scipy.optimize import brentq, minimize_scalar  # slow to load

        def reaction(t: float) -> float:
            return float(self.reaction(t))

        start = self._without_ends  # R > 0 until then, ₁F₁ being positive
        while start < 20.0:
            times = self._scan(start)
            values = self.reaction(times)
            for i in range(1, times.size - 1):
                low = float(times[i])
                if values[i] > 0.0 and values[i] <= min(values[i - 1], values[i + 1]):
                    low = float(minimize_scalar(reaction, bounds=(times[i - 1], times[i + 1]), method="bounded").x)
                if reaction(low) <= 0.0:
                    time = float(brentq(reaction, times[i - 1], low, xtol=1e-300, rtol=1e-14))
                    return Release(time, float(self.impulse(time)))
            start = float(times[-2])
        raise ArithmeticError(f"the reaction does not change sign before 20 T* at damping = {self.damping!r}")

    @property
    def _without_ends(self) -> float:
        """Until then (T*) what has been at an end and back is below round-off. An underdamped wave k = 1/t has
        e^{−ηk⁴t/2} ≤ e^{−100} left, an overdamped one e^{−¾(ηt)^{−1/3}} ≤ e^{−59}."""
        return float(min((self.damping / 200.0) ** (1.0 / 3.0), 2e-6 / self.damping))

    def _scan(self, start: float) -> FloatArray:
        times = [start]
        for _ in range(400):
            t = times[-1]
            alive = min(np.sqrt(2.0 * _DEAD / (self.damping * t)), 2.0 / self.damping)
            times.append(t + min(0.1 * t, 0.25 * np.pi / alive))
        return np.array(times)

    def _modes(self, shortest: float) -> int:
        """Number of modes that are not negligible at `shortest` (T*), all that are not far overdamped included."""
        alive = (2.0 * _DEAD / (self.damping * shortest)) ** 0.25
        # x = 1/(ηω)² ≤ 1e-4 in the tail, whose third term is then below 1e-12; e^{−t/η} is another way out of it
        overdamped = 10.0 / np.sqrt(self.damping) if shortest < 100.0 * self.damping else 0.0
        return int(np.ceil(max(alive, overdamped) / np.pi)) + 20

    def _evaluate(self, times: ArrayLike, kind: str) -> FloatArray:
        values = np.asarray(times, dtype=np.float64)
        if not np.all(np.isfinite(values) & (values >= 0.0)):
            raise ValueError(f"times must be finite and not negative (got {times!r})")
        if kind != "impulse" and np.any(values == 0.0):
            raise ValueError(f"times must be positive (got 0): the {kind} is infinite at t = 0")
        flat = values.ravel()
        result = np.zeros_like(flat)
        early = (flat > 0.0) & (flat < self._without_ends)
        result[early] = self._first(flat[early], kind)
        rest = np.flatnonzero(flat >= self._without_ends)
        rest = rest[np.argsort(flat[rest])]
        while rest.size:
            modes = self._modes(float(flat[rest[0]]))
            chosen, rest = np.split(rest, [max(1, _AT_ONCE // modes)])
            result[chosen] = self._sum(flat[chosen], modes, kind)
        return result.reshape(values.shape)

    def _first(self, t: FloatArray, kind: str) -> FloatArray:
        age = t / self.damping
        if kind == "impulse":
            return 4.0 * np.sqrt(2.0 / np.pi * t) * damped_point.impulse_ratio(age)
        if kind == "reaction":
            return 2.0 * np.sqrt(2.0 / (np.pi * t)) * damped_point.reaction_ratio(age)
        return damped_point.moment_ratio(age)

    def _sum(self, t: FloatArray, modes: int, kind: str) -> FloatArray:
        b, sigma = _cantilever(modes)
        eta, age = self.damping, t / self.damping
        overdamped_decay = np.exp(-age)
        # Σ b^{−power} of the modes left out, b = (j − ½)π
        first, second = (zeta(n, modes + 0.5) / np.pi**n for n in ((7, 11) if kind == "moment" else (6, 10)))
        if kind == "impulse":
            rate, _ = self._oscillators(b**2, t)
            tail = 8.0 * overdamped_decay * (first / eta**2 + (3.0 - age) * second / eta**4)
            return 2.0 * (1.0 - rate @ (2.0 * sigma / b) ** 2) + tail
        _, force = self._oscillators(b**2, t)
        tail = -overdamped_decay * (first / eta**3 + (4.0 - age) * second / eta**5)
        if kind == "reaction":
            return force @ (8.0 * sigma**2 * b**2) + 8.0 * tail
        return force @ (4.0 * sigma * b) + 4.0 * tail

    def _oscillators(self, omega: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        """q̇ and q + ηq̇, shape (times, modes), each by the form that does not cancel for its damping."""
        eta, time = self.damping, t[:, None]
        a = 0.5 * eta * omega**2
        # roots −a ± root, imaginary below critical damping: the slow one without cancellation, 1 + η·slow = −(ω/fast)²
        root = np.sqrt((a - omega) * (a + omega) + 0.0j)
        fast = a + root
        slow = omega**2 / fast
        slow_decay, fast_decay = np.exp(-slow * time), np.exp(-fast * time)
        with np.errstate(divide="ignore", invalid="ignore"):
            rate = (fast * fast_decay - slow * slow_decay) / (2.0 * root)
            force = (-((omega / fast) ** 2) * slow_decay - (1.0 - eta * fast) * fast_decay) / (2.0 * root)
        # the roots nearly meet: sinh as one function
        near = np.abs(root) < 0.1 * a
        a, root = a[near], root[near]
        sinh = np.where(root == 0.0, time, -np.expm1(-2.0 * root * time) / np.where(root == 0.0, 1.0, 2.0 * root))
        q, cosh = slow_decay[:, near] * sinh, 0.5 * (slow_decay + fast_decay)[:, near]
        rate[:, near], force[:, near] = cosh - a * q, q * (1.0 - eta * a) + eta * cosh
        return rate.real, force.real


def _cantilever(modes: int) -> tuple[FloatArray, FloatArray]:
    """b_j, the roots of cos b cosh b = −1, and σ_j; both to round-off, shape (modes,)."""
    b: FloatArray = (np.arange(1, modes + 1, dtype=np.float64) - 0.5) * np.pi
    low = b[:12].copy()
    low[0] = 1.8751
    for _ in range(6):
        low -= (np.cos(low) + 1.0 / np.cosh(low)) / (-np.sin(low) - np.tanh(low) / np.cosh(low))
    b[:12] = low[: b.size]
    inverse = 1.0 / np.cosh(np.minimum(b, 100.0))
    return b, np.asarray((1.0 + np.cos(b) * inverse) / (np.tanh(b) + np.sin(b) * inverse))
