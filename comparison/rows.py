"""The rows of a match: what each asks and answers; the rows as a document and as a table."""

import math
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Any

from bent_beam.checks import between, finite, non_negative, one_of, positive, shortened
from bent_beam.errors import InputError, SimulationError, TimeLimitError
from bent_beam.impact import Impact
from bent_beam.measure.estimators import LeadingEstimate
from bent_beam.measure.numbers import MISSING, Number
from bent_beam.method import Method, settings_of
from comparison.questions import ERROR_BARS
from comparison.readable import shown, text_table

__all__ = [
    "DURATION", "HELD_AGAINST", "THESIS_KAPPAS", "First", "MatchQuestion", "MatchRow", "about", "failures",
    "first_order_epsilon", "lost_row", "match_document", "match_table", "questions", "reason_of",
    "with_theory",
]  # fmt: skip

First = tuple[float, float, float, float]
"""(α, ψ, χ, N) with ν = 1."""

GROUPS = ("alpha", "psi", "chi", "axial")

DURATION = 0.1  # t*
THESIS_KAPPAS = (1 / 1600, 1 / 800, 1 / 400, 1 / 200, 1 / 100, 1 / 40, 1 / 20, 1 / 4, 1 / 2)
"""κ/ν of the thesis's Table 3.4."""

HELD_AGAINST = {"lambda0": 0.0, "r0": 0.0, "lambda1": 1.0, "r1": 1.0}
"""Errors are relative to the larger of |theory| and this."""

LEGEND = (
    "± is the error bar, % the difference from theory. lift: largest gap inside the contact zone; pull: largest",
    "adhesive over largest contact impulse; held: until when contact was held; s: seconds of its runs.",
)

EXTREME = 1e30  # of ε: its powers are calculated with


@dataclass(frozen=True)
class MatchQuestion:
    """One row to be matched. ``first`` : (α, ψ, χ, N), or ``None`` for the leading order alone; ``refine`` : elements
    and steps so many times finer than the method's own; ``error_bars`` : of :data:`comparison.questions.ERROR_BARS`;
    ``duration`` : end of the runs, t*. Any will do at ε = 0, which is self-similar; the thesis ends at 0.1; ``wall`` :
    stiffness of the wall over μ/t*² and its damping ratio, ``None`` of a rigid one."""

    method: Method
    kappa_over_nu: float
    first: First | None = None
    refine: float = 1.0
    error_bars: str = "quick"
    duration: float = DURATION
    wall: tuple[float, float] | None = None

    @property
    def bare(self) -> Impact:
        """The impact without loads, in units of the fast layer."""
        impact = Impact.dimensionless(self.kappa_over_nu)
        if self.wall is None:
            return impact
        stiffness, ratio = self.wall
        return impact.replace(wall_stiffness=stiffness, wall_damping=2.0 * ratio * math.sqrt(stiffness))

    @property
    def loads(self) -> dict[str, float]:
        """α, ψ, χ and N by name."""
        return dict(zip(GROUPS, self.first or (0.0,) * 4))

    def loaded(self, epsilon: float) -> Impact:
        """The impact with (εα, εψ, εχ, n) = ε·(α, ψ, χ, N)."""
        alpha, psi, chi, axial = (epsilon * value for value in self.loads.values())
        return self.bare.replace(acceleration=alpha, fourth_derivative=psi, curvature_rate=chi, axial_force=axial)

    def __post_init__(self) -> None:
        for name in ("kappa_over_nu", "refine", "duration"):
            positive(name, getattr(self, name))
        one_of("error_bars", self.error_bars, ERROR_BARS)
        if self.wall is not None:
            positive("--wall", self.wall[0])
            non_negative("--wall", self.wall[1])
        if self.first is not None:
            for name, value in zip(GROUPS, self.first):
                finite(name, value)
            object.__setattr__(self, "first", (*self.first, 0.0)[:4] if any(self.first) else None)


