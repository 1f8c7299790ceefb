"""The commands on whole impacts: ``bentbeam bounce``, and ``sweep``, of many cases."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from bent_beam.errors import InputError
from comparison.command_line import options
from comparison.command_line.options import end_of_rows, folder_for, of_path, progress, setting_names

if TYPE_CHECKING:
    from bent_beam import Case, Method


def bounce(
    case: Annotated[
        Path | None, typer.Argument(metavar="[CASE.toml]", help="Case file; or give --kappa-over-nu and --damping.")
    ] = None,
    kappa_over_nu: Annotated[
        float | None, typer.Option(help="κ/ν, with --damping, in place of a case (inf: one point).")
    ] = None,
    damping: Annotated[float | None, typer.Option(help="η/T*, damping time of the material; 0 gives a band.")] = None,
    path: Annotated[
        list[str] | None, of_path("hermite (default), exudyn or an installed one; repeatable: side by side.")
    ] = None,
    assignments: options.Set = None,
    runs: Annotated[
        int | None, typer.Option(min=2, max=1000, help="Runs of the ensemble without damping. Default: 24.")
    ] = None,
    seed: Annotated[int | None, typer.Option(min=0, help="Seed of the ensemble. Default: 15.")] = None,
    hits: Annotated[int, typer.Option(min=1, max=20, help="Number of hits to follow.")] = 1,
    out: Annotated[Path | None, folder_for("document, picture and animation")] = None,
    jobs: options.Jobs = 1,
    fresh: options.Fresh = False,
    verbose: options.Verbose = False,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Follow the whole impact to its last separation.

    Gives restitution, contact times, the largest moment and stress of the whole motion, each with an error bar. A hit
    is a time of contact whose gaps are shorter than a period of the first mode. Between supports or walls: simulate.

    Example: bentbeam bounce --kappa-over-nu 2 --damping 0.01
    """
    from comparison.store import RunStore, check_writable

    paths = path or ["hermite"]
    asked = _asked(case, kappa_over_nu, damping, paths, assignments or ())
    check_writable(out, folder=True)
    from comparison import bouncing  # SciPy: no refusal above waits for it
    from comparison.readable import hits_table
    from comparison.whole_numbers import OF_ONE_WALL

    how: dict[str, Any] = {"runs": runs, "seed": seed, "jobs": jobs}
    how["store"], every = RunStore.usual(fresh), []
    for one, method in asked:
        with progress(f"{method.path}: the whole impact", quiet) as bar:
            every.append(bouncing.bounce(one, method, **how, progress=bar.fraction))
    found, (_, method) = every[0], asked[0]
    document = found.to_dict()
    rows: list[dict[str, Any]] = []
    fewer: list[str] = []
    if len(paths) > 1:
        document["paths"] = [{"path": name, **one.to_dict()} for name, one in zip(paths, every)]
    if hits > 1:
        with progress("hits", quiet):
            followed, why = bouncing.followed_hits(found.impact, method, hits, first=found.history)
        rows = [{**vars(hit), "restitution": hit.restitution} for hit in followed]
        document["hits"] = rows
        fewer = [f"{len(rows)} of {hits} hits: {why}"] if len(rows) < hits else []
        document["warnings"] += fewer

    def write(folder: Path) -> None:
        document["files"] = [str(file) for file in found.write(folder, document)]

    def text() -> str:
        tables = [one.text(verbose=verbose) for one in every]
        titled = tables if len(paths) == 1 else [f"{name}\n{table}\n" for name, table in zip(paths, tables)]
        of = [f"Hits, {paths[0]}"] if len(paths) > 1 else []
        table = ["", *of, hits_table(rows, OF_ONE_WALL)] if rows else []
        made_up = "Of a beam with L/2 = EI = mu = V0 = 1 in SI units: N, ms and m are those of no real beam."
        said = [made_up] if case is None else []
        return "\n".join([*titled, *said, *table, *(f"warning: {line}" for line in fewer)])

    options.emit_with_files(document, as_json, text, out, write)


def _asked(
    case: Path | None, kappa_over_nu: float | None, damping: float | None, paths: list[str], assignments: Sequence[str]
) -> list[tuple["Case", "Method"]]:
    """The case, or that of the two numbers, with the method of each path."""
    from bent_beam.cases import load_case
    from comparison.methods import check_effect, methods_of

    if (case is None) == (kappa_over_nu is None):
        raise InputError("bounce takes a case file or --kappa-over-nu, one of them")
    if case is not None:
        if damping is not None:
            raise InputError(f"--damping {damping!r} goes with --kappa-over-nu; in a case set beam.damping (s)")
        loaded = load_case(case, assignments)
        check_effect(assignments, paths, {"run": "a whole impact ends with the last separation"}, "--set")
        return [(loaded, method) for method in methods_of(paths, (), loaded)]
    if damping is None:
        raise InputError("--damping is required next to --kappa-over-nu (eta/T*; 0 for none)")
    from comparison.bouncing import case_of, problem

    beam = case_of(problem(kappa_over_nu or 0.0, damping))
    return [(beam, method) for method in methods_of(paths, assignments)]


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
    path: Annotated[str, of_path("hermite, exudyn or an installed one.")] = "hermite",
    assignments: options.Set = None,
    jobs: options.ManyJobs = None,
    scheduler: options.Scheduler = None,
    out: Annotated[Path | None, folder_for("the table (CSV, netCDF) and the figure")] = None,
    fresh: options.Fresh = False,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Vary keys of a case: the whole impact of each, in a table.

    A row has the main numbers of bentbeam bounce. One key gives curves with error bars, two a map. What is finished is
    kept.

    Example: bentbeam sweep cases/tube.toml --vary impact.velocity=0.5:2:4 --vary beam.sagitta=0.005,0.01,0.02 --out out
    """
    from math import prod

    from comparison.doors import sweep as sweep_all
    from comparison.store import check_writable
    from comparison.sweeping import varied_from

    check_writable(out, folder=True)
    keys = [varied_from(text) for text in vary]
    asked, rows = dict[str, list[Any]](), prod(len(values) for _, values in keys)
    for key, values in keys:
        if key in asked:
            raise InputError(f"--vary {key} is given twice; leave one of them out")
        asked[key] = values
    how = {"assignments": assignments or (), "scheduler": scheduler, "fresh": fresh}
    with progress(f"{rows} rows", quiet) as bar:
        found = sweep_all(case, asked, path, jobs=jobs, progress=bar.count, **how)  # type: ignore[arg-type]
    options.emit_with_files(found.to_dict(), as_json, lambda: str(found), out, found.write)
    end_of_rows(found.rows)
