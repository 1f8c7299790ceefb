"""Contact at the nodes: g_i = −y_i ≥ 0, one row a node (thesis 3.3.5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hermite_fe.beam import HermiteBeam
from hermite_fe.contacts.base import Contact
from hermite_fe.system import ContactRows

__all__ = ["NodeContact"]


@dataclass(frozen=True)
class NodeContact(Contact):
    """Rows at the nodes; a row's tributary length is half of each neighbouring element."""

    def rows(self, beam: HermiteBeam, facing: NDArray[np.float64], *, full: bool) -> ContactRows:
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
