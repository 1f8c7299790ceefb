"""``bentbeam problem``."""

import json
from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line.options import Overwrite, check_out, names_of

problem_ids = names_of("bent_beam_programs.open_benchmark.problem:shipped_ids")


def problem(
    name: Annotated[
        str,
        typer.Argument(
            metavar="ID",
            help="leading-K, point-K, first-K-A-P-C[-N], bounce-K-D, elastic-wall-K-Z, elastic-stop-S, ball, bar, …",
            autocompletion=problem_ids,
        ),
    ],
    out: Annotated[
        Path | None, typer.Option(metavar="FILE.toml", help="Where to, .toml or .json; standard output when left out.")
    ] = None,
    overwrite: Overwrite = False,
) -> None:
    """Write a problem of the open benchmark as a file.

    Example: bentbeam problem leading-0.5 --out problem.toml
    """
    from bent_beam.files import write_atomically
    from bent_beam_programs.open_benchmark.problem import document, problem_text
    from bent_beam_programs.open_benchmark.problem import problem as problem_of

    asked = problem_of(name)
    text = json.dumps(document(asked), indent=1) if out and out.suffix == ".json" else problem_text(asked)
    check_out(out, overwrite)
    if out is None:
        print(text)
        return
    write_atomically(out, text)
