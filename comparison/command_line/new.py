"""``bentbeam new``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line.options import Json, Overwrite, check_out, complete, emit

__all__ = ["new"]


def section_kinds(incomplete: str) -> list[str]:
    """Completion of ``--section``."""
    from bent_beam.section import SECTIONS

    return complete(list(SECTIONS), incomplete)


def new(
    out: Annotated[Path, typer.Argument(metavar="FILE.toml", help="Where to write the case.")] = Path("my_beam.toml"),
    section: Annotated[
        str, typer.Option(help="pipe, round_bar, rectangle or general.", autocompletion=section_kinds)
    ] = "pipe",
    damping_ratio: Annotated[
        float | None, typer.Option(min=0.0, help="Of the first bending mode; otherwise state it in the file.")
    ] = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> None:
    """Write a commented case file for a beam of your own.

    Example: bentbeam new my_pipe.toml --section pipe
    """
    from comparison.new_case import new_case
    from comparison.store import write_atomically

    text = new_case(section, damping_ratio)
    check_out(out, overwrite)
    write_atomically(out, text)
    emit(
        {"file": str(out), "section": section},
        as_json,
        lambda: f"{out}: change every number or delete its line, then bentbeam predict {out}",
    )
