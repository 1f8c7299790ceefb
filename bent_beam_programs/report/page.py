"""The main job's result: every method matched with the theory, as one HTML page that needs no network.

The page tells the story first: the problem, the answer, how well each path has it, the verdicts on the thesis, what to
believe; then numbers and studies. The parameter studies, the printed numbers and the sheets of work and precision are
taken as they are stored. Whatever fails is named on the page, and the page is written all the same.
"""

import base64
import io
import json
import os
import platform
import time as clock
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup
from PIL import Image

from bent_beam.errors import ANY_FAILURE
from bent_beam.files import write_atomically
from bent_beam.method import Method, refined
from bent_beam.versions import processor, versions
from bent_beam_programs.report.impacts import END, ENERGIES, SHOWN, ShownImpact, acceleration_rows, show_all, theory_of
from bent_beam_programs.report.rows import first_order_rows, headline, labels, leading_rows, percent, summary
from bent_beam_programs.report.stills import draw_acceleration, draw_maps, grouped
from bent_beam_programs.report.studies import stored_numbers, stored_studies
from bent_beam_programs.report.whole import COLUMNS, pipe_prediction
from bent_beam_programs.report.work import stored_measurements
from comparison.figures.matching import write_match
from comparison.figures.style import marks
from comparison.matching import match
from comparison.rows import MatchQuestion, MatchRow, failures
from comparison.store import RunStore

TEMPLATES = Path(__file__).resolve().parent / "templates"


@dataclass(frozen=True)
class Content:
    rows: Sequence[MatchRow]
    impacts: Sequence[ShownImpact] = ()
    lost_impacts: Sequence[str] = ()
    pipe: Mapping[str, Any] | None = None
    numbers: Mapping[str, Any] | None = None
    studies: Sequence[Mapping[str, Any]] = ()
    work: Sequence[Mapping[str, Any]] = ()
    pictures: Sequence[Path] = ()
    seconds: float = 0.0
    jobs: int = 1


