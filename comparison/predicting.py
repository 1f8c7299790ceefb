"""One beam: the theory of its first instants beside a simulation of the beam as it is, and its whole impact.

The theory says what closed forms and formulas allow (:mod:`theory.validity`). The simulation runs the whole beam with
its ends, loads, damping and wall: a question to each time, and one to the last separation, the same that ``simulate``
and ``bounce`` ask (:mod:`comparison.questions`).
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam import Case, Method, SimulationError
from bent_beam.history import REFLECTED, Array, ImpactHistory
from bent_beam.hysteresis import converges
from bent_beam.measure.balance import balance_of
from bent_beam.measure.estimators import lift_shares
from bent_beam.measure.instant import instant
from bent_beam.measure.moments import AROUND
from bent_beam.measure.numbers import FACTOR, Number
from bent_beam.measure.reduction import LANDING
from bent_beam.tables import in_keys
from comparison.bounced import Bounce, documents, with_stress
from comparison.bouncing import bounce
from comparison.doubts import doubts, energy_at_end, told_by, yields
from comparison.questions import Progress, Question
from comparison.readable import milliseconds, write_answer
from comparison.runs import UNDAMPED, Runs, numbers_of, runs_of, unseen_of_moment
from comparison.store import RunStore
from comparison.texts import prediction_text
from theory import Prediction, predict

PATH = "hermite"
COMPARED = ("half_contact_length", "reaction", "impulse", "peak_moment", "peak_stress")
"""What theory and simulation both say at a time."""
OF_WHOLE_IMPACT = ("restitution", "last_contact", "peak_moment", "peak_stress", "peak_force", "push")
OF_INSTANT = {"half_contact_length": "m", "reaction": "N", "impulse": "N s", "peak_moment": "N m", "peak_force": "N",
              "peak_penetration": "m", "peak_pressure": "N/m"}  # fmt: skip
"""Fields of :class:`bent_beam.measure.instant.Instant` that are numbers, and their units."""

CHECKED = 24  # instants between a hundredth of the last time and the last, at which theory and simulation are compared
AGREE = 0.02  # of the theory's number, beyond the error bar
LATEST = 20.0  # T*: later times are not simulated
ROUND_OFF = 1e-9  # of the mean force so far, and of V₀√(EIμ): less is none
VISCOSITY = 2e-3  # of an early number: what grid viscosity and start do to a run and its companion alike


def instants_reading(times: tuple[float, ...], first_spread: bool, history: ImpactHistory) -> dict[str, Any]:
    """What a run says at the last of ``times``, s, and at those before, JSON-ready."""
    last = times[-1]
    *before, found = (asdict(instant(history, t, first_spread=first_spread)) for t in times)
    if last > 0.0 and abs(found["reaction"] or 0.0) < ROUND_OFF * abs(found["impulse"]) / last:
        found |= {"reaction": 0.0, "half_contact_length": None}  # impulses of a beam in flight add up to round-off
    if abs(found["peak_moment"] or 0.0) < ROUND_OFF * history.impact.moment_scale:
        found["peak_moment"] = 0.0  # of a straight beam that a wall presses evenly
    return found | {"before": before, "balance": asdict(balance_of(history)), "energy": energy_at_end(history)}


def instant_numbers(runs: Runs) -> dict[str, Number]:
    """The numbers at the time of a question, SI, from runs read by :func:`instants_reading`."""
    question, reading = runs.question, runs.run.reading
    known: dict[str, dict[str, float]] = {name: {} for name in OF_INSTANT}
    known["half_contact_length"]["element"] = reading["element"]
    if question.late and converges(question.impact):
        known["impulse"]["about_the_time"] = _crossings(runs)
    if question.impact.wall_stiffness is not None:
        known["reaction"]["about_the_time"] = _crossings_of_force(runs)
        known["peak_force"]["sharp"] = reading["peak_force_sharp"]
        if all(one.reading["peak_pressure"] == reading["peak_pressure"] for one in runs.every):  # that of a landing
            known["peak_pressure"]["sharp"] = LANDING * (reading["peak_pressure"] or 0.0)
    known["peak_moment"] = unseen_of_moment(runs)
    if not question.late:
        impact = question.impact
        # a load, damping, or a wall that gives way may lift the zone rightly; else the scheme has thrown it off, as it
        # has in companions
        rightly = impact.lifts or impact.damping or impact.wall_stiffness is not None
        for name in OF_INSTANT:
            known[name]["grid_viscosity"] = VISCOSITY * abs(reading[name] or 0.0)
        for name, share in zip(("impulse", "half_contact_length"), lift_shares(0.0 if rightly else reading["lift"])):
            known[name]["lift"] = share * (reading[name] or 0.0)
    if reading["half_contact_length"] is not None:  # a companion without contact has a half length of 0
        name = "half_contact_length"
        runs = runs.part(lambda one: {**one, name: 0.0 if one[name] is None else one[name]})
    found = numbers_of(runs, tuple(OF_INSTANT), known)
    return {name: replace(number, unit=OF_INSTANT[name]) for name, number in found.items()}


def _crossings(runs: Runs) -> float:
    """What companions change of the impulse within a tenth of the time around, beyond what they change at the time
    itself, N s: the curves of two runs cross, and agree there by chance."""
    changes = np.abs(_changes_around(runs))
    return FACTOR * float((changes.max(axis=1, initial=0.0) - changes[:, changes.shape[1] // 2]).sum())


def _crossings_of_force(runs: Runs) -> float:
    """The same of the reaction, N, the mean force over that window. Two runs may agree in it by chance, and not over
    parts of it: the largest change of the impulse over any part counts, beyond that over all of it."""
    if runs.question.until is None:  # to the last separation, where nothing pushes
        return 0.0
    changes = _changes_around(runs)
    more = np.ptp(changes, axis=1) - np.abs(changes[:, -1] - changes[:, 0])
    unsure = FACTOR * float(more.sum()) / (2.0 * AROUND * runs.question.until)
    return unsure if unsure > ROUND_OFF * abs(runs.run.reading["impulse"]) / runs.question.until else 0.0


def _changes_around(runs: Runs) -> Array:
    """What each companion changes of the impulse around the time, N s, shape (companions, instants)."""
    own = np.array(runs.run.reading["impulse_around"])
    found = [np.array(one.reading["impulse_around"]) - own for one in runs.companions.values()]
    return np.array(found).reshape(-1, own.size)


@dataclass(frozen=True)
class PredictedCase:
    """What is known of a case.

    theory : its first rows are the times asked, the rest those of ``agreement``. simulated : a simulation's numbers by
    name, for each time asked. agreement : the longest interval, s, in which half length and impulse of theory and
    simulation agree within bars and 2 %. whole : ``None`` where it is not simulated, for the reason ``no_whole``.
    runs : to the last time.
    """

    case: Case
    theory: Prediction
    simulated: Sequence[dict[str, Number]] | None
    agreement: dict[str, float] | None
    whole: Bounce | None
    no_whole: str | None
    warnings: list[str]
    runs: Runs | None = None

    def to_dict(self) -> dict[str, Any]:
        """The contract of ``bentbeam predict --json``."""
        document, whole = self.theory.to_dict(), self.whole
        rows = document["times"]
        for row, numbers in zip(rows, self.simulated or ()):
            row["simulation"] = {name: n.to_dict() for name, n in numbers.items() if name in COMPARED}
        holds = document["valid_until"]  # a beam whose damping is not stated has some, enough to absorb short waves
        force = document["force_until"] if self.case.damping_stated else holds
        for row in rows:
            if force < min(row["time"], holds):  # beyond ``holds`` the whole row is told to be invalid
                row["reaction"] = None
        told: list[Mapping[str, Any]] = [*(self.simulated or ()), *([] if whole is None else [whole.in_si])]
        known = [one for numbers in told if (one := yields(numbers, self.case.section)) is not None]
        of_whole: dict[str, Any] | None = None
        if whole is not None:
            of_whole = documents(whole.in_si, OF_WHOLE_IMPACT) | whole.hardest
            of_whole |= {"span": list(whole.span), "over_damping": whole.over_damping, "warnings": whole.warnings}
        return document | {
            "yields": any(known) if known else document["yields"],
            "force_until": force,
            "times": rows if self.simulated is None else rows[: len(self.simulated)],
            "model": self.case.impact.model,
            "velocity": self.case.impact.velocity,
            "damping": self.case.impact.relative_damping,
            "warnings": self.warnings,
            "agreement": self.agreement,
            "compared_from": rows[len(self.simulated)]["time"] if self.simulated and self.runs else None,
            "yield_stress": getattr(self.case.section, "yield_stress", None),
            "whole_impact": of_whole,
            "no_whole_impact": self.no_whole,
        }

    def __str__(self) -> str:
        return prediction_text(self.to_dict())

    def plot(self) -> Any:
        """The whole impact, or where it is not known the run to the last time, as a Matplotlib figure. Raises
        ``ValueError`` where nothing is simulated."""
        from comparison.figures.history import impact_figure

        if self.whole is not None:
            return self.whole.plot()
        if self.runs is None or not self.simulated:
            raise ValueError(f"there is nothing to be drawn: {self.no_whole}")
        question = self.runs.question
        end = float(question.until or 0.0)
        return impact_figure(question.run(question.run_by).until(end), self.case, numbers_at(self.runs, self.case), end)

    def write(self, out: str | Path) -> list[Path]:
        """``predict.json`` and ``predict.png`` in ``out``; returns the files. Raises as :meth:`plot`."""
        return write_answer(self, out, "predict")


def predict_case(
    case: Case,
    times: Sequence[float],
    *,
    theory_only: bool = False,
    whole: bool = True,
    store: RunStore | None = None,
    progress: Progress | None = None,
) -> PredictedCase:
    """Theory beside simulation at ``times`` (s, each ≥ 0), and, with ``whole``, the whole impact.

    store : where runs are kept. progress : called with the finished fraction of the simulations.
    Raises ``ValueError`` for what the theory does not cover, :class:`bent_beam.SimulationError` where a simulation
    cannot finish.
    """
    impact, method = case.impact, None if theory_only else case.method(PATH)
    warnings = doubts(impact, case.section)
    last = max(times)
    if method is None or last <= 0.0:
        prediction = predict(impact, times, section=case.section)
        instead = "leave --theory-only out" if method is None else "ask for a time after 0"
        return PredictedCase(case, prediction, None, None, None, f"nothing is simulated: {instead}", warnings)
    latest = LATEST * impact.slow_time_scale
    within = max((time for time in times if 0.0 < time <= latest), default=latest)
    checked = np.geomspace(0.01 * within, within, CHECKED).tolist()
    prediction = predict(impact, [*times, *checked], section=case.section)
    told, share = progress or (lambda _: None), 1.0 / (len(set(times)) + whole)
    found: dict[float, Runs] = {}
    for i, time in enumerate(sorted({t for t in times if 0.0 < t <= within})):
        asked = (*checked, time) if time == within else (time,)
        found[time] = runs_to(case, method, asked, store, lambda done, i=i: told(share * (i + done)))  # type: ignore[misc]
    simulated = [numbers_at(found.get(time), case) for time in times]
    # what runs say, but for their ends: the theory beside them says how long those do not matter
    said_by = {time: {line for line in runs.warnings if REFLECTED not in line} for time, runs in found.items()}
    late = [time for time, lines in said_by.items() if UNDAMPED in lines]  # the whole impact has some damping
    warnings += [f"until {milliseconds(late[0])}{' and later' if late[1:] else ''}: {UNDAMPED}"] if late else []
    said_by = {time: lines - {UNDAMPED} for time, lines in said_by.items()}
    by_all = set.intersection(*said_by.values()) if said_by else set()
    warnings += by_all
    warnings += [f"run to {milliseconds(time)}: {line}" for time, lines in said_by.items() for line in lines - by_all]
    for time, numbers in zip(times, simulated):
        warnings += [f"at {milliseconds(time)}: {line}" for line in told_by(numbers, case.section)]
    if last > latest:
        warnings.append(f"times beyond {latest:.4g} s ({LATEST:g} T*) are not simulated here: bentbeam simulate")
    agreement = _agreement(checked, prediction, found[within], len(times)) if within in found else None
    answer = PredictedCase(case, prediction, simulated, agreement, None, None, sorted(set(warnings)), found.get(within))
    if not whole:
        return answer
    try:
        found_whole = bounce(case, method, store=store, progress=lambda done: told(1.0 - share * (1.0 - done)))
    except (ValueError, SimulationError) as error:
        return replace(answer, no_whole=in_keys(str(error)))
    return replace(answer, whole=found_whole)


def runs_to(
    case: Case, method: Method, times: tuple[float, ...], store: RunStore | None, progress: Progress | None = None
) -> Runs:
    """Runs of a case to the last of ``times``, s, each read at all of them. Raises as :func:`runs_of`."""
    question = Question(case.impact, method, times[-1], damping_stated=case.damping_stated)
    return runs_of(question, partial(instants_reading, times, question.first_spread), store=store, progress=progress)


def numbers_at(runs: Runs | None, case: Case) -> dict[str, Number]:
    """The numbers of one time, the largest stress too; nothing where nothing was simulated."""
    return {} if runs is None else with_stress(instant_numbers(runs), case)


def _agreement(checked: Sequence[float], prediction: Prediction, runs: Runs, first: int) -> dict[str, float] | None:
    """The longest interval between checked instants in which half length and impulse agree within bars and 2 %;
    ``None`` where they agree at none."""
    agree = []
    for i, row in enumerate(prediction.times[first:]):
        found = instant_numbers(runs.part(lambda reading, i=i: reading["before"][i]))  # type: ignore[misc]
        pairs = [(getattr(row, name), found[name]) for name in ("half_contact_length", "impulse")]
        agree.append(
            all(a is not None and b.measured and abs(b.known - a) <= b.spread + AGREE * abs(a) for a, b in pairs)
        )
    spans = [list(span) for both, span in groupby(range(len(agree)), key=agree.__getitem__) if both]
    longest = max(spans, key=lambda span: checked[span[-1]] - checked[span[0]], default=None)
    return {"from": checked[longest[0]], "until": checked[longest[-1]]} if longest else None
