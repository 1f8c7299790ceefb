"""A material whose loss hardly depends on the frequency: a spring and Maxwell branches beside it (docs/damping.md).

    EI(s) = EI_∞ (1 + Σ_j g_j sτ_j/(1 + sτ_j)),     EI(2πif) = EI(1 + iη) at the loss frequency f

g ≥ 0, so that no motion gains energy. That the loss factor is η at ω is linear in g,

    Σ_j g_j (x_j − η x_j²)/(1 + x_j²) = η,     x_j = ωτ_j,

and holds by least squares over the range from a tenth of the first free–free mode, or f, to 10⁶ times that mode or
10⁴/t*, whichever is higher. Times lie evenly over the logarithm of the range. Rows are weighted by ω^−(2/π)atan η,
since a constant loss makes the modulus grow by that power (Kramers and Kronig). Below the range the material is a
spring EI_∞, above it a stiffer one, both without loss. (Simo, Hughes, Computational Inelasticity, 1998, chapter 10.)

And what damping does to an answer: whether short waves die out (:func:`is_damped`), so that whole impacts converge
(:func:`converges`).
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from bent_beam.errors import InputError
from bent_beam.loads import Array, wall_scales
from bent_beam.scales import Scales

FIRST_MODE = 4.730040744862704  # cos β cosh β = 1, of a free–free beam as of a clamped one
BELOW, ABOVE, EARLIEST = 0.1, 1e6, 1e-4  # of the first mode, of the first mode, t*
PER_DECADE, MARGIN = 1.5, math.sqrt(10.0)  # branches, and how far they go beyond either end of the range
WEIGHT_OF_LOSS = 100.0  # weight of the loss frequency over that of any other
LEAST_LOSS = 0.05  # with less, meshes, steps and contact laws scatter restitution by hundredths (docs/damping.md)
SOFT = 0.05  # ℓ_k over L/2: before softer walls impacts without damping converge (docs/whole_impact.md)
RANGE = (1e-3, 1e6)  # times the first mode: where a loss frequency may lie


@dataclass(frozen=True)
class Branches:
    """relaxed : EI_∞/EI. shares, times : g_j and τ_j, s, shape (branches,). lowest, highest : the range, Hz;
    deviation : the most by which the loss factor differs from that asked for in it, over it."""

    relaxed: float
    shares: Array
    times: Array
    lowest: float
    highest: float
    deviation: float

    @property
    def about(self) -> dict[str, float]:
        """The range, Hz, how many branches, and the deviation, for the record of a run."""
        return {
            "lowest_frequency": self.lowest,
            "highest_frequency": self.highest,
            "branches": self.shares.size,
            "deviation": self.deviation,
        }

    def modulus(self, frequency: Array) -> Array:
        """EI(2πif)/EI, complex, at ``frequency``, Hz."""
        s = 2j * math.pi * np.asarray(frequency, float)[..., None] * self.times
        return np.asarray(self.relaxed * (1.0 + (self.shares * s / (1.0 + s)).sum(axis=-1)))


def first_mode(impact: Scales) -> float:
    """Frequency of the first free–free bending mode, Hz."""
    return float(FIRST_MODE**2 * impact.wave_constant / impact.length**2 / (2.0 * math.pi))


def is_damped(impact: Scales) -> bool:
    """Whether the beam itself takes short waves away: little hysteretic loss damps them no more than long ones."""
    return bool(impact.damping > 0.0 or impact.hysteretic_loss >= LEAST_LOSS)


def converges(impact: Scales) -> bool:
    """Whether a whole impact has numbers that finer elements come to: that of a damped beam, or on a soft wall, whose
    ℓ_k is :data:`SOFT` L/2 at least."""
    wall = wall_scales(impact)
    return is_damped(impact) or (wall is not None and wall.length >= SOFT * impact.half_length)


def branches_of(impact: Scales) -> Branches | None:
    """The branches of ``impact.hysteretic_loss``; ``None`` without."""
    if not impact.hysteretic_loss or impact.loss_frequency is None:
        return None
    mode, earliest = first_mode(impact), 1.0 / (2.0 * math.pi * EARLIEST * impact.time_scale)
    lowest = min(BELOW * mode, impact.loss_frequency)
    return _fitted(impact.hysteretic_loss, impact.loss_frequency, lowest, max(ABOVE * mode, earliest))


@lru_cache(maxsize=16)
def _fitted(loss: float, frequency: float, lowest: float, highest: float) -> Branches:
    """The branches by non-negative least squares."""
    from scipy.optimize import nnls

    count = math.ceil(PER_DECADE * math.log10(highest / lowest * MARGIN**2)) + 1
    times = 1.0 / (2.0 * math.pi * np.geomspace(lowest / MARGIN, highest * MARGIN, count))
    asked = np.append(np.geomspace(lowest, highest, 12 * count), frequency)
    x = 2.0 * math.pi * asked[:, None] * times
    power = 2.0 / math.pi * math.atan(loss)
    weight = (asked / frequency) ** -power
    weight[-1] *= WEIGHT_OF_LOSS
    size = (times / times[-1]) ** -power  # g is about in proportion: columns of one size
    shares = size * nnls(size * weight[:, None] * (x - loss * x**2) / (1.0 + x**2), loss * weight)[0]
    found = Branches(1.0, shares, times, lowest, highest, 0.0)
    modulus = found.modulus(asked)
    deviation = float(np.abs(modulus.imag / modulus.real / loss - 1.0).max())
    return Branches(1.0 / float(modulus[-1].real), shares, times, lowest, highest, deviation)


def check_loss(impact: Scales) -> None:
    """``ValueError`` where loss and loss frequency do not go together; it names field and value."""
    if not impact.hysteretic_loss:
        if impact.loss_frequency is not None:
            raise InputError(f"loss_frequency has no effect without hysteretic_loss (got {impact.loss_frequency!r})")
        return
    if impact.damping:
        raise InputError(
            f"damping = {impact.damping!r} and hysteretic_loss = {impact.hysteretic_loss!r} are two dampings of one "
            "material: give one of them"
        )
    mode = first_mode(impact)
    if impact.loss_frequency is None or not RANGE[0] * mode <= impact.loss_frequency <= RANGE[1] * mode:
        raise InputError(
            f"loss_frequency must say where EI and hysteretic_loss hold, between {RANGE[0]:g} and {RANGE[1]:g} times "
            f"the first mode's {mode:.6g} Hz (got {impact.loss_frequency!r})"
        )
    for name in ("fourth_derivative", "curvature_rate"):
        if getattr(impact, name):
            raise InputError(
                f"{name} must be 0 with hysteretic_loss: how long the beam has been bent so is not known "
                f"(got {getattr(impact, name)!r})"
            )