@dataclass(frozen=True)
class MatchRow:
    """One row of the matching table; the command line prints it as it stands here.

    lift : the largest gap inside the zone over V₀t in the last decade of time; pull : the largest negative contact
    impulse over the largest positive one, after the start; hold : ``{"until": s, "pull": …}`` where any contact was
    held; momentum_residual, gap_of_push : the largest of the runs (:class:`~bent_beam.measure.balance.Balance`);
    seconds : of its runs, companions left out; epsilons : of the runs of first order.
    wall : of the question; peak_force : the largest on it, in V₀√μ(EI k)^¼.
    reason : why there are no numbers (``None``: there are); refused : the method had said so before the run.
    """

    label: str
    path: str
    settings: dict[str, Any]
    kappa_over_nu: float
    alpha: float
    psi: float
    chi: float
    axial: float
    refine: float
    wall: tuple[float, float] | None = None
    regime: str | None = None
    lambda0: Number = MISSING
    r0: Number = MISSING
    lambda1: Number = MISSING
    r1: Number = MISSING
    peak_force: Number = MISSING
    lift: float | None = None
    pull: float | None = None
    hold: dict[str, float | None] | None = None
    momentum_residual: float | None = None
    gap_of_push: float | None = None
    seconds: float | None = None
    steps: int | None = None
    epsilons: list[float] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    reason: str | None = None
    refused: bool = False

    @property
    def name(self) -> str:
        """In words."""
        text = f"{self.label}, kappa/nu = {self.kappa_over_nu:.6g}"
        text += f", (alpha, psi, chi, N) = ({', '.join(f'{v:g}' for v in self.first)})" if self.of_first_order else ""
        return text + (f", refined {self.refine:g} times" if self.refine != 1.0 else "")

    @property
    def first(self) -> First:
        return (self.alpha, self.psi, self.chi, self.axial)

    @property
    def of_first_order(self) -> bool:
        return any(self.first)

    @property
    def of_tension_alone(self) -> bool:
        """Whether it is about a bow free of stress under an axial force in free flight: λ₁/N = λ_N, r₁/N = r_N."""
        flight = math.isclose(self.alpha, -self.kappa_over_nu * self.axial, rel_tol=1e-9)
        return self.axial != 0.0 and flight and self.psi == self.chi == 0.0

    def to_dict(self) -> dict[str, Any]:
        """JSON-ready, a number as ``{"value", "error", "theory"}``."""
        return {name: one.compared() if isinstance(one, Number) else one for name, one in vars(self).items()}

    def compared(self) -> dict[str, Number]:
        """The numbers that this row is about."""
        names = ("lambda1", "r1") if self.of_first_order else ("lambda0", "r0")
        return {name: getattr(self, name) for name in names}


def questions(
    methods: Sequence[Method],
    kappas: Iterable[float],
    firsts: Sequence[Sequence[float | None]] = (),
    refines: Sequence[float] = (1.0,),
    error_bars: str = "quick",
    duration: float = DURATION,
    wall: tuple[float, float] | None = None,
) -> list[MatchQuestion]:
    """Every method × κ/ν × (α, ψ, χ[, N]) × refinement, before ``wall``; without ``firsts`` the leading order alone.

    α = ``None``: what the axial force makes of a bow free of stress in free flight, α = −κN.
    """

    def load(first: Sequence[float | None] | None, kappa: float) -> Any:
        if first is None or first[0] is not None:
            return first
        return (0.0 - kappa * ((*first, 0.0)[3] or 0.0), *first[1:])  # 0, not −0

    kappas, asked = list(kappas), [*firsts] if firsts else [None]
    for name, given in (("kappa_over_nu", kappas), ("refine", refines)):
        if not given:
            raise InputError(f"{name} must have a value (got none)")
    for first in firsts:
        if isinstance(first, str) or not isinstance(first, Sequence) or len(first) not in (3, 4):
            raise InputError(f"first_order takes alpha, psi, chi and, if there is one, N each (got {shortened(first)})")
    for name, values in (("kappa_over_nu", kappas), ("first_order", asked), ("refine", refines)):
        if len({tuple(value) if isinstance(value, Sequence) else value for value in values}) < len(values):
            raise InputError(f"{name} has a value twice (got {shortened(list(values))})")
    return [
        MatchQuestion(method, kappa, load(first, kappa), refine, error_bars, duration, wall)
        for kappa, method, first, refine in product(kappas, methods, asked, refines)
    ]


def with_theory(question: MatchQuestion, leading: Any, estimate: Any) -> dict[str, Any]:
    """The numbers of a row with the theory's beside them. λ₁ is missing where a run does not show the zone that a flat
    bow has; a sharp one has none, and λ₁ = 0."""
    from theory import contact_parameters

    exact = contact_parameters(question.kappa_over_nu, **question.loads)
    row: dict[str, Any] = {"regime": str(exact.regime)}
    for name, source in (("lambda0", leading), ("r0", leading), ("lambda1", estimate), ("r1", estimate)):
        missing = source is None or (name == "lambda1" and question.kappa_over_nu < 1.0 and not leading.front > 0.0)
        number = MISSING if missing else getattr(source, name)
        theory = getattr(exact, name) if name in ("lambda0", "r0") or question.first else None
        row[name] = replace(number, theory=theory)
    return row


