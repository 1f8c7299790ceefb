"""The benchmark's page: a work–precision sheet per problem, property × code, adapters' sources, how to enter.

HTML that needs no network, and the same in JSON.
"""

from __future__ import annotations

import json
import platform
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import jinja2

from bent_beam.files import write_atomically
from bent_beam.versions import processor
from open_benchmark.adapter import Adapter
from open_benchmark.campaign import Row
from open_benchmark.figures import MEASURES, svg, work_precision_figures
from open_benchmark.problem import problem
from open_benchmark.properties import in_words, properties

__all__ = ["document", "errors_table", "write_page"]

TEMPLATES = Path(__file__).parent / "templates"
IN_SHORT = (
    "lambda0",
    "r0",
    "restitution",
    "impulse_error",
    "peak_force",
    "peak_time",
)  # of the table of errors, where no loads act


def document(rows: Sequence[Row], adapters: Sequence[Adapter], seed: int | None = None) -> dict[str, Any]:
    """All of the page as JSON. ``seed`` : of the drawn problems."""
    return {
        "format": "beam-impact benchmark 2",
        "seed": seed,
        "machine": {"processor": processor(), "python": platform.python_version()},
        "seconds": sum((row.seconds or 0.0) * row.repeats for row in rows),
        "solvers": [
            {
                "name": a.name,
                "label": a.label,
                "host": a.host,
                "mesh and steps": a.chosen,
                "manual": [{"statement": statement, "page": page} for statement, page in a.manual],
                "adapter": a.file.name,
                "installed": missing is None,
                "missing": missing,
                "packages": a.packages,
                "properties": properties(rows, a.name),
            }
            for a, missing in [(a, a.missing()) for a in adapters]
        ],
        "rows": [row.to_dict() for row in rows],
    }


def errors_table(rows: Sequence[Row], solvers: Sequence[str]) -> str:
    """Markdown: code × problem, errors in per cent from the coarse to the fine mesh, each with its wall clock in s and
    the judge's words for it."""
    names = _names(rows)
    lines = [f"| code | {' | '.join(f'`{name}`' for name in names)} |", "| --- " * (1 + len(names)) + "|"]
    for solver in solvers:
        cells = []
        for name in names:
            own = [row for row in rows if row.solver == solver and row.problem == name]
            cells.append("; ".join(dict.fromkeys(_in_short(row) for row in own)) or "not asked")
        lines.append(f"| {solver} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def _in_short(row: Row) -> str:
    wanted = ("lambda1", "r1") if problem(row.problem).kind == "first" else IN_SHORT
    known = [_error(row, name) for name in wanted if name in row.score.measured]
    errors = ["–" if error is None else f"{100 * error:+.3f}" for error in known]
    if not any(error is not None for error in known):
        return row.score.brief
    words = row.score.outcome.partition(", ")[2]
    about = [] if row.seconds is None else [f"{row.seconds:.2g}"]
    return f"{' / '.join(errors)} ({', '.join([*about, *([words] if words else [])])})"


def _error(row: Row, name: str) -> float | None:
    """Relative error of one measured number; that of J(t) over time is measured itself, against nothing."""
    number = row.score.measured.get(name)
    return number.value if number is not None and name == "impulse_error" else row.score.error(name)


def _cell(row: Row, measure: str) -> str:
    found, error = row.score.measured.get(measure), row.score.error(measure)
    if found is None or found.value is None:
        return "–"
    return f"{found.value:.3g}" if error is None else f"{100 * error:+.3f} %"


def _sheets(rows: Sequence[Row], solvers: Sequence[str], out: Path) -> list[dict[str, Any]]:
    """The problems' parts of a table; their figures are written to ``out``, too."""
    return [_sheet([r for r in rows if r.problem == name], name, solvers, out) for name in _names(rows)]


def _names(rows: Sequence[Row]) -> list[str]:
    return list(dict.fromkeys(row.problem for row in rows))


def _sheet(own: Sequence[Row], name: str, solvers: Sequence[str], out: Path) -> dict[str, Any]:
    figures = {measure: svg(figure) for measure, figure in work_precision_figures(own, name, solvers).items()}
    for measure, text in figures.items():
        write_atomically(out / f"{name}-{measure}.svg", text)
    shown = [measure for measure in MEASURES if any(measure in row.score.measured for row in own)]
    return {
        "id": name,
        "words": in_words(problem(name)),
        "figures": list(figures.values()),
        "measures": [MEASURES[measure] for measure in shown],
        "rows": [(row, [_cell(row, measure) for measure in shown]) for row in own],
    }


def write_page(
    rows: Sequence[Row], adapters: Sequence[Adapter], out: Path, about: dict[str, Any] | None = None
) -> Path:
    """Write ``index.html``, the same as ``benchmark.json``, the errors of either table (``errors-TABLE.md``) and
    its figures (``sheets/TABLE/PROBLEM-MEASURE.svg``); returns the page. ``about`` : :func:`document` of both."""
    about = about or document(rows, adapters)
    solvers = list(dict.fromkeys([*(a.name for a in adapters), *(row.solver for row in rows)]))
    tables = {"verified": [r for r in rows if not r.unverified], "self-declared": [r for r in rows if r.unverified]}
    versions = {row.solver: version for row in rows if (version := row.score.metadata.get("version"))}
    loader = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    html = loader.get_template("benchmark.html.j2").render(
        tables={name: _sheets(own, solvers, out / "sheets" / name) for name, own in tables.items()},
        seed=about["seed"],
        solvers=about["solvers"],
        versions=versions,
        unlimited=sorted({row.unlimited for row in rows if row.unlimited}),
        adapters=[
            (a, solver["missing"], a.file.read_text(encoding="utf-8", errors="replace"))
            for a, solver in zip(adapters, about["solvers"], strict=True)
        ],
        minutes=about["seconds"] / 60.0,
    )
    write_atomically(out / "benchmark.json", json.dumps(about, indent=1, allow_nan=False))
    for name, own in tables.items():
        write_atomically(out / f"errors-{name}.md", errors_table(own, solvers))
    write_atomically(out / "index.html", html)
    return out / "index.html"
