"""How an impact at one contact row moves its neighbours: the Delassus operator W = G M⁻¹ Gᵀ.

A row j that stops from the velocity V₀ takes the impulse V₀/W_jj, and this changes the gap velocity of row i by
(W_ij/W_jj)V₀. With

    c = W_{j,j±1}/W_jj

the neighbour that has just come to rest is thrown off the wall at cV₀ when c > 0, and pressed on, which only costs
another impulse, when c < 0. On equal elements (l = 1, μ = 1) lumped masses with the rotary part r give

    nodes: W = 1, c = 0;    middles: W = ½ + 1/(64 r),  c = (¼ − 1/(128 r))/W: zero at r = 1/32.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hermite_fe.beam import HermiteBeam
from hermite_fe.contacts import Contact
from hermite_fe.masses import Mass

__all__ = ["ImpactCoupling", "impact_coupling"]

ELEMENTS = 40  # the consistent mass matrix couples over some five elements: the ends are out of reach


@dataclass(frozen=True)
class ImpactCoupling:
    """moved_mass : 1/W_jj over μΔx, what an impact at one row has to stop; neighbour : c, see the module's text."""

    moved_mass: float
    neighbour: float


def impact_coupling(contact: Contact, mass: Mass) -> ImpactCoupling:
    """Of rows far from the ends of a beam of equal elements."""
    from scipy.linalg import cho_solve_banded, cholesky_banded  # here: few runs need what takes long to import

    beam = HermiteBeam(np.arange(ELEMENTS + 1.0), 1.0, 1.0)
    rows = contact.rows(beam, np.zeros(beam.dofs), full=False)
    j = len(rows) // 2
    G = np.zeros((2, beam.dofs))
    for k in range(2):
        G[k, rows.dofs[j + k]] = rows.factors[j + k]
    moved = cho_solve_banded((cholesky_banded(mass.matrix(beam), lower=True), True), G[0])
    own, next_one = (float(v) for v in G @ moved)
    return ImpactCoupling(moved_mass=1.0 / own, neighbour=next_one / own)
