"""The main job's result: every method matched with the theory, as one HTML page that needs no network.

``write_report`` computes the rows (:mod:`comparison.report.rows`), a few impacts to look at
(:mod:`comparison.report.impacts`), the same impact with the thesis's settings (:mod:`comparison.report.noise`) and a
drill pipe in SI units (:mod:`comparison.report.pipe`), takes the parameter studies and the map of whole impacts as
they are stored, draws all of it (:mod:`comparison.report.plots`) and puts it into ``templates/report.html.j2`` with
plotly.js inside. Whatever fails is named on the page, and the page is written all the same.
"""

from __future__ import annotations

import base64
import json
import os
import platform
import time as clock
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from bent_beam.method import Method, refined
from bent_beam.versions import processor, versions
from comparison.figures.style import marks
from comparison.figures.work_precision import draw_work_precision
from comparison.match import MatchRow, Question, failures, match
from comparison.methods import default_methods
from comparison.predictor import panel
from comparison.report.guides import Guide, guides
from comparison.report.impacts import END, ENERGIES, ENERGY_STYLE, SHOWN, ShownImpact, show_all, theory_of
from comparison.report.noise import Noise, compare_noise, noise_methods
from comparison.report.pipe import Pipe, pipe_verdict
from comparison.report.plots import bounce_plot, noise_plots, plots
from comparison.report.rows import PATHS, convergence_rows, first_order_rows, labels, leading_rows, report_questions
from comparison.report.stills import draw_acceleration, draw_impact, draw_maps, draw_noise, grouped
from comparison.report.studies import StudyNote, stored_studies
from comparison.report.text import (
    acceleration_rows,
    acceleration_short,
    agreement_answer,
    edge_answer,
    headline,
    noise_answer,
    powers,
    problem_answer,
    speed_answer,
)
from comparison.report.work import StoredMeasurement, stored_measurements
from comparison.store import RunStore, write_atomically
from comparison.tables import write_match
from comparison.whole_impact.stored_map import stored_map

__all__ = ["Content", "machine", "page", "write_report"]

Progress = Callable[[int, int], None]
TEMPLATES = Path(__file__).resolve().parent / "templates"


@dataclass(frozen=True)
class Content:
    """All that the page shows. ``bounce`` : the stored map of whole impacts (:mod:`comparison.whole_impact.map`)."""

    rows: Sequence[MatchRow]
    impacts: Sequence[ShownImpact] = ()
    lost_impacts: Sequence[str] = ()
    noise: Noise | None = None
    pipe: Pipe | None = None
    bounce: Mapping[str, Any] | None = None
    studies: Sequence[StudyNote] = ()
    work: Sequence[StoredMeasurement] = ()
    pictures: Sequence[Path] = ()
    guides: Sequence[Guide] = ()
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
) -> dict[str, Any]:
    """Compute everything and write ``out/index.html``, with its rows and still pictures in ``out/data``.

    methods : to report on instead of one of each path. questions : rows to ask for instead of the usual ones.
    progress : called with (done, total) as rows finish.

    Returns ``page``, ``files``, ``headline``, ``failures`` (JSON-ready) and ``rows`` (their number).
    A row that fails is listed, not raised.
    """
    began = clock.perf_counter()
    shown_methods = default_methods(PATHS) if methods is None else list(methods)
    asked = list(report_questions(shown_methods) if questions is None else questions)
    total = len(asked) + len(SHOWN) * len(shown_methods) + 1

    def count(done: int) -> None:
        if progress is not None:
            progress(done, total)

    warm_up([*shown_methods, *noise_methods()])
    rows = match(asked, store=store, jobs=jobs, scheduler=scheduler, progress=lambda done, _: count(done))
    impacts, lost = show_all(
        SHOWN, shown_methods, store=store, jobs=jobs, progress=lambda done, _: count(len(asked) + done)
    )
    noise, lost_noise = compare_noise(store=store)  # a second or two: processes would take longer to start
    files = write_match(rows, out / "data") + draw_work_precision([r.row for r in convergence_rows(rows)], out / "data")
    files += still_pictures(impacts, noise, out / "data")
    content = Content(
        rows=rows,
        impacts=impacts,
        lost_impacts=[*lost, *lost_noise],
        noise=noise,
        pipe=pipe_verdict(),
        bounce=stored_map(),
        studies=stored_studies(),
        work=stored_measurements(),
        pictures=[f for f in files if f.suffix == ".png"],
        guides=guides(out),
        seconds=clock.perf_counter() - began,
        jobs=jobs,
        machine=machine(),
    )
    index = out / "index.html"
    write_atomically(index, page(content))
    count(total)
    return {
        "page": str(index),
        "files": [str(f) for f in [index, *files]],
        "headline": headline(leading_rows(rows), first_order_rows(rows), len(failures(rows))),
        "failures": [{"label": r.label, "kappa_over_nu": r.kappa_over_nu, "reason": r.reason} for r in failures(rows)],
        "rows": len(rows),
    }


