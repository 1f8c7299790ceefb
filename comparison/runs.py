"""Runs of a question about one beam, reduced to readings, kept, and made into numbers with bars.

A reading is a dictionary of plain numbers by name: what a store keeps of a run. Without a store nothing is turned
into text.
"""

import statistics
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, Self

from bent_beam import Impact, ImpactHistory, InputError, SimulationError
from bent_beam.hysteresis import converges
from bent_beam.measure.balance import Balance
from bent_beam.measure.numbers import FACTOR, Band, Number, number_of
from bent_beam.method import Method, settings_of
from comparison.doubts import loss_warnings, steep
from comparison.questions import OF_REBOUND, SHORT, Progress, Question
from comparison.store import RunStore, code_of, source_of
from comparison.workers import run_all

LEAST = 1e-4  # of a number: its least bar; beams drawn at random were off by as much where companions agreed better
LIGHT = 3e-4  # η/T* below which a beam has hardly any damping …
LEAST_LIGHT = 1e-3  # … and its numbers after :data:`SHORT` this least bar, for the same reason
FLATTEST = 0.1  # κ/ν: below 1 the least bar of a rebound from a rigid wall is :data:`LEAST`/(κ/ν)², below this no more
CHATTER = 0.01  # of the largest moment: what single nodes add to it on a zone of hardly any damping
UNDAMPED = "no damping is stated: these numbers are those of a beam without any; state [beam] damping_ratio"
Reading = Callable[[ImpactHistory], dict[str, Any]]
"""A function of a module, or a ``partial`` of one with JSON-ready positional arguments. What it returns is JSON-ready
and holds the ``energy`` at the end and the ``balance``."""


@dataclass(frozen=True)
class Run:
    """What is kept of a run: its ``reading``, and what it says of itself. kept : whether it came from a store."""

    reading: dict[str, Any]
    warnings: list[str]
    seconds: float
    steps: int
    kept: bool = False

    @classmethod
    def of(cls, history: ImpactHistory, read: Reading) -> Self:
        return cls(read(history), [*history.warnings, *steep(history)], history.seconds, history.steps)


@dataclass(frozen=True)
class Runs:
    """The run of a question and its companions by cause; ``lost``: a sentence for each that could not finish;
    ``history`` of the run itself, where it was asked for or nothing is kept."""

    question: Question
    run: Run
    companions: Mapping[str, Run] = field(default_factory=dict)
    lost: Sequence[str] = ()
    history: ImpactHistory | None = None

    @property
    def every(self) -> list[Run]:
        return [self.run, *self.companions.values()]

    @property
    def causes(self) -> dict[str, Run]:
        """The companions that differ from the run by one cause each."""
        return {cause: one for cause, one in self.companions.items() if cause != OF_REBOUND}

    @property
    def seconds(self) -> float:
        return sum(run.seconds for run in self.every)

    @property
    def kept(self) -> bool:
        """Whether nothing had to be simulated."""
        return not self.lost and all(run.kept for run in self.every)

    @property
    def warnings(self) -> list[str]:
        """What the run says, what steps and mesh took, what is out of balance, which companions are missing."""
        question, energy = self.question, self.run.reading["energy"]
        bare = not (question.damping_stated or question.impact.damping or question.impact.hysteretic_loss)
        unstated = [UNDAMPED] if bare and question.late else []
        return [*unstated, *self.run.warnings, *loss_warnings(energy), *self.balance.warnings, *self.lost]

    @property
    def balance(self) -> Balance:
        """Of the run itself."""
        return Balance(**self.run.reading["balance"])

    def part(self, of: Callable[[dict[str, Any]], dict[str, Any]]) -> Self:
        """The same runs with a part of their readings."""
        run, *others = (replace(one, reading=of(one.reading)) for one in self.every)
        return replace(self, run=run, companions=dict(zip(self.companions, others)))


def runs_of(
    question: Question,
    read: Reading,
    *,
    store: RunStore | None = None,
    whole_history: bool = False,
    jobs: int = 1,
    progress: Progress | None = None,
) -> Runs:
    """Run ``question`` and its companions, or find them in ``store``.

    whole_history : also the history of the run itself, which is then made anew.
    Raises ``ValueError`` for what the method refuses, :class:`bent_beam.SimulationError` where the run cannot finish.
    """
    if reason := question.method.refuses(question.impact):
        raise InputError(reason)
    told = progress or (lambda _: None)
    first, others = question.run_by, question.companions()
    share = 1.0 / (1 + len(others))
    simulate = partial(question.run, first, progress=lambda part: told(share * part))
    history = simulate() if whole_history or not (store and store.folder) else None
    run = Run.of(history, read) if history else kept(store, question.key(question.impact), first, read, simulate)
    told(share)
    calls = [(store, question, read, method, impact) for impact, method in others.values()]
    how: dict[str, Any] = {"jobs": jobs, "on_death": lambda _, why: why}
    found = run_all(_attempted, calls, progress=lambda done, _: told(share * (1 + done)), **how)
    companions = {cause: one for cause, one in zip(others, found) if isinstance(one, Run)}
    lost = [f"no companion run ({cause}): {one}" for cause, one in zip(others, found) if isinstance(one, str)]
    return Runs(question, run, companions, lost, history)


