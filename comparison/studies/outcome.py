"""One run of a study, reduced to curves and the handful of numbers that tell runs apart.

- contact length: λ₀ fitted to the centroid of the reaction; reaction: r₀ fitted to the impulse
(:mod:`comparison.estimators`);
  with first-order terms both are compared with theory at the end of the run;
- lift: largest gap inside nine tenths of the contact zone over V₀t ("double detachment", thesis 3.3.5);
- noise: what a fiftieth of the run's impulse scatters about theory, root mean square;
- energy: what impacts and damping took, over the energy V₀∫R dt of the exact fast layer, which loses none.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from comparison.estimators import leading_order, moments
from comparison.studies.exact import Exact

__all__ = ["MEASURES", "Outcome", "failed", "outcome_of", "saved_times"]

Array = NDArray[np.float64]
WINDOWS = 50
TOUCH = 1e-6  # of V₀t: gaps below are contact (the thesis takes 10⁻⁶ m, which reads ahead of a thick front)

MEASURES: dict[str, str] = {
    "contact_length_error": "λ₀ error (%)",
    "reaction_error": "r₀ error (%)",
    "lift": "lift/(V₀t)",
    "noise": "noise of R (%)",
    "lost_impact": "lost in impacts (%)",
    "lost_damping": "lost in damping (%)",
    "strain": "strain energy/theory",
    "nodes": "nodes",
    "steps": "steps",
    "seconds": "seconds",
}
"""Numbers of an outcome and how they are headed."""


def saved_times(end: float, even: int = 400, root: int = 120) -> Array:
    """Instants that show both a reaction (even in t) and a front (even in √t)."""
    return np.unique(np.concatenate([np.linspace(0.0, end, even + 1), end * np.linspace(0.0, 1.0, root + 1) ** 2]))


@dataclass(frozen=True)
class Outcome:
    """A finished run.

    mark : the path whose mark it is drawn with, for a reference; ``None`` for one of the varied settings, which are
    lines.
    value : of the varied parameter, if a number.
    time, front, side_impulse, strain, energy : (times,), SI, the energy being that of the whole beam over its first
        value; x, gap : the beam at the end, half of it.
    measures : numbers by the names of ``MEASURES``; ``None`` where there is none to be had.
    failure : why a run did not finish; then everything may be empty. refused : the method had said so before.
    setting, refine : of the varied parameter, and of a method's resolution, where methods are varied; ``label`` is then
        the method's.
    """

    label: str
    impact: Impact
    value: float | None
    time: Array
    front: Array
    side_impulse: Array
    strain: Array
    energy: Array
    x: Array
    gap: Array
    measures: dict[str, float | None]
    mark: str | None = None
    warnings: tuple[str, ...] = ()
    failure: str | None = None
    refused: bool = False
    setting: str = ""
    refine: float = 1.0

    @property
    def method(self) -> str:
        """The label, and the resolution where it is not the method's own."""
        return self.label if self.refine == 1.0 else f"{self.label}, refined {self.refine:g} times"

    @property
    def name(self) -> str:
        """The run in words."""
        return f"{self.method}, {self.setting}" if self.setting else self.method

    @property
    def reference(self) -> bool:
        """A method that the varied settings are held against."""
        return self.mark is not None

    def measure(self, name: str) -> float:
        """A number that this run must have. Raises ``ValueError`` naming run and number where it has none."""
        value = self.measures.get(name)
        if value is None:
            raise ValueError(f"{self.label or 'run'}: no {MEASURES.get(name, name)} was measured")
        return value

    @property
    def lift(self) -> float:
        """Largest gap inside nine tenths of the contact zone at the end, m."""
        return self.measure("lift") * self.impact.velocity * float(self.time[-1])

    @cached_property
    def exact(self) -> Exact:
        return Exact(self.impact)

    def reaction(self, windows: int = 200) -> tuple[Array, Array]:
        """Mean reaction of one side (N) in windows even in √t, and the time (s) at which 1/√t has its mean in each."""
        first = max(float(self.time[0]), 0.0)
        root = np.linspace(np.sqrt(first), np.sqrt(self.time[-1]), windows + 1)
        edges = root**2
        gathered = np.interp(edges, self.time, self.side_impulse)
        return (0.5 * (root[1:] + root[:-1])) ** 2, np.diff(gathered) / np.diff(edges)

    def row(self) -> dict[str, Any]:
        """JSON-ready: label, path of a reference, value, measures, failure."""
        return {
            "label": self.label,
            "setting": self.setting or None,
            "refine": self.refine,
            "reference": self.mark,
            "value": self.value,
            **self.measures,
            "failure": self.failure,
            "refused": self.refused,
        }


def failed(label: str, impact: Impact, value: float | None, reason: str, **about: Any) -> Outcome:
    """A run that could not finish. ``about`` : further fields."""
    none = np.zeros(0)
    return Outcome(label, impact, value, *(none,) * 7, dict.fromkeys(MEASURES), failure=reason, **about)


