"""Signorini's condition for the mean gap of each element, with a reaction constant over the element (thesis
4.0.6):

    0 ≤ r_e ⊥ (1/l)∫_e g dx = −(½w₁ + (l/12)θ₁ + ½w₂ − (l/12)θ₂) ≥ 0

The element's reaction impulse is p_e = l ∫ r_e dt: the pair (mean gap, p_e) is conjugate, so the work of a
piecewise-constant reaction is exact.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hermite_fe.beam import HermiteBeam
from hermite_fe.contacts.base import Contact
from hermite_fe.contacts.element import element_rows
from hermite_fe.system import ContactRows

__all__ = ["MeanContact"]


@dataclass(frozen=True)
class MeanContact(Contact):
    """Rows for the mean gaps of the elements."""

    def rows(self, beam: HermiteBeam, facing: NDArray[np.float64], *, full: bool) -> ContactRows:
        l, half = beam.lengths, np.full(beam.lengths.size, 0.5)  # noqa: E741
        return element_rows(beam, facing, np.stack([half, l / 12, half, -l / 12], axis=1), full=full)