def kept(
    store: RunStore | None, asked: Mapping[str, Any], method: Method, read: Reading, run: Callable[[], ImpactHistory]
) -> Run:
    """What ``read`` makes of ``run()``, or the same from ``store``. asked : what the run depends on next to its
    ``method`` and the code of that, JSON-ready."""
    if store is None:
        return Run.of(run(), read)
    computed = []

    def compute() -> dict[str, Any]:
        computed.append(Run.of(run(), read))
        return vars(computed[0])

    named, given = (read.func, read.args) if isinstance(read, partial) else (read, ())
    settings = settings_of(method) | {"label": ""}
    key = {**asked, "settings": settings, "source": source_of(method), "read": [code_of(named), *given]}
    return replace(Run(**store.answer(key, compute)), kept=not computed)


def _attempted(store: RunStore | None, question: Question, read: Reading, method: Method, impact: Impact) -> Run | str:
    """A companion run; where it fails, since coarser elements may be too coarse, why."""
    try:
        return kept(store, question.key(impact), method, read, lambda: question.run(method, impact))
    except (SimulationError, ValueError) as error:
        return str(error)


def numbers_of(
    runs: Runs, names: Sequence[str], known: Mapping[str, Mapping[str, float]] | None = None
) -> dict[str, Number]:
    """Numbers by name from the readings. known : of a name, cause → size of what no companion shows.

    Where a late motion does not converge (no damping, no soft wall) a number is the mean of all runs, its bar two
    standard deviations. Elsewhere a bar is at least :data:`LEAST` of its number; :data:`LEAST_LIGHT` with hardly any
    damping, once waves have run along the beam; and more of a flat beam's rebound from a rigid wall.
    """
    found, extra, least = dict[str, Number](), known or {}, LEAST_LIGHT if _is_light(runs.question) else LEAST
    of_rebound = max(least, _least_of_rebound(runs.question.impact))
    scattered = runs.question.late and not converges(runs.question.impact)
    scales = _scales_of_rebound(runs.run.reading)
    for name in names:
        value = runs.run.reading[name]
        others = {cause: run.reading[name] for cause, run in runs.causes.items()}
        if scattered and len(others) > 1 and None not in (value, *others.values()):
            values = [float(value), *(float(other) for other in others.values())]
            parts = {"no_damping": 2.0 * statistics.stdev(values), **extra.get(name, {})}
            found[name] = Number(statistics.fmean(values), sum(parts.values()), parts=parts)
        else:
            scale = max(scales.get(name, 0.0) / abs(value), 1.0) if value else 1.0
            share = of_rebound if name in scales else least
            sizes = {**extra.get(name, {}), **(_law_on_coarser(runs, name) if name in scales else {})}
            found[name] = number_of(value, others, sizes, least=share * scale)
    return found


def _scales_of_rebound(reading: Mapping[str, Any]) -> dict[str, float]:
    """Of what the least bar of a rebound's numbers is a share. e and J are known only as well as 1 + e, J = (1 + e)mV;
    the energies follow from e²."""
    if "restitution" not in reading:
        return {}
    scales = {name: abs(reading[name]) for name in ("impulse", "dissipated")}
    if not (e := reading["restitution"]):
        return scales
    energy = 2.0 * abs((1.0 + e) / e) * reading["translation"]
    return scales | {"restitution": abs(1.0 + e), "translation": energy, "vibration": energy}


def _law_on_coarser(runs: Runs, name: str) -> dict[str, float]:
    """What another contact law changes of a number on half of the elements, beyond what it changes on all."""
    compared = [runs.companions.get(cause) for cause in ("contact_law", OF_REBOUND, "mesh_and_step")]
    values = [run.reading[name] for run in (runs.run, *compared) if run is not None]
    if len(values) < 4 or None in values:
        return {}
    own, law, law_coarser, coarser = values
    return {OF_REBOUND: FACTOR * max(abs(law_coarser - coarser) - abs(law - own), 0.0)}


def _least_of_rebound(impact: Impact) -> float:
    """Least bar of a rebound: the flatter a bow is, the more of it lands on a rigid wall while a wave passes an
    element. Beams drawn at random were as much off, and the companions of some agreed better."""
    if impact.wall_stiffness is not None or impact.wall_in_part or not impact.kappa_over_nu:
        return LEAST
    return LEAST / min(max(impact.kappa_over_nu, FLATTEST), 1.0) ** 2


def unseen_of_moment(runs: Runs) -> dict[str, float]:
    """Errors of the largest moment that no companion shows, by cause: what it may have been in first instants that no
    mesh resolves; how a push on one point spreads within an element, and beside it; what single nodes add where the
    beam does not converge, or on a zone with hardly any damping once waves have run along the beam."""
    reading, impact = runs.run.reading, runs.question.impact
    hardly = _is_light(runs.question) and impact.kappa_over_nu < 1.0 and impact.wall_stiffness is None
    return {
        "first_instants": FACTOR * max(reading["moment_left_out"] - reading["peak_moment"], 0.0),
        "spread": reading["moment_spread"],
        "chatter": CHATTER * reading["peak_moment"] if hardly or not converges(impact) else 0.0,
    }


def _is_light(question: Question) -> bool:
    """Whether a beam has hardly any damping, and waves have run along it."""
    impact, until = question.impact, question.until
    ran = until is None or until > SHORT * impact.slow_time_scale
    return ran and not impact.hysteretic_loss and impact.relative_damping < LIGHT


def bands_of(runs: Runs, names: Sequence[str]) -> dict[str, Band | Number]:
    """Bands over all runs; a number without a value where one of them has none, or all others were lost."""
    every = {name: [run.reading[name] for run in runs.every] for name in names}
    return {name: Number() if None in values or len(values) < 2 else Band.of(values) for name, values in every.items()}