def write_report(
    out: Path,
    methods: Sequence[Method],
    questions: Sequence[MatchQuestion],
    *,
    store: RunStore,
    jobs: int = 1,
    scheduler: str | None = None,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> dict[str, Any]:
    """Compute everything and write ``out/index.html``, with its rows and still pictures in ``out/data``. Returns
    ``page``, ``files``, ``headline``, ``failures`` (JSON-ready) and ``rows`` (their number). A row that fails is
    listed, not raised."""
    began = clock.perf_counter()
    asked = len(questions)
    total = asked + len(SHOWN) * len(methods) + 1
    warm_up(methods)
    where: dict[str, Any] = {"jobs": jobs} if scheduler is None else {"scheduler": scheduler}
    rows = match(questions, store=store, **where, progress=lambda done, _: progress(done, total))
    impacts, lost = show_all(
        SHOWN, methods, store=store, jobs=jobs, progress=lambda done, _: progress(asked + done, total)
    )
    files = write_match(rows, out / "data")
    if impacts:  # for paper and for readers without JavaScript
        files += draw_maps(impacts, out / "data") + draw_acceleration(impacts, out / "data")
    content = Content(
        rows=rows,
        impacts=impacts,
        lost_impacts=lost,
        pipe=pipe_prediction(store=store),
        numbers=stored_numbers(),
        studies=stored_studies(),
        work=stored_measurements(),
        pictures=[f for f in files if f.suffix == ".png"],
        seconds=clock.perf_counter() - began,
        jobs=jobs,
    )
    index = out / "index.html"
    write_atomically(index, render(content))
    progress(total, total)
    failed = failures(rows)
    return {
        "page": str(index),
        "files": [str(f) for f in [index, *files]],
        "headline": headline(leading_rows(rows), first_order_rows(rows), len(failed)),
        "failures": [{"label": r.label, "kappa_over_nu": r.kappa_over_nu, "reason": r.reason} for r in failed],
        "rows": len(rows),
    }


def warm_up(methods: Sequence[Method]) -> None:
    """Run each method once, coarsely, so that kernels are compiled (and cached) before anything is timed. A method that
    fails here fails again in its rows, with its reason."""
    impact = SHOWN[0].impact
    for method in methods:
        with suppress(*ANY_FAILURE):  # whatever a method of somebody else's raises is the reason of its rows
            (refined(method, 0.25) or method).simulate(impact, end_time=END * impact.time_scale, save=8)


def render(content: Content) -> str:
    """The whole page as text. Nothing in it refers to anything outside it; every string is escaped."""
    rules: dict[str, Any] = {"undefined": jinja2.StrictUndefined, "trim_blocks": True, "lstrip_blocks": True}
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, **rules)
    environment.filters |= {"percent": percent, "picture": picture}
    leading, first = leading_rows(content.rows), first_order_rows(content.rows)
    methods, groups = labels(content.rows), grouped(content.impacts)
    settings = {f"Method: {row.label}": row.settings for row in content.rows}
    settings |= {f"Shown impact: {i.label}, {i.shown.title}": dict(i.settings) for i in content.impacts}
    return environment.get_template("report.html.j2").render(
        content=content,
        headline=headline(leading, first, len(failures(content.rows))),
        summary=summary(leading, first),
        leading=leading,
        first=first,
        failures=[row for row in content.rows if row.reason],
        warnings=[(r, w) for r in [*leading, *first] for w in r.row.warnings],
        methods=methods,
        colours={label: mark["color"] for label, mark in marks(methods).items()},
        groups=groups,
        shown_methods=list(dict.fromkeys(i.label for i in content.impacts)),
        acceleration=acceleration_rows(content.impacts),
        pipe_headings=[heading for heading, _ in COLUMNS.values()],
        pictures={file.stem: picture(file) for file in content.pictures},
        caption_of=lambda name, title: f"{name.replace('fig-', 'Fig. ').replace('extra-', 'Its ')}: {title}",
        facts=facts(content),
        settings={title: json.dumps(value, indent=1, ensure_ascii=False) for title, value in settings.items()},
        data={"energies": ENERGIES, "impacts": [impact_data(runs) for runs in groups.values()]},
        script=Markup((TEMPLATES / "report.js").read_text(encoding="utf-8")),
        style=Markup((TEMPLATES / "report.css").read_text(encoding="utf-8")),
    )


def picture(file: Path) -> str:
    """A PNG as a data URL, smaller and without loss; empty where there is none."""
    if not file.exists():
        return ""
    stream = io.BytesIO()
    with Image.open(file) as image:
        image.convert("RGB").save(stream, format="WEBP", lossless=True)
    return "data:image/webp;base64," + base64.b64encode(stream.getvalue()).decode("ascii")


def impact_data(runs: Sequence[ShownImpact]) -> dict[str, Any]:
    """An impact as the page's script reads it: theory and every method on one timeline."""
    colours, methods = marks(run.label for run in runs), []
    for run in runs:
        drawn = {name: values for name, values in run.data.items() if name != "map"}  # it is a still
        methods.append({"label": run.label, "colour": colours[run.label]["color"]} | drawn)
    return {"theory": theory_of(runs[0].shown), "methods": methods}


def facts(content: Content) -> dict[str, str]:
    return {
        "written": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "rows": f"{len(content.rows)} asked for, {len(failures(content.rows))} failed",
        "time for this report": f"{content.seconds:.0f} s, {content.jobs} processes at most",
        "time in the rows": f"{sum(r.seconds or 0.0 for r in content.rows):.0f} s "
        "(runs kept from before count what they took then)",
        "processor": processor(),
        "cores": str(os.cpu_count() or "unknown"),
        "system": f"{platform.system()} {platform.release()} ({platform.machine()})",
        "Python": platform.python_version(),
        **versions(),
    }
