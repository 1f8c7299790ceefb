"""Runs that several items share, kept while a process draws: the thesis's cases with its settings, and the references.

V₀ = 20 m/s, EI = 1 N m², μ = 1 kg/m, L = 50 m throughout (3.2.1, 3.4); K and τ as each figure asks.
"""

import functools
import time as clock
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from bent_beam import Case, Impact, ImpactHistory
from bent_beam.method import refined
from bent_beam_programs.thesis.studies.outcome import Array, Outcome, Steps, outcome_of, saved_times
from bent_beam_programs.thesis.studies.thesis import MASSES, Settings, references, thesis_settings
from hermite_fe import HermiteFE, resolution
from hermite_fe.constraints import ContactLaw
from hermite_fe.model import beam_model
from hermite_fe.run import Stepper, saved_steps, trajectory_of
from hermite_fe.simulate import history_of, settings_of_run

HALF = 0.5  # of Hermite's resolution, for references with thin fronts: 0.1 % off, in a quarter of the time


def case(curvature: float, duration: float) -> Case:
    """The thesis's beam of a curvature (1/m), followed to τ = ``duration``."""
    impact = Impact(bending_stiffness=1.0, mass_per_length=1.0, length=50.0, curvature=curvature, velocity=20.0)
    title = f"K = {curvature:.4g} 1/m, τ = {duration:g}"
    return Case(title=title, impact=impact, end_time=duration * impact.time_scale, mesh=None, tables={})


def every_step(
    impact: Impact, end_time: float, method: HermiteFE, save: Sequence[float] | Array
) -> tuple[ImpactHistory, Steps]:
    """Run to ``end_time``, s, step by step, on half the beam: its history at the instants ``save``, s, and all steps.

    Raises ``ArithmeticError`` for a step without a solution.
    """
    parts = {name: getattr(method, name) for name in ("mesh", "integrator", "contact", "far_field", "mass")}
    chosen = resolution.choose(impact, end_time, resolution.Composition(**parts))
    model = beam_model(impact, chosen.nodes, chosen.contact, chosen.far_field, full=False, mass=chosen.mass)
    law = ContactLaw(restitution=chosen.contact.restitution)
    run = Stepper(model.system, model.displacement, model.velocity, chosen.integrator, end_time, law)
    samples, total, wanted = [], np.zeros(run.instants.size), set(saved_steps(run.instants, save).tolist())
    run.compile()
    began = clock.perf_counter()
    for k in range(total.size):
        if status := run.advance_to(k):
            raise ArithmeticError(f"step {k} of {total.size - 1} has no solution (status {status})")
        total[k] = run.state.impulse.sum()
        if k in wanted:
            samples.append(run.sample())
    found = trajectory_of(run, samples, clock.perf_counter() - began)
    history = history_of(impact, model, found, settings_of_run(impact, chosen, found))
    return history, Steps(run.instants[1:], np.diff(total) / np.diff(run.instants))


@functools.cache
def stepped(impact: Impact, end_time: float, settings: Settings) -> Outcome:
    """A run of the Hermite path until ``end_time``, s, with its history and the reaction of every step."""
    history, steps = every_step(impact, end_time, settings.method(), saved_times(end_time))
    return replace(outcome_of(history, "", steps=steps), history=history)


def thesis(label: str, curvature: float, duration: float, **changes: Any) -> Outcome:
    """One run with the thesis's settings but for ``changes``."""
    given = case(curvature, duration)
    settings = thesis_settings(given.impact, given.end_time).replace(**changes)
    return replace(stepped(given.impact, given.end_time, settings), label=label)


@functools.cache
def reference_history(curvature: float, duration: float, path: str) -> ImpactHistory:
    given = case(curvature, duration)
    (run,) = (v for v in references(given.impact, given.end_time) if v.method.path == path)
    thin = path == HermiteFE.path and given.impact.kappa_over_nu < resolution.THIN
    coarser = refined(run.method, HALF) if thin else None
    return replace(run, method=coarser or run.method).history()


def reference_runs(curvature: float, duration: float) -> list[Outcome]:
    """This project's methods: the fixed mesh and the infinite beam in similarity coordinates."""
    given = case(curvature, duration)
    methods = [v.method for v in references(given.impact, given.end_time)]
    return [outcome_of(reference_history(curvature, duration, m.path), m.label, mark=m.path) for m in methods]


@dataclass(frozen=True)
class Series:
    """Runs with the thesis's settings, label → changes, with both masses; the references beside them."""

    curvature: float
    duration: float
    runs: Mapping[str, dict[str, Any]]

    def outcomes(self, mass: str) -> list[Outcome]:
        """Those of a mass (a key of ``MASSES``)."""
        about = self.curvature, self.duration
        own = [thesis(label, *about, mass=MASSES[mass], **changed) for label, changed in self.runs.items()]
        return own + reference_runs(*about)
