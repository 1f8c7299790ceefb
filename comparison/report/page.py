"""The main job's result: both paths matched with the theory, as one HTML page that needs no network.

``write_report`` computes the rows (:mod:`comparison.report.rows`), a few impacts to look at
(:mod:`comparison.report.impacts`) and the studies, draws them (:mod:`comparison.report.plots`) and puts
them into ``templates/report.html.j2`` with plotly.js inside. Whatever fails is named on the page, with the
command that asks again; the page is written all the same.
"""

from __future__ import annotations

import base64
import json
import os
import platform
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from bent_beam.history import SimulationError, versions
from bent_beam.method import Method
from comparison.match import MatchRow, Question, failures, match
from comparison.predictor import panel
from comparison.report.impacts import SHOWN, Shown, ShownImpact, show
from comparison.report.plots import plots
from comparison.report.rows import first_order_rows, labels, leading_rows, report_questions
from comparison.report.studies import StudyNote, common_ending, known_studies, study_notes
from comparison.report.text import (
    acceleration_answer,
    acceleration_short,
    agreement_answer,
    headline,
    speed_answer,
)
from comparison.store import RunStore, write_atomically
from comparison.tables import write_match

__all__ = ["Content", "machine", "page", "write_report"]

Progress = Callable[[int, int], None]
TEMPLATES = Path(__file__).resolve().parent / "templates"


@dataclass(frozen=True)
class Content:
    """All that the page shows."""

    rows: Sequence[MatchRow]
    impacts: Sequence[ShownImpact] = ()
    lost_impacts: Sequence[str] = ()
    studies: Sequence[StudyNote] = ()
    pictures: Sequence[Path] = ()
    seconds: float = 0.0
    jobs: int = 1
    machine: dict[str, str] = field(default_factory=dict)


def write_report(
    out: Path,
    *,
    store: RunStore,
    jobs: int = 1,
    scheduler: str | None = None,
    progress: Progress | None = None,
    methods: Sequence[Method] | None = None,
    questions: Sequence[Question] | None = None,
    studies: bool = True,
) -> dict[str, Any]:
    """Compute everything and write ``out/index.html``, with its rows and still pictures in ``out/data``.

    methods : to report on instead of one of each path. questions : rows to ask for instead of the usual ones.
    studies : run the parameter studies too.
    progress : called with (done, total) as rows finish.

    Returns ``page``, ``files``, ``headline``, ``failures`` (JSON-ready) and ``rows`` (their number).
    A row that fails is listed, not raised.
    """
    began = clock.perf_counter()
    asked = list(report_questions(methods) if questions is None else questions)
    names = list(known_studies()) if studies else []
    total = len(asked) + len(SHOWN) + len(names)

    def count(done: int, _: int) -> None:
        if progress is not None:
            progress(done, total)

    rows = match(asked, store=store, jobs=jobs, scheduler=scheduler, progress=count)
    impacts, lost = shown_impacts(SHOWN)
    before = len(asked) + len(SHOWN)
    count(before, total)
    notes = study_notes(names, store=store, jobs=jobs, progress=lambda done, _: count(before + done, total))
    files = write_match(rows, out / "data")
    files += still_pictures(impacts, out / "data")
    content = Content(
        rows=rows,
        impacts=impacts,
        lost_impacts=lost,
        studies=notes,
        pictures=[f for f in files if f.suffix == ".png"],
        seconds=clock.perf_counter() - began,
        jobs=jobs,
        machine=machine(),
    )
    index = out / "index.html"
    write_atomically(index, page(content))
    return {
        "page": str(index),
        "files": [str(f) for f in [index, *files]],
        "headline": headline(leading_rows(rows), first_order_rows(rows), len(failures(rows))),
        "failures": [{"label": r.label, "kappa_over_nu": r.kappa_over_nu, "reason": r.reason} for r in failures(rows)],
        "rows": len(rows),
    }


def shown_impacts(wanted: Sequence[Shown]) -> tuple[list[ShownImpact], list[str]]:
    """The impacts to look at, and what could not be shown."""
    impacts, lost = [], []
    for shown in wanted:
        try:
            impacts.append(show(shown))
        except (SimulationError, ValueError, ArithmeticError) as error:
            lost.append(f"{shown.title}: {' '.join(str(error).split())}")
    return impacts, lost


def still_pictures(impacts: Sequence[ShownImpact], out: Path) -> list[Path]:
    """The impacts as still pictures, for paper and for readers without JavaScript."""
    from comparison.report.stills import draw_acceleration, draw_impact, draw_maps

    files = [file for impact in impacts for file in draw_impact(impact, out)]
    return files + (draw_maps(impacts, out) + draw_acceleration(impacts, out) if impacts else [])


