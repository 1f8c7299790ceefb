"""The reaction of every step, and the thesis's filter (3.3.1, 3.3.5).

    R_k = ΔI_k/h of one side, then Matlab's filtfilt with a filter of order 1 and the cut-off 0.04

The cut-off is a share of half the sampling rate, 1/(2h): the filter smooths over a number of steps, 1/(0.04 π) ≈ 8 each
way, and the time is proportional to h. The text gives the order and the cut-off; we take Butterworth's filter, the
usual one.
"""

from __future__ import annotations

import time as clock
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from hermite_fe import HermiteFE, resolution
from hermite_fe.constraints import ContactLaw
from hermite_fe.model import beam_model
from hermite_fe.resolution import Composition
from hermite_fe.run import Stepper, saved_steps, trajectory_of
from hermite_fe.simulate import history_of, settings_of_run

Array = NDArray[np.float64]
CUT_OFF = 0.04


@dataclass(frozen=True)
class Steps:
    """Ends of the steps, s, and the mean reaction of one side in each, N, shapes (steps,); cut_off : of the filter."""

    time: Array
    reaction: Array
    cut_off: float = CUT_OFF

    def filtered(self) -> Array:
        """The reaction, filtered forwards and backwards, N; as it is from a cut-off of half the sampling rate on."""
        from scipy.signal import butter, filtfilt

        if self.cut_off >= 1.0:
            return self.reaction
        b, a = butter(1, self.cut_off)
        return np.asarray(filtfilt(b, a, self.reaction, padlen=3))  # Matlab's length of the reflected ends


def every_step(
    impact: Impact, end_time: float, method: HermiteFE, save: Sequence[float] | Array
) -> tuple[ImpactHistory, Steps]:
    """Run to ``end_time``, s, step by step, on half the beam: its history at the instants ``save``, s, and all steps.

    Raises ``ArithmeticError`` for a step without a solution.
    """
    parts = {name: getattr(method, name) for name in ("mesh", "integrator", "contact", "far_field", "mass")}
    chosen = resolution.choose(impact, end_time, Composition(**parts))
    model = beam_model(impact, chosen.nodes, chosen.contact, chosen.far_field, full=False, mass=chosen.mass)
    law = ContactLaw(restitution=chosen.contact.restitution)
    run = Stepper(model.system, model.displacement, model.velocity, chosen.integrator, end_time, law)
    kept = saved_steps(run.instants, save)
    samples, total, wanted = [], np.zeros(run.instants.size), set(kept.tolist())
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


def scatter(time: Array, reaction: Array, exact: Array) -> float:
    """Root mean square of reaction over theory less one, in the second half of the run."""
    late = time > 0.5 * time[-1]
    return float(np.sqrt(np.mean((reaction / exact - 1.0)[late] ** 2)))
