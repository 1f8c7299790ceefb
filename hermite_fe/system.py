"""A linear mechanical system with unilateral constraints:

    M q̈ + C q̇ + K q = F(t) + Gᵀλ,   0 ≤ λ ⊥ g = g₀ + G q ≥ 0,   q = const. at supports.   (thesis 3.2.5–7)

All integrators (:mod:`hermite_fe.integrators`) work on a :class:`System`: the bent beam (:mod:`hermite_fe.model`), a
bouncing ball, an oscillator against a stop. Round-off is judged for even and odd dofs apart, deflections and slopes.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bent_beam.errors import InputError
from hermite_fe.compiled import Array, Places
from hermite_fe.elastic_wall import NO_SPRINGS, Springs

DAMPINGS = ("viscous", "material", "absorbed")
"""Causes of damping whose losses are recorded apart: viscosity at grid scale, the material, an absorbing layer."""

WIDTH = 4  # diagonal and three subdiagonals: what Hermite elements need


def _left_out() -> Any:
    return np.zeros(0)


@dataclass(frozen=True)
class ContactRows:
    """Unilateral constraints g_j = gap_j + Σ_k factors[j, k]·q[dofs[j, k]] ≥ 0.

    dofs : (rows, w) int; factors : (rows, w); gap : (rows,), the gap at q = 0.
    places : (rows,), x of each, m (for the record).
    order : (rows,) int, number from the middle of the beam on, negative left of it; it serves only a hold behind a
        moving front (:class:`hermite_fe.contacts.Contact`).
    tributary : (rows,), the length of beam that a row answers for: of a half beam's middle node half an element's
        (penalty contact scales with it).
    """

    dofs: Places
    factors: Array
    gap: Array
    places: Array = field(default_factory=_left_out)
    order: Places = field(default_factory=_left_out)
    tributary: Array = field(default_factory=_left_out)

    def __post_init__(self) -> None:
        set_, dofs = object.__setattr__, np.ascontiguousarray(np.atleast_2d(self.dofs), np.int64)
        rows = dofs.shape[0]
        set_(self, "dofs", dofs)
        set_(self, "factors", np.ascontiguousarray(self.factors, float).reshape(dofs.shape))
        set_(self, "gap", np.ascontiguousarray(self.gap, float).reshape(rows))
        defaults = {"places": np.zeros(rows), "order": np.arange(rows), "tributary": np.ones(rows)}
        for name, default in defaults.items():
            value = getattr(self, name) if np.size(getattr(self, name)) else default
            if np.shape(value) != (rows,):
                raise InputError(f"contact rows: {name} must have shape ({rows},) (got {np.shape(value)})")
            set_(self, name, np.ascontiguousarray(value, default.dtype))
        first = self.dofs.min(axis=1)
        shared = dofs.shape[1] == 1  # a dof between two walls has a constraint for either
        if np.any(np.diff(first) < (0 if shared else 1)):
            raise InputError("contact rows must be sorted by their first dof, those of several dofs each with another")

    def __len__(self) -> int:
        return int(self.gap.size)

    def at(self, which: NDArray[Any]) -> ContactRows:
        """A copy of the rows ``which``, marks or numbers."""
        return ContactRows(*(getattr(self, part.name)[which] for part in fields(self)))

    def gaps(self, q: Array) -> Array:
        """g = g₀ + G q, shape (rows,)."""
        return np.asarray(self.gap + np.einsum("jk,jk->j", self.factors, q[self.dofs]))


def _bands(name: str, value: Array, dofs: int) -> Array:
    """``value`` in lower banded form, shape (4, dofs)."""
    bands = np.atleast_2d(np.asarray(value, float))
    if bands.shape[1] != dofs or bands.shape[0] > WIDTH:
        raise InputError(f"system.{name} must have shape (≤ {WIDTH}, {dofs}) (got {bands.shape})")
    return np.pad(bands, ((0, WIDTH - bands.shape[0]), (0, 0)))


class Bending(NamedTuple):
    """What bending moments need, M = EI w_xx + ``free``.

    lengths : (elements,), m, none of a system that is no beam; phi : Φ of each, :mod:`hermite_fe.beam`;
    stiffness : EI, N m², relaxed where there are branches; free : moment at q = 0, N m; middle : node in the middle.
    """

    lengths: Array = _left_out()
    phi: Array = _left_out()
    stiffness: float = 0.0
    free: float = 0.0
    middle: int = 0


class Branches(NamedTuple):
    """Maxwell branches beside the bending stiffness (:mod:`hermite_fe.maxwell`).

    matrix : the bending part of K, (4, dofs). shares, rates : (branches,), g and 1/τ, 1/s; means, weights :
    (branches,), ϑ and 1/(1 + ϑh/τ) of the step matrix. z : (2 elements, branches), the stretches. A beam without
    hysteresis has none: its runs and those with it are compiled once.
    """

    matrix: Array
    shares: Array = _left_out()
    rates: Array = _left_out()
    means: Array = _left_out()
    weights: Array = _left_out()
    z: Array = np.zeros((0, 0))


NO_BRANCHES = Branches(np.zeros((4, 0)))


@dataclass(frozen=True)
class System:
    """Banded matrices, loads, supports and constraints.

    mass, stiffness : symmetric, scipy's lower banded form (≤ 4, dofs): ``mass[m, i] = M(i + m, i)``.
    dampings : (cause, bands) pairs that add up to C, causes out of :data:`DAMPINGS`; the loss to each is recorded
        under its own name (:data:`hermite_fe.stepping.ENERGIES`).
    load : (powers, dofs), F(t) = Σ_k load[k]·t^k.
    contacts : unilateral constraints; before a wall that gives way by ``springs`` they only say where impulses are
        recorded. second : springs of a second wall, behind the beam. supports : dofs that keep their initial value.
    bending, branches : of a beam.

    Raises ``ValueError`` when shapes disagree, a cause of damping is unknown or named twice, or a support carries a
    constraint of its own.
    """

    mass: Array
    stiffness: Array
    contacts: ContactRows
    dampings: tuple[tuple[str, Array], ...] = ()
    load: Array = field(default_factory=_left_out)
    supports: tuple[int, ...] = ()
    springs: Springs = NO_SPRINGS
    second: Springs = NO_SPRINGS
    bending: Bending = field(default_factory=Bending)
    branches: Branches = NO_BRANCHES

    def __post_init__(self) -> None:
        set_ = object.__setattr__
        n = np.atleast_2d(np.asarray(self.mass, float)).shape[1]
        set_(self, "mass", _bands("mass", self.mass, n))
        set_(self, "stiffness", _bands("stiffness", self.stiffness, n))
        causes = [cause for cause, _ in self.dampings]
        if not set(causes) <= set(DAMPINGS) or len(set(causes)) < len(causes):
            raise InputError(f"system.dampings must name each of {DAMPINGS} at most once (got {causes})")
        dampings = tuple((cause, _bands(f"dampings[{cause!r}]", bands, n)) for cause, bands in self.dampings)
        set_(self, "dampings", tuple((cause, bands) for cause, bands in dampings if np.any(bands)))
        load = np.zeros((1, n)) if np.size(self.load) == 0 else np.atleast_2d(np.asarray(self.load, float))
        if load.shape[1] != n:
            raise InputError(f"system.load must have shape (powers, {n}) (got {load.shape})")
        set_(self, "load", np.ascontiguousarray(load))
        dofs = self.contacts.dofs
        if dofs.size and (dofs.min() < 0 or dofs.max() >= n):
            raise InputError(f"contact rows must name dofs from 0 to {n - 1}")
        if any(not 0 <= s < n for s in self.supports):
            raise InputError(f"system.supports must name dofs from 0 to {n - 1} (got {self.supports!r})")
        if dofs.shape[1] == 1 and np.intersect1d(dofs, self.supports).size:
            raise InputError("system.supports and contact rows must not share a dof")

    @property
    def damping(self) -> Array:
        """C, shape (4, dofs)."""
        return sum((bands for _, bands in self.dampings), np.zeros_like(self.mass))

    @property
    def dofs(self) -> int:
        return int(self.mass.shape[1])
