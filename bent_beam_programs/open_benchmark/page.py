"""The benchmark's page: a work–precision sheet per problem, property × code, adapters' sources, how to enter.

HTML that needs no network, and the same in JSON. A property is one number over the rows of one code. Figures show the
relative error against the seconds of the adapter's own loop, else of its process, a line a code from coarse to fine
mesh: a code has the same colour and mark in every figure; a point whose contact zone is lifted off is open, one whose
wall pulls is crossed out.
"""

import io
import json
import platform
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import jinja2
import matplotlib
import numpy as np
from matplotlib.figure import Figure

from bent_beam.files import write_atomically
from bent_beam.versions import processor
from bent_beam_programs.open_benchmark.adapter import GIVEN, RESOLUTIONS, Adapter, shipped_adapters
from bent_beam_programs.open_benchmark.campaign import Row
from bent_beam_programs.open_benchmark.judgement import LOADED, Score
from bent_beam_programs.open_benchmark.problem import LADDER, Problem, problem

MEASURES = {"lambda0": "λ₀", "r0": "r₀", "lambda1": "λ₁", "r1": "r₁", "restitution": "e", "impulse_error": "J(t)",
            "peak_force": "the largest force", "peak_time": "its time"}  # fmt: skip
MARKS = "osD^vP*<>hp8d"
SMALLEST = 1e-7  # relative error that a figure still shows
TEMPLATES = Path(__file__).parent / "templates"
CONVERGED = 0.002  # relative error on the finest mesh that a converging code reaches (strict codes do)

