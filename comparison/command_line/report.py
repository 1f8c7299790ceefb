"""``bentbeam report``."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line.console import Console
from comparison.command_line.options import Json, Overwrite, Quiet, Scheduler, emit

__all__ = ["report"]


def report(
    out: Annotated[Path, typer.Option(help="Folder to write into.")] = Path("report"),
    jobs: Annotated[int, typer.Option("--jobs", "-j", min=1, help="Processes on this machine.")] = max(
        1, os.cpu_count() or 1
    ),
    scheduler: Scheduler = None,
    methods: Annotated[
        Path | None, typer.Option(metavar="FILE.toml", help="Labelled methods to report on (see cases/methods/).")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Do not use runs kept from before.")] = False,
    overwrite: Overwrite = False,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Match all methods with the theory; write one HTML page.

    Example: bentbeam report --out report
    """
    from bent_beam.parts import InputError
    from comparison.methods import methods_from_file
    from comparison.report.page import write_report
    from comparison.store import RunStore, check_writable, default_store

    page = out / "index.html"
    if page.exists() and not overwrite:
        raise InputError(f"out: {page} exists already (give another folder, or --overwrite)")
    check_writable(out, folder=True)
    store = RunStore(None if fresh else default_store())
    with Console(quiet).progress("report") as bar:
        found = write_report(
            out,
            methods=None if methods is None else methods_from_file(methods),
            store=store,
            jobs=jobs,
            scheduler=scheduler,
            progress=bar.count,
        )
    emit(found, as_json, lambda: f"{found['headline']}\nReport: {page}")
    if found["failures"]:
        raise typer.Exit(3)