def outcome_of(
    history: ImpactHistory, label: str, *, value: float | None = None, mark: str | None = None, **about: Any
) -> Outcome:
    """Curves and numbers of a history. The contact length of the varied settings is read as the thesis does
    (:func:`touching`), that of a reference (``mark``) from the centroid of the reaction. ``about`` : further fields.
    """
    exact = Exact(history.impact)
    moving = "position" in history
    half = history.positions(-1) >= 0.0
    strain = history.array("strain_energy")
    energy = history.array("kinetic_energy") + strain - history.energy("work_of_loads")
    if moving:  # energies of the fast part alone: what the wall has put in is what the free motion has lost
        energy = energy + history.array("loss_absorbed")
    else:
        energy = energy - energy[0]
    found = moments(history)
    return Outcome(
        label=label,
        impact=history.impact,
        value=value,
        time=history.time,
        front=touching(history) if mark is None else found.front * history.impact.length_scale,
        side_impulse=history.array("total_impulse") / 2.0,
        strain=strain,
        energy=energy,
        x=history.positions(-1)[half],
        gap=history.array("gap", -1)[half],
        measures={
            **_errors(found, exact, history),
            **_energy(history, exact, moving),
            "steps": float(history.steps),
            "nodes": float(history.positions(-1).size),
            "mean_iterations": history.settings.get("mean_iterations"),
            "most_iterations": history.settings.get("most_iterations"),
            "seconds": history.seconds,
        },
        mark=mark,
        warnings=tuple(history.warnings),
        **about,
    )


def touching(history: ImpactHistory) -> Array:
    """The thesis's reading of λ_c (3.3.5), m: coming from the end, the first node that touches or is a minimum of
    the gap.
    """
    gap = history.array("gap")
    x = np.abs(history.positions(0))
    half = history.positions(0) >= 0.0
    gap, x = gap[:, half], x[half]
    outer = np.pad(gap, ((0, 0), (1, 1)), constant_values=np.inf)
    lowest = (gap < outer[:, 2:]) & (gap <= outer[:, :-2]) & (x < 0.5 * x[-1])
    small = TOUCH * history.impact.velocity * float(history.time[-1])
    reached = np.where((gap <= small) | lowest, x[None, :], 0.0).max(axis=1)
    return np.asarray(np.where(history.time > 0.0, reached, 0.0))


def _errors(found: Any, exact: Exact, history: ImpactHistory) -> dict[str, float | None]:
    end, impact, p = float(history.time[-1]), history.impact, exact.parameters
    total = float(history.array("total_impulse")[-1])
    length = reaction = None
    if exact.leading:
        try:
            fitted = leading_order(found)
        except ValueError:
            fitted = None
        if fitted is not None:
            reaction = 100.0 * (fitted.r0.value / p.r0 - 1.0)
            length = 100.0 * (fitted.lambda0.value / p.lambda0 - 1.0) if p.lambda0 > 0.0 else None
    else:
        reaction = 100.0 * (total / float(exact.impulse(end)) - 1.0)
        front = float(found.front[-1]) * impact.length_scale
        length = 100.0 * (front / float(exact.front(end)) - 1.0) if p.lambda0 > 0.0 else None
    return {
        "contact_length_error": length,
        "reaction_error": reaction,
        "lift": float(found.lift[-1]),
        "noise": 100.0 * _noise(history, exact),
    }


def _noise(history: ImpactHistory, exact: Exact) -> float:
    """Scatter of the windows' impulses over the second half of the run, relative to theory's, its mean error taken
    out.
    """
    end = float(history.time[-1])
    edges = np.linspace(0.5 * end, end, WINDOWS + 1)
    gathered = np.interp(edges, history.time, history.array("total_impulse"))
    ratio = np.diff(gathered) / np.diff(exact.impulse(edges))
    return float(np.std(ratio))


def _energy(history: ImpactHistory, exact: Exact, moving: bool) -> dict[str, float | None]:
    end = float(history.time[-1])
    whole = float(exact.fast_energy(end))
    if not exact.leading or not math.isfinite(whole) or whole <= 0.0:
        return {"lost_impact": None, "lost_damping": None, "strain": None}

    def lost(*names: str) -> float | None:
        found = [float(history.array(name)[-1]) for name in names if name in history]
        return 100.0 * sum(found) / whole if found else None

    strain = history.array("strain_energy")
    return {
        "lost_impact": lost("loss_impact"),
        # a moving mesh's viscosity is its absorber: what it takes has left the zone
        "lost_damping": lost("loss_algorithmic") if moving else lost("loss_algorithmic", "loss_viscous"),
        "strain": None if moving else float(strain[-1] - strain[0]) / float(exact.strain_energy(end)),
    }
