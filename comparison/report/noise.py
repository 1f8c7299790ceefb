"""Before and after: one impact with the thesis's own settings and with today's, for the noise of both.

The thesis (Tables 3.2 and 3.3): elements of 0.05 l* growing by 1.25 outside the zone, nonsmooth generalised-α with
ρ∞ = 0.8, contact at element middles, steps of 1e-5 t*.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bent_beam.method import Method
from comparison.report.impacts import END, SHOWN, ShownImpact, show_all, theory_of
from comparison.store import RunStore
from comparison.studies.thesis import thesis_settings
from hermite_fe import HermiteFE

__all__ = ["Noise", "compare_noise", "noise_methods"]


@dataclass(frozen=True)
class Noise:
    """The same impact before and after. ``scatter`` : standard deviation of reaction over theory; ``lift`` over V₀t."""

    before: ShownImpact
    after: ShownImpact

    @staticmethod
    def scatter(run: ShownImpact) -> float:
        """Standard deviation of one end's reaction over theory's, over the frames shown."""
        return float(np.std(np.array(run.data["reaction"]) / np.array(theory_of(run.shown)["reaction"])))

    @staticmethod
    def lift(run: ShownImpact) -> float:
        """The largest gap inside the zone over V₀t at any frame shown."""
        return float(max(run.data["lift"]))


def noise_methods() -> list[Method]:
    """The thesis's settings, and the same code with everything chosen from the problem."""
    impact = SHOWN[0].impact
    thesis = thesis_settings(impact, END * impact.time_scale).method()
    return [
        dataclasses.replace(thesis, label="settings of the thesis"),
        HermiteFE(label="settings of today"),
    ]


def compare_noise(*, store: RunStore) -> tuple[Noise | None, Sequence[str]]:
    """Both runs, or ``None`` and why one of them failed."""
    runs, lost = show_all(SHOWN[:1], noise_methods(), store=store)
    return (Noise(runs[0], runs[1]) if len(runs) == 2 else None), lost
