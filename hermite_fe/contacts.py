"""Unilateral contact along the beam: at nodes, all or every other one, at element middles (thesis 3.3.5, A.6), or by
the mean gap of each element (thesis 4.0.6).

    nodes    g_i = −y_i ≥ 0
    middles  g_e = −y(ξ = ½) = −(½w₁ + (l/8)θ₁ + ½w₂ − (l/8)θ₂) ≥ 0
    means    (1/l)∫_e g dx = −(½w₁ + (l/12)θ₁ + ½w₂ − (l/12)θ₂) ≥ 0

The reaction impulse of a mean gap is p_e = l ∫ r_e dt: the pair is conjugate, so the work of a piecewise-constant
reaction is exact. Where a row closes ġ⁺ = −e ġ⁻ (thesis 3.2.4).

**The hold.** Contact is unilateral unless its law has a strength (:class:`hermite_fe.constraints.ContactLaw`). Two
options, off unless stated, keep closed constraints closed whatever they pull, for comparison and for the infinite
beam's first instants only:

- ``hold_until``: nothing that has closed opens before this time: a bilateral start. With the long first step of
  :mod:`hermite_fe.resolution` it is not needed.
- ``hold``: a constraint that has closed is not released until the front is so many constraints further. Behind a moving
  front the exact reaction is zero, and noise of either sign there turns into pushes off the wall. Runs that measure
  what a pressing load changes take a ``hold`` by themselves.

Neither acts after 0.005 T* (:data:`bent_beam.impact.WAVES_FELT`), from when on waves from the ends may move the zone.
What a held constraint pulled is recorded as ``held_impulse``, and how hard as ``hold`` in the settings.
"""

import dataclasses
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity
from hermite_fe.beam import HermiteBeam
from hermite_fe.compiled import Array
from hermite_fe.constraints import ContactLaw
from hermite_fe.masses import Mass
from hermite_fe.system import ContactRows

__all__ = ["CONTACTS", "AlternateContact", "Contact", "MeanContact", "MiddleContact", "NodeContact", "element_rows",
           "impact_coupling"]  # fmt: skip

COUPLED = 40  # elements; the consistent mass matrix couples over some five: the ends are out of reach


@dataclass(frozen=True)
class Contact(Part, ABC):
    """Base of the contact discretisations."""

    where: ClassVar[str] = "hermite.contact"

    restitution: Annotated[float, Quantity("", "e", least=0.0, most=1.0)] = 0.0
    hold: Annotated[
        int, Quantity("", "constraints in the bilateral strip behind the front, until 0.005 T* at most", least=0)
    ] = 0
    hold_until: Annotated[
        float, Quantity("s", "until then, and 0.005 T* at most, closed constraints do not open", least=0.0)
    ] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.held and self.restitution > 0.0:
            name, value = next(iter(self.held.items()))
            raise InputError(
                f"hermite.contact.{name} keeps rows closed that restitution {self.restitution!r} makes rebound: "
                f"state one of them (got {value!r})"
            )

    @property
    def sticks(self) -> bool:
        """Whether :meth:`law` has a strength: a whole beam then gets a scheme in which what has landed rests."""
        return False

    @property
    def held(self) -> dict[str, float]:
        """What keeps closed constraints closed, by the name of its field."""
        return {name: getattr(self, name) for name in ("hold", "hold_until") if getattr(self, name)}

    def law(self, rows: ContactRows, hold_ends: float) -> ContactLaw:
        """What ``rows`` do that have closed; nothing is held from ``hold_ends``, s, on."""
        return ContactLaw(self.restitution, self.hold, self.hold_until, hold_ends)

    def checked_law(self, rows: ContactRows, hold_ends: float) -> ContactLaw:
        """:meth:`law`, which may be somebody else's; ``ValueError`` where it is none of these rows and this class."""
        law, name = self.law(rows, hold_ends), f"hermite.contact: {type(self).__name__}"
        if not isinstance(law, ContactLaw):
            raise InputError(f"{name}.law must return a ContactLaw (got {law!r})")
        if np.shape(law.strength) not in ((), (1,), (len(rows),)):
            shape = np.shape(law.strength)
            raise InputError(f"{name}.law must give one strength, or one a row, ({len(rows)},) (got shape {shape})")
        if np.asarray(law.strength).dtype.kind not in "fiu":
            raise InputError(f"{name}.law must give its strength as a number, N (got {law.strength!r})")
        if np.any(law.strength) and not self.sticks:
            raise InputError(f"{name}.law has a strength: set `sticks = True` in the class")
        return law

    @abstractmethod
    def rows(self, beam: HermiteBeam, facing: Array, *, full: bool) -> ContactRows:
        """The constraint rows of ``beam`` for g = y_w − y = −(u + facing).

        u : the unknown dofs; facing : (dofs,), Hermite dofs of the bow as seen from the wall, −(K − K_w)(x − x₀)²/2
            less the clearance, x₀ being where it touches first.
        """


