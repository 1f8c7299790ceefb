"""Runs that several items share, kept while a process draws: the thesis's cases with its settings, and the references.

V₀ = 20 m/s, EI = 1 N m², μ = 1 kg/m, L = 50 m throughout (3.2.1, 3.4); K and τ as each figure asks.
"""

from __future__ import annotations

import functools
from typing import Any

from bent_beam.cases import Case
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from comparison.studies.outcome import Outcome, outcome_of
from comparison.studies.thesis import Variant, references, thesis_settings

__all__ = ["case", "reference_history", "reference_runs", "thesis", "thesis_history"]


def case(curvature: float, duration: float, title: str = "") -> Case:
    """The thesis's beam of a curvature (1/m), followed to τ = ``duration``."""
    impact = Impact(bending_stiffness=1.0, mass_per_length=1.0, length=50.0, curvature=curvature, velocity=20.0)
    name = title or f"K = {curvature:.4g} 1/m, τ = {duration:g}"
    return Case(title=name, impact=impact, end_time=duration * impact.time_scale, mesh=None, tables={})


@functools.cache
def thesis_history(curvature: float, duration: float, **changes: Any) -> ImpactHistory:
    """One run with the thesis's settings but for ``changes`` (fields of
    :class:`comparison.studies.thesis.Settings`).
    """
    given = case(curvature, duration)
    settings = thesis_settings(given.impact, given.end_time).replace(**changes)
    return Variant("", given.impact, given.end_time, settings.method()).history()


def thesis(label: str, curvature: float, duration: float, *, value: float | None = None, **changes: Any) -> Outcome:
    """The same, reduced to its curves; ``value`` is that of the parameter that varies."""
    return outcome_of(thesis_history(curvature, duration, **changes), label, value=value)


@functools.cache
def reference_history(curvature: float, duration: float, path: str) -> ImpactHistory:
    """One reference's run."""
    given = case(curvature, duration)
    return next(v for v in references(given.impact, given.end_time) if v.method.path == path).history()


def reference_runs(curvature: float, duration: float) -> list[Outcome]:
    """This project's own choices: the fixed mesh and the infinite beam in similarity coordinates."""
    given = case(curvature, duration)
    return [
        outcome_of(reference_history(curvature, duration, v.method.path), v.label, mark=v.method.path)
        for v in references(given.impact, given.end_time)
    ]