def warm_up(methods: Sequence[Method]) -> None:
    """Run each method once, coarsely, so that kernels are compiled (and cached) before anything is timed.

    A method that fails here fails again in its rows, with its reason.
    """
    impact = SHOWN[0].impact
    for method in methods:
        try:
            (refined(method, 0.25) or method).simulate(impact, end_time=END * impact.time_scale, save=8)
        except Exception:  # whatever a method of somebody else's raises is the reason of its rows
            continue


def still_pictures(impacts: Sequence[ShownImpact], noise: Noise | None, out: Path) -> list[Path]:
    """The impacts as still pictures, for paper and for readers without JavaScript."""
    files = [file for shown, runs in grouped(impacts).items() for file in draw_impact(shown, runs, out)]
    files += draw_maps(impacts, out) + draw_acceleration(impacts, out) if impacts else []
    return files + (draw_noise(noise.before, noise.after, out) if noise else [])


def machine() -> dict[str, str]:
    """What the numbers were measured on."""
    return {
        "processor": processor(),
        "cores": str(os.cpu_count() or "unknown"),
        "system": f"{platform.system()} {platform.release()} ({platform.machine()})",
        "Python": platform.python_version(),
    }


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
    drawn = plots(leading, first, convergence_rows(content.rows))
    if content.noise is not None:
        drawn |= noise_plots(content.noise.before, content.noise.after)
    if content.bounce is not None:
        drawn["bounce"] = bounce_plot(content.bounce)
    return environment.get_template("report.html.j2").render(
        title=headline(leading, first, len(failures(content.rows))),
        problem=problem_answer(leading),
        agreement=agreement_answer(leading, first),
        speed=speed_answer(leading, first),
        acceleration=acceleration_rows(content.impacts),
        acceleration_short=acceleration_short(content.impacts),
        edge=edge_answer(content.impacts),
        noise=None if content.noise is None else noise_answer(content.noise),
        pipe=content.pipe,
        bounce=content.bounce,
        leading=leading,
        first=first,
        failures=[row for row in content.rows if row.reason],
        methods=labels(content.rows),
        colours={label: mark["color"] for label, mark in marks(labels(content.rows)).items()},
        warnings=[(r, w) for r in [*leading, *first] for w in r.row.warnings],
        energies=[
            {"title": title, **ENERGY_STYLE[name]}
            for name, title in ENERGIES.items()
            if any(any(i.data["energy"].get(name, ())) for i in content.impacts)
        ],
        groups=grouped(content.impacts),
        shown_methods=list(dict.fromkeys(i.label for i in content.impacts)),
        impact_warnings=[(i, w) for i in content.impacts for w in i.warnings],
        lost_impacts=content.lost_impacts,
        studies=[(note, powers(note.conclusion)) for note in content.studies],
        work=[(w, picture(w.picture)) for w in content.work if w.picture.exists()],
        study_dates=span_of([note.date for note in content.studies if note.date]),
        pictures={p.stem: picture(p) for p in content.pictures if p.exists()}
        | {f"study-{n.name}": picture(n.picture) for n in content.studies if n.picture.exists()},
        guides=content.guides,
        facts=facts(content),
        settings=settings(content),
        data={
            "plots": drawn,
            "energies": {name: {"title": title, **ENERGY_STYLE[name]} for name, title in ENERGIES.items()},
            "impacts": [impact_data(runs) for runs in grouped(content.impacts).values()],
        },
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


def impact_data(runs: Sequence[ShownImpact]) -> dict[str, Any]:
    """An impact as the page's script reads it: theory and every method on one timeline."""
    shown = runs[0].shown
    colours = marks(run.label for run in runs)
    return {
        "name": shown.name,
        "title": shown.title,
        "kappa": shown.kappa_over_nu,
        "epsilon": shown.epsilon,
        "theory": theory_of(shown),
        "methods": [{"label": run.label, "colour": colours[run.label]["color"], **run.data} for run in runs],
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


def span_of(dates: Sequence[str]) -> str:
    """When things of these dates (ISO) were measured: "on" the one day, or "from … to …"; empty without dates."""
    first, last = min(dates, default=""), max(dates, default="")
    return f"on {last}" if first == last and last else f"from {first} to {last}" if dates else ""


def plotly_version() -> str:
    import importlib.metadata

    return importlib.metadata.version("plotly")


def settings(content: Content) -> list[tuple[str, str]]:
    """Settings of the runs, as pairs of title and JSON text."""
    by_label = {r.label: r.settings for r in content.rows}
    found = [(f"Method: {label}", json.dumps(chosen, indent=1)) for label, chosen in by_label.items()]
    found += [
        (f"Shown impact: {i.label}, {i.shown.title}", json.dumps(dict(i.settings), indent=1)) for i in content.impacts
    ]
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
