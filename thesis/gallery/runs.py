"""Runs that several items share, kept while a process draws: the thesis's cases with its settings, and the references.

V₀ = 20 m/s, EI = 1 N m², μ = 1 kg/m, L = 50 m throughout (3.2.1, 3.4); K and τ as each figure asks.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from bent_beam.cases import Case
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from thesis.studies.outcome import Outcome, outcome_of
from thesis.studies.steps import Steps, every_step
from thesis.studies.thesis import MASSES, Variant, references, thesis_settings


def case(curvature: float, duration: float) -> Case:
    """The thesis's beam of a curvature (1/m), followed to τ = ``duration``."""
    impact = Impact(bending_stiffness=1.0, mass_per_length=1.0, length=50.0, curvature=curvature, velocity=20.0)
    title = f"K = {curvature:.4g} 1/m, τ = {duration:g}"
    return Case(title=title, impact=impact, end_time=duration * impact.time_scale, mesh=None, tables={})


@functools.cache
def thesis_history(curvature: float, duration: float, **changes: Any) -> ImpactHistory:
    """One run with the thesis's settings but for ``changes`` (fields of :class:`thesis.studies.thesis.Settings`)."""
    given = case(curvature, duration)
    settings = thesis_settings(given.impact, given.end_time).replace(**changes)
    return Variant("", given.impact, given.end_time, settings.method()).history()


@functools.cache
def thesis_steps(curvature: float, duration: float, **changes: Any) -> Steps:
    """The reaction of every step of the same run."""
    given = case(curvature, duration)
    settings = thesis_settings(given.impact, given.end_time).replace(**changes)
    return every_step(given.impact, given.end_time, settings.method())


def thesis(label: str, curvature: float, duration: float, **changes: Any) -> Outcome:
    """The run reduced to its curves."""
    return outcome_of(thesis_history(curvature, duration, **changes), label)


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


@dataclass(frozen=True)
class Series:
    """Runs with the thesis's settings, label → changes, with both masses; the references beside them."""

    curvature: float
    duration: float
    runs: Mapping[str, dict[str, Any]]

    def outcomes(self, mass: str, *, steps: bool = False) -> list[Outcome]:
        """Those of a mass (a key of ``MASSES``); steps : with the reaction of every step."""
        found = []
        for label, changed in self.runs.items():
            chosen = {**changed, "mass": MASSES[mass]}
            outcome = thesis(label, self.curvature, self.duration, **chosen)
            every = thesis_steps(self.curvature, self.duration, **chosen) if steps else None
            found.append(replace(outcome, steps=every))
        return found + reference_runs(self.curvature, self.duration)
