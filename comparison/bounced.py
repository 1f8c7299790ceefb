"""The answer of ``bentbeam bounce``: a whole impact found by :mod:`comparison.bouncing`, its numbers in SI, what a
reader must know of them, document, text and picture."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from bent_beam import Case, Impact, ImpactHistory
from bent_beam.free_flight import LOWEST_PERIOD, bears_free_flight
from bent_beam.measure.balance import Balance
from bent_beam.measure.numbers import MISSING, Band, Number
from bent_beam.measure.whole_impact import SHORTEST_SEPARATION, WINDOW, WholeImpact, peak_times
from bent_beam.method import LONGEST_OF_WALL, ON_WALL, settings_of, time_on_wall
from bent_beam.versions import versions
from comparison.doubts import doubts, energy_residual, numerical_loss, told_by
from comparison.readable import folder, milliseconds, write_answer
from comparison.runs import Runs
from comparison.texts import bounce_text
from comparison.whole_numbers import MAY_RISE, WHOLE

__all__ = ["OF_WHOLE", "Bounce", "documents", "scales", "with_stress"]

OF_WHOLE = ("restitution", "peak_moment", "peak_stress", "peak_force")
"""Numbers of the whole impact that other answers include."""
LYING = 5.0  # times the largest push or moment: the end for a beam that does not leave
MARGIN = 1.15  # times the last contact, or the largest value: the end of the axes


@dataclass(frozen=True)
class Bounce:
    """A whole impact: ``numbers`` by name (:data:`comparison.whole_numbers.WHOLE`), dimensionless; bands
    where the beam has no damping.

    case : of the run that the numbers come from. runs : that and its companions. over : where no damping was
    stated, the whole impact at each damping ratio, this one's too, by ratio.
    """

    case: Case
    numbers: Mapping[str, Number | Band]
    runs: Runs
    over: Mapping[float, "Bounce"] | None = None

    @property
    def impact(self) -> Impact:
        """Of the run that the numbers come from."""
        return self.case.impact

    @property
    def over_damping(self) -> list[dict[str, Any]] | None:
        """The whole impact at each damping ratio where none was stated, SI, JSON-ready; ``None`` where one was."""
        if self.over is None:
            return None
        return [{"damping_ratio": ratio, **documents(one.in_si, OF_WHOLE)} for ratio, one in self.over.items()]

    @cached_property
    def outcome(self) -> WholeImpact:
        """What the run itself came to."""
        reading = self.runs.run.reading
        pairs = {name: tuple((float(a), float(b)) for a, b in reading[name]) for name in ("contacts", "returns")}
        return WholeImpact(**{name: reading[name] for name in WholeImpact.__dataclass_fields__} | pairs)

    @property
    def left(self) -> bool:
        """Whether the first hit is over in every run that a number or its bar comes from."""
        return all(run.reading["left"] or run.reading["again"] for run in self.runs.every)

    @property
    def seconds(self) -> float:
        """Of all runs together, at any damping ratio."""
        return sum(one.runs.seconds for one in (self.over or {0.0: self}).values())

    @property
    def settings(self) -> dict[str, Any]:
        """Of the method of the run."""
        return settings_of(self.runs.question.run_by)

    @property
    def kept(self) -> bool:
        """Whether nothing had to be simulated, at any damping ratio."""
        return all(one.runs.kept for one in (self.over or {0.0: self}).values())

    @cached_property
    def history(self) -> ImpactHistory:
        """Of the run itself; simulated again where a store keeps its reading alone."""
        return self.runs.history or self.runs.question.run(self.runs.question.run_by)

    @property
    def units(self) -> dict[str, float]:
        """SI units of the numbers (:func:`scales`); of an energy the initial one and the work of the loads, J."""
        return scales(self.impact) | {"energy": self.outcome.supplied}

    @property
    def in_si(self) -> dict[str, Number | Band]:
        """The numbers in SI units, and the largest stress (:func:`with_stress`)."""
        unit = {"": 1.0, **self.units}
        about = ((name, number, WHOLE[name]) for name, number in self.numbers.items())
        found = {name: number.scaled(unit[one.scale], name=one.unit) for name, number, one in about}
        # shares become J by the energy supplied until the last contact: as loads work on, the bar of its time adds to J
        late = abs(self.outcome.supplied_rate) * (self.numbers["last_contact"].bar or 0.0)
        for name, n in found.items():
            if late and WHOLE[name].scale == "energy" and n.bar is not None:
                parts = {**n.parts, "work_of_loads": late * abs(n.known)}
                found[name] = replace(n, bar=n.bar + parts["work_of_loads"], parts=parts)
        return with_stress(found, self.case)

    @property
    def span(self) -> tuple[float, float]:
        """What the largest moment, stress and force are the largest of, s: from the first touch to one period of the
        lowest mode after the last contact."""
        return 0.0, self.outcome.until * self.impact.slow_time_scale

    @property
    def hardest(self) -> dict[str, Any]:
        """When and where the wall pushes hardest (:func:`peak_times`); of a largest force that is missing, nothing."""
        found = peak_times(self.outcome, self.impact)
        none = {"peak_force_time": None, "peak_force_place": None}
        return found | (none if self.numbers.get("peak_force") == MISSING else {})

    @property
    def balance(self) -> Balance:
        """Momentum, energy and contact of the run itself, read from its state."""
        return self.runs.balance

    @property
    def warnings(self) -> list[str]:
        """What a reader must know of the numbers."""
        found, others = doubts(self.impact, self.case.section), list[str]()
        if self.over is not None:
            for ratio, one in self.over.items():
                others += [f"{100.0 * ratio:g} %: {line}" for line in one.runs.warnings if one.runs is not self.runs]
            ratios = ", ".join(f"{100.0 * ratio:g}" for ratio in self.over)
            found.append(
                f"no damping is stated: the numbers are those of the largest stress among {ratios} % of the first "
                "mode; state [beam] damping_ratio"
            )
        if self.runs.question.band is not None:
            loss = self.impact.hysteretic_loss
            own = f"a hysteretic loss of {loss:g} and no other damping" if loss else "no damping"
            found.append(
                f"the beam has {own} of its own: the outcome is irregular and does not converge, so a band is "
                "given; state a damping for numbers"
            )
        rising = [WHOLE[name].title for name in MAY_RISE if self.numbers.get(name) == MISSING]
        if rising:
            found.append(f"no {' and no '.join(rising)}: it still rises when the run ends")
        turns = self.impact.supported or self.impact.wall_in_part or self.impact.off_centre
        turns = turns or bears_free_flight(self.impact)
        pressed, stays = self.impact.net_load > 0.0, "it has not left the wall for good, so no restitution is given"
        thrown = ON_WALL * time_on_wall(self.impact) < LONGEST_OF_WALL * self.units["time"]  # if no load holds it
        if not self.left and pressed and thrown:
            found.append(
                f"the loads keep the beam on the wall: {stays} (flights shorter than "
                f"{1e3 * LOWEST_PERIOD * self.units['time']:.3g} ms are part of a hit; for that of the impact alone "
                "leave out loads that press, and give impact.velocity in place of a drop_height)"
            )
        elif not self.left:
            found.append(f"a run ended with the beam at the wall: {stays}")
        elif self.outcome.again:
            found.append(
                "the beam comes back to the wall: restitution and last contact are of the first hit, and so are "
                f"impulse and energies of bounce; largest values are of all hits until {milliseconds(self.span[1])}; "
                "bentbeam bounce --hits 3 lists them"
            )
        elif pressed or (self.outcome.may_return and turns):
            back = "the beam may come back"
            if pressed or (self.impact.supported and self.outcome.may_return):
                back = "the loads bring the beam back"
            found.append(
                f"{back} to the wall; these numbers are those of the first hit, later ones may be larger: "
                "bentbeam bounce --hits 3 lists them"
            )
        last, method = self.numbers["last_contact"], self.runs.question.method
        if last.value is not None and (last.bar or 0.0) > last.value:
            found.append(
                "it is not sure whether the beam touches the wall once more: the last contact may be much earlier or "
                "later, and the rebound may change by more than its bar; ask once more with "
                f"--set {method.path}.refine={2.0 * getattr(method, 'refine', 1.0):g}"
            )
        return [*found, *told_by(self.in_si, self.case.section), *self.runs.warnings, *others]

    def to_dict(self) -> dict[str, Any]:
        """The contract of ``bentbeam bounce --json``."""
        in_si, reading, balance, band = self.in_si, self.runs.run.reading, self.balance, self.runs.question.band
        stress, section, residual = in_si.get("peak_stress"), self.case.section, energy_residual(reading["energy"])
        with_unit = {name: n.to_dict() | {"unit": WHOLE[name].unit} for name, n in in_si.items() if WHOLE[name].scale}
        energies = {name: n.to_dict() for name, n in self.numbers.items() if WHOLE[name].scale == "energy"}
        return {
            "model": self.impact.model,
            "velocity": self.impact.velocity,
            "clearance": self.impact.wall_clearance,
            "kappa_over_nu": self.impact.kappa_over_nu,
            "damping": self.impact.relative_damping,
            "hysteretic_loss": reading["loss"],
            **{name: number.to_dict() for name, number in self.numbers.items() if name not in energies},
            "energy": energies,
            "si": with_unit | {"time_unit": self.units["time"]},
            "peak_stress": None if stress is None else {**stress.to_dict(), "unit": "Pa"},
            "yield_stress": None if section is None else section.yield_stress,
            **self.hardest,
            "shortest_separation": SHORTEST_SEPARATION,
            "span": list(self.span),
            "over_damping": self.over_damping,
            "contacts": [list(times) for times in self.outcome.contacts],
            "error_parts": {name: dict(n.parts) for name, n in self.numbers.items() if isinstance(n, Number)},
            "energy_residual": residual,
            "energy_defect": residual,  # its older name
            "numerical_loss": numerical_loss(reading["energy"]),
            "energy_gain": self.outcome.energy_gain,
            "energy_of_state": balance.energy,
            "momentum_residual": balance.momentum,
            **{name: getattr(balance, name) for name in ("gap_of_push", "penetration", "pull")},
            "left": self.left,
            "again": self.outcome.again,
            "steps": self.runs.run.steps,
            "seconds": self.seconds,
            "seed": band[1] if band else None,
            "settings": self.settings,
            "versions": versions(),
            "warnings": self.warnings,
        }

    def __str__(self) -> str:
        return self.text()

    def text(self, *, verbose: bool = False) -> str:
        """Every number with its error bar; ``verbose``: with what tells an expert how good they are."""
        return bounce_text(self.to_dict(), verbose=verbose)

    def plot(self) -> Any:
        """Force, stress and contact over time, and shapes, in the units of the case, as a Matplotlib figure."""
        from comparison.figures.history import impact_figure

        return impact_figure(self.history, self.case, self.in_si, self._shown_until)

    def write(self, out: str | Path, document: dict[str, Any] | None = None) -> list[Path]:
        """``bounce.json``, ``bounce.png`` and the animation ``bounce.gif`` in ``out``; returns the files.

        document : with what a command adds to :meth:`to_dict`.
        """
        from comparison.figures.history import animate

        film = animate(self.history, folder(out) / "bounce.gif", self._shown_until)
        return [*write_answer(self, out, "bounce", document=document), film]

    @property
    def _shown_until(self) -> float:
        """End of the time axis, s; of a beam that comes to lie on the wall, soon after the largest push or moment."""
        outcome = self.outcome
        hardest = max(outcome.peak_moment_time, outcome.push_time)
        last = outcome.last_contact if self.left else min(outcome.last_contact, LYING * (hardest + WINDOW))
        return MARGIN * max(last, outcome.peak_moment_time) * self.units["time"]


def scales(impact: Impact) -> dict[str, float]:
    """SI units of the dimensionless numbers: N s, s, N m, m, N."""
    time, length = impact.slow_time_scale, impact.half_length
    impulse = impact.mass_per_length * length * impact.velocity
    return {"impulse": impulse, "time": time, "moment": impact.moment_scale, "length": length, "force": impulse / time}


def documents(numbers: Mapping[str, Number | Band], names: Iterable[str]) -> dict[str, Any]:
    """Of the named ``numbers``, JSON-ready; ``None`` for those that there are none of."""
    return {name: numbers[name].to_dict() if name in numbers else None for name in names}


def with_stress(numbers: Mapping[str, Any], case: Case) -> dict[str, Any]:
    """``numbers``, SI, and of a known section the largest stress, Pa: |M|/W + |N|/A where and when |M| is largest."""
    if (section := case.section) is None:
        return dict(numbers)
    alone = section.stress(0.0, case.impact.axial_force)
    return {**numbers, "peak_stress": numbers["peak_moment"].scaled(1.0 / section.section_modulus, alone, "Pa")}
