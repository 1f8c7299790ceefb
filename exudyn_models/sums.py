"""Sums over the steps of a run, and over contact points."""

from __future__ import annotations

from typing import Any

import numpy as np

from exudyn_models.arrays import Array, Flags

__all__ = ["Largest", "means", "of_two_walls", "onwards", "products"]


def products(first: Array, second: Array) -> Array:
    """Scalar products of the rows."""
    return np.asarray(np.einsum("ij,ij->i", first, second))


def onwards(before: Array, gains: Array) -> Array:
    """Sums after each gain, ``before`` first."""
    return np.concatenate([before[None], before + np.cumsum(gains, axis=0)])


def means(rows: Array) -> Array:
    """Of neighbouring rows."""
    return np.asarray((rows[1:] + rows[:-1]) / 2)


def of_two_walls(fields: dict[str, tuple[Any, Any]], front: Flags) -> dict[str, tuple[Any, Any]]:
    """What the two walls gave, apart; contact points of the ``front`` wall come first, then the opposite's."""
    (dims, impulse), (_, active) = fields["impulse"], fields["in_contact"]
    return {
        "impulse": (dims, impulse[:, front]),
        "opposite_impulse": (dims, -impulse[:, ~front]),
        "in_contact": (dims, active[:, front] | active[:, ~front]),
    }


class Largest:
    """The largest gain of any contact point between two saved instants."""

    def __init__(self, contacts: int) -> None:
        self.now, self.saved = np.zeros(contacts), np.zeros(contacts)
        self.value = 0.0

    def add(self, gains: Array, saved: list[int]) -> None:
        """What the points gained in more steps, (steps, contacts), and after how many of these was saved."""
        sums = onwards(self.now, gains)
        kept = np.concatenate([self.saved[None], sums[saved]])
        self.value = max(self.value, float(np.diff(kept, axis=0).max(initial=0.0)))
        self.now, self.saved = sums[-1], kept[-1]