def about(question: MatchQuestion) -> dict[str, Any]:
    """The fields of a row that its question says."""
    method, asked = question.method, ("kappa_over_nu", "refine", "wall")
    of_method = {"label": method.label, "path": method.path, "settings": settings_of(method)}
    return of_method | question.loads | {name: getattr(question, name) for name in asked}


def lost_row(question: MatchQuestion, reason: str, *, refused: bool = False) -> MatchRow:
    """The row of a question without an answer."""
    row = about(question)
    with suppress(ValueError):  # of which the theory has nothing to say either
        row |= with_theory(question, None, None)
    return MatchRow(**row, reason=reason, refused=refused)


def reason_of(error: BaseException) -> str:
    """Why there is no answer, on one line; what nobody has foreseen with its kind."""
    foreseen = isinstance(error, (ValueError, SimulationError, TimeLimitError))
    return " ".join((str(error) if foreseen else f"{type(error).__name__}: {error}").split())


def failures(rows: Iterable[Any]) -> list[Any]:
    """The rows, of a match or a sweep, that failed though nothing had said that they must."""
    return [row for row in rows if row.reason is not None and not row.refused]


def first_order_epsilon(leading: LeadingEstimate, first: First, perturbation: float, duration: float) -> float:
    """The largest ε of the runs: the loads change the free motion by a small part of V₀t over the contact zone.

    ε τ (|α|/2 + |χ|z²/2 + |ψ|z⁴/24 + |N|/2) = ``perturbation`` at the end, z being the zone measured at ε = 0 and half
    the front's thickness. ε is reduced for a front near the centre, which would move too far.
    """
    front = leading.front
    z = front + 1.0 / math.sqrt(1.0 + front**2)
    alpha, psi, chi, axial = (abs(v) for v in first)
    part = perturbation * (front / (front + 0.2) if front > 0.0 else 1.0)
    top = part / (duration * (alpha / 2 + chi * z**2 / 2 + psi * z**4 / 24 + axial / 2))
    return between("first_order: the largest ε of the runs, from alpha, psi, chi and N,", top, 1 / EXTREME, EXTREME)


def match_document(rows: Sequence[MatchRow]) -> dict[str, Any]:
    """The contract of ``bentbeam match --json``: ``rows``, and ``failures``, those that failed unexpectedly."""
    names = ("label", "path", "kappa_over_nu", "reason")
    lost = [{name: getattr(row, name) for name in names} for row in failures(rows)]
    return {"rows": [r.to_dict() for r in rows], "failures": lost}


def match_table(rows: Sequence[MatchRow]) -> str:
    """Value ± error bar, and the difference from theory in per cent."""
    first, refined = any(r.of_first_order for r in rows), any(r.refine != 1.0 for r in rows)
    elastic, names = any(r.wall for r in rows), ("lambda0", "r0", "lambda1", "r1")[: 4 if first else 2]
    head = ["method", "kappa/nu", *["refine"] * refined, *["alpha,psi,chi,N"] * first]
    head += [title for name in names for title in (name, "%")]
    head += ["F/(V0 sqrt(mu)(EI k)^1/4)", "theory"] * elastic
    head += ["lift/(V0 t)", "pull", "momentum", "gap of push", "held", "s"]
    body = []
    for r in rows:
        line = [r.label, f"{r.kappa_over_nu:.6g}", *[f"{r.refine:g}"] * refined]
        line += [",".join(f"{v:g}" for v in r.first) if r.of_first_order else "-"] * first
        for name in names:
            number = getattr(r, name)
            off = number.relative(HELD_AGAINST[name])
            line += [str(number), shown(off and 100 * off, "+.3f")]
        line += [str(r.peak_force), shown(r.peak_force.theory)] * elastic
        line += [shown(v, ".0e") for v in (r.lift, r.pull, r.momentum_residual, r.gap_of_push)]
        line += ["-" if r.hold is None else f"until {r.hold['until']:.2g}"]
        body.append([*line, shown(r.seconds, ".1f")])
    notes = [f"{r.name}: {r.reason}" for r in rows if r.reason]
    notes += [f"warning: {r.name}: {w}" for r in rows for w in r.warnings]
    return "\n".join([text_table(head, body), "", *LEGEND, *notes])
