"""``bentbeam`` as it is called, inside this process or in one of its own."""

import contextlib
import io
import json
import subprocess
import sys
from typing import Any

from comparison.command_line.app import run

HEARS = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
MAIN = "from comparison.command_line.app import main; main()"
CASE = """[beam]
bending_stiffness = 1.0
mass_per_length = 1.0
length = 20.0
curvature = 0.5
[impact]
velocity = 1.0
"""  # a case file: κ/ν = 0.5


def command(*words: object) -> tuple[int, str, str]:
    """Exit code, standard output and standard error, without what a machine says that is new to the kernels."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = run([str(word) for word in words])
    lines = err.getvalue().splitlines(keepends=True)
    return code, out.getvalue(), "".join(line for line in lines if not line.startswith("compiling, as always"))


def finite(name: str) -> None:
    raise AssertionError(f"{name} in JSON")


def answered(*words: object) -> Any:
    """The one document, of finite numbers, of a command that succeeds."""
    code, out, err = command(*words, "--json")
    assert code == 0, err
    return json.loads(out, parse_constant=finite)


def refused(*words: object) -> str:
    """The one line of a command that is refused."""
    code, out, err = command(*words)
    assert (code, out, err.count("\n")) == (2, "", 1) and err.startswith("error: "), (code, out, err)
    return err


def started(*words: object, program: str = MAIN, **how: Any) -> subprocess.Popen[str]:
    """``bentbeam``, or another program, in a session of its own: a signal to its group reaches its workers too.

    It hears Ctrl-C, which a shell without job control has the children of its background jobs ignore.
    """
    pipe = subprocess.PIPE
    chosen = {"stdout": pipe, "stderr": pipe, "text": True, "start_new_session": True} | how
    return subprocess.Popen([sys.executable, "-c", HEARS + program, *map(str, words)], **chosen)
