"""``bentbeam gallery``."""

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line.options import Jobs, Json, Quiet, emit, names_of, printable, progress, stated

item_names = names_of("bent_beam_programs.thesis.gallery:ITEMS")


def gallery(
    context: typer.Context,
    ids: Annotated[
        list[str] | None,
        typer.Argument(help="Figures and tables by number, e.g. fig-3.29. Default: all.", autocompletion=item_names),
    ] = None,
    list_only: Annotated[bool, typer.Option("--list", help="List what there is.")] = False,
    out: Annotated[Path, typer.Option(help="Folder to write into.")] = Path("gallery"),
    format: Annotated[list[str], typer.Option(help="png, pdf or svg; repeatable.")] = ["png"],  # noqa: B006
    jobs: Jobs = 1,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Draw figures and tables of the thesis, each with its data.

    Example: bentbeam gallery fig-2.7a fig-3.29 --out out/gallery
    """
    import sys

    from bent_beam.errors import InputError
    from bent_beam_programs.thesis.gallery import ITEMS, draw_all, listing
    from comparison.store import check_writable

    idle = [*(repr(one) for one in ids or ()), *stated(context, "out", "format", "jobs", "quiet")]
    if list_only and idle:
        raise InputError(f"--list lists all and draws nothing: leave {idle[0]} out")
    if list_only:
        entries = listing()
        emit(entries, as_json, lambda: "\n".join(f"{e['id']:>10}  {e['title']}" for e in entries))
        return
    check_writable(out, folder=True)
    with progress("gallery", quiet) as bar:
        drawn, failures = draw_all(ids or list(ITEMS), out, formats=format, jobs=jobs, progress=bar.count)
    lines = "\n".join(f"{d['id']:>10}  {d['files'][0]}" for d in drawn)
    emit({"drawn": drawn, "failures": failures}, as_json, lambda: lines)
    for f in failures:
        print(printable(f"error: {f['id']}: {f['reason']}"), file=sys.stderr)
    if failures:
        raise typer.Exit(3)
