"""``bentbeam bounce``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from bent_beam.errors import InputError
from comparison.command_line import options
from comparison.command_line.options import emit, path_names, progress

if TYPE_CHECKING:
    from bent_beam.cases import Case
    from bent_beam.method import Method

__all__ = ["bounce"]


def bounce(
    case: Annotated[
        Path | None, typer.Argument(metavar="[CASE.toml]", help="Case file; or give --kappa-over-nu and --damping.")
    ] = None,
    kappa_over_nu: Annotated[
        float | None, typer.Option(help="κ/ν, with --damping, in place of a case (inf: one point).")
    ] = None,
    damping: Annotated[float | None, typer.Option(help="η/T*, damping time of the material; 0 gives a band.")] = None,
    path: Annotated[
        list[str] | None,
        typer.Option(
            help="hermite (default), exudyn or an installed one; repeatable: side by side.", autocompletion=path_names
        ),
    ] = None,
    assignments: options.Set = None,
    runs: Annotated[int, typer.Option(min=2, max=1000, help="Runs of the ensemble without damping.")] = 24,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the ensemble.")] = 15,
    hits: Annotated[int, typer.Option(min=1, max=20, help="Number of hits to follow under loads.")] = 1,
    out: Annotated[Path | None, typer.Option(help="Folder for document, picture and animation.")] = None,
    jobs: options.Jobs = 1,
    fresh: options.Fresh = False,
    verbose: options.Verbose = False,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Follow the whole impact to its last separation.

    Gives restitution, contact times, the largest moment and stress of the first hit, each with an error bar. A hit is a
    time of contact whose gaps are shorter than a period of the first mode. Between supports or walls: simulate.

    Example: bentbeam bounce --kappa-over-nu 2 --damping 0.01
    """
    from comparison.store import RunStore, check_writable

    paths = path or ["hermite"]
    asked = _asked(case, kappa_over_nu, damping, paths, assignments or ())
    if out is not None:
        check_writable(out, folder=True)
    from comparison.bouncing import bounce as follow  # SciPy: no refusal above waits for it
    from comparison.hits import OF_ONE_WALL, follow_hits, hits_table

    how: dict[str, Any] = {"runs": runs, "seed": seed, "jobs": jobs, "history": out is not None or hits > 1}
    how["store"], every = RunStore.usual(fresh), []
    for one, method in asked:
        with progress(f"{method.path}: the whole impact", quiet) as bar:
            every.append(follow(one, method, **how, progress=bar.fraction))
    found, (_, method) = every[0], asked[0]
    with progress("hits", quiet):
        followed = follow_hits(found.impact, method, hits, first=found.history) if hits > 1 else []
    rows = [{**vars(hit), "restitution": hit.restitution} for hit in followed]
    document, problem_of_files = found.to_dict(), ""
    if len(paths) > 1:
        document["paths"] = [{"path": name, **one.to_dict()} for name, one in zip(paths, every)]
    if hits > 1:
        document["hits"] = rows
    if out is not None:
        try:
            document["files"] = [str(file) for file in found.write(out, document)]
        except OSError as error:  # the answer is worth more than its files
            problem_of_files = f"--out: {error}"

    def text() -> str:
        tables = [one.text(verbose=verbose) for one in every]
        titled = tables if len(paths) == 1 else [f"{name}\n{table}\n" for name, table in zip(paths, tables)]
        return "\n".join([*titled, *(["", hits_table(rows, OF_ONE_WALL)] if rows else [])])

    emit(document, as_json, text)
    if problem_of_files:
        raise InputError(problem_of_files)


def _asked(
    case: Path | None, kappa_over_nu: float | None, damping: float | None, paths: list[str], assignments: Sequence[str]
) -> list[tuple[Case, Method]]:
    """The case, or that of the two numbers, with the method of each path."""
    from bent_beam.cases import load_case

    if (case is None) == (kappa_over_nu is None):
        raise InputError("bounce takes a case file or --kappa-over-nu, one of them")
    if case is not None:
        if damping is not None:
            raise InputError(f"--damping {damping!r} goes with --kappa-over-nu; in a case set beam.damping (s)")
        loaded = load_case(case, assignments)
        return [(loaded, loaded.method(path)) for path in paths]
    if damping is None:
        raise InputError("--damping is required next to --kappa-over-nu (eta/T*; 0 for none)")
    from comparison.bouncing import case_of, problem
    from comparison.methods import methods_of

    beam = case_of(problem(kappa_over_nu or 0.0, damping))
    return [(beam, method) for method in methods_of(paths, assignments)]
