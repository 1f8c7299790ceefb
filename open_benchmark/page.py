"""The benchmark's page: a work–precision sheet per problem, property × code, adapters' sources, how to enter.

HTML that needs no network, and the same in JSON.
"""

from __future__ import annotations

import io
import json
import platform
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import jinja2
import matplotlib
import numpy as np
from matplotlib.figure import Figure

from bent_beam.versions import processor
from comparison.store import write_atomically
from open_benchmark.adapter import RESOLUTIONS, Adapter
from open_benchmark.campaign import Row
from open_benchmark.judgement import Score
from open_benchmark.problem import Problem, problem

__all__ = ["document", "errors_table", "properties", "work_precision_figures", "write_page"]

TEMPLATES = Path(__file__).parent / "templates"
MEASURES = {"lambda0": "λ₀", "r0": "r₀", "lambda1": "λ₁", "r1": "r₁", "restitution": "e", "impulse_error": "J(t)"}
CONVERGED = 0.002  # relative error on the finest mesh that a converging code reaches (the trial's strict codes do)
MARKS = "osD^vPX*<>hp"


def properties(rows: Sequence[Row], solver: str) -> dict[str, str]:
    """One code's column of the table: each answer from its own rows, "not reported" where these do not say."""
    own = [row for row in rows if row.solver == solver]
    done = [row for row in own if row.score.outcome.startswith("completed")]
    if not done:
        why = {row.score.outcome.split("(")[0].replace("_", " ") for row in own}
        return {name: why.pop() if len(why) == 1 else "no result" for name in PROPERTIES}
    return {name: rule(own) for name, rule in PROPERTIES.items()}


def _done(rows: Sequence[Row], kinds: Sequence[str]) -> list[Row]:
    return [r for r in rows if r.score.outcome.startswith("completed") and problem(r.problem).kind in kinds]


def _converges(rows: Sequence[Row]) -> str:
    """Leading-order problems in which the larger of the errors of λ₀ and r₀ falls from coarse to fine and is small."""
    verdicts = []
    for name in dict.fromkeys(r.problem for r in _done(rows, ("leading", "point"))):
        own = [r for r in rows if r.problem == name]
        first, last = (_worst([r for r in own if r.resolution == k]) for k in (RESOLUTIONS[0], RESOLUTIONS[-1]))
        falls = first is not None and last is not None and last <= max(first, CONVERGED / 10)
        verdicts.append(falls and last is not None and last < CONVERGED)
    return "not reported" if not verdicts else f"{sum(verdicts)} of {len(verdicts)} problems"


def _worst(rows: Sequence[Row]) -> float | None:
    errors = [abs(e) for row in rows for n in ("lambda0", "r0") if (e := row.score.error(n)) is not None]
    return max(errors, default=None)


def _largest(rows: Sequence[Row], name: str, kinds: Sequence[str]) -> str:
    finest = [r for r in _done(rows, kinds) if r.resolution == RESOLUTIONS[-1]]
    values = [v for r in finest if (v := getattr(r.score, name)) is not None]
    return f"{max(values):.1e}" if values else "not reported"


def _unilateral(rows: Sequence[Row]) -> str:
    found = [r.score.adhesion for r in _done(rows, ("leading", "point")) if r.score.adhesion is not None]
    if not found:
        return "not reported"
    return "yes" if max(found) < 1e-6 else f"pulls up to {100 * max(found):.2g} % of J"


def _energy(rows: Sequence[Row]) -> str:
    found = [
        e["gained"] for r in _done(rows, ("leading", "point")) if (e := r.score.energy) and e["gained"] is not None
    ]
    if not found:
        return "not reported"
    return "never grows" if max(found) < 1e-6 else f"grows by up to {100 * max(found):.2g} % of JV₀"


def _first(rows: Sequence[Row], wanted: str) -> str:
    """First-order problems of one regime on the finest mesh: errors of λ₁ and r₁."""
    chosen = []
    for row in rows:
        asked = problem(row.problem)
        if asked.kind != "first" or row.resolution != RESOLUTIONS[-1]:
            continue
        if _regime(asked) == wanted:
            chosen.append(row)
    if not chosen:
        return "not asked"
    worst = [abs(e) for row in chosen for n in ("lambda1", "r1") if (e := row.score.error(n)) is not None]
    if not worst:
        return chosen[0].score.outcome.split("(")[0].replace("_", " ")
    return f"within {100 * max(worst):.2g} %"


