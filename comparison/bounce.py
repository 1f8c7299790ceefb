"""The whole impact of one beam with error bars: e, impulse, times, moments, energy; without damping, a band.

Each number comes from one run; its error bar is the sum of what it moves by when elements, steps and the contact law
change (``cross_checks`` of the method), and half a saved interval where it is a time. The sum, not the root of squares:
all schemes come from the same side, and halving elements moves e by little more than what is left.
Without damping of the beam itself, or with little hysteretic loss, the numbers do not converge (docs/whole_impact.md):
an ensemble of runs, meshes, steps and contact laws drawn at random from a seed, gives mean and standard deviation
instead.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from bent_beam.checks import finite
from bent_beam.free_flight import LOWEST_PERIOD
from bent_beam.history import ImpactHistory
from bent_beam.hysteresis import converges
from bent_beam.impact import Impact
from bent_beam.measure.balance import Balance, balance_of
from bent_beam.measure.measured import Band, Measured
from bent_beam.measure.whole_impact import Hit, WholeImpact, hits, whole_impact
from bent_beam.method import Method, for_whole_beam, refined, settings_of, simulate_to_separation
from bent_beam.section import Section
from comparison.workers import run_all

__all__ = ["NUMBERS", "Bounce", "Number", "bounce", "follow_hits", "problem", "scales"]

Number = Measured | Band
NUMBERS = (
    "restitution",
    "impulse",
    "last_contact",
    "separations",
    "peak_moment",
    "peak_moment_place",
    "peak_moment_time",
    "midspan_moment",
    "translation",
    "vibration",
    "dissipated",
)
"""Fields of :class:`bent_beam.measure.whole_impact.WholeImpact` that get error bars."""
RUNS = 24  # of a band
SEED = 15
LARGEST_KAPPA = 100.0  # beyond, and long before, the beam touches in one point: infinity is calculated as this
LONGEST = 100.0  # T*: the longest run that follows hits
INSTANTS = 200  # saved a T* of it
TIMES = ("last_contact", "peak_moment_time")


@dataclass(frozen=True)
class Bounce:
    """A whole impact: ``numbers`` by name (:data:`NUMBERS`), dimensionless; bands where the beam has no damping.

    parts : of each error bar, by cause.
    history : of the run that the values come from (one of the ensemble, for a band); outcome : what it came to.
    left : whether the beam is off the wall for good in every run that a number or its error bar comes from.
    settings : of that run's method; seconds : of all runs together; seed : of the ensemble.
    section : what stresses follow from (``None``: none are given).
    """

    impact: Impact
    numbers: Mapping[str, Number]
    parts: Mapping[str, Mapping[str, float]]
    history: ImpactHistory
    outcome: WholeImpact
    left: bool
    settings: dict[str, Any]
    seconds: float
    seed: int | None = None
    section: Section | None = None

    @property
    def units(self) -> dict[str, float]:
        """SI units of the numbers (:func:`scales`); shares of energy are of what the loads have worked, too."""
        return scales(self.impact) | {"energy": self.outcome.supplied}

    @property
    def peak_stress(self) -> Number | None:
        """Largest normal stress, Pa; ``None`` without a section."""
        return largest_stress(self.numbers["peak_moment"], self.impact, self.section)

    @cached_property
    def balance(self) -> Balance:
        """Momentum, energy and contact of that run, read from its state."""
        return balance_of(self.history)

    @property
    def warnings(self) -> list[str]:
        """What a reader must know of the numbers."""
        found = []
        if self.seed is not None:
            loss = self.impact.hysteretic_loss
            own = f"a hysteretic loss of {loss:g} and no other damping" if loss else "no damping"
            found.append(
                f"the beam has {own} of its own: the outcome is irregular and does not converge, so a band is "
                "given; state [beam] damping (or --damping) for numbers"
            )
        if not self.left:
            found.append("the beam had not left the wall for good when a run ended: the numbers are not final")
        elif self.impact.net_load > 0.0:
            found.append(
                "the loads bring the beam back to the wall; these numbers are those of the first hit (--hits follows "
                "more)"
            )
        return [*found, *self.balance.warnings]


def problem(kappa_over_nu: float, damping: float) -> Impact:
    """The beam in units of its half length; κ/ν = ∞ is calculated as a point contact."""
    kappa = kappa_over_nu if kappa_over_nu == math.inf else finite("kappa_over_nu", kappa_over_nu)
    return Impact.whole_beam(min(kappa, LARGEST_KAPPA), relative_damping=damping)


def _outcome(method: Method, impact: Impact, save: int) -> tuple[WholeImpact, float]:
    history = simulate_to_separation(method, impact, save=save)
    return whole_impact(history), history.seconds


def bounce(
    impact: Impact,
    method: Method,
    *,
    section: Section | None = None,
    runs: int = RUNS,
    seed: int = SEED,
    save: int = 2000,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> Bounce:
    """Follow ``impact`` to its last separation by ``method``, and by what it names to compare with.

    section : of the beam, for its stress. runs, seed : of the ensemble, where the beam has no damping.
    save : saved instants a T*.
    Raises ``ValueError`` for what the method refuses, :class:`bent_beam.SimulationError` when it cannot finish.
    """
    reason = method.refuses(impact)
    if reason is not None:
        raise ValueError(reason)
    random = np.random.default_rng(seed)
    checks = _cross_checks(method, impact) if converges(impact) else {}
    methods = (
        [method, *checks.values()] if converges(impact) else [_varied(method, impact, random) for _ in range(runs)]
    )

    def told(done: int) -> None:
        if progress is not None:
            progress(done, len(methods))

    told(0)
    history = simulate_to_separation(methods[0], impact, save=save)
    told(1)
    others = [(other, impact, save) for other in methods[1:]]
    found = run_all(_outcome, others, jobs=jobs, progress=lambda done, _: told(1 + done))
    outcomes = [whole_impact(history), *(outcome for outcome, _ in found)]
    numbers: dict[str, Number] = {}
    parts: dict[str, dict[str, float]] = {}
    for name in NUMBERS if outcomes[0].peak_force is None else (*NUMBERS, "peak_force"):
        value, *moved = (float(getattr(outcome, name)) for outcome in outcomes)
        parts[name] = {cause: abs(other - value) for cause, other in zip(checks, moved)}
        if not converges(impact):
            numbers[name] = Band.of([value, *moved])
            continue
        if name in TIMES:
            parts[name]["saved_instants"] = 0.5 * outcomes[0].spacing
        numbers[name] = Measured(value, sum(parts[name].values()) if checks else None)
    return Bounce(
        impact=impact,
        numbers=numbers,
        parts=parts,
        history=history,
        outcome=outcomes[0],
        left=all(outcome.left for outcome in outcomes),
        settings=settings_of(for_whole_beam(methods[0], impact)),
        seconds=history.seconds + sum(seconds for _, seconds in found),
        seed=None if converges(impact) else seed,
        section=section,
    )


def _cross_checks(method: Method, impact: Impact) -> dict[str, Method]:
    own = getattr(method, "cross_checks", None)
    if own is not None:
        return dict(own(impact))
    coarser = refined(for_whole_beam(method, impact), 0.5)
    return {} if coarser is None else {"mesh_and_step": coarser}


def _varied(method: Method, impact: Impact, random: np.random.Generator) -> Method:
    """One of an ensemble; of a path that draws none itself, coarser elements and steps by a random factor."""
    own = getattr(method, "varied", None)
    if own is not None:
        drawn: Method = own(impact, random)
        return drawn
    coarser = refined(for_whole_beam(method, impact), 2.0 ** random.uniform(-1.5, -0.5))
    if coarser is None:
        raise ValueError(
            f"damping: without damping of the beam a whole impact is a band, and {method.path} varies neither elements "
            "nor steps; state a damping"
        )
    return coarser


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


def largest_stress(moment: Number, impact: Impact, section: Section | None) -> Number | None:
    """Largest normal stress, Pa, |M|/W + |N|/A at the place and time of the largest ``moment``, in V₀√(μEI); ``None``
    without a section."""
    if section is None:
        return None
    unit = scales(impact)["moment"] / section.section_modulus
    return moment.scaled(unit, section.stress(0.0, impact.axial_force))


def follow_hits(
    impact: Impact,
    method: Method,
    count: int,
    *,
    first: ImpactHistory,
    progress: Callable[[float], None] | None = None,
) -> list[Hit]:
    """The first ``count`` hits of a beam on its wall by one run, fewer where it does not come back.

    first : the run that a first hit has been read from: the first row is its own.
    Raises ``ValueError`` for what the method refuses, and between two walls.
    """
    if impact.opposite_wall is not None:
        raise ValueError("--hits: follows one wall; between two, bentbeam simulate lists the hits")
    chosen, period = for_whole_beam(method, impact), LOWEST_PERIOD * impact.slow_time_scale
    fall = impact.net_load / impact.mass_per_length  # acceleration back to the wall, m/s²
    end, longest = 2.0 * period, LONGEST * impact.slow_time_scale
    while True:
        save = round(INSTANTS * end / impact.slow_time_scale)
        found = hits(chosen.simulate(impact, end_time=end, save=save, progress=progress))
        over = [hit for hit in found if end - hit.end >= period]
        if len(over) >= count or end >= longest or (over and fall <= 0.0):
            return [*hits(first)[:1], *over[1:count]]
        flight = 2.0 * max(-over[-1].after, 0.0) / fall if over else end
        end = min(end + flight + 2.0 * period, longest)
