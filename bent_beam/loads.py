"""The loads of an impact, and the motion of the beam under them without a wall.

    y₀(x, t) = Σ c xⁱtʲ/(i! j!):    V₀ (0, 1),   −K (2, 0),   a₀ (0, 2),   c₀ (2, 1),   q₀ (4, 0)           (2.2.30)

A load stands in one place: the field of :class:`bent_beam.Impact` that holds it, annotated by a :class:`Load`. With a
term of y₀ the load has a dimensionless group, a share of the uniform load μ∂²y₀/∂t² + EI ∂⁴y₀/∂x⁴ + N K, and a share of
the end forces of y₀; every solver asks :class:`FreeMotion` for these. A load without a term is a force of its own,
which a solver adds. A solver names the loads and other features that it models, and refuses the rest
(:func:`unmodelled`).

To add a load: its field in ``impact.py``, its key in ``tables.py``, and, where it has no term, its force in
``Impact.net_load``, in a solver (``hermite_fe/model.py``) and, unless it is uniform, in ``measure/balance.py`` for a
part of a beam. What compares with theory refuses it by itself (:func:`unmodelled`).
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from bent_beam.fields import Quantity, declared

__all__ = ["Feature", "FreeMotion", "Load", "beyond_first_order", "load_against", "loads_of", "unmodelled"]

Powers = tuple[int, int]
SIMULATED = ": bentbeam simulate follows it, on the Hermite and the Exudyn path"


@dataclass(frozen=True)
class Feature(Quantity):
    """A field that not every solver models: those that do name it, the others refuse it, and say what to do instead."""

    instead: str = ""


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


def beyond_first_order(impact: Any) -> str | None:
    """Why theory to first order cannot take an impact, naming the field (``None``: it can)."""
    return unmodelled(impact, [name for name, load in loads_of(type(impact)).items() if load.group])


def unmodelled(impact: Any, modelled: Collection[str]) -> str | None:
    """Why a solver of the features ``modelled``, loads among them, cannot take an impact, naming the field (``None``:
    it can)."""
    about = declared(type(impact))  # type: ignore[arg-type]
    for field in dataclasses.fields(impact):
        value, quantity = getattr(impact, field.name), about[field.name].quantity
        if isinstance(quantity, Feature) and field.name not in modelled and value != field.default:
            return f"{field.name} is not modelled by this method (got {value!r}){quantity.instead}"
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


def load_against(impact: Any, curvature: float) -> float:
    """μa₀ + EI q₀ + N(K − ``curvature``), N/m; nothing where the terms cancel to rounding."""
    motion = impact.free_motion(0.0)
    terms = (
        impact.mass_per_length * float(motion(0.0, by_t=2)),
        impact.bending_stiffness * float(motion(0.0, by_x=4)),
        impact.axial_force * (impact.curvature - curvature),
    )
    total = math.fsum(terms)
    return total if abs(total) > 1e-14 * max(abs(term) for term in terms) else 0.0
