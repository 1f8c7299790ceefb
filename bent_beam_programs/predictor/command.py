"""``bentbeam predictor``."""

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line.options import Overwrite, check_out, printable


def predictor(
    out: Annotated[Path, typer.Option(help="The page to write.")] = Path("predictor.html"),
    overwrite: Overwrite = False,
) -> None:
    """Write a web page that simulates an impact, offline.

    Example: bentbeam predictor --out predictor.html
    """
    from bent_beam_programs.predictor.page import write_page

    check_out(out, overwrite)
    print(printable(f"{write_page(out)}: open it in a browser"))
