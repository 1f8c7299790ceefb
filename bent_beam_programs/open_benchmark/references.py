"""Values that results are held against, as data: ``references.json`` (schema beam-impact-references/2).

Values of the shipped problems stand there, so that scoring needs no theory; those of other parameters are computed
(:mod:`.exact`). A whole impact has no closed form: its values, of a converged simulation with its error bars, stand in
``bounce_reference.json`` (:mod:`.bounce_reference`), those of other parameters come from a run on a coarser mesh.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import PPoly

from bent_beam.stored import read
from bent_beam_programs.open_benchmark.problem import Problem
from bent_beam_programs.open_benchmark.result import Array

BOUNCES = Path(__file__).with_name("bounce_reference.json")
REFERENCES = Path(__file__).with_name("references.json")
SCHEMA = "beam-impact-references/2"
POWERS = {"time": 1.0, "fourth root of time": 0.25}  # of the variable that J(t) is a piecewise polynomial of
stored = cache(read)


@dataclass(frozen=True)
class Reference:
    """``values``: numbers by name, exact unless they stand in ``errors`` with an error bar; ``source``: of such;
    ``impulse``: exact J(τ) of a problem of the ladder."""

    values: dict[str, float] = field(default_factory=dict)
    impulse: Callable[[Array], Array] | None = None
    errors: dict[str, float] = field(default_factory=dict)
    source: str = ""


def reference(asked: Problem) -> Reference:
    """The answer to a problem, as far as there is one."""
    if asked.kind == "bounce":
        return _bounce(asked)
    known = stored(REFERENCES)["problems"].get(asked.id)
    if known is None:  # not shipped: the theory is asked, and loaded only then
        from bent_beam_programs.open_benchmark.exact import computed

        known = computed(asked)
    impulse = _impulse(known["impulse"]) if "impulse" in known else None
    errors = known.get("errors", {})
    return Reference(known.get("values", {}), impulse, errors, "computed from the theory" if errors else "")


def _impulse(table: Mapping[str, Any]) -> Callable[[Array], Array]:
    pieces = PPoly(np.array(table["coefficients"]).T, np.array(table["breaks"]))
    return lambda tau: np.asarray(pieces(tau ** POWERS[table["variable"]]))


def _bounce(asked: Problem) -> Reference:
    shipped = stored(BOUNCES)
    if asked.id in shipped["problems"]:
        (value, error), source = shipped["problems"][asked.id]["restitution"], shipped["made_by"]
    else:
        (value, error), source = _restitution(asked), "Hermite elements, run now; bar: half the mesh, contact law"
    if value is None or error is None:
        return Reference()  # without damping there is no number
    return Reference({"restitution": value}, errors={"restitution": error}, source=source)


@lru_cache(maxsize=64)
def _restitution(asked: Problem) -> tuple[float | None, float | None]:
    from bent_beam_programs.open_benchmark.exact import whole_impact

    return tuple(whole_impact(asked)["restitution"]) if asked.damping > 0.0 else (None, None)
