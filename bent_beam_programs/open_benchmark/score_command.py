"""``bentbeam score``."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comparison.command_line.options import Json, emit, printable

if TYPE_CHECKING:
    from bent_beam_programs.open_benchmark.judgement import Score


def score(
    results: Annotated[
        list[Path],
        typer.Argument(metavar="RESULT…", help="Results of any code: .npz, .csv beside .json, or a history (.nc)."),
    ],
    base: Annotated[
        Path | None, typer.Option(metavar="RESULT", help="The same code's result without loads, for λ₁ and r₁.")
    ] = None,
    as_json: Json = False,
) -> int:
    """Score results of any code against the exact solution.

    What is seen in each is listed with its figure, limit and where, and what its file cannot tell; a cause is named
    only where one symptom has one cause. Three results of one problem with the very same numbers are flagged.
    Exit code 2 when a result cannot be read; the others are scored all the same.

    Example: bentbeam score coarse.npz medium.npz fine.npz
    """
    from bent_beam_programs.open_benchmark.judgement import Score
    from bent_beam_programs.open_benchmark.reading import load_result
    from bent_beam_programs.open_benchmark.result import ResultError
    from bent_beam_programs.open_benchmark.score import resolution_ignored
    from bent_beam_programs.open_benchmark.score import score as score_of

    found, code = [], 0
    reference = None if base is None else load_result(base)
    for file in results:
        try:
            found.append(score_of(load_result(file), reference))
        except ResultError as error:
            found.append(Score("", "invalid", printable(str(error))))
        if found[-1].outcome == "invalid":
            reason = str(found[-1].reason)
            named = reason if reason.startswith(printable(str(file))) else f"{file}: {reason}"
            print(printable(f"error: {named}"), file=sys.stderr)
            code = 2
    found = resolution_ignored(found)
    document = found[0].to_dict() if len(found) == 1 else {"results": [s.to_dict() for s in found]}
    readable = [s for s in found if s.outcome != "invalid"]
    if as_json or readable:
        emit(document, as_json, lambda: "\n\n".join(_text(s) for s in readable))
    return code


def _text(found: "Score") -> str:
    why = "" if found.completed or not found.reason else f" ({found.reason})"
    lines = [f"{found.problem}: {found.outcome}{why}"]
    for name, value in found.measured.items():
        exact = "" if value.theory is None else f", exact {value.theory:.8g}"
        if name in found.reference:
            exact = f", reference {type(value)(value.theory, found.reference[name]['error'])}"
        error, bar = found.error(name), found.bar(name)
        about = "" if error is None else f" ({100 * error:+.3f}{'' if bar is None else f' ± {100 * bar:.2g}'} %)"
        lines.append(f"{name:>18} = {value}{exact}{about}")
    lines += [f"{name:>18} = {one.figure:.2g}" for name, one in found.readings.items() if one.figure is not None]
    lines += [f"seen: {symptom}" for symptom in found.symptoms]
    for needs in dict.fromkeys(found.not_told.values()):
        names = ", ".join(name.replace("_", " ") for name, field in found.not_told.items() if field == needs)
        lines.append(f"cannot be told without {needs}: {names}")
    for finding in found.diagnosis:
        lines.append(f"verdict: {finding.name.replace('_', ' ')}" + (f": {finding.advice}" if finding.advice else ""))
    return "\n".join(lines)
