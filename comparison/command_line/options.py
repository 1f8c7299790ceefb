"""Options that several commands share, and how progress and a result are shown."""

import logging
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from pkgutil import resolve_name
from typing import Annotated, Any

import typer

from bent_beam.errors import InputError


def names_of(where: str, *first: str) -> Callable[[str], list[str]]:
    """Completion of an option: ``first``, then the names in ``module:object``, which is called if it is a function. It
    is imported only when a shell asks."""

    def complete(incomplete: str) -> list[str]:
        found = resolve_name(where)
        known = sorted(found() if callable(found) else found)
        return [name for name in (*first, *known) if name.startswith(incomplete)]

    return complete


def setting_names(incomplete: str) -> list[str]:
    """Completion of ``--set``: every setting, and the kinds of each part."""
    from bent_beam.settings import settings

    known = {f"{s.table}.kind={s.kind}" if s.name == "kind" else f"{s.table}.{s.name}=" for s in settings()}
    return [name for name in sorted(known) if name.startswith(incomplete)]


def of_path(help: str) -> Any:
    """The option ``--path``; which paths a command takes, and how many, is its own to say."""
    return typer.Option("--path", help=help, autocompletion=names_of("bent_beam.method:paths"))


def folder_for(content: str) -> Any:
    """The option ``--out`` of a command that writes several files."""
    return typer.Option(help=f"Folder for {content}; earlier ones are replaced.")


Json = Annotated[bool, typer.Option("--json", help="Print one JSON document on standard output and nothing else.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress on standard error.")]
Verbose = Annotated[bool, typer.Option("--verbose", "-v", help="Also numbers for experts.")]
CaseFile = Annotated[
    Path, typer.Argument(metavar="CASE.toml", help="Case file (see cases/; `bentbeam new` writes one).")
]
Jobs = Annotated[int, typer.Option("--jobs", "-j", min=1, help="Processes on this machine.")]
ManyJobs = Annotated[
    int | None,
    typer.Option("--jobs", "-j", min=1, help="Processes on this machine. Default: one per core from 5 s of work on."),
]
Scheduler = Annotated[
    str | None, typer.Option(help="Address of a dask.distributed scheduler, e.g. tcp://127.0.0.1:8786.")
]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="TABLE.KEY=VALUE",
        help="Change a setting of the case; without a case file one of a path, PATH.KEY=VALUE. Repeatable.",
        autocompletion=setting_names,
    ),
]
Methods = Annotated[
    list[Path] | None,
    typer.Option(metavar="FILE.toml", help="File of methods (see cases/methods/), in place of --path. Repeatable."),
]
ErrorBars = Annotated[
    str,
    typer.Option(
        help="quick: one more run, of half the resolution. thorough: also one of twice. drift: no further run. "
        "Later than 0.003 T* simulate adds runs of its own (see the guide)."
    ),
]
Refine = Annotated[
    str | None, typer.Option(metavar="1,2,4", help="Factors by which elements and steps are refined, a row each.")
]
Fresh = Annotated[bool, typer.Option("--fresh", help="Neither read nor store runs.")]
Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace existing files.")]


def end_of_rows(rows: Sequence[Any]) -> None:
    """A line on standard error for each row that failed unexpectedly; leave with exit code 3 where one did, 2 where
    input refused every row."""
    from comparison.rows import failures

    lost = failures(rows)
    for row in lost:
        print(printable(f"error: {row.name}: {row.reason}"), file=sys.stderr)
    if lost:
        raise typer.Exit(3)
    if all(row.refused for row in rows):  # what was asked for cannot be: input, not a result
        print(printable(f"error: every row was refused: {rows[0].reason}"), file=sys.stderr)
        raise typer.Exit(2)


def numbers(option: str, text: str, counts: Sequence[int], what: str) -> tuple[float, ...]:
    """Finite numbers, comma separated in ``text``. Raises :class:`InputError` when there are not as many as allowed."""
    try:
        found = tuple(float(word) for word in text.split(","))
    except ValueError:
        found = ()
    if len(found) not in counts or not all(math.isfinite(v) for v in found):
        raise InputError(f"{option} takes {what} (got {text!r})")
    return found


