"""A file of somebody else is read by a child process first: HDF5 may hang or crash on a damaged one, deaf to signals.

The child is started with the first file and waits for more; where it does not answer within ``LIMIT`` it ends by its
own alarm (not on Windows).
"""

import atexit
import json
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

LIMIT = 30  # s; the largest history takes three
CHILD = "import json, sys; sys.path[:] = json.loads(sys.argv[1]); "
CHILD += "from bent_beam.files import examine; from bent_beam.guarded import serve; serve(examine)"

_lock = threading.Lock()
_child: subprocess.Popen[str] | None = None


def try_first(file: Path) -> None:
    """Have all of ``file`` examined and read. ``ValueError`` says why it cannot be; ``OSError`` where it is missing."""
    global _child
    file.stat()
    with _lock:
        if _child is None or _child.poll() is not None:
            words = [sys.executable, "-P", "-c", CHILD, json.dumps(sys.path)]
            _child = subprocess.Popen(words, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
            atexit.register(_child.kill)
        assert _child.stdin is not None and _child.stdout is not None
        try:
            print(json.dumps(str(file.absolute())), file=_child.stdin, flush=True)
            answer = _child.stdout.readline()
        except BaseException:  # its answer would be taken for that on the next file
            _child.kill()
            _child.wait()
            raise
        if not answer:
            ended = _child.wait()
            raise ValueError(f"to read it takes longer than {LIMIT} s" if ended == -ALARM else "to read it is a crash")
    if reason := json.loads(answer):
        raise ValueError(reason)


ALARM = int(getattr(signal, "SIGALRM", 0))


def serve(examine: Callable[[Path], object]) -> None:
    """In the child: examine and read the files named on standard input, a line each; answer with null or a reason."""
    import os

    import h5py

    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what a library prints is no answer
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # of the terminal: the parent ends it
    alarm: Callable[[int], object] = getattr(signal, "alarm", lambda seconds: None)
    for line in sys.stdin:
        alarm(LIMIT)
        try:
            file = Path(json.loads(line))
            examine(file)
            with h5py.File(file, "r") as content:
                for name in content:
                    content[name][()]
            reason = None
        except Exception as error:
            reason = " ".join(str(error).split()) or type(error).__name__
        alarm(0)
        print(json.dumps(reason), file=answers, flush=True)
