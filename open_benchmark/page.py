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
from open_benchmark.figures import MEASURES, row_seconds, svg, work_precision_figures
from open_benchmark.problem import problem
from open_benchmark.properties import in_words, properties

__all__ = ["document", "errors_table", "write_page"]

TEMPLATES = Path(__file__).parent / "templates"
IN_SHORT = ("lambda0", "r0", "restitution", "impulse_error")  # of the table of errors, where no loads act


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
    wanted = ("lambda1", "r1") if problem(row.problem).kind == "first" else IN_SHORT
    errors = [f"{100 * error:+.3f}" for name in wanted if (error := _error(row, name)) is not None]
    if not errors:
        return row.score.brief
    seconds = row_seconds(row)
    return " / ".join(errors) + ("" if seconds is None else f" ({seconds:.2g})")


def _error(row: Row, name: str) -> float | None:
    """Relative error of one measured number; that of J(t) over time is measured itself, against nothing."""
    number = row.score.measured.get(name)
    return number.value if number is not None and name == "impulse_error" else row.score.error(name)


def _cell(row: Row, measure: str) -> str:
    found, error = row.score.measured.get(measure), row.score.error(measure)
    if found is None or found.value is None:
        return "–"
    return f"{found.value:.3g}" if error is None else f"{100 * error:+.3f} %"


def _sheet(rows: Sequence[Row], name: str, solvers: Sequence[str], out: Path) -> dict[str, Any]:
    """One problem's part of the page; its figures are written to ``out``, too."""
    own = [row for row in rows if row.problem == name]
    figures = {measure: svg(figure) for measure, figure in work_precision_figures(own, name, solvers).items()}
    for measure, text in figures.items():
        write_atomically(out / f"{name}-{measure}.svg", text)
    shown = [measure for measure in MEASURES if any(measure in row.score.measured for row in own)]
    return {
        "id": name,
        "words": in_words(problem(name)),
        "figures": list(figures.values()),
        "measures": [MEASURES[measure] for measure in shown],
        "rows": [(row, [_cell(row, measure) for measure in shown], row_seconds(row)) for row in own],
    }


def write_page(
    rows: Sequence[Row], adapters: Sequence[Adapter], out: Path, about: dict[str, Any] | None = None
) -> Path:
    """Write ``index.html``, the same as ``benchmark.json``, its errors as a table (``errors.md``) and its figures
    (``sheets/PROBLEM-MEASURE.svg``); returns the page. ``about`` : :func:`document` of both, if it is there."""
    about = about or document(rows, adapters)
    solvers = [a.name for a in adapters]
    versions = {row.solver: version for row in rows if (version := row.score.metadata.get("version"))}
    loader = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    html = loader.get_template("benchmark.html.j2").render(
        sheets=[_sheet(rows, name, solvers, out / "sheets") for name in dict.fromkeys(row.problem for row in rows)],
        solvers=about["solvers"],
        versions=versions,
        unlimited=sorted({row.unlimited for row in rows if row.unlimited}),
        adapters=[
            (a, solver["missing"], a.file.read_text(encoding="utf-8", errors="replace"))
            for a, solver in zip(adapters, about["solvers"], strict=True)
        ],
        minutes=sum(row.seconds for row in rows) / 60.0,
    )
    write_atomically(out / "benchmark.json", json.dumps(about, indent=1, allow_nan=False))
    write_atomically(out / "errors.md", errors_table(rows, solvers))
    write_atomically(out / "index.html", html)
    return out / "index.html"