WORDS = {
    "leading": "infinite beam: the contact spreads",
    "point": "infinite beam: one point in contact",
    "first": "infinite beam, first order in the loads",
    "bounce": "free beam with damping, until it has left the wall",
    "stopped-beam": "free beam with damping, before the wall first lets go",
    "elastic-wall": "infinite beam on a wall that gives way",
    "elastic-stop": "hinged beam swung on a stop",
} | {name: rung.words for name, rung in LADDER.items()}


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
                "label": f"{a.name} (host)" if a.host else a.name,
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
    """Markdown: code × problem, errors ± bars in per cent from the coarse to the fine mesh, each with seconds of solver
    and process, and the judge's words for it."""
    names = dict.fromkeys(row.problem for row in rows)
    lines = [f"| code | {' | '.join(f'`{name}`' for name in names)} |", "| --- " * (1 + len(names)) + "|"]
    for solver in solvers:
        cells = []
        for name in names:
            own = [row for row in rows if row.solver == solver and row.problem == name]
            cells.append("; ".join(dict.fromkeys(_in_short(row) for row in own)) or "not asked")
        lines.append(f"| {solver} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def _in_short(row: Row) -> str:
    wanted = LOADED if problem(row.problem).kind == "first" else MEASURES
    known = [name for name in wanted if name in row.score.measured]
    if not any(_error(row, name) is not None for name in known):
        return row.score.brief
    words = row.score.outcome.split(", ")[1:]
    seconds = " of ".join(f"{s:.2g}" for s in (row.solver_seconds, row.seconds) if s is not None)
    about = filter(None, [seconds, *(word for word in words if not word.startswith("within"))])  # the bars say it
    return f"{' / '.join(_cell(row, name) for name in known)} ({', '.join(about)})"


def _error(row: Row, name: str) -> float | None:
    """Relative error of one measured number; that of J(t) over time is measured itself, against nothing."""
    number = row.score.measured.get(name)
    return number.value if number is not None and name == "impulse_error" else row.score.error(name)


def _cell(row: Row, measure: str) -> str:
    """Relative error ± bar in per cent; the number itself where nothing exact is known."""
    found, error = row.score.measured.get(measure), _error(row, measure)
    if found is None or found.value is None:
        return "–"
    if error is None:
        return str(found)
    bar = row.score.bar(measure)
    return f"{100 * error:+.3f}" + ("" if bar is None else f" ± {100 * bar:.2g}")


def _sheet(rows: Sequence[Row], name: str, solvers: Sequence[str], out: Path) -> dict[str, Any]:
    """A problem's part of a table; its figures are written to ``out``, too."""
    own = [row for row in rows if row.problem == name]
    wanted = LOADED if problem(name).kind == "first" else MEASURES
    figures = {m: _svg(_figure(own, m, solvers)) for m in wanted if any(_point(row, m) for row in own)}
    for measure, text in figures.items():
        write_atomically(out / f"{name}-{measure}.svg", text)
    shown = [measure for measure in MEASURES if any(measure in row.score.measured for row in own)]
    return {
        "id": name,
        "words": WORDS[problem(name).kind],
        "figures": list(figures.values()),
        "measures": [MEASURES[measure] for measure in shown],
        "rows": [(row, [_cell(row, measure) for measure in shown]) for row in own],
    }


def _regime(asked: Problem) -> str:
    """Which loads act on an infinite beam."""
    alpha, psi, _, axial = asked.loads
    if axial:
        return "tension" if axial > 0.0 else "compression"
    return "lift-off" if alpha + psi < 0.0 else "pressed"


def write_page(
    rows: Sequence[Row], adapters: Sequence[Adapter], out: Path, about: dict[str, Any] | None = None
) -> Path:
    """Write ``index.html``, the same as ``benchmark.json``, the errors of either table (``errors-TABLE.md``, and
    ``errors-TABLE-given.md`` on the given mesh) and its figures (``sheets/TABLE/PROBLEM-MEASURE.svg``); returns the
    page. ``about`` : :func:`document` of both."""
    about = about or document(rows, adapters)
    solvers = list(dict.fromkeys([*(a.name for a in adapters), *(row.solver for row in rows)]))
    tables = {name: [row for row in rows if row.table == name] for name in ("run here", "self-declared")}
    places = {name: name.replace(" ", "-") for name in tables}
    loader = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    html = loader.get_template("benchmark.html.j2").render(
        tables={
            table: [
                _sheet(own, name, solvers, out / "sheets" / places[table])
                for name in dict.fromkeys(row.problem for row in own)
            ]
            for table, own in tables.items()
        },
        seed=about["seed"],
        solvers=about["solvers"],
        versions={row.solver: version for row in rows if (version := row.score.metadata.get("version"))},
        unlimited=sorted({row.unlimited for row in rows if row.unlimited}),
        sources={a.name: a.file.read_text(encoding="utf-8", errors="replace") for a in adapters},
        minutes=about["seconds"] / 60.0,
    )
    write_atomically(out / "benchmark.json", json.dumps(about, indent=1, allow_nan=False))
    for name, own in tables.items():
        for mesh, given in (("", False), ("-given", True)):
            shown = [row for row in own if (row.resolution == GIVEN) == given]
            write_atomically(out / f"errors-{places[name]}{mesh}.md", errors_table(shown, solvers))
    write_atomically(out / "index.html", html)
    return out / "index.html"


class Property(NamedTuple):
    """The largest of ``numbers`` of the scores of the problems of some kinds, with loads of one regime, at the
    finest resolution alone or at all."""

    numbers: Callable[[Score], Iterable[float | None]]
    kinds: Sequence[str]
    regime: str = ""
    finest: bool = True

    def counts(self, row: Row) -> bool:
        asked = problem(row.problem)
        fits = asked.kind in self.kinds and self.regime in ("", _regime(asked))
        return fits and row.resolution in (RESOLUTIONS[-1:] if self.finest else (*RESOLUTIONS, GIVEN))


WITHOUT_LOADS = ("leading", "point")
PROPERTIES = {
    "unilateral": Property(lambda found: [found.figure("pull")], WITHOUT_LOADS, finest=False),
    "energy": Property(lambda found: [found.figure("energy")], WITHOUT_LOADS, finest=False),
    "noise": Property(lambda found: [found.figure("noise_in_time")], WITHOUT_LOADS),
    "lift": Property(lambda found: [found.figure("lift")], ("leading",)),
} | {
    f"first order, {regime}": Property(lambda found: [found.error(name) for name in LOADED], ("first",), regime)
    for regime in ("pressed", "lift-off", "tension", "compression")
}


def properties(rows: Sequence[Row], solver: str) -> dict[str, str]:
    """One code's column of the table."""
    own = [row for row in rows if row.solver == solver]
    return {"converges": _converges(own), **{name: _largest(own, rule) for name, rule in PROPERTIES.items()}}


def _largest(rows: Sequence[Row], rule: Property) -> str:
    """The number, the outcome where no row has a result, or why there is none."""
    chosen = [row for row in rows if rule.counts(row)]
    if not chosen:
        return "not asked"
    numbers = [abs(number) for row in chosen for number in rule.numbers(row.score) if number is not None]
    if numbers:
        return f"{max(numbers):.1e}" if any(numbers) else "0"
    return " or ".join(sorted({row.score.brief for row in chosen if not row.score.completed})) or "not reported"


def _converges(rows: Sequence[Row]) -> str:
    """Of the problems without loads, those in which the larger of the errors of λ₀ and r₀ falls and ends small."""
    errors: dict[str, dict[str, float]] = {}
    for row in rows:
        worst = [abs(error) for name in ("lambda0", "r0") if (error := row.score.error(name)) is not None]
        if problem(row.problem).kind in WITHOUT_LOADS and worst:
            errors.setdefault(row.problem, {})[row.resolution] = max(worst)
    pairs = [(own.get(RESOLUTIONS[0]), own.get(RESOLUTIONS[-1])) for own in errors.values()]
    converged = [a is not None and b is not None and b <= max(a, CONVERGED / 10) and b < CONVERGED for a, b in pairs]
    return f"{sum(converged)} of {len(converged)} problems" if converged else "no result"


def _figure(rows: Sequence[Row], measure: str, solvers: Sequence[str]) -> Figure:
    """Of one number. A faint line above a point ends at the error plus the error bar."""
    figure = Figure(figsize=(5.2, 4.3), layout="constrained")
    axis = figure.subplots()
    styles = {name: k for k, name in enumerate([*shipped_adapters(), *sorted(set(solvers) - set(shipped_adapters()))])}
    for solver in solvers:
        k = styles[solver]
        own = [r for name in RESOLUTIONS for r in rows if r.solver == solver and r.resolution == name]
        points = [p for row in own if (p := _point(row, measure))]
        if points:
            seconds, errors, tops = zip(*points)
            color, style = f"C{k % 10}", "-" if k < 10 else "--"
            axis.vlines(seconds, errors, tops, color=color, lw=0.8, alpha=0.35)
            point: dict[str, Any] = {"marker": MARKS[k % len(MARKS)], "color": color}
            axis.loglog(seconds, errors, ms=5, lw=1.2, ls=style, label=solver, **point)
            looks = {"lifted": point | {"mfc": "white"}, "adhesive": {"marker": "x", "color": "k"}}
            for word, look in looks.items():
                marked = [p[:2] for row in own if word in row.score.outcome and (p := _point(row, measure))]
                axis.loglog(*np.array(marked).reshape(-1, 2).T, ls="", ms=5, **look)
    for (low, high), bound in ((axis.get_ylim(), axis.set_ylim), (axis.get_xlim(), axis.set_xlim)):
        bound(10.0 ** np.floor(np.log10(low)), 10.0 ** np.ceil(np.log10(high)))
    axis.xaxis.set_minor_formatter("")
    axis.set_xlabel("seconds of the time loop (of the process where not reported)")
    axis.set_ylabel(f"relative error of {MEASURES[measure]}")
    axis.grid(True, which="major", lw=0.4, color="0.85")
    axis.spines[["top", "right"]].set_visible(False)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=8)
    return figure


def _point(row: Row, measure: str) -> tuple[float, float, float] | None:
    """Seconds, relative error, and that with the error bar on top."""
    found, seconds = row.score.measured.get(measure), row.solver_seconds or row.seconds
    if found is None or found.difference is None or seconds is None or (found.theory == 0.0 and measure == "lambda0"):
        return None
    error = max(abs(found.relative() or 0.0), SMALLEST)
    return seconds, error, error + (found.relative_bar() or 0.0)


def _svg(figure: Figure) -> str:
    """The figure as an SVG element, the same bits for the same numbers."""
    stream = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "beam-impact", "svg.fonttype": "path"}):
        figure.savefig(stream, format="svg", metadata={"Date": None})
    text = stream.getvalue()
    return text[text.index("<svg") :]
