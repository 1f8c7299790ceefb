"""``bentbeam bounce``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from bent_beam.errors import InputError
from comparison.command_line.options import Fresh, Jobs, Json, Quiet, Set, Verbose, emit, path_names, progress

if TYPE_CHECKING:
    from bent_beam.impact import Impact
    from bent_beam.method import Method
    from bent_beam.section import Section

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
    assignments: Set = None,
    runs: Annotated[int, typer.Option(min=2, max=1000, help="Runs of the ensemble without damping.")] = 24,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the ensemble.")] = 15,
    hits: Annotated[int, typer.Option(min=1, max=20, help="Number of hits to follow under loads.")] = 1,
    out: Annotated[Path | None, typer.Option(help="Folder for document, figure and animation.")] = None,
    jobs: Jobs = 1,
    fresh: Fresh = False,
    verbose: Verbose = False,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Follow the whole impact to its last separation.

    Gives restitution, contact times, the largest moment and stress of the first hit, each with an error bar. A hit is a
    time of contact whose gaps are shorter than a period of the first mode. Between supports or walls: simulate.

    Example: bentbeam bounce --kappa-over-nu 2 --damping 0.01
    """
    from dataclasses import asdict

    from bent_beam.method import paths_with
    from comparison.bounce_text import bounce_document, bounce_table, hits_table
    from comparison.bouncing import bounce as follow
    from comparison.bouncing import follow_hits
    from comparison.store import RunStore, check_writable, default_store

    paths = path or ["hermite"]
    asked = [_asked(case, kappa_over_nu, damping, one, assignments or ()) for one in paths]
    for _, method, _, _ in asked:
        if not hasattr(method, "for_whole_beam"):
            able = " and ".join(paths_with("for_whole_beam"))
            raise InputError(f"path: {method.path} has no choices for the whole beam ({able} have)")
    if out is not None:
        check_writable(out, folder=True)
    how: dict[str, Any] = {"runs": runs, "seed": seed, "jobs": jobs}
    how["store"], how["history"] = RunStore(None if fresh else default_store()), out is not None or hits > 1
    every = []
    for impact, method, section, stated in asked:
        with progress(f"{method.path}: the whole impact", quiet) as bar:
            told: dict[str, Any] = {"section": section, "damping_stated": stated, "progress": bar.fraction}
            every.append(follow(impact, method, **how, **told))
    found, (_, method, _, _) = every[0], asked[0]
    with progress("hits", quiet):
        followed = follow_hits(found.impact, method, hits, first=found.history) if hits > 1 else []
    document, problem_of_files = bounce_document(found), ""
    if len(paths) > 1:
        document["paths"] = [{"path": name, **bounce_document(one)} for name, one in zip(paths, every)]
    if hits > 1:
        document["hits"] = [{**asdict(hit), "restitution": hit.restitution} for hit in followed]
    if out is not None:
        from comparison.figures.whole_impact import write_bounce

        try:
            document["files"] = [str(file) for file in write_bounce(found, out)]
        except OSError as error:  # the answer is worth more than its files
            problem_of_files = f"--out: {error}"

    def text() -> str:
        tables = [bounce_table(one, verbose=verbose) for one in every]
        titled = tables if len(paths) == 1 else [f"{name}\n{table}\n" for name, table in zip(paths, tables)]
        return "\n".join([*titled, *hits_table(followed)])

    emit(document, as_json, text)
    if problem_of_files:
        raise InputError(problem_of_files)


def _asked(
    case: Path | None, kappa_over_nu: float | None, damping: float | None, path: str, assignments: Sequence[str]
) -> tuple[Impact, Method, Section | None, bool]:
    """The impact, its method, its section and whether a damping is stated, from a case or from the two numbers."""
    from bent_beam.cases import load_case
    from comparison.bouncing import problem
    from comparison.methods import methods_of

    if (case is None) == (kappa_over_nu is None):
        raise InputError("bounce takes a case file or --kappa-over-nu, one of them")
    if case is not None:
        if damping is not None:
            raise InputError(f"--damping {damping!r} goes with --kappa-over-nu; in a case set beam.damping (s)")
        loaded = load_case(case, assignments)
        return loaded.impact, loaded.method(path), loaded.section, loaded.damping_stated
    if damping is None:
        raise InputError("--damping is required next to --kappa-over-nu (eta/T*; 0 for none)")
    return problem(kappa_over_nu or 0.0, damping), methods_of([path], assignments)[0], None, True
