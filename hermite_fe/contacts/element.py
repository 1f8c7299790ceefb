"""Rows that belong to elements: g_e = Σ_k c_k·(dof k of element e), with one row an element."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.beam import HermiteBeam
from hermite_fe.system import ContactRows

__all__ = ["element_rows"]

Array = NDArray[np.float64]


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
