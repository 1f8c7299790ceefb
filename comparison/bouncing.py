"""The whole impact of one beam: e, impulse, times, moment, stress, energies, with bars; without damping, bands.

Damping has three states. Stated: numbers. Stated 0, or little hysteretic loss: the motion does not converge
(docs/whole_impact.md); an ensemble of runs, meshes, steps and contact laws drawn from a seed, gives mean and standard
deviation. Not stated: numbers at each of :data:`DAMPING_RATIOS`, and the answer is that of the largest moment.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from typing import Any

from bent_beam.checks import finite
from bent_beam.errors import InputError
from bent_beam.free_flight import LOWEST_PERIOD
from bent_beam.history import ImpactHistory
from bent_beam.hysteresis import converges
from bent_beam.impact import Impact
from bent_beam.measure.balance import Balance, balance_of
from bent_beam.measure.numbers import Band, Number
from bent_beam.measure.whole_impact import WholeImpact, whole_impact
from bent_beam.method import Method, for_whole_beam, separation_times, settings_of
from bent_beam.section import Section
from comparison.answers import Runs, bands_of, numbers_of, runs_of
from comparison.doubts import doubts
from comparison.energies import energy_at_end, loss_warnings, numerical_loss
from comparison.questions import Question
from comparison.store import RunStore

__all__ = ["DAMPING_RATIOS", "NUMBERS", "SI", "Bounce", "bounce", "over_damping", "problem", "scales"]

NUMBERS = (
    "restitution",
    "impulse",
    "last_contact",
    "separations",
    "peak_moment",
    "peak_moment_place",
    "peak_moment_time",
    "midspan_moment",
    "push",
    "translation",
    "vibration",
    "dissipated",
)
"""Fields of :class:`bent_beam.measure.whole_impact.WholeImpact` that get bars."""
SI = {
    "impulse": ("impulse", "N s"),
    "last_contact": ("time", "s"),
    "peak_moment": ("moment", "N m"),
    "peak_moment_place": ("length", "m"),
    "peak_moment_time": ("time", "s"),
    "midspan_moment": ("moment", "N m"),
    "peak_force": ("force", "N"),
    "push": ("impulse", "N s"),
    "translation": ("energy", "J"),
    "vibration": ("energy", "J"),
    "dissipated": ("energy", "J"),
}
"""Of a number that has one: what it is scaled by (:func:`scales`), and its unit."""
FINAL = ("restitution", "last_contact", "translation", "vibration", "dissipated")  # only once the beam has left
TIMES = ("last_contact", "peak_moment_time")
RUNS = 24  # of a band
SEED = 15
DAMPING_RATIOS = (0.0002, 0.002, 0.02)  # of the first mode: bare steel, a bar as it is held, with joints
LARGEST_KAPPA = 100.0  # beyond, and long before, the beam touches in one point: infinity is calculated as this


@dataclass(frozen=True)
class Bounce:
    """A whole impact: ``numbers`` by name (:data:`NUMBERS`), dimensionless; bands where the beam has no damping.

    impact : of the run that the numbers come from. runs : that and its companions. settings : of its method.
    seed : of the ensemble. section : what stresses follow from (``None``: none are given).
    over : the whole impact at other damping ratios, where none was stated, by ratio.
    """

    impact: Impact
    numbers: Mapping[str, Number | Band]
    runs: Runs
    settings: dict[str, Any]
    seed: int | None = None
    section: Section | None = None
    over: Mapping[float, Bounce] | None = None

    @cached_property
    def outcome(self) -> WholeImpact:
        """What the run itself came to."""
        return _outcome(self.runs.run.reading)

    @property
    def left(self) -> bool:
        """Whether the beam is off the wall for good in every run that a number or its bar comes from."""
        return all(run.reading["left"] for run in self.runs.every)

    @property
    def seconds(self) -> float:
        """Of all runs together."""
        return self.runs.seconds

    @cached_property
    def history(self) -> ImpactHistory:
        """Of the run itself; simulated again where only its numbers were kept."""
        if self.runs.history is not None:
            return self.runs.history
        return self.runs.question.run(self.runs.question.run_by)

    @property
    def units(self) -> dict[str, float]:
        """SI units of the numbers (:func:`scales`); shares of energy are of what the loads have worked, too."""
        return scales(self.impact) | {"energy": self.outcome.supplied}

    @property
    def in_si(self) -> dict[str, Number | Band]:
        """The numbers in SI units (:data:`SI`); where the section is known, its largest stress, Pa, too."""
        unit = self.units
        found = {name: n.scaled(unit[SI[name][0]]) if name in SI else n for name, n in self.numbers.items()}
        stress = self.peak_stress
        return found if stress is None else found | {"peak_stress": stress}

    @property
    def peak_stress(self) -> Number | Band | None:
        """Largest normal stress, Pa, |M|/W + |N|/A at the place and time of the largest moment; ``None`` without a
        section."""
        return stress_of(self.numbers["peak_moment"].scaled(scales(self.impact)["moment"]), self.impact, self.section)

    @property
    def span(self) -> tuple[float, float]:
        """What the largest moment, stress and force are the largest of, s: from the first touch to one period of the
        lowest mode after the last contact."""
        return 0.0, self.outcome.until * self.impact.slow_time_scale

    @property
    def balance(self) -> Balance:
        """Momentum, energy and contact of the run itself, read from its state."""
        return Balance(**self.runs.run.reading["balance"])

    @property
    def energy(self) -> dict[str, float | None]:
        """Energies of the run at its end, J."""
        return dict(self.runs.run.reading["energy"])

    @property
    def warnings(self) -> list[str]:
        """What a reader must know of the numbers."""
        found = [*self.runs.lost, *doubts(self.impact, self.section)]
        if self.over is not None:
            ratios = ", ".join(f"{100.0 * ratio:g}" for ratio in self.over)
            found.append(
                f"no damping is stated: the numbers are those of the largest stress among {ratios} % of the first "
                "mode; state [beam] damping_ratio"
            )
        if self.seed is not None:
            loss = self.impact.hysteretic_loss
            own = f"a hysteretic loss of {loss:g} and no other damping" if loss else "no damping"
            found.append(
                f"the beam has {own} of its own: the outcome is irregular and does not converge, so a band is "
                "given; state [beam] damping (or --damping) for numbers"
            )
        if not self.left:
            pressed = self.impact.net_load > 0.0
            why = "the loads keep the beam on the wall" if pressed else "a run ended with the beam at the wall"
            short = f"flights shorter than {1e3 * LOWEST_PERIOD * self.units['time']:.3g} ms are part of a hit"
            hint = f" ({short}; for that of the impact alone give impact.velocity and no gravity)" if pressed else ""
            found.append(f"{why}: it has not left the wall for good, so no restitution is given{hint}")
        elif self.impact.net_load > 0.0:
            found.append(
                "the loads bring the beam back to the wall; these numbers are those of the first hit, later ones may "
                "be larger (--hits follows more)"
            )
        told = [*self.runs.run.warnings, *loss_warnings(numerical_loss(self.energy)), *self.balance.warnings]
        return [*found, *told]


def problem(kappa_over_nu: float, damping: float) -> Impact:
    """The beam in units of its half length; κ/ν = ∞ is calculated as a point contact."""
    kappa = kappa_over_nu if kappa_over_nu == math.inf else finite("kappa_over_nu", kappa_over_nu)
    return Impact.whole_beam(min(kappa, LARGEST_KAPPA), relative_damping=damping)


def whole_reading(history: ImpactHistory) -> dict[str, Any]:
    """A whole impact as it is kept: :class:`WholeImpact`, balance and energies, JSON-ready."""
    found = asdict(whole_impact(history)) | {"balance": asdict(balance_of(history)), "energy": energy_at_end(history)}
    return found | {"loss": history.settings.get("hysteretic_loss")}


def _outcome(reading: Mapping[str, Any]) -> WholeImpact:
    names = WholeImpact.__dataclass_fields__
    contacts = tuple((float(begin), float(end)) for begin, end in reading["contacts"])
    return WholeImpact(**{name: reading[name] for name in names if name != "contacts"}, contacts=contacts)


def bounce(
    impact: Impact,
    method: Method,
    *,
    section: Section | None = None,
    damping_stated: bool = True,
    runs: int = RUNS,
    seed: int = SEED,
    save: int | None = None,
    store: RunStore | None = None,
    history: bool = False,
    jobs: int = 1,
    progress: Callable[[float], None] | None = None,
) -> Bounce:
    """Follow ``impact`` to its last separation by ``method``, and by what it names to compare with.

    section : of the beam, for its stress. damping_stated : otherwise over :data:`DAMPING_RATIOS`.
    runs, seed : of the ensemble, where the beam has no damping. save : saved instants a T*.
    store : where runs are kept. history : also keep that of the run itself.
    Raises ``ValueError`` for what the method refuses, :class:`bent_beam.SimulationError` when it cannot finish.
    """
    separation_times(impact)  # refuses what no separation ends
    if not hasattr(method, "for_whole_beam"):
        raise InputError(
            f"path: {method.path} lacks for_whole_beam(impact), which chooses for a whole beam what it leaves open "
            "(nothing open: return self; docs/guide/add-method.md)"
        )
    if not damping_stated and not (impact.damping or impact.hysteretic_loss):
        how: dict[str, Any] = {"section": section, "save": save, "store": store, "history": history, "jobs": jobs}
        return _over_ratios(impact, method, progress or (lambda _: None), how)
    question = Question(impact, method, save=save)
    ensemble = None if converges(impact) else question.drawn(runs, seed)
    kept: dict[str, Any] = {"store": store, "whole_history": history, "jobs": jobs, "progress": progress}
    made = runs_of(question, whole_reading, ensemble=ensemble, **kept)
    return Bounce(
        impact=impact,
        numbers=whole_numbers(made, ensemble is not None),
        runs=made,
        settings=settings_of(question.run_by if ensemble is None else for_whole_beam(ensemble[0], impact)),
        seed=None if ensemble is None else seed,
        section=section,
    )


def _over_ratios(impact: Impact, method: Method, told: Callable[[float], None], how: dict[str, Any]) -> Bounce:
    """Of the damping ratio with the largest moment, next to the others."""
    found, share = dict[float, Bounce](), 1.0 / len(DAMPING_RATIOS)
    for i, ratio in enumerate(DAMPING_RATIOS):
        damped = impact.replace(damping=ratio * LOWEST_PERIOD / math.pi * impact.slow_time_scale)
        found[ratio] = bounce(damped, method, **how, progress=lambda done, i=i: told(share * (i + done)))  # type: ignore[misc]
    return replace(max(found.values(), key=lambda one: one.numbers["peak_moment"].value or 0.0), over=found)


def whole_numbers(made: Runs, scattered: bool = False) -> dict[str, Number | Band]:
    """Every number of a whole impact, bands where it is ``scattered``; those of its end only where the beam left."""
    reading = made.run.reading
    names = NUMBERS if reading["peak_force"] is None else (*NUMBERS, "peak_force")
    known = {name: {"saved_instants": 0.5 * reading["spacing"]} for name in TIMES}
    known["restitution"] = {"saved_instants": reading["drift"]}
    found = dict(bands_of(made, names) if scattered else numbers_of(made, names, known))
    if not all(run.reading["left"] for run in made.every):
        found |= {name: Number() for name in FINAL}
    return found


def over_damping(found: Bounce) -> list[dict[str, Any]] | None:
    """The whole impact at each damping ratio where none was stated, SI, JSON-ready; ``None`` where one was."""
    if found.over is None:
        return None
    names = ("restitution", "peak_moment", "peak_stress", "peak_force")
    return [{"damping_ratio": ratio, **documents(one.in_si, names)} for ratio, one in found.over.items()]


def documents(numbers: Mapping[str, Number | Band], names: Iterable[str]) -> dict[str, Any]:
    """Of the named ``numbers``, JSON-ready; ``None`` for those that there are none of."""
    return {name: numbers[name].to_dict() if name in numbers else None for name in names}


def scales(impact: Impact) -> dict[str, float]:
    """SI units of the dimensionless numbers: N s, s, N m, J, m, N."""
    impulse = impact.mass_per_length * impact.half_length * impact.velocity
    return {
        "impulse": impulse,
        "time": impact.slow_time_scale,
        "moment": impact.velocity * math.sqrt(impact.bending_stiffness * impact.mass_per_length),
        "energy": impulse * impact.velocity,
        "length": impact.half_length,
        "force": impulse / impact.slow_time_scale,
    }


def stress_of(moment: Number | Band, impact: Impact, section: Section | None) -> Any:
    """Largest normal stress, Pa, of a largest ``moment``, N m; ``None`` without a section."""
    if section is None:
        return None
    return moment.scaled(1.0 / section.section_modulus, section.stress(0.0, impact.axial_force), "Pa")
