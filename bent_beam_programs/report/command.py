"""``bentbeam report``."""

import os
from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line import options


def report(
    out: Annotated[Path, typer.Option(help="Folder to write into.")] = Path("out/report"),
    jobs: Annotated[int, typer.Option("--jobs", "-j", min=1, help="Processes on this machine.")] = os.cpu_count() or 1,
    scheduler: options.Scheduler = None,
    path: Annotated[
        list[str] | None,
        options.of_path("hermite, self_similar, exudyn or an installed one; repeatable. Default: these three."),
    ] = None,
    assignments: options.Set = None,
    methods: options.Methods = None,
    refine: options.Refine = "0.5,1",
    fresh: options.Fresh = False,
    overwrite: options.Overwrite = False,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Match methods with the theory; write one HTML page.

    Example: bentbeam report --out report --methods cases/methods/one_of_each.toml --refine 0.5,1,2
    """
    from bent_beam.errors import InputError
    from comparison.methods import chosen_methods
    from comparison.store import RunStore, check_writable

    try:
        from bent_beam_programs.report.page import write_report
        from bent_beam_programs.report.rows import PATHS, report_questions
    except ModuleNotFoundError as error:
        raise InputError(
            f"report: {error.name} is missing, of the extra [report] (pip install 'bent-beam-impact[report]')"
        ) from None

    page = out / "index.html"
    if page.exists() and not overwrite:
        raise InputError(f"--out: {page} exists already (give another folder, or --overwrite)")
    named = path or (() if methods else PATHS)
    chosen, refines = chosen_methods(named, assignments or (), methods or ()), options.factors(refine)
    check_writable(out, folder=True)
    store = RunStore.usual(fresh)
    with options.progress("report", quiet) as bar:
        asked = report_questions(chosen, refines)
        found = write_report(out, chosen, asked, store=store, jobs=jobs, scheduler=scheduler, progress=bar.count)
    options.emit(found, as_json, lambda: f"{found['headline']}\nReport: {page}")
    if found["failures"]:
        raise typer.Exit(3)
