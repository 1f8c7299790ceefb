"""Finished runs, kept under a key of what was asked and with which versions: a killed sweep resumes where it was.

One JSON file a run, written beside its place and renamed into it, with a checksum inside: a file that is torn, edited
or from other versions is never read as good.
"""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import platformdirs
from numpy.typing import NDArray

from bent_beam.errors import InputError
from bent_beam.files import write_atomically
from bent_beam.versions import versions
from comparison.sources import source_digest, source_of

__all__ = ["RunStore", "check_writable", "default_store", "source_digest", "source_of", "write_atomically"]


def check_writable(out: Path, *, folder: bool) -> None:
    """``InputError`` when ``out`` (or a file in it, a ``folder``) cannot be written: asked before the work."""
    place = out if folder else out.parent
    try:
        if not folder and out.exists() and not out.is_file():  # a device would be replaced by the file
            raise ValueError("it is a directory" if out.is_dir() else "it is no regular file")
        place.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=place).close()
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise InputError(f"--out: {out} cannot be written: {why.lower()}") from None


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


@dataclass(frozen=True)
class RunStore:
    """A folder of finished runs; ``None`` keeps nothing."""

    folder: Path | None

    def file(self, question: Mapping[str, Any]) -> Path | None:
        """Where the answer to ``question`` (JSON-ready, also where nothing is kept) is kept."""
        key = _digest(_canonical({"question": dict(question), "versions": versions(), "source": source_digest()}))
        return None if self.folder is None else self.folder / f"{key[:40]}.json"

    def answer(self, question: Mapping[str, Any], compute: Callable[[], dict[str, Any]]) -> dict[str, Any]:
        """The kept answer, or ``compute()``'s, kept from now on. Answers are finite JSON data."""
        file = self.file(question)
        kept = None if file is None else self._read(file)
        if kept is not None:
            return kept
        found: dict[str, Any] = json.loads(_canonical(compute()))
        if file is not None:
            with suppress(OSError):  # a full or read-only cache costs time, not the answer
                write_atomically(file, _canonical({"answer": found, "sha256": _digest(_canonical(found))}))
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
            whole = isinstance(answer, dict) and kept["sha256"] == _digest(_canonical(answer))
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return None
        return answer if whole else None
