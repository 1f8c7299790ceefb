"""The steps of a run that are saved."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import MOST_INSTANTS

__all__ = ["saved_steps"]

Array = NDArray[np.float64]


def saved_steps(instants: Array, save: int | Sequence[float] | Array) -> NDArray[np.int64]:
    """Indices of the instants to keep: so many, evenly spaced in √t, or those nearest to given times; the first always.

    Raises ``ValueError`` for fewer than two, or times that are not increasing, negative or past the end.
    """
    end = instants[-1]
    if np.ndim(save) == 0:
        count = int(np.asarray(save))
        if count != save or not 2 <= count <= MOST_INSTANTS:
            raise ValueError(f"save must be a whole number from 2 to {MOST_INSTANTS}, or times (got {save!r})")
        wanted = end * np.linspace(0.0, 1.0, count) ** 2
    else:
        wanted = np.asarray(save, float)
        if wanted.ndim != 1 or wanted.size < 1 or not np.all(np.isfinite(wanted)):
            raise ValueError("save must be a whole number of at least 2, or a list of finite times")
        if np.any(np.diff(wanted) <= 0.0) or wanted[0] < 0.0 or wanted[-1] > end * (1.0 + 1e-9):
            raise ValueError(f"save must hold increasing times from 0 to the end time {end!r}")
    middles = 0.5 * (instants[1:] + instants[:-1])
    return np.unique(np.concatenate([[0], np.searchsorted(middles, wanted)]))
