"""``bentbeam sweep``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line import options
from comparison.command_line.options import emit, end_of_rows, path_names, progress, setting_names

__all__ = ["sweep"]


def sweep(
    case: options.CaseFile,
    vary: Annotated[
        list[str],
        typer.Option(
            metavar="TABLE.KEY=A:B:N|A,B,C",
            help="A key of the case file and its values: N evenly from A to B, or a list; repeatable.",
            autocompletion=setting_names,
        ),
    ],
    path: Annotated[
        str, typer.Option(help="hermite, exudyn or an installed one.", autocompletion=path_names)
    ] = "hermite",
    assignments: options.Set = None,
    jobs: options.ManyJobs = None,
    scheduler: options.Scheduler = None,
    out: Annotated[Path | None, typer.Option(help="Folder for the table (CSV, netCDF) and the figure.")] = None,
    fresh: options.Fresh = False,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Vary keys of a case: the whole impact of each, in a table.

    A row has the numbers of bentbeam bounce. One key gives curves with error bars, two a map. What is finished is kept.

    Example: bentbeam sweep cases/tube.toml --vary impact.velocity=0.5:2:4 --vary beam.sagitta=0.005,0.01,0.02 --out out
    """
    from math import prod

    from bent_beam.errors import InputError
    from comparison.doors import sweep as sweep_all
    from comparison.store import check_writable
    from comparison.sweeping import varied_from

    if out is not None:
        check_writable(out, folder=True)
    keys = [varied_from(text) for text in vary]
    asked, rows = dict(keys), prod(len(values) for _, values in keys)
    if len(asked) < len(keys):
        raise InputError("--vary: a key is given twice")
    how = {"assignments": assignments or (), "scheduler": scheduler, "fresh": fresh}
    with progress(f"{rows} rows", quiet) as bar:
        found = sweep_all(case, asked, path, jobs=jobs, progress=bar.count, **how)  # type: ignore[arg-type]
    emit(found.to_dict(), as_json, lambda: str(found))
    if out is not None:
        found.write(out)  # after the answer, which a full disk must not cost
    end_of_rows(found.rows)
