"""Finished runs, kept under a key of what was asked and with which versions: a killed sweep resumes where it was.

One JSON file a run, written beside its place and renamed into it, with a checksum inside: a file that is torn, edited
or from other versions is never read as good.
"""

import hashlib
import inspect
import json
import os
import sysconfig
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from importlib.metadata import distributions
from pathlib import Path
from typing import Any, Self

from platformdirs import user_cache_path

from bent_beam.errors import InputError
from bent_beam.files import write_atomically
from bent_beam.versions import versions

PACKAGES = ("bent_beam", "theory", "hermite_fe", "self_similar_fe", "exudyn_models", "comparison")
ROOT = Path(__file__).resolve().parent.parent
LOADED = time.time()
NO_PARTS = ("builtins", "abc", "typing", "numpy")  # their classes hold no code of a method


def check_writable(out: Path | None, *, folder: bool) -> None:
    """``InputError`` when ``out`` (or a file in it, a ``folder``) cannot be written: asked before the work."""
    if out is None:
        return
    place = out.resolve() if folder else out.resolve().parent  # of a link, where it leads
    try:
        if not folder and out.exists() and not out.is_file():  # a device would be replaced by the file
            raise ValueError("it is a directory" if out.is_dir() else "it is no regular file")
        place.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=place).close()
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise InputError(f"--out: {out} cannot be written: {why.lower()}") from None


def _canonical(value: Any) -> str:
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True)
class RunStore:
    """A folder of finished runs; ``None`` keeps nothing."""

    folder: Path | None

    @classmethod
    def usual(cls, fresh: bool = False) -> Self:
        """``$BENTBEAM_STORE``, or in the user's cache folder; ``fresh``: one that keeps nothing, so reads nothing."""
        cache = user_cache_path("bent-beam-impact", appauthor=False) / "runs"
        return cls(None if fresh else Path(os.environ.get("BENTBEAM_STORE") or cache))

    def answer(self, question: Mapping[str, Any], compute: Callable[[], dict[str, Any]]) -> dict[str, Any]:
        """The kept answer to ``question``, or ``compute()``'s, kept unless ``source`` is unknown; all JSON-ready."""
        if self.folder is None or question.get("source", "") is None:
            return compute()
        key = _digest(_canonical({"question": dict(question), "versions": versions(), "source": source_digest()}))
        file = self.folder / f"{key[:40]}.json"
        if (kept := self._read(file)) is not None:
            return kept
        found = compute()
        with suppress(OSError, ValueError):  # a full cache, a value that JSON lacks: they cost time, not the answer
            write_atomically(file, _canonical({"answer": found, "sha256": _digest(_canonical(found))}))
        return found

    @staticmethod
    def _read(file: Path) -> dict[str, Any] | None:
        try:
            kept = json.loads(file.read_text())
            answer = kept["answer"]
            whole = isinstance(answer, dict) and kept["sha256"] == _digest(_canonical(answer))
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return None
        return answer if whole else None


def digest_of_files(files: Iterable[Path], root: Path) -> str:
    """Of their contents and their places below ``root``."""
    digest = hashlib.sha256()
    for file in sorted(files):
        digest.update(file.relative_to(root).as_posix().encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()


@cache
def source_digest() -> str:
    """Digest of this project's own sources: a changed solver must not be served an old answer. Where a file was edited
    after this process had read it, the digest is this process's own, and nobody else is served its answers."""
    files = [file for package in PACKAGES for file in (ROOT / package).rglob("*.py")]
    edited = max(file.stat().st_mtime for file in files) > LOADED
    return digest_of_files(files, ROOT) + (f" {os.getpid()} {LOADED}" if edited else "")


def this_code() -> dict[str, str]:
    """Versions and digest of the sources that compute in this process."""
    source, *edited = source_digest().split(" ", 1)
    return versions() | {"sources": " ".join([source[:12], *edited])}


def code_of(function: Any) -> str:
    """Name of a function of a module; outside :data:`PACKAGES` with the digest of its file."""
    name, file = f"{function.__module__}.{function.__qualname__}", Path(inspect.getfile(function))
    return name if name.partition(".")[0] in PACKAGES else f"{name} {digest_of_files([file], file.parent)}"


def source_of(method: Any) -> str | None:
    """A method's class, and what tells it from its older versions; ``None`` where it or a part of it is neither this
    project's nor of an installed package. The files that such code depends on are unknown, so its runs are not kept.
    With another package's parts the versions of all that is installed."""
    name, places = f"{type(method).__module__}.{type(method).__qualname__}", {_place_of(k) for k in _kinds_in(method)}
    if None in places:
        return None
    return name if places == {"ours"} else f"{name} {_digest(repr(_all_installed()))}"


def _kinds_in(value: Any) -> set[Any]:
    """Classes and functions that a method is made of."""
    if value is None or isinstance(value, (bool, int, float, str, bytes)):
        return set()
    if isinstance(value, Mapping | list | tuple | set | frozenset):
        items = value.values() if isinstance(value, Mapping) else value
        return {kind for item in items for kind in _kinds_in(item)}
    if inspect.isroutine(value) or isinstance(value, type):
        return {value}
    held = vars(value).values() if hasattr(value, "__dict__") else ()
    return {kind for kind in type(value).__mro__ if kind.__module__ not in NO_PARTS} | _kinds_in(list(held))


def _place_of(kind: Any) -> str | None:
    try:
        file = Path(inspect.getfile(kind)).resolve()
    except (OSError, TypeError):  # made at a prompt
        return None
    if any(file.is_relative_to(ROOT / package) for package in PACKAGES):
        return "ours"
    return "installed" if any(file.is_relative_to(place) for place in installed()) else None


def installed() -> tuple[Path, ...]:
    """Folders of this Python's packages."""
    return tuple(Path(sysconfig.get_path(kind)).resolve() for kind in ("purelib", "platlib"))


@cache
def _all_installed() -> list[tuple[str, str]]:
    return sorted((str(one.name), one.version) for one in distributions())