@dataclass(frozen=True)
class NodeContact(Contact):
    """Rows at the nodes; a row's tributary length is half of each neighbouring element."""

    def rows(self, beam: HermiteBeam, facing: Array, *, full: bool) -> ContactRows:
        number, factors = np.arange(beam.nodes.size), -np.ones((beam.nodes.size, 1))
        order, tributary = number - (number.size // 2 if full else 0), np.convolve(beam.lengths, [0.5, 0.5])
        return ContactRows(2 * number[:, None], factors, -facing[0::2], beam.nodes, order, tributary)


def element_rows(
    beam: HermiteBeam, facing: Array, weights: Array, *, at: float | Array = 0.5, full: bool
) -> ContactRows:
    """Rows −weights·(w₁, θ₁, w₂, θ₂), one an element.

    weights : (elements, 4). facing : (dofs,), the bow as seen from the wall. at : where in its element each row sits,
        0 … 1 from the left, a number or (elements,); the moment of the reactions, and with it λ_c, is taken there.

    Raises ``ValueError`` when ``at`` lies outside the elements, or weights do not move with the beam.
    """
    number, share = np.arange(beam.lengths.size), np.asarray(at, float)
    if not np.all((share >= 0.0) & (share <= 1.0)):
        raise InputError(f"at must lie in [0, 1], within the element (got {at!r})")
    lifted = weights[:, 0] + weights[:, 2]
    if not np.allclose(lifted, 1.0, rtol=0.0, atol=1e-9):
        worst = float(lifted[np.argmax(np.abs(lifted - 1.0))])
        raise InputError(f"weights of the deflections w₁ and w₂ must add up to one in each element (got {worst:.6g})")
    dofs, order = 2 * number[:, None] + np.arange(4), number - (number.size // 2 if full else 0)
    gap, places = -np.einsum("jk,jk->j", weights, facing[dofs]), beam.nodes[:-1] + share * beam.lengths
    return ContactRows(dofs, -weights, gap, places, order, beam.lengths)


@dataclass(frozen=True)
class MiddleContact(Contact):
    """Rows at the element middles; nodes may dip into the wall by KΔx²/8 before their element's row closes."""

    slope_share: ClassVar[float] = 8.0  # a slope counts for its element's length over this

    def rows(self, beam: HermiteBeam, facing: Array, *, full: bool) -> ContactRows:
        half, slope = np.full(beam.lengths.size, 0.5), beam.lengths / self.slope_share
        return element_rows(beam, facing, np.stack([half, slope, half, -slope], axis=1), full=full)


@dataclass(frozen=True)
class MeanContact(MiddleContact):
    """Rows for the mean gaps of the elements."""

    slope_share: ClassVar[float] = 12.0


@dataclass(frozen=True)
class AlternateContact(NodeContact):
    """Rows at every other node, the middle among them: those between may carry the mass of contact points without any
    (:mod:`hermite_fe.integrators.massless_boundary`)."""

    def rows(self, beam: HermiteBeam, facing: Array, *, full: bool) -> ContactRows:
        rows = super().rows(beam, facing, full=full)
        kept = rows.at(rows.order % 2 == 0)
        return dataclasses.replace(kept, order=kept.order // 2, tributary=2.0 * kept.tributary)


CONTACTS: dict[str, type] = {
    "node": NodeContact,
    "middle": MiddleContact,
    "mean": MeanContact,
    "alternate": AlternateContact,
}
"""Kinds of a case file's ``[hermite.contact]`` table."""


def impact_coupling(contact: Contact, mass: Mass) -> float:
    """c = W_{j,j±1}/W_jj, W = G M⁻¹ Gᵀ, of rows far from the ends of a beam of equal elements.

    A row that stops from the velocity V₀ throws its neighbour off the wall at cV₀ where c > 0, and presses it on where
    c < 0 (docs/numerics.md).
    """
    from scipy.linalg import cho_solve_banded, cholesky_banded  # here: few runs need what takes long to import

    beam = HermiteBeam(np.arange(COUPLED + 1.0), 1.0, 1.0)
    rows = contact.rows(beam, np.zeros(beam.dofs), full=False)
    G, j = np.zeros((2, beam.dofs)), len(rows) // 2
    np.put_along_axis(G, rows.dofs[j : j + 2], rows.factors[j : j + 2], axis=1)
    moved = cho_solve_banded((cholesky_banded(mass.matrix(beam), lower=True), True), G[0])
    own, next_one = (float(v) for v in G @ moved)
    return next_one / own
