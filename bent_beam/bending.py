"""Curvatures of the cubics between nodes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["end_curvatures"]

Array = NDArray[np.float64]


def end_curvatures(x: Array, y: Array, slope: Array) -> Array:
    """y_xx at both ends of each element, (…, elements, 2), from deflections and slopes, (…, nodes)."""
    h = np.diff(x)
    rise = np.diff(y, axis=-1) / h
    left = (6.0 * rise - 4.0 * slope[..., :-1] - 2.0 * slope[..., 1:]) / h
    right = (-6.0 * rise + 2.0 * slope[..., :-1] + 4.0 * slope[..., 1:]) / h
    return np.stack([left, right], axis=-1)
