"""What acts on the beam: loads, and its motion under them without a wall; supports; a wall that gives way.

    y₀(x, t) = Σ c xⁱtʲ/(i! j!):    V₀ (0, 1),   −K (2, 0),   a₀ (0, 2),   c₀ (2, 1),   q₀ (4, 0)           (2.2.30)

A load is a field of :class:`bent_beam.Impact`, annotated by a :class:`Load`: unit, meaning and range. Its check, its
key in ``[impact]`` and its line of the page of settings follow from these. One with ``powers`` is a term of y₀. Every
solver gets the uniform load μ∂²y₀/∂t² + EI ∂⁴y₀/∂x⁴ + N K and the forces at the ends from :class:`FreeMotion`.
A load that a :class:`Place` goes with is a force at a point (``Impact.forces``). Theory to first order knows the loads
that have a ``group``. A solver names the loads and other features that it models in its ``MODELLED``, and refuses the
rest; theory and what compares with it do so, too (:func:`unmodelled`). How to add one: docs/guide/add-load.md.

A beam with held ends arrives unbent from its bow, in the lowest mode that they allow (:mod:`bent_beam.modes`), with V₀
in its middle.

A wall that gives way pushes with R = max(0, k p + c ṗ) per length of beam where the penetration p is positive:

    ℓ_k = (EI/k)^¼,   t_k = ℓ_k²√(μ/EI) = √(μ/k),   ζ = c/(2√(kμ));      of a stop, k in N/m:   ℓ_k = (EI/k)^⅓
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bent_beam.fields import Part, Quantity, declared

Array = NDArray[np.float64]
Powers = tuple[int, int]
UNSHEARED = ': [beam] model = "euler_bernoulli" leaves shear out'
SIMULATED = ": bentbeam simulate follows it"


@dataclass(frozen=True)
class Feature(Quantity):
    """A field that not every solver models: those that do name it, the others refuse it, and say what to do instead."""

    instead: str = ""


@dataclass(frozen=True)
class Place(Feature):
    """A field that is a place of the beam, m from its middle: Hermite and Exudyn put a node there.

    outside : what a refusal of a place off the beam adds. load : the load whose place it is, without which it has no
    effect; "" for an edge of the wall.
    """

    outside: str = ""
    load: str = ""


@dataclass(frozen=True)
class Load(Feature):
    """A field that is a load.

    group : its dimensionless group with ν = 1, as theory calls it ("": it has none).
    powers : (i, j) of its term of y₀ (``None``: it has none).
    """

    group: str = ""
    powers: Powers | None = None


def loads_of(kind: type) -> dict[str, Load]:
    """The loads among the fields of :class:`bent_beam.Impact`, by name."""
    return {name: field.quantity for name, field in declared(kind).items() if isinstance(field.quantity, Load)}


def places_of(kind: type) -> dict[str, Place]:
    """The places among the fields of :class:`bent_beam.Impact`, by name."""
    return {name: field.quantity for name, field in declared(kind).items() if isinstance(field.quantity, Place)}


def beyond_first_order(impact: Part) -> str | None:
    """Why theory to first order cannot take an impact, naming the field (``None``: it can)."""
    return unmodelled(impact, [name for name, load in loads_of(type(impact)).items() if load.group])


def unmodelled(impact: Part, modelled: Collection[str]) -> str | None:
    """Why a solver of the features ``modelled``, loads among them, cannot take an impact, naming the field (``None``:
    it can). Features are the fields annotated by :class:`Feature`; any solver takes the other fields."""
    about = declared(type(impact))  # type: ignore[arg-type]
    for field in dataclasses.fields(impact):
        value, quantity = getattr(impact, field.name), about[field.name].quantity
        if isinstance(quantity, Feature) and field.name not in modelled and value != field.default:
            got = repr(float(f"{value:.6g}")) if isinstance(value, float) else repr(value)  # it may be computed
            return f"{field.name} is not modelled by this method (got {got}){quantity.instead}"
    return None


@dataclass(frozen=True)
class FreeMotion:
    """y₀ as the terms {(i, j): c} of the module's head, in any consistent units; x counts from the first touch."""

    terms: Mapping[Powers, float]

    def __call__(self, x: Any, t: Any = 0.0, *, by_x: int = 0, by_t: int = 0) -> Any:
        """y₀ or a derivative of it at places and times, which are broadcast."""
        total = np.zeros(np.broadcast_shapes(np.shape(x), np.shape(t)))
        for (i, j), c in self.terms.items():
            if c and i >= by_x and j >= by_t:
                i, j = i - by_x, j - by_t
                total = total + c * np.power(x, i) * np.power(t, j) / (math.factorial(i) * math.factorial(j))
        return total

    def scaled(self, length: float, time: float, deflection: float) -> FreeMotion:
        """The same motion in these units."""
        return FreeMotion({(i, j): c * (length**i * time**j / deflection) for (i, j), c in self.terms.items()})

    def bending(self) -> FreeMotion:
        """Its terms that bend the beam."""
        return FreeMotion({powers: c for powers, c in self.terms.items() if powers[0] >= 2})

    def first_order(self) -> FreeMotion:
        """Its terms that grow like t² where x ~ √t, against the t of V₀t and Kx²/2."""
        return FreeMotion({(i, j): c for (i, j), c in self.terms.items() if i + 2 * j == 4})


ENDS = ("free", "hinged", "clamped")


class WallScales(NamedTuple):
    """ℓ_k, m, and t_k, s, see the module's head."""

    length: float
    time: float


def wall_scales(impact: Any) -> WallScales | None:
    """The scales of the wall of ``impact``; ``None`` of a rigid one."""
    if impact.wall_stiffness is None:
        return None
    begin, end = impact.wall_span
    length = (impact.bending_stiffness / impact.wall_stiffness) ** (1.0 / 3.0 if begin == end else 0.25)
    return WallScales(length, length**2 / impact.wave_constant)