PROPERTIES = {
    "converges": _converges,
    "unilateral": _unilateral,
    "energy": _energy,
    "noise": lambda rows: _largest(rows, "noise", ("leading", "point")),
    "lift": lambda rows: _largest(rows, "lift", ("leading",)),
    "first order, pressed": lambda rows: _first(rows, "pressed"),
    "first order, lift-off": lambda rows: _first(rows, "lift-off"),
    "first order, tension": lambda rows: _first(rows, "tension"),
    "first order, compression": lambda rows: _first(rows, "compression"),
}


def document(rows: Sequence[Row], adapters: Sequence[Adapter]) -> dict[str, Any]:
    """All of the page as JSON."""
    return {
        "format": "beam-impact benchmark 1",
        "machine": {"processor": processor(), "python": platform.python_version()},
        "seconds": sum(row.seconds for row in rows),
        "solvers": [
            {
                "name": a.name,
                "adapter": a.file.name,
                "installed": missing is None,
                "missing": missing,
                "packages": list(a.install) or ([a.debian] if a.debian else []),
                "properties": properties(rows, a.name),
            }
            for a, missing in [(a, a.missing()) for a in adapters]
        ],
        "rows": [row.to_dict() for row in rows],
    }


def in_words(asked: Problem) -> str:
    """A problem in words, for a heading."""
    front = f"infinite beam, κ/ν = {asked.kappa_over_nu:g}"
    if asked.kind == "first":
        alpha, psi, chi, axial = (f"{value:g}".replace("-", "−") for value in asked.loads)
        loads = f"(α, ψ, χ, n) = ({alpha}, {psi}, {chi}, {axial})"
        return f"{front}, first order in the loads {loads}: {_regime(asked)}"
    if asked.kind == "bounce":
        return f"free beam, κ/ν = {asked.kappa_over_nu:g}, damping η/T* = {asked.damping:g}, until it has left the wall"
    return {
        "leading": f"{front}: the contact spreads",
        "point": f"{front}: one point in contact",
        "stopped-beam": "free beam with damping, before the wall first lets go",
        "ball": "bouncing ball, ten elastic impacts",
        "bar": "elastic bar that meets the wall end on and leaves",
        "string": "string that lands on an obstacle all at once",
    }[asked.kind]


def _regime(asked: Problem) -> str:
    alpha, psi, _, axial = asked.loads
    if axial:
        return "tension" if axial > 0.0 else "compression"
    return "lift-off" if alpha + psi < 0.0 else "pressed"


def _seconds(row: Row) -> float | None:
    """Of the time loop as the adapter says, never more than the wall clock of the whole run."""
    said = row.score.seconds
    if said is None:
        return row.seconds or None
    return min(said, row.seconds) if row.seconds > 0.0 else said


def work_precision_figures(rows: Sequence[Row], name: str, solvers: Sequence[str]) -> dict[str, Figure]:
    """Measured number → relative error against seconds, a line a code from its coarse to its fine mesh.

    A faint line above a point ends at the error plus the error bar: what the result itself vouches for.
    """
    own = [row for row in rows if row.problem == name]
    shown = [m for m in MEASURES if any(_point(row, m) for row in own)]
    if problem(name).kind == "first":
        shown = [m for m in shown if m in ("lambda1", "r1")]
    return {measure: _panel(own, measure, solvers) for measure in shown}


def _panel(rows: Sequence[Row], measure: str, solvers: Sequence[str]) -> Figure:
    figure = Figure(figsize=(5.2, 4.3), layout="constrained")
    axis = figure.subplots()
    for k, solver in enumerate(solvers):
        own = sorted((r for r in rows if r.solver == solver), key=lambda r: _rank(r.resolution))
        points = [p for row in own if (p := _point(row, measure))]
        if points:
            seconds, errors, tops = zip(*points)
            color, style = f"C{k % 10}", "-" if k < 10 else "--"
            axis.vlines(seconds, errors, tops, color=color, lw=0.8, alpha=0.35)
            axis.loglog(
                seconds, errors, marker=MARKS[k % len(MARKS)], ms=5, lw=1.2, color=color, ls=style, label=solver
            )
    low, high = axis.get_ylim()
    axis.set_ylim(10.0 ** np.floor(np.log10(low)), 10.0 ** np.ceil(np.log10(high)))
    axis.set(xlabel="time loop, s", ylabel=f"relative error of {MEASURES[measure]}")
    axis.grid(True, which="major", lw=0.4, color="0.85")
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=8)
    return figure


def _rank(resolution: str) -> int:
    return RESOLUTIONS.index(resolution) if resolution in RESOLUTIONS else len(RESOLUTIONS)


