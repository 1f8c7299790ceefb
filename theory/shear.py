r"""First instants of a beam that shears (Timoshenko's), where formulas say them (docs/shear.md).

    μ w_tt = S(w_x − φ)_x − r,     J φ_tt = EI φ_xx + S(w_x − φ),     S = κ_sGA

Units t_s = √(EIμ)/S, l_s = √(EI/S), force V₀√(Sμ), moment V₀√(EIμ) leave κ = κ/ν and g = J S/(EI μ), κ_sG/E.

**One point that is stopped.** Waves e^{−ax} of the Laplace transform leave P = √(1 + g s²), q = s + P and

    R̂ = (2/s)√(1 − 1/q²),     Ĵ = R̂/s,     M̂ = 1/(s q);

with damping η of shear and bending alike s becomes s/√D in the roots, and R̂ and M̂ take the factor √D, D = 1 + ηs. It
starts with R = 2V₀√(Sμ): Euler and Bernoulli's force is infinite there, Timoshenko's is not (Szalai 2014, J. Vib.
Acoust. 136, 041002), and is Euler and Bernoulli's in the end, J = 4√(2t/π)[1 − (3 − g)/(8t)].

**With shear every bent beam starts with a zone**, with damping a very short one (without shear, but with damping, it
starts as one point: `theory.damped_point`). Without damping its rim runs ahead of shear waves until t_c = 1/(2κ), as of
a string:

    X = √(2t/κ),     J = 2X,     R = √(2/(κt)).

It is exact where nothing at all runs ahead of the rim, t < g t_c; until t_c bending waves do, which move little.

**Towards Euler and Bernoulli's law** the force is spread over one l_s behind the rim, and with a deflection that decays
as e^{−x} ahead, κ < 1 gives X − coth X = λ₀√t, κ > 1 coth X − X = (κ − 1)√(πt/2), so that the zone shrinks again.
"""

from dataclasses import dataclass
from math import comb

import numpy as np
from numpy.typing import ArrayLike, NDArray

from theory import damped_point
from theory._fresnel import FloatArray
from theory.contact import ContactParameters

#: t_s after which force, impulse and rim are within 2 % of `first_instants` (``python -m benchmarks.shear``).
FORGOTTEN = 10.0
#: κ/ν of the flattest zone of which the impulse is, too.
FLATTEST_SHEARED = 0.05
NEWTON = 40  # steps from the far side of any root, doublings at first
LATE = 500.0  # t_s from which on the stopped point's asymptotic series has all that matters
ABSCISSA = 22.0  # A of Abate and Whitt: discretisation error e^−A
TERMS, MEANS = 30, 15  # of the alternating sum besides the waves within it, and of its binomial means


@dataclass(frozen=True)
class StoppedPoint:
    """A straight endless beam, stopped in one point. ratio : g; damping : η over t_s, of shear and bending alike.

    Values at times t > 0, t_s, of any shape, to about 1e-6: Abate & Whitt's sum (1992, Queueing Systems 10, 5).

    >>> from theory.shear import StoppedPoint
    >>> round(float(StoppedPoint(0.2).impulse(10.0)), 4)
    9.7217
    """

    ratio: float
    damping: float = 0.0

    def reaction(self, times: ArrayLike) -> FloatArray:
        """R, V₀√(Sμ); 2 at first, with damping 2√(η/(πt))."""
        return self._inverse(times, "reaction")

    def impulse(self, times: ArrayLike) -> FloatArray:
        """J, V₀√(Sμ) t_s."""
        return self._inverse(times, "impulse")

    def moment(self, times: ArrayLike) -> FloatArray:
        """Bending moment under the force, its viscous part included, V₀√(EIμ)."""
        return self._inverse(times, "moment")

    def zone(self, times: ArrayLike, kappa_over_nu: float) -> FloatArray:
        """X, l_s, of the zone under the force: it gives the kink of the deflection, the shear angle γ̂ = R̂/2D, to the
        sections' angle, which the force has bent from κ to κ − m, m̂ = M̂/D: sinh X = γ/(κ − m). ∞ where κ ≤ m."""
        kink, bent = self._inverse(times, "kink"), self._inverse(times, "bent")
        left = kappa_over_nu - bent
        return np.where(left > 0.0, np.arcsinh(kink / np.where(left > 0.0, left, 1.0)), np.inf)

    def _transform(self, s: NDArray[np.complex128], kind: str) -> NDArray[np.complex128]:
        root = np.sqrt(1.0 + self.damping * s)
        u = s / root
        wave = u + np.sqrt(1.0 + self.ratio * u * u)
        elastic = root**2 if kind in ("kink", "bent") else 1.0
        if kind in ("moment", "bent"):
            return np.asarray(root / (s * wave) / elastic)
        push = 2.0 * root / s * np.sqrt(1.0 - 1.0 / wave**2)
        return np.asarray({"impulse": push / s, "kink": 0.5 * push / elastic}.get(kind, push))

    def _inverse(self, times: ArrayLike, kind: str) -> FloatArray:
        t = np.asarray(times, dtype=np.float64)
        if not np.all(np.isfinite(t) & (t > 0.0)):
            raise ValueError(f"times must be positive and finite (got {times!r})")
        count = TERMS + int(2.0 * t.max(initial=0.0) / (np.pi * np.sqrt(max(self.ratio, 0.01))))
        k = np.arange(count + MEANS + 1)
        s = np.asarray((0.5 * ABSCISSA + 1j * np.pi * k) / t[..., None], np.complex128)
        terms = (-1.0) ** k * self._transform(s, kind).real
        terms[..., 0] *= 0.5
        sums = np.cumsum(terms, axis=-1)[..., count:]
        weights = np.array([comb(MEANS, j) for j in range(MEANS + 1)]) / 2.0**MEANS
        return np.asarray(np.exp(0.5 * ABSCISSA) / t * (sums @ weights))


