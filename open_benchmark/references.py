"""Exact values that results are held against; nothing here is a measurement.

The infinite beam: ``theory``. The ladder: closed forms in ``theory.ladder``. A whole impact has no closed form.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from open_benchmark.problem import Problem

__all__ = ["Reference", "reference"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Reference:
    """``values``: exact numbers by name; ``impulse``: exact J(τ) of a problem of the ladder."""

    values: dict[str, float] = field(default_factory=dict)
    impulse: Callable[[Array], Array] | None = None

    def __getitem__(self, name: str) -> float | None:
        return self.values.get(name)


def reference(asked: Problem) -> Reference:
    """The exact answer to a problem, as far as there is one."""
    if asked.is_front:
        return Reference(_front(asked))
    return Reference()


def _front(asked: Problem) -> dict[str, float]:
    from theory import contact_parameters

    alpha, psi, chi, axial = asked.loads
    found = contact_parameters(asked.kappa_over_nu, alpha, psi, chi, **({"axial": axial} if axial else {}))
    values = {"lambda0": float(found.lambda0), "r0": float(found.r0)}
    if asked.kind == "first":
        values |= {"lambda1": float(found.lambda1), "r1": float(found.r1)}
    return values
