"""The main job's result: every method matched with the theory, as one HTML page that needs no network.

``write_report`` computes the rows (:mod:`report.rows`) and a few impacts to look at (:mod:`report.impacts`), takes the
parameter studies, the sheets of work and precision and the map of whole impacts as they are stored, and has
:mod:`report.render` put all of it into the page. Whatever fails is named on the page, and the page is written all the
same.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from bent_beam.errors import ANY_FAILURE
from bent_beam.files import write_atomically
from bent_beam.method import Method, refined
from comparison.figures.work_precision import draw_work_precision
from comparison.match import match
from comparison.methods import default_methods
from comparison.rows import Question, failures
from comparison.store import RunStore
from comparison.tables import write_match
from comparison.whole_impact.figures import draw_map
from report.impacts import END, SHOWN, ShownImpact, show_all
from report.numbers import stored_numbers
from report.pipe import pipe_prediction
from report.render import Content, render
from report.rows import PATHS, convergence_rows, first_order_rows, leading_rows, report_questions
from report.stills import draw_acceleration, draw_maps
from report.studies import stored_studies
from report.summary import headline
from report.work import stored_measurements

__all__ = ["write_report"]

Progress = Callable[[int, int], None]


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

    warm_up(shown_methods)
    rows = match(asked, store=store, jobs=jobs, scheduler=scheduler, progress=lambda done, _: count(done))
    impacts, lost = show_all(
        SHOWN, shown_methods, store=store, jobs=jobs, progress=lambda done, _: count(len(asked) + done)
    )
    files = write_match(rows, out / "data")
    files += [f for f in draw_work_precision(convergence_rows(rows), out / "data") if f not in files]
    files += draw_map(out / "data") + still_pictures(impacts, out / "data")
    content = Content(
        rows=rows,
        impacts=impacts,
        lost_impacts=lost,
        pipe=pipe_prediction(),
        numbers=stored_numbers(),
        studies=stored_studies(),
        work=stored_measurements(),
        pictures=[f for f in files if f.suffix == ".png"],
        seconds=clock.perf_counter() - began,
        jobs=jobs,
    )
    index = out / "index.html"
    write_atomically(index, render(content))
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
        except ANY_FAILURE:  # whatever a method of somebody else's raises is the reason of its rows
            continue


def still_pictures(impacts: Sequence[ShownImpact], out: Path) -> list[Path]:
    """The impacts as still pictures, for paper and for readers without JavaScript."""
    return draw_maps(impacts, out) + draw_acceleration(impacts, out) if impacts else []
