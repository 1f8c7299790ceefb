"""Unilateral contact along the beam: at nodes, at element middles (thesis 3.3.5, A.6), or by the mean gap of each
element (thesis 4.0.6).

    nodes    g_i = −y_i ≥ 0
    middles  g_e = −y(ξ = ½) = −(½w₁ + (l/8)θ₁ + ½w₂ − (l/8)θ₂) ≥ 0
    means    (1/l)∫_e g dx = −(½w₁ + (l/12)θ₁ + ½w₂ − (l/12)θ₂) ≥ 0

The reaction impulse of a mean gap is p_e = l ∫ r_e dt: the pair is conjugate, so the work of a piecewise-constant
reaction is exact. What they share is the impact law and the hold behind the front:

    ġ⁺ = −e ġ⁻ where a row closes                                                           (thesis 3.2.4)

**The hold.** Contact is unilateral. Two options keep closed constraints closed against that, for comparison and for the
infinite beam's first instants only:

- ``hold_until``: nothing that has closed opens before this time (a bilateral start). No mesh resolves the first
  instants, when the front is thinner than an element; the impacts of that phase may leave the zone with a velocity
  off the wall ("double detachment", thesis 3.3.5). Off unless stated: a long first step makes it needless
  (:mod:`hermite_fe.resolution`).
- ``hold``: a constraint that has closed is not released until the front is so many constraints further (the strip
  shrinks with the mesh: consistent). Behind a moving front the exact reaction is zero, and noise of either sign there
  turns into pushes off the wall. Off unless stated, but in runs that measure what a pressing load changes.

Neither acts after t_w = 0.005 T* (:data:`bent_beam.impact.FIRST_SPREAD`), from when on waves from the ends may move the
zone. A held constraint may pull; what it pulled is recorded as ``held_impulse``, and how hard as ``hold`` in the
settings.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import NDArray

from bent_beam.fields import Part, Quantity
from hermite_fe.beam import HermiteBeam
from hermite_fe.system import ContactRows

__all__ = ["CONTACTS", "Contact", "MeanContact", "MiddleContact", "NodeContact", "element_rows"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Contact(Part, ABC):
    """Base of the contact discretisations."""

    where: ClassVar[str] = "contact"

    restitution: Annotated[float, Quantity("", "e", least=0.0, most=1.0)] = 0.0
    hold: Annotated[
        int, Quantity("", "constraints in the bilateral strip behind the front", least=0)
    ] = 0
    hold_until: Annotated[float, Quantity("s", "until then closed constraints do not open", least=0.0)] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.restitution > 0.0:
            for name in ("hold", "hold_until"):
                if getattr(self, name):
                    raise ValueError(
                        f"contact.{name} keeps rows closed that restitution {self.restitution!r} makes rebound: "
                        f"state one of them (got {getattr(self, name)!r})"
                    )

    @abstractmethod
    def rows(self, beam: HermiteBeam, facing: Array, *, full: bool) -> ContactRows:
        """The constraint rows of ``beam`` for g = y_w − y = −(u + facing).

        u : the unknown dofs; facing : (dofs,), Hermite dofs of the bow as seen from the wall, −(K − K_w)x²/2.
        """


@dataclass(frozen=True)
class NodeContact(Contact):
    """Rows at the nodes; a row's tributary length is half of each neighbouring element."""

    def rows(self, beam: HermiteBeam, facing: Array, *, full: bool) -> ContactRows:
        x, count = beam.nodes, beam.nodes.size
        tributary = np.zeros(count)
        tributary[:-1] += 0.5 * beam.lengths
        tributary[1:] += 0.5 * beam.lengths
        first = count // 2 if full else 0
        return ContactRows(
            dofs=2 * np.arange(count)[:, None],
            factors=-np.ones((count, 1)),
            gap=-facing[0::2],
            places=x,
            rank=np.abs(np.arange(count) - first),
            side=(np.arange(count) < first).astype(np.int64),
            tributary=tributary,
        )


def element_rows(
    beam: HermiteBeam, facing: Array, weights: Array, *, at: float | Array = 0.5, full: bool
) -> ContactRows:
    """Rows −weights·(w₁, θ₁, w₂, θ₂), one an element.

    weights : (elements, 4). facing : (dofs,), the bow as seen from the wall. at : where in its element each row sits,
        0 … 1 from the left, a number or (elements,); the moment of the reactions, and with it λ_c, is taken there.

    Raises ``ValueError`` when ``at`` lies outside the elements.
    """
    count = beam.nodes.size - 1
    share = np.broadcast_to(np.asarray(at, float), (count,))
    if not np.all((share >= 0.0) & (share <= 1.0)):
        raise ValueError(f"at must lie in [0, 1], within the element (got {at!r})")
    dofs = 2 * np.arange(count)[:, None] + np.arange(4)[None, :]
    first = count // 2 if full else 0
    left = np.arange(count) < first
    return ContactRows(
        dofs=dofs,
        factors=-weights,
        gap=-np.einsum("jk,jk->j", weights, facing[dofs]),
        places=beam.nodes[:-1] + share * beam.lengths,
        rank=np.where(left, first - 1 - np.arange(count), np.arange(count) - first),
        side=left.astype(np.int64),
        tributary=beam.lengths,
    )


@dataclass(frozen=True)
class MiddleContact(Contact):
    """Rows at the element middles; nodes may dip into the wall by KΔx²/8 before their element's row
    closes."""

    def rows(self, beam: HermiteBeam, facing: Array, *, full: bool) -> ContactRows:
        l, half = beam.lengths, np.full(beam.lengths.size, 0.5)  # noqa: E741
        return element_rows(beam, facing, np.stack([half, l / 8, half, -l / 8], axis=1), full=full)


@dataclass(frozen=True)
class MeanContact(Contact):
    """Rows for the mean gaps of the elements."""

    def rows(self, beam: HermiteBeam, facing: Array, *, full: bool) -> ContactRows:
        l, half = beam.lengths, np.full(beam.lengths.size, 0.5)  # noqa: E741
        return element_rows(beam, facing, np.stack([half, l / 12, half, -l / 12], axis=1), full=full)


CONTACTS: dict[str, type] = {"node": NodeContact, "middle": MiddleContact, "mean": MeanContact}
"""Kinds of a case file's ``[hermite.contact]`` table."""
