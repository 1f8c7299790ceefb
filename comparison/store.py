"""Finished runs, kept under a key of what was asked and with which versions: a killed sweep resumes where it was.

One JSON file a run, written beside its place and renamed into it, with a checksum inside: a file that is torn, edited
or from other versions is never read as good.
"""

from __future__ import annotations

import errno
import hashlib
import inspect
import json
import os
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import platformdirs
from numpy.typing import NDArray

from bent_beam.errors import InputError
from bent_beam.files import write_atomically
from bent_beam.versions import versions

__all__ = ["RunStore", "check_writable", "default_store", "source_of", "write_atomically"]


def check_writable(out: Path, *, folder: bool) -> None:
    """``InputError`` when ``out`` (or a file in it, a ``folder``) cannot be written: asked before the work."""
    place = out if folder else out.parent
    try:
        if not folder and out.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        place.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=".", suffix=".part", dir=place)
        os.close(handle)
        os.unlink(name)
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise InputError(f"out: {out} cannot be written: {why.lower()}") from None


def default_store() -> Path:
    """``$BENTBEAM_STORE``, or the user's cache folder."""
    given = os.environ.get("BENTBEAM_STORE")
    if given:
        return Path(given)
    return Path(platformdirs.user_cache_dir("bent-beam-impact", appauthor=False)) / "runs"


def _canonical(value: Any) -> str:
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


@cache
def source_digest() -> str:
    """Digest of this project's own sources: a changed solver must not be served an old answer."""
    root = Path(__file__).resolve().parent.parent
    digest = hashlib.sha256()
    for package in ("bent_beam", "theory", "hermite_fe", "self_similar_fe", "exudyn_models", "comparison"):
        for file in sorted((root / package).rglob("*.py")):
            digest.update(file.relative_to(root).as_posix().encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()


def source_of(kind: type) -> str:
    """Digest of the file that defines a class: somebody else's method is told from its older versions by it."""
    try:
        source = Path(inspect.getfile(kind)).read_bytes()
    except (OSError, TypeError):  # made at a prompt
        source = repr(kind).encode()
    return f"{kind.__module__}.{kind.__qualname__} {hashlib.sha256(source).hexdigest()}"


@dataclass(frozen=True)
class RunStore:
    """A folder of finished runs; ``None`` keeps nothing."""

    folder: Path | None

    def file(self, question: Mapping[str, Any]) -> Path | None:
        """Where the answer to ``question`` (JSON-ready, also where nothing is kept) is kept."""
        _canonical(dict(question))
        if self.folder is None:
            return None
        key = _digest(_canonical({"question": dict(question), "versions": versions(), "source": source_digest()}))
        return self.folder / f"{key[:40]}.json"

    def answer(self, question: Mapping[str, Any], compute: Callable[[], dict[str, Any]]) -> dict[str, Any]:
        """The kept answer, or ``compute()``'s, kept from now on. Answers are finite JSON data."""
        file = self.file(question)
        if file is not None:
            kept = self._read(file)
            if kept is not None:
                return kept
        found: dict[str, Any] = json.loads(_canonical(compute()))
        if file is not None:
            try:
                write_atomically(file, _canonical({"answer": found, "sha256": _digest(_canonical(found))}))
            except OSError:
                pass  # a full or read-only cache costs time, not the answer
        return found

    def array(self, function: Callable[..., NDArray[np.float64]], *arguments: Any) -> NDArray[np.float64]:
        """``function(*arguments)``, finite numbers for JSON-ready arguments, from the store where it is there."""
        question = {"function": f"{function.__module__}.{function.__qualname__}", "arguments": list(arguments)}
        return np.array(self.answer(question, lambda: {"values": function(*arguments).tolist()})["values"])

    @staticmethod
    def _read(file: Path) -> dict[str, Any] | None:
        try:
            kept = json.loads(file.read_text())
            answer = kept["answer"]
            if kept["sha256"] != _digest(_canonical(answer)) or not isinstance(answer, dict):
                return None
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return None
        return answer
