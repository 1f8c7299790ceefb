"""The table property × code: one number each, over the rows of one code."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from open_benchmark.adapter import RESOLUTIONS
from open_benchmark.campaign import Row
from open_benchmark.judgement import Score
from open_benchmark.problem import LADDER, Problem, problem

__all__ = ["PROPERTIES", "in_words", "properties"]

CONVERGED = 0.002  # relative error on the finest mesh that a converging code reaches (strict codes do)

WORDS = {
    "leading": "infinite beam, κ/ν = {p.kappa_over_nu:g}: the contact spreads",
    "point": "infinite beam, κ/ν = {p.kappa_over_nu:g}: one point in contact",
    "first": "infinite beam, κ/ν = {p.kappa_over_nu:g}, first order in the loads (α, ψ, χ, n) = ({loads}): {regime}",
    "bounce": "free beam, κ/ν = {p.kappa_over_nu:g}, damping η/T* = {p.damping:g}, until it has left the wall",
    "stopped-beam": "free beam with damping, before the wall first lets go",
    "elastic-wall": "infinite beam on a wall that gives way, κ/ν = {p.kappa_over_nu:g}, ζ = {ratio:g}",
    "elastic-stop": "hinged beam swung on a stop of {p.given[stop_stiffness]:g} N/m",
} | {name: rung.words for name, rung in LADDER.items()}


def in_words(asked: Problem) -> str:
    """A problem in words, for a heading."""
    loads = ", ".join(f"{value:g}".replace("-", "−") for value in asked.loads)
    ratio = asked.given.get("wall_damping", 0.0) / 2.0
    return WORDS[asked.kind].format(p=asked, loads=loads, regime=_regime(asked), ratio=ratio)


def _regime(asked: Problem) -> str:
    """Which loads act on an infinite beam."""
    alpha, psi, _, axial = asked.loads
    if axial:
        return "tension" if axial > 0.0 else "compression"
    return "lift-off" if alpha + psi < 0.0 else "pressed"


@dataclass(frozen=True)
class Property:
    """The largest of ``numbers`` of the scores of the problems ``asked``, at the finest resolution alone or at all."""

    numbers: Callable[[Score], Iterable[float | None]]
    asked: Callable[[Problem], bool]
    finest: bool = True


def _without_loads(asked: Problem) -> bool:
    return asked.kind in ("leading", "point")


def _first_order(regime: str) -> Property:
    return Property(
        lambda found: [found.error("lambda1"), found.error("r1")],
        lambda asked: asked.kind == "first" and _regime(asked) == regime,
    )


PROPERTIES: dict[str, Property] = {
    "unilateral": Property(lambda found: [found.adhesion], _without_loads, finest=False),
    "energy": Property(lambda found: [found.gained], _without_loads, finest=False),
    "noise": Property(lambda found: [found.noise], _without_loads),
    "lift": Property(lambda found: [found.lift], lambda asked: asked.kind == "leading"),
    **{f"first order, {name}": _first_order(name) for name in ("pressed", "lift-off", "tension", "compression")},
}


def properties(rows: Sequence[Row], solver: str) -> dict[str, str]:
    """One code's column of the table."""
    own = [row for row in rows if row.solver == solver]
    return {"converges": _converges(own), **{name: _largest(own, rule) for name, rule in PROPERTIES.items()}}


def _largest(rows: Sequence[Row], rule: Property) -> str:
    """The number, the outcome where no row has a result, or why there is none."""
    resolutions = RESOLUTIONS[-1:] if rule.finest else RESOLUTIONS
    chosen = [row for row in rows if rule.asked(problem(row.problem)) and row.resolution in resolutions]
    if not chosen:
        return "not asked"
    numbers = [abs(number) for row in chosen for number in rule.numbers(row.score) if number is not None]
    if numbers:
        return f"{max(numbers):.1e}" if any(numbers) else "0"
    outcomes = {row.score.brief for row in chosen if not row.score.completed}
    return " or ".join(sorted(outcomes)) or "not reported"


def _converges(rows: Sequence[Row]) -> str:
    """Of the problems without loads, those in which the larger of the errors of λ₀ and r₀ falls and ends small."""
    errors: dict[str, dict[str, float]] = {}
    for row in rows:
        worst = [abs(error) for name in ("lambda0", "r0") if (error := row.score.error(name)) is not None]
        if _without_loads(problem(row.problem)) and worst:
            errors.setdefault(row.problem, {})[row.resolution] = max(worst)
    pairs = [(own.get(RESOLUTIONS[0]), own.get(RESOLUTIONS[-1])) for own in errors.values()]
    converged = [a is not None and b is not None and b <= max(a, CONVERGED / 10) and b < CONVERGED for a, b in pairs]
    return f"{sum(converged)} of {len(converged)} problems" if converged else "no result"
