"""One run, reduced to curves and to the handful of numbers that distinguish runs.

- contact length: λ₀ fitted to the centroid of the reaction; reaction: r₀ fitted to the impulse
  (:mod:`bent_beam.measure.estimators`); with first-order terms both are compared with theory at the end of the run;
- lift: largest gap inside nine tenths of the contact zone over V₀t ("double detachment", thesis 3.3.5);
- noise: root mean square scatter about theory of the impulse in a fiftieth of half the run;
- energy: losses to impacts and damping over the energy V₀∫R dt of the exact fast layer, which loses none.

The reaction of every step is filtered as in the thesis (3.3.1, 3.3.5):

    R_k = ΔI_k/h of one side, then Matlab's filtfilt with a filter of order 1 and the cut-off 0.04

The cut-off is a share of half the sampling rate, 1/(2h): the filter smooths over a number of steps, 1/(0.04 π) ≈ 8 each
way, and the time is proportional to h. The text gives the order and the cut-off; we take Butterworth's, the usual one.
"""

import math
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from bent_beam import Impact, ImpactHistory
from bent_beam.measure.estimators import leading_order
from bent_beam.measure.moments import moments
from bent_beam_programs.thesis.studies.exact import Array, Exact

WINDOWS = 50
CUT_OFF = 0.04
TOUCH = 1e-6  # of V₀t: smaller gaps are contact (the thesis takes 10⁻⁶ m, too much ahead of a thick front)
MEASURES: dict[str, str] = {  # numbers of an outcome and their headings
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


def saved_times(end: float) -> Array:
    """Instants that show both a reaction (even in t) and a front (even in √t)."""
    return np.unique(np.concatenate([np.linspace(0.0, end, 401), end * np.linspace(0.0, 1.0, 121) ** 2]))


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


def scatter(time: Array, reaction: Array, exact: Array) -> float:
    """Root mean square of reaction over theory less one, in the second half of the run."""
    return float(np.sqrt(np.mean((reaction / exact - 1.0)[time > 0.5 * time[-1]] ** 2)))


@dataclass(frozen=True)
class Outcome:
    """A finished run, or the reason why there is none.

    value : of the varied parameter, if a number.
    time, front, side_impulse, strain, energy : (times,), SI, the energy being that of the whole beam over its first
        value; x, gap : the beam at the end, half of it.
    measures : numbers by the names of ``MEASURES`` and a few more; ``None`` where there is none.
    mark : the path of a reference, whose mark it is drawn with; ``None`` for varied settings, which are lines.
    failure : why a run did not finish; then the arrays are empty. refused : the method had said so before.
    setting, refine : of the varied parameter and of the resolution, where methods are varied; ``label`` is then the
        method's. steps : the reaction of every step, history : of the whole run, where they were asked for.
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
    steps: Steps | None = None
    history: Any = None

    @property
    def method(self) -> str:
        """The label, and the resolution where it is not the method's own."""
        return self.label if self.refine == 1.0 else f"{self.label}, refined {self.refine:g} times"

    @property
    def name(self) -> str:
        return f"{self.method}, {self.setting}" if self.setting else self.method

    @property
    def lift(self) -> float:
        """Largest gap inside nine tenths of the contact zone at the end, m. Raises ``ValueError`` without a number."""
        share = self.measures.get("lift")
        if share is None:
            raise ValueError(f"{self.label or 'run'}: no {MEASURES['lift']} was measured")
        return share * self.impact.velocity * float(self.time[-1])

    @cached_property
    def exact(self) -> Exact:
        return Exact(self.impact)

    def reaction(self, windows: int = 200) -> tuple[Array, Array]:
        """Mean reaction of one side (N) in windows even in √t, and the time (s) at which 1/√t has its mean in each."""
        root = np.linspace(np.sqrt(max(float(self.time[0]), 0.0)), np.sqrt(self.time[-1]), windows + 1)
        gathered = np.interp(root**2, self.time, self.side_impulse)
        return (0.5 * (root[1:] + root[:-1])) ** 2, np.diff(gathered) / np.diff(root**2)

    def row(self) -> dict[str, Any]:
        about = {"label": self.label, "setting": self.setting or None, "refine": self.refine, "reference": self.mark}
        return {**about, "value": self.value, **self.measures, "failure": self.failure, "refused": self.refused}


def outcome_of(
    history: ImpactHistory, label: str, *, value: float | None = None, mark: str | None = None, **about: Any
) -> Outcome:
    """Curves and numbers of a history. The contact length of the varied settings is read as the thesis does
    (:func:`touching`), that of a reference (``mark``) from the centroid of the reaction. ``about`` : further fields."""
    exact, found = Exact(history.impact), moments(history)
    moving = "position" in history
    half = history.positions(-1) >= 0.0
    strain = history.array("strain_energy")
    energy = history.array("kinetic_energy") + strain - history.energy("work_of_loads")
    # a moving mesh has the energies of the fast part alone, which gains at the wall the loss of the free motion
    energy = energy + history.array("loss_absorbed") if moving else energy - energy[0]
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
            **_losses(history, exact, moving),
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
    """λ_c as the thesis reads it (3.3.5), m: coming from the end, the first node that touches or has a minimal gap."""
    half = history.positions(0) >= 0.0
    gap, x = history.array("gap")[:, half], np.abs(history.positions(0))[half]
    outer = np.pad(gap, ((0, 0), (1, 1)), constant_values=np.inf)
    lowest = (gap < outer[:, 2:]) & (gap <= outer[:, :-2]) & (x < 0.5 * x[-1])
    small = TOUCH * history.impact.velocity * float(history.time[-1])
    reached = np.where((gap <= small) | lowest, x[None, :], 0.0).max(axis=1)
    return np.asarray(np.where(history.time > 0.0, reached, 0.0))


def _errors(found: Any, exact: Exact, history: ImpactHistory) -> dict[str, float | None]:
    """Errors of λ₀ and r₀ in per cent, lift and noise."""
    end, p, total = float(history.time[-1]), exact.parameters, history.array("total_impulse")
    length = reaction = None
    if not exact.leading:
        reaction = 100.0 * (float(total[-1]) / float(exact.impulse(end)) - 1.0)
        length = float(found.front[-1]) * history.impact.length_scale / (float(exact.front(end)) or np.nan)
    else:
        with suppress(ValueError):  # too little to fit
            fitted = leading_order(found)
            reaction = 100.0 * (fitted.r0.value / p.r0 - 1.0)
            length = fitted.lambda0.known / (float(p.lambda0) or np.nan)
    edges = np.linspace(0.5 * end, end, WINDOWS + 1)
    gathered = np.diff(np.interp(edges, history.time, total))
    return {
        "contact_length_error": None if length is None or p.lambda0 <= 0.0 else 100.0 * (length - 1.0),
        "reaction_error": reaction,
        "lift": float(found.lift[-1]),
        "noise": 100.0 * float(np.std(gathered / np.diff(exact.impulse(edges)))),
    }


def _losses(history: ImpactHistory, exact: Exact, moving: bool) -> dict[str, float | None]:
    """Losses to impacts and damping in per cent of the fast layer's energy, and strain energy over theory's; the
    energy residual over the largest loss."""
    end = float(history.time[-1])
    budget = history.energy_budget()
    largest = max((abs(v) for k, v in budget.items() if k.startswith("loss_")), default=0.0)
    found: dict[str, float | None] = dict.fromkeys(("lost_impact", "lost_damping", "strain"))
    found["defect"] = abs(budget["defect"]) / largest if largest > 0.0 else None
    whole = float(exact.fast_energy(end))
    if not exact.leading or not math.isfinite(whole) or whole <= 0.0:
        return found

    # a moving mesh's viscosity is its absorber: that energy has left the zone
    damping = ("loss_algorithmic",) if moving else ("loss_algorithmic", "loss_viscous")
    for name, losses in (("lost_impact", ("loss_impact",)), ("lost_damping", damping)):
        taken = [float(history.array(loss)[-1]) for loss in losses if loss in history]
        found[name] = 100.0 * sum(taken) / whole if taken else None
    strain = history.array("strain_energy")
    return found | {"strain": None if moving else float(strain[-1] - strain[0]) / float(exact.strain_energy(end))}
