"""The ``bentbeam`` command: its commands stand beside this file.

Exit codes: 0 done; 2 bad input (one line naming field and value); 3 a solver could not finish; 130 interrupted.
The library's commands are listed here; programs on top of it add theirs by the entry-point group
``bentbeam.commands``. A command imports what is heavy inside its function: ``bentbeam --help`` answers at once.
"""

import io
import os
import re
import signal
import sys
import warnings
from collections.abc import Sequence
from functools import cache
from importlib import metadata
from typing import Annotated

import typer

from bent_beam.errors import ANY_FAILURE, InputError, SimulationError
from comparison.command_line.cases import new, predict, settings, simulate
from comparison.command_line.histories import compare, plot, rerun
from comparison.command_line.options import printable
from comparison.command_line.theory import match, theory
from comparison.command_line.whole import bounce, sweep

COMMANDS = (new, predict, bounce, sweep, plot, simulate, settings, compare, rerun, theory, match)
"""Of the library, in the order of ``bentbeam --help``."""

INTERRUPTED = 130
AGAIN = (signal.SIGALRM,) if hasattr(signal, "SIGALRM") else ()
PATIENCE = 10.0  # s between an interrupt and the next: workers and files are cleared away meanwhile
RESUMED = ("predict", "bounce", "sweep", "match", "gallery", "report", "benchmark")  # keep what is finished

app = typer.Typer(
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"max_content_width": 110, "help_option_names": ["-h", "--help"]},
)

# Typer hides its copy of click, whose base class of usage errors this is.
USAGE_ERRORS: tuple[type[Exception], ...] = tuple(
    kind for kind in typer.BadParameter.__mro__ if kind.__name__ == "ClickException"
)


@app.callback(invoke_without_command=True)
def bentbeam(
    context: typer.Context, version: Annotated[bool, typer.Option("--version", help="Print the version.")] = False
) -> None:
    """A naturally bent beam hits a wall: theory and simulations compared."""
    if version:
        print(metadata.version("bent-beam-impact"))
        raise typer.Exit()
    if context.invoked_subcommand is None:
        print(context.get_help())


for command in COMMANDS:
    app.command()(command)


@cache
def add_programs() -> None:
    """Add the commands of programs, which the library's own need not wait for."""
    for entry in sorted(metadata.entry_points(group="bentbeam.commands")):
        try:
            app.command()(entry.load())
        except ANY_FAILURE as error:  # somebody else's package may fail in any way
            why = printable(" ".join(f"{type(error).__name__}: {error}".split()))
            print(f"warning: the command {entry.name!r} is installed but does not load ({why})", file=sys.stderr)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and leave with its exit code."""
    _open_closed_streams()
    ends = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    for end in ends:
        if signal.getsignal(end) in (signal.SIG_DFL, signal.default_int_handler):  # under nohup, SIGHUP stays ignored
            signal.signal(end, interrupt)  # as Ctrl-C: no half of a file is left
    code = run(arguments)
    for end in (*ends, *AGAIN):
        signal.signal(end, signal.SIG_IGN)  # nothing is left to interrupt, and leaving takes a moment
    try:
        sys.stdout.flush()
    except OSError as error:
        _drop_output()
        if not isinstance(error, BrokenPipeError):
            code = _refuse(f"standard output cannot be written: {error.strerror}", 2)
    sys.exit(code)


def interrupt(*_: object) -> None:
    """Raise ``KeyboardInterrupt``, and again until one has come through: a solver's callback may swallow it."""
    for number in AGAIN:
        signal.signal(number, interrupt)
        signal.setitimer(signal.ITIMER_REAL, PATIENCE)
    raise KeyboardInterrupt


def _open_closed_streams() -> None:
    """Open what was closed (``>&-``, some daemons) on the null device: Python has ``None`` in its place, and the first
    file that is opened would take its number, and with it whatever a library prints."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")  # a terminal without Greek letters costs them, not the answer


def _drop_output() -> int:
    """Nobody reads on: what is left in the buffer has nowhere to go, and that is no failure."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    return 0


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code, prints one line on standard error when it is not 0."""
    warnings.simplefilter("ignore", RuntimeWarning)  # every result is checked to be finite
    words = list(sys.argv[1:] if arguments is None else arguments)
    try:
        check_numbers(words)
        if words[:1] not in [[command.__name__] for command in COMMANDS]:
            add_programs()
        code = app(args=words, prog_name="bentbeam", standalone_mode=False)
        if code == INTERRUPTED:  # Typer makes this of Ctrl-C, without a word
            raise KeyboardInterrupt
        return int(code or 0)
    except USAGE_ERRORS as error:
        return _refuse(error.format_message(), 2)  # type: ignore[attr-defined]
    except SimulationError as error:
        return _refuse(str(error), 3)
    except BrokenPipeError:
        return _drop_output()
    except MemoryError:
        return _refuse("not enough memory; fewer nodes, steps or saved instants need less", 3)
    except SystemExit as ended:
        if not ended.code:  # the shell's completion ends so
            return 0
        if isinstance(ended.__context__, BrokenPipeError):  # click takes `| head` for a failure
            return _drop_output()
        return _refuse(f"something that was called ended the program: {ended}", 3)
    except (KeyboardInterrupt, typer.Abort, ImportError, ValueError, OSError) as error:
        # a library that is interrupted while it loads may say that it cannot be imported, and a path that needs it, too
        stopped = any(signal.getsignal(number) is interrupt for number in AGAIN)
        if stopped or isinstance(error, (KeyboardInterrupt, typer.Abort)):
            return _refuse(f"interrupted; {how_to_go_on(words)}", INTERRUPTED)
        if isinstance(error, ImportError):
            raise
        return _refuse(str(error), 2)  # InputError among them


NUMBER = re.compile(r"\s*[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|nan|inf(?:inity)?)\s*", re.A | re.I)
OF_FILES = ("--out", "--methods")


def check_numbers(words: Sequence[str]) -> None:
    """``InputError`` for what Python reads as a number and a reader may not: 1_0, digits of other scripts. Names of
    files may look like that."""
    for before, word in zip(["", *words], words):
        option, value = word.split("=", 1) if word.startswith("--") and "=" in word else (before, word)
        for text in value.split(",") if option.startswith("-") and option not in OF_FILES else ():
            try:
                float(text)
            except ValueError:
                continue
            if not NUMBER.fullmatch(text):
                raise InputError(f"{word} is not a plain number: digits 0 to 9, without _")


def how_to_go_on(arguments: Sequence[str]) -> str:
    """What an interrupt has left, and what the same command does next."""
    if "--fresh" not in arguments and arguments[:1] and arguments[0] in RESUMED:
        return "what was finished is kept: the same command again goes on from there"
    return "no half of a file is left: the same command again starts from the beginning"


def _refuse(message: str, code: int) -> int:
    if code != INTERRUPTED:  # another interrupt may come: nothing heavy is imported
        from bent_beam.tables import in_keys

        message = in_keys(message)
    print("error: " + printable(" ".join(message.split())), file=sys.stderr)
    return code
