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
from matplotlib.figure import Figure

from comparison.store import write_atomically
from open_benchmark.adapter import RESOLUTIONS, Adapter
from open_benchmark.campaign import Row
from open_benchmark.problem import problem

__all__ = ["document", "properties", "work_precision_figure", "write_page"]

TEMPLATES = Path(__file__).parent / "templates"
MEASURES = {"lambda0": "λ₀", "r0": "r₀", "lambda1": "λ₁", "r1": "r₁", "restitution": "e", "impulse_error": "J(t)"}
CONVERGED = 0.002  # relative error on the finest mesh that a converging code reaches (the trial's strict codes do)
MARKS = "osD^vPX*<>hp"


def properties(rows: Sequence[Row], solver: str) -> dict[str, str]:
    """One code's column of the table: each answer from its own rows, "not reported" where these do not say."""
    own = [row for row in rows if row.solver == solver]
    done = [row for row in own if row.score.outcome.startswith("completed")]
    if not done:
        return {name: "no result" for name in PROPERTIES}
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
        alpha, psi, _, axial = asked.loads
        regime = "tension" if axial else "lift-off" if alpha + psi < 0.0 else "pressed"
        if regime == wanted:
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
}


def document(rows: Sequence[Row], adapters: Sequence[Adapter]) -> dict[str, Any]:
    """All of the page as JSON."""
    return {
        "format": "beam-impact benchmark 1",
        "machine": {"processor": platform.machine(), "python": platform.python_version()},
        "solvers": [
            {
                "name": a.name,
                "adapter": a.file.name,
                "installed": a.missing() is None,
                "packages": list(a.install) or ([a.debian] if a.debian else []),
                "properties": properties(rows, a.name),
            }
            for a in adapters
        ],
        "rows": [row.to_dict() for row in rows],
    }


def _seconds(row: Row) -> float | None:
    """Of the time loop as the adapter says, never more than the wall clock of the whole run."""
    said = row.score.seconds
    if said is None:
        return row.seconds or None
    return min(said, row.seconds) if row.seconds > 0.0 else said


def work_precision_figure(rows: Sequence[Row], name: str, solvers: Sequence[str]) -> Figure | None:
    """Relative error against seconds, a line a code, a panel a measured number; ``None`` when there is nothing."""
    own = [row for row in rows if row.problem == name]
    shown = [m for m in MEASURES if any(_point(row, m) for row in own)]
    if problem(name).kind == "first":
        shown = [m for m in shown if m in ("lambda1", "r1")]
    if not shown:
        return None
    figure = Figure(figsize=(4.4 * len(shown) + 1.6, 3.7), layout="constrained")
    axes = figure.subplots(1, len(shown), squeeze=False)[0]
    for axis, measure in zip(axes, shown):
        for k, solver in enumerate(solvers):
            points = sorted(p for row in own if row.solver == solver and (p := _point(row, measure)))
            if points:
                axis.loglog(
                    *zip(*points), marker=MARKS[k % len(MARKS)], ms=5, lw=1.2, color=f"C{k % 10}",
                    ls="-" if k < 10 else "--", label=solver,
                )  # fmt: skip
        axis.set(xlabel="time loop, s", ylabel=f"relative error of {MEASURES[measure]}")
        axis.grid(True, which="major", lw=0.4, color="0.85")
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right upper", frameon=False, fontsize=8)
    return figure


def _point(row: Row, measure: str) -> tuple[float, float] | None:
    found, seconds = row.score.measured.get(measure), _seconds(row)
    if found is None or found.difference is None or seconds is None or (found.theory == 0.0 and measure == "lambda0"):
        return None
    return seconds, max(abs(found.relative() or 0.0), 1e-7)


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


def write_page(rows: Sequence[Row], adapters: Sequence[Adapter], out: Path) -> Path:
    """Write ``index.html`` and ``benchmark.json``; returns the page."""
    solvers = [a.name for a in adapters]
    sheets = []
    for name in dict.fromkeys(row.problem for row in rows):
        figure = work_precision_figure(rows, name, solvers)
        own = [row for row in rows if row.problem == name]
        shown = [m for m in MEASURES if any(m in row.score.measured for row in own)]
        sheets.append(
            {
                "id": name,
                "figure": None if figure is None else _svg(figure),
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
        properties={s: properties(rows, s) for s in solvers},
        names=list(PROPERTIES),
        adapters=[(a, a.missing(), a.file.read_text(encoding="utf-8", errors="replace")) for a in adapters],
        versions={s: _version(rows, s) for s in solvers},
    )
    write_atomically(out / "benchmark.json", json.dumps(document(rows, adapters), indent=1, allow_nan=False))
    write_atomically(out / "index.html", html)
    return out / "index.html"


def _version(rows: Sequence[Row], solver: str) -> str:
    return next((str(v) for r in rows if r.solver == solver and (v := r.score.metadata.get("version"))), "")
