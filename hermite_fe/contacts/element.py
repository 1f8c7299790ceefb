"""Rows that belong to elements: g_e = Σ_k c_k·(dof k of element e), with one row an element."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.beam import HermiteBeam
from hermite_fe.system import ContactRows

__all__ = ["element_rows"]

Array = NDArray[np.float64]


def element_rows(beam: HermiteBeam, natural: Array, weights: Array, *, full: bool) -> ContactRows:
    """Rows −weights·(w₁, θ₁, w₂, θ₂); ``weights`` (elements, 4); ``natural`` (dofs,) is the stress-free
    shape."""
    count = beam.nodes.size - 1
    dofs = 2 * np.arange(count)[:, None] + np.arange(4)[None, :]
    first = count // 2 if full else 0
    left = np.arange(count) < first
    return ContactRows(
        dofs=dofs,
        factors=-weights,
        gap=-np.einsum("jk,jk->j", weights, natural[dofs]),
        places=0.5 * (beam.nodes[:-1] + beam.nodes[1:]),
        rank=np.where(left, first - 1 - np.arange(count), np.arange(count) - first),
        side=left.astype(np.int64),
        tributary=beam.lengths,
    )
