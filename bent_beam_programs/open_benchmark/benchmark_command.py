"""``bentbeam benchmark``."""

from pathlib import Path
from typing import Annotated

import typer

from bent_beam_programs.open_benchmark.problem_command import problem_ids
from comparison.command_line.options import Json, Quiet, emit, names_of, progress, stated

solver_names = names_of("bent_beam_programs.open_benchmark.adapter:shipped_adapters")


def benchmark(
    context: typer.Context,
    solver: Annotated[
        list[str] | None, typer.Option(help="A shipped adapter; repeatable (all).", autocompletion=solver_names)
    ] = None,
    problem: Annotated[
        list[str] | None, typer.Option(metavar="ID", help="Repeatable (the standard set).", autocompletion=problem_ids)
    ] = None,
    adapter: Annotated[
        list[Path] | None, typer.Option(metavar="FILE", help="An adapter of your own; repeatable.")
    ] = None,
    out: Annotated[Path, typer.Option(metavar="DIR", help="Results and the page; resumed when it is there.")] = Path(
        "benchmark"
    ),
    result: Annotated[
        list[Path] | None,
        typer.Option(metavar="FILE", help="A result that was run elsewhere: it is self-declared; repeatable."),
    ] = None,
    seed: Annotated[int | None, typer.Option(min=0, help="Of the drawn problems (a new one, kept in --out).")] = None,
    seconds: Annotated[float, typer.Option(min=1.0, help="Wall seconds that one run may take.")] = 120.0,
    install: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="Make an adapter's environment from pinned versions, and stop; repeatable."),
    ] = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> int:
    """Run codes on the open benchmark and write one page.

    Each problem is solved at three resolutions (by shipped adapters on a given mesh, too), and one like it whose
    parameters are drawn now: one table has what was run here on these, with nodal histories and gaps; the rest is
    self-declared. An adapter that hangs, crashes, writes rubbish or is not installed is a row that says so. Runs
    that are there are not run again.

    Example: bentbeam benchmark --install scikit-fem
    """
    from bent_beam.errors import InputError
    from bent_beam_programs.open_benchmark.adapter import chosen_adapters
    from bent_beam_programs.open_benchmark.adapter import install as install_environment
    from bent_beam_programs.open_benchmark.campaign import STANDARD, campaign, declared_rows, drawn_once
    from bent_beam_programs.open_benchmark.page import document, write_page
    from bent_beam_programs.open_benchmark.problem import problem as problem_of
    from bent_beam_programs.open_benchmark.running import Limits
    from comparison.store import check_writable

    if install:
        if idle := stated(context, "solver", "problem", "adapter", "result", "seed", "out", "seconds", "quiet"):
            raise InputError(f"--install runs nothing: leave {idle[0]} out")
        lines = [install_environment(one) for one in chosen_adapters(install)]
        emit({"installed": lines}, as_json, lambda: "\n".join(lines))
        return 0
    adapters = chosen_adapters(solver or (), adapter or ())
    names = [problem_of(name).id for name in problem or STANDARD]
    check_writable(out, folder=True)
    rows = declared_rows(result or ())
    drawn = drawn_once(out, seed)
    with progress("benchmark", quiet) as bar:
        rows = campaign(adapters, names, out, limits=Limits(seconds=seconds), seed=drawn, progress=bar.count) + rows
    about = document(rows, adapters, drawn)
    page = write_page(rows, adapters, out, about)
    told = [f"{r.solver:>20} {r.problem:>22} {r.resolution:>7} {r.table:>13} {r.score.outcome}" for r in rows]
    lines = [f"seed of the drawn problems: {drawn}", *told, f"page: {page}"]
    emit({"page": str(page), **about}, as_json, lambda: "\n".join(lines))
    return 0