def _point(row: Row, measure: str) -> tuple[float, float, float] | None:
    """Seconds, relative error, and that with the error bar on top."""
    found, seconds = row.score.measured.get(measure), _seconds(row)
    if found is None or found.difference is None or seconds is None or (found.theory == 0.0 and measure == "lambda0"):
        return None
    error = max(abs(found.relative() or 0.0), 1e-7)
    return seconds, error, error + (found.relative_error() or 0.0)


def _svg(figure: Figure) -> str:
    stream = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "beam-impact", "svg.fonttype": "path"}):
        figure.savefig(stream, format="svg", metadata={"Date": None})
    text = stream.getvalue()
    return text[text.index("<svg") :]


def _cell(row: Row, measure: str) -> str:
    found, error = row.score.measured.get(measure), row.score.error(measure)
    if found is None or found.value is None:
        return "–"
    return f"{found.value:.3g}" if error is None else f"{100 * error:+.3f} %"


def errors_table(rows: Sequence[Row], solvers: Sequence[str]) -> str:
    """Markdown: code × problem, errors in per cent from the coarse to the fine mesh, each with its time loop in s."""
    names = list(dict.fromkeys(row.problem for row in rows))
    lines = [f"| code | {' | '.join(f'`{name}`' for name in names)} |", "| --- " * (1 + len(names)) + "|"]
    for solver in solvers:
        cells = []
        for name in names:
            own = [row for row in rows if row.solver == solver and row.problem == name]
            cells.append("; ".join(dict.fromkeys(_in_short(row) for row in own)) or "not asked")
        lines.append(f"| {solver} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def _in_short(row: Row) -> str:
    first = problem(row.problem).kind == "first"
    wanted = ("lambda1", "r1") if first else ("lambda0", "r0", "restitution", "impulse_error")
    errors = [f"{100 * e:+.3f}" for name in wanted if (e := _error(row.score, name)) is not None]
    if not errors:
        return row.score.outcome.split("(")[0].replace("_", " ")
    seconds = _seconds(row)
    return " / ".join(errors) + ("" if seconds is None else f" ({seconds:.2g})")


def _error(found: Score, name: str) -> float | None:
    """Relative error of one measured number; that of J(t) over time is measured itself, against nothing."""
    number = found.measured.get(name)
    return found.error(name) if name != "impulse_error" or number is None else number.value


def write_page(
    rows: Sequence[Row], adapters: Sequence[Adapter], out: Path, about: dict[str, Any] | None = None
) -> Path:
    """Write ``index.html``, the same as ``benchmark.json``, its errors as a table (``errors.md``) and its figures
    (``sheets/PROBLEM-MEASURE.svg``); returns the page. ``about`` : what :func:`document` has said of them."""
    about = about or document(rows, adapters)
    solvers = [a.name for a in adapters]
    sheets = []
    for name in dict.fromkeys(row.problem for row in rows):
        figures = {m: _svg(figure) for m, figure in work_precision_figures(rows, name, solvers).items()}
        for measure, text in figures.items():
            write_atomically(out / "sheets" / f"{name}-{measure}.svg", text)
        own = [row for row in rows if row.problem == name]
        shown = [m for m in MEASURES if any(m in row.score.measured for row in own)]
        sheets.append(
            {
                "id": name,
                "words": in_words(problem(name)),
                "figures": list(figures.values()),
                "measures": [MEASURES[m] for m in shown],
                "rows": [(row, [_cell(row, m) for m in shown], _seconds(row)) for row in own],
            }
        )
    loader = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    html = loader.get_template("benchmark.html.j2").render(
        sheets=sheets,
        solvers=solvers,
        properties={said["name"]: said["properties"] for said in about["solvers"]},
        names=list(PROPERTIES),
        adapters=[
            (a, said["missing"], a.file.read_text(encoding="utf-8", errors="replace"))
            for a, said in zip(adapters, about["solvers"], strict=True)
        ],
        versions={s: _version(rows, s) for s in solvers},
        minutes=sum(row.seconds for row in rows) / 60.0,
    )
    write_atomically(out / "benchmark.json", json.dumps(about, indent=1, allow_nan=False))
    write_atomically(out / "errors.md", errors_table(rows, solvers))
    write_atomically(out / "index.html", html)
    return out / "index.html"


def _version(rows: Sequence[Row], solver: str) -> str:
    return next((str(v) for r in rows if r.solver == solver and (v := r.score.metadata.get("version"))), "")
