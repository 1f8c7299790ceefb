"""Contact at the element middles: g_e = −y(ξ = ½) = −(½w₁ + (l/8)θ₁ + ½w₂ − (l/8)θ₂) ≥ 0 (thesis 3.3.5,
A.6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hermite_fe.beam import HermiteBeam
from hermite_fe.contacts.base import Contact
from hermite_fe.contacts.element import element_rows
from hermite_fe.system import ContactRows

__all__ = ["MiddleContact"]


@dataclass(frozen=True)
class MiddleContact(Contact):
    """Rows at the element middles; nodes may dip into the wall by KΔx²/8 before their element's row
    closes."""

    def rows(self, beam: HermiteBeam, facing: NDArray[np.float64], *, full: bool) -> ContactRows:
        l, half = beam.lengths, np.full(beam.lengths.size, 0.5)  # noqa: E741
        return element_rows(beam, facing, np.stack([half, l / 8, half, -l / 8], axis=1), full=full)