def factors(refine: str | None) -> tuple[float, ...]:
    """The factors of ``--refine``, 1 where it is not given. Raises :class:`InputError`."""
    from bent_beam.checks import positive

    found = numbers("--refine", "1" if refine is None else refine, range(1, 20), "factors, e.g. 1,2,4")
    return tuple(positive("refine", factor) for factor in found)


def stated(context: typer.Context, *names: str) -> list[str]:
    """Those of the options ``names`` that stand on the command line, as they are typed."""
    sources = {name: context.get_parameter_source(name) for name in names}
    return [f"--{name}" for name, source in sources.items() if source is not None and source.name == "COMMANDLINE"]


def emit(document: Any, as_json: bool, text: Callable[[], str]) -> None:
    """Print ``document`` as one line of JSON, numbers finite and missing values null, or as ``text``."""
    if as_json:
        import json

        from bent_beam.as_json import json_text

        unicode = (sys.stdout.encoding or "utf-8").lower().startswith("utf")

        def plain(c: str) -> bool:
            return c.isprintable() and (unicode or c.isascii())

        print("".join(c if plain(c) else json.dumps(c)[1:-1] for c in json_text(document)))
    else:
        print(printable(text()))


def emit_with_files(
    document: Any, as_json: bool, text: Callable[[], str], out: Path | None, write: Callable[[Path], Any]
) -> None:
    """Files come first, as a reader who has read enough (``| head``) ends the program. Where they cannot be written,
    the answer is printed and then the error raised, of files and values as :class:`InputError`."""
    problem: Exception | None = None
    if out is not None:
        try:
            write(out)
        except Exception as error:  # none may cost the answer
            problem = error
    emit(document, as_json, text)
    if isinstance(problem, (OSError, ValueError)):
        raise InputError(f"--out: {problem}") from problem
    if problem is not None:
        raise problem


def printable(text: str) -> str:
    """``text`` without control characters, which a name from a file could send to the terminal."""
    return "".join(c if c.isprintable() or c == "\n" else c.encode("unicode_escape").decode() for c in text)


def check_out(out: Path | None, overwrite: bool, suffix: str = "") -> None:
    """``InputError`` when the file cannot be written, is there already, or ends in another suffix than what it holds
    has (``""``: any)."""
    from comparison.store import check_writable

    if out is None and overwrite:
        raise InputError("--overwrite has no effect without --out: leave it out")
    if out is not None and suffix and out.suffix[1:].isalpha() and out.suffix.lower() != suffix:
        raise InputError(f"--out must not end in {out.suffix}: the file is a {suffix} (got {out})")
    if out is not None and out.exists() and not overwrite:
        raise InputError(f"{out} exists already (give another name, or --overwrite)")
    check_writable(out, folder=False)


@dataclass(frozen=True)
class Bar:
    """What a long job reports to: a fraction, or a count of things done."""

    fraction: Callable[[float], None]

    def count(self, done: int, total: int) -> None:
        self.fraction(done / max(total, 1))


@contextmanager
def progress(title: str, quiet: bool) -> Iterator[Bar]:
    """Progress on standard error, with the time that is left, and what paths log for the user; a bar on a terminal
    only, and nothing where ``quiet``."""
    if quiet or not sys.stderr.isatty():
        with notices((lambda text: None) if quiet else partial(print, file=sys.stderr)):
            yield Bar(lambda done: None)
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TimeElapsedColumn, TimeRemainingColumn

    words = ("{task.description}", BarColumn(), "{task.percentage:>3.0f} %")
    columns = (*words, TimeElapsedColumn(), "left", TimeRemainingColumn())
    terminal = Console(stderr=True)
    with Progress(*columns, console=terminal, transient=True) as bar, notices(terminal.print):
        task = bar.add_task(title, total=1.0)
        yield Bar(lambda done: bar.update(task, completed=done))


@contextmanager
def notices(show: Callable[[str], None]) -> Iterator[None]:
    """What any path logs for the user (the logger ``bent_beam``) goes to ``show`` while in here."""

    class Shown(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            show(record.getMessage())

    handler, log = Shown(logging.INFO), logging.getLogger("bent_beam")
    level = log.level
    log.addHandler(handler)
    log.setLevel(logging.INFO)
    try:
        yield
    finally:
        log.removeHandler(handler)
        log.setLevel(level)
