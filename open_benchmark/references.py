"""Values that results are held against: exact ones, and for a whole impact a converged one with its error bar.

The infinite beam: ``theory``. The ladder: closed forms in ``theory.ladder``. A whole impact has no closed form: its
reference is a converged simulation with an error bar, ``bounce_reference.json`` for the problems that are shipped (made
by ``python -m open_benchmark.bounce_reference``) and the map of the whole impact for others.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from comparison.stored import read
from open_benchmark.problem import LADDER, Problem
from theory import contact_parameters

__all__ = ["BOUNCES", "Reference", "reference", "stored_bounces"]

BOUNCES = Path(__file__).with_name("bounce_reference.json")

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Reference:
    """``values``: numbers by name, exact unless they stand in ``errors`` with an error bar; ``source``: of such;
    ``impulse``: exact J(τ) of a problem of the ladder."""

    values: dict[str, float] = field(default_factory=dict)
    impulse: Callable[[Array], Array] | None = None
    errors: dict[str, float] = field(default_factory=dict)
    source: str = ""

    def __getitem__(self, name: str) -> float | None:
        return self.values.get(name)


def reference(asked: Problem) -> Reference:
    """The answer to a problem, as far as there is one."""
    if asked.is_front:
        return Reference(_front(asked))
    if asked.kind == "bounce":
        return _bounce(asked)
    return Reference(impulse=IMPULSES[asked.kind](asked))


def _front(asked: Problem) -> dict[str, float]:
    alpha, psi, chi, axial = asked.loads
    found = contact_parameters(asked.kappa_over_nu, alpha, psi, chi, **({"axial": axial} if axial else {}))
    names = ("lambda0", "r0", "lambda1", "r1") if asked.kind == "first" else ("lambda0", "r0")
    return {name: float(getattr(found, name)) for name in names}


def _bounce(asked: Problem) -> Reference:
    stored = stored_bounces()
    if asked.id in stored["problems"]:
        value, error = stored["problems"][asked.id]["restitution"]
        return Reference({"restitution": value}, errors={"restitution": error}, source=stored["made_by"])
    from comparison.whole_impact.stored_map import bounce_from_map

    found = bounce_from_map(asked.kappa_over_nu, asked.damping) if asked.damping > 0.0 else None
    number = None if found is None else found["restitution"]
    if number is None or number.value is None or number.error is None:
        return Reference()  # off the map, or without damping, where no number exists
    source = "comparison/whole_impact/map.json, interpolated"
    return Reference({"restitution": number.value}, errors={"restitution": number.error}, source=source)


@cache
def stored_bounces() -> dict[str, Any]:
    """``bounce_reference.json``."""
    return read(BOUNCES)


# Imported inside: the command line loads this module, and SciPy takes a tenth of a second.


def _ball(asked: Problem) -> Callable[[Array], Array]:
    from theory.ladder import BouncingBall

    given = dict(LADDER["ball"].given)
    mass = given.pop("mass")
    return lambda tau: np.asarray(mass * BouncingBall(**given).impulse(tau))


def _bar(asked: Problem) -> Callable[[Array], Array]:
    from theory.ladder import FlyingBar

    given = dict(LADDER["bar"].given)
    bar = FlyingBar(stiffness=given.pop("axial_stiffness"), **given)
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


IMPULSES = {"ball": _ball, "bar": _bar, "string": _string, "stopped-beam": _stopped_beam}
