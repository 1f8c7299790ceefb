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
from bent_beam.method import refined
from hermite_fe import HermiteFE, resolution
from thesis.studies.outcome import Outcome, outcome_of, saved_times
from thesis.studies.steps import Steps, every_step
from thesis.studies.thesis import MASSES, references, thesis_settings

HALF = 0.5
"""Of Hermite's resolution, for references with thin fronts: 0.1 % off, which no circle shows, a quarter of the time."""


def case(curvature: float, duration: float) -> Case:
    """The thesis's beam of a curvature (1/m), followed to τ = ``duration``."""
    impact = Impact(bending_stiffness=1.0, mass_per_length=1.0, length=50.0, curvature=curvature, velocity=20.0)
    title = f"K = {curvature:.4g} 1/m, τ = {duration:g}"
    return Case(title=title, impact=impact, end_time=duration * impact.time_scale, mesh=None, tables={})


@functools.cache
def thesis_run(curvature: float, duration: float, **changes: Any) -> tuple[ImpactHistory, Steps]:
    """One run with the thesis's settings but for ``changes`` (fields of :class:`thesis.studies.thesis.Settings`)."""
    given = case(curvature, duration)
    settings = thesis_settings(given.impact, given.end_time).replace(**changes)
    return every_step(given.impact, given.end_time, settings.method(), saved_times(given.end_time))


def thesis_history(curvature: float, duration: float, **changes: Any) -> ImpactHistory:
    """Its saved instants."""
    return thesis_run(curvature, duration, **changes)[0]


def thesis(label: str, curvature: float, duration: float, **changes: Any) -> Outcome:
    """The run reduced to its curves, with the reaction of every step."""
    history, steps = thesis_run(curvature, duration, **changes)
    return outcome_of(history, label, steps=steps)


@functools.cache
def reference_history(curvature: float, duration: float, path: str) -> ImpactHistory:
    """One reference's run."""
    given = case(curvature, duration)
    (run,) = (v for v in references(given.impact, given.end_time) if v.method.path == path)
    thin = path == HermiteFE.path and given.impact.kappa_over_nu < resolution.THIN
    coarser = refined(run.method, HALF) if thin else None
    return replace(run, method=coarser or run.method).history()


def reference_runs(curvature: float, duration: float) -> list[Outcome]:
    """This project's methods: the fixed mesh and the infinite beam in similarity coordinates."""
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

    def outcomes(self, mass: str) -> list[Outcome]:
        """Those of a mass (a key of ``MASSES``)."""
        found = [
            thesis(label, self.curvature, self.duration, **changed, mass=MASSES[mass])
            for label, changed in self.runs.items()
        ]
        return found + reference_runs(self.curvature, self.duration)