def early_until(kappa_over_nu: float) -> float:
    """t_c, t_s: until then the zone's rim is faster than shear waves."""
    return 0.5 / kappa_over_nu


def early_zone(kappa_over_nu: float, time: float) -> tuple[float, float, float]:
    """X, l_s, R and J at 0 < ``time`` ≤ t_c, t_s, of a rigid wall."""
    if not 0.0 < time <= early_until(kappa_over_nu) * (1.0 + 1e-12):
        raise ValueError(f"time must lie in (0, {early_until(kappa_over_nu)!r}] shear times (got {time!r})")
    place = float(np.sqrt(2.0 * time / kappa_over_nu))
    return place, place / time, 2.0 * place


def rim(kappa_over_nu: float, lambda0: float, time: float) -> float:
    """X, l_s, long after t_c, t_s: the half length of the zone, κ/ν of any size."""
    gap = lambda0 * np.sqrt(time) if kappa_over_nu < 1.0 else (1.0 - kappa_over_nu) * np.sqrt(0.5 * np.pi * time)
    place = 1e-3 / (1.0 + abs(gap))  # Newton's method for x − coth x = gap, which is concave, from below; slope coth²x
    for _ in range(NEWTON):
        coth = 1.0 / np.tanh(place)
        place += (gap + coth - place) / coth**2
    return float(place)


def first_instants(
    kappa_over_nu: float, solved: ContactParameters, ratio: float, time: float, damping: float = 0.0
) -> tuple[float, float, float]:
    """X, l_s, R, V₀√(Sμ), and J, V₀√(Sμ) t_s, at ``time`` > 0, t_s, without loads: until t_c those of the early zone,
    later R and J of Euler and Bernoulli's zone or of a stopped point with ``ratio`` g and ``damping`` η over t_s. A
    point with damping does not spread from the first instant on.
    solved : of this κ/ν, or of one point where damping keeps a zone from spreading."""
    kappa, early = solved.kappa_over_nu, time <= early_until(kappa_over_nu)
    summed = kappa >= 1.0 and time <= LATE
    if early and not (summed and damping > 0.0):
        return early_zone(kappa_over_nu, time)
    place = early_zone(kappa_over_nu, time)[0] if early else rim(kappa, solved.lambda0, time)
    if summed:
        point = StoppedPoint(ratio, damping)
        held = float(point.zone(time, kappa_over_nu))
        if early and held >= place:
            return early_zone(kappa_over_nu, time)
        return min(held, place), float(point.reaction(time)), float(point.impulse(time))
    push, given = 2.0 * np.sqrt(2.0 / (np.pi * time)), 4.0 * np.sqrt(2.0 * time / np.pi)
    if kappa < 1.0:
        return place, push * solved.r0, given * solved.r0
    lag = (3.0 - ratio) / (8.0 * time)
    age = time / damping if damping > 0.0 else np.inf
    if age < 1e12:
        push, given = push * damped_point.reaction_ratio(age), given * damped_point.impulse_ratio(age)
    return place, float(push * (1.0 + lag)), float(given * (1.0 - lag))


def forgotten_after(kappa_over_nu: float) -> float:
    """t_s from which on `first_instants` are within 2 %. A flat zone outruns shear waves until t_c and its impulse is
    larger for it; its sections' own turning lifts its middle for (ν/κ)² t_s."""
    return np.inf if kappa_over_nu < FLATTEST_SHEARED else max(FORGOTTEN, kappa_over_nu**-2.0)
