"""Exact values that results are held against; nothing here is a measurement.

The infinite beam: ``theory``. The ladder: closed forms in ``theory.ladder``. A whole impact has no closed form.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from open_benchmark.problem import LADDER, Problem

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
    impulse = {"ball": _ball, "bar": _bar, "string": _string, "stopped-beam": _stopped_beam}.get(asked.kind)
    return Reference(impulse=None if impulse is None else impulse(asked))


def _front(asked: Problem) -> dict[str, float]:
    from theory import contact_parameters

    alpha, psi, chi, axial = asked.loads
    found = contact_parameters(asked.kappa_over_nu, alpha, psi, chi, **({"axial": axial} if axial else {}))
    values = {"lambda0": float(found.lambda0), "r0": float(found.r0)}
    if asked.kind == "first":
        values |= {"lambda1": float(found.lambda1), "r1": float(found.r1)}
    return values


def _ball(asked: Problem) -> Callable[[Array], Array]:
    from theory.ladder import BouncingBall

    given = LADDER["ball"][1]
    names = ("height", "velocity", "gravity", "restitution")
    return lambda tau: np.asarray(given["mass"] * BouncingBall(**{name: given[name] for name in names}).impulse(tau))


def _bar(asked: Problem) -> Callable[[Array], Array]:
    from theory.ladder import FlyingBar

    given = LADDER["bar"][1]
    bar = FlyingBar(
        length=given["length"],
        stiffness=given["axial_stiffness"],
        mass_per_length=given["mass_per_length"],
        velocity=given["velocity"],
        gap=given["gap"],
    )
    return lambda tau: np.asarray(bar.impulse(tau))


def _string(asked: Problem) -> Callable[[Array], Array]:
    from theory.ladder import StringOnObstacle

    # the impulse per length of a parabola is piecewise linear in x with a break in the middle: midpoints are exact
    x = (np.arange(64) + 0.5) / 64.0
    return lambda tau: np.asarray(StringOnObstacle().impulse(x[:, None], np.asarray(tau)[None, :]).mean(axis=0))


def _stopped_beam(asked: Problem) -> Callable[[Array], Array]:
    from theory.stopped_beam import StoppedBeam

    def impulse(tau: Array) -> Array:
        out = np.zeros(tau.size)  # of both halves; nothing before the first touch
        out[tau > 0.0] = StoppedBeam(asked.damping).impulse(tau[tau > 0.0])
        return out

    return impulse