def machine() -> dict[str, str]:
    """What the numbers were measured on."""
    return {
        "processor": processor(),
        "cores": str(os.cpu_count() or "unknown"),
        "system": f"{platform.system()} {platform.release()} ({platform.machine()})",
        "Python": platform.python_version(),
    }


def processor() -> str:
    """The processor's name as its maker gives it, where the system tells."""
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.lower().startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


# --- the page ---------------------------------------------------------------------------------------------


def page(content: Content) -> str:
    """The whole page as text. Nothing in it refers to anything outside it; every string is escaped."""
    from plotly.offline import get_plotlyjs

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    leading, first = leading_rows(content.rows), first_order_rows(content.rows)
    ending = common_ending(content.studies)
    return environment.get_template("report.html.j2").render(
        title=headline(leading, first, len(failures(content.rows))),
        agreement=agreement_answer(leading, first),
        speed=speed_answer(leading, first),
        acceleration=acceleration_answer(content.impacts),
        acceleration_short=acceleration_short(content.impacts),
        leading=leading,
        first=first,
        failures=[row for row in content.rows if row.reason],
        methods=labels(content.rows),
        warnings=[(r, w) for r in [*leading, *first] for w in r.row.warnings],
        impacts=content.impacts,
        lost_impacts=content.lost_impacts,
        studies=[(s, s.conclusion.removesuffix(ending).strip()) for s in content.studies],
        studies_ending=ending,
        pictures={p.stem: picture(p) for p in content.pictures if p.exists()},
        facts=facts(content),
        settings=settings(content),
        data={"plots": plots(leading, first), "impacts": [impact_data(i) for i in content.impacts]},
        plotly=inline_script(get_plotlyjs()),
        predictor=_predictor(),
        script=inline_script((TEMPLATES / "report.js").read_text(encoding="utf-8")),
        style=Markup((TEMPLATES / "report.css").read_text(encoding="utf-8")),
    )


def _predictor() -> dict[str, Markup]:
    """The panel for one's own beam."""
    own = panel()
    return {"markup": Markup(own.markup), "style": Markup(own.style), "script": inline_script(own.script)}


def inline_script(text: str) -> Markup:
    """Our own or plotly's script, safe between script tags."""
    return Markup(text.replace("</script", "<\\/script").replace("<!--", "<\\!--"))


def picture(file: Path) -> str:
    """A PNG as a data URL."""
    return "data:image/png;base64," + base64.b64encode(file.read_bytes()).decode("ascii")


def impact_data(impact: ShownImpact) -> dict[str, Any]:
    """An impact as the page's script reads it."""
    shown = impact.shown
    return {
        "name": shown.name,
        "title": shown.title,
        "kappa": shown.kappa_over_nu,
        "epsilon": shown.epsilon,
        **impact.data,
    }


def facts(content: Content) -> list[tuple[str, str]]:
    """Versions, machine and times, as pairs of name and value."""
    when = datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
    return [
        ("written", when),
        ("rows", f"{len(content.rows)} asked for, {len(failures(content.rows))} failed"),
        (
            "time for this report",
            f"{content.seconds:.0f} s with {content.jobs} process{'es' if content.jobs > 1 else ''}",
        ),
        (
            "time in the rows",
            f"{sum(r.seconds or 0.0 for r in content.rows):.0f} s (runs kept from before count what they took then)",
        ),
        *content.machine.items(),
        *versions().items(),
        ("plotly", plotly_version()),
    ]


def plotly_version() -> str:
    import importlib.metadata

    return importlib.metadata.version("plotly")


def settings(content: Content) -> list[tuple[str, str]]:
    """Settings of the runs, as pairs of title and JSON text."""
    by_label = {r.label: r.settings for r in content.rows}
    found = [(f"Method: {label}", json.dumps(chosen, indent=1)) for label, chosen in by_label.items()]
    found += [(f"Shown impact: {i.shown.title}", json.dumps(dict(i.settings), indent=1)) for i in content.impacts]
    epsilons = {
        f"{r.row.label}, kappa/nu = {r.row.kappa_over_nu:g}, {r.first_text}": [
            float(f"{e:.4g}") for e in r.row.epsilons
        ]
        for r in first_order_rows(content.rows)
    }
    if epsilons:
        found.append(
            (
                "First order: ε of the runs, chosen automatically",
                json.dumps(epsilons, indent=1, ensure_ascii=False),
            )
        )
    return found
