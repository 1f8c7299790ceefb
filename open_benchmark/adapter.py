"""Adapters: which there are, the environment that each runs in, and how one is installed.

An adapter is one program, ``adapter PROBLEM.toml RESULT RESOLUTION [ARGUMENTS]``. The shipped ones stand in
``adapters/adapters.toml`` with the versions they were reviewed with; anybody's own is a file given on the command line.
"""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from bent_beam.parts import InputError, nearest
from bent_beam.versions import versions
from comparison.store import source_digest
from open_benchmark.problem import Problem

__all__ = ["ADAPTERS", "RESOLUTIONS", "Adapter", "chosen_adapters", "environments", "install", "shipped_adapters"]

ADAPTERS = Path(__file__).parent / "adapters"
RESOLUTIONS = ("coarse", "medium", "fine")
SYSTEM_PYTHON = "/usr/bin/python3"
INSTALL_SECONDS = 900.0


@dataclass(frozen=True)
class Adapter:
    """One code. ``install``: pinned packages of its environment; ``debian``: a package of the system's Python
    instead; neither: this Python. ``kinds``: kinds of problems it takes (empty: any)."""

    name: str
    file: Path
    arguments: tuple[str, ...] = ()
    module: str = ""
    environment: str = ""
    install: tuple[str, ...] = ()
    debian: str = ""
    kinds: tuple[str, ...] = ()

    def takes(self, asked: Problem) -> bool:
        """Whether the code is asked this problem at all."""
        return not self.kinds or asked.kind in self.kinds

    @property
    def python(self) -> Path:
        """The interpreter it runs with."""
        if self.debian:
            return Path(SYSTEM_PYTHON)
        return environments() / self.environment / "bin" / "python" if self.install else Path(sys.executable)

    def command(self, problem_file: Path, result_file: Path, resolution: str) -> list[str]:
        """What is run."""
        start = [str(self.python), str(self.file)] if self.file.suffix == ".py" else [str(self.file)]
        return [*start, str(problem_file), str(result_file), resolution, *self.arguments]

    def missing(self) -> str | None:
        """Why it cannot run here (``None``: it can)."""
        if not self.file.exists():
            return f"{self.file} does not exist"
        if self.file.suffix == ".py":
            how = f"apt-get install {self.debian}" if self.debian else f"bentbeam benchmark --install {self.name}"
            if not self.python.exists():
                return how
            if self.module:
                look = f"import importlib.util as u, sys; sys.exit(u.find_spec({self.module.split('.')[0]!r}) is None)"
                found = subprocess.run([str(self.python), "-c", look], capture_output=True, check=False)
                return how if found.returncode else None
        elif not os.access(self.file, os.X_OK):
            return f"{self.file} is not executable"
        return None

    def digest(self) -> str:
        """Of everything that decides its answers but the problem: source, arguments, pinned versions; of a method of
        this project its solver's source and what that runs with."""
        text = repr((self.arguments, self.install, self.debian)).encode()
        if self.module and not (self.install or self.debian):
            text += repr((source_digest(), versions())).encode()
        return hashlib.sha256(self.file.read_bytes() + text).hexdigest()


def environments() -> Path:
    """Where environments are made: ``$BENTBEAM_ENVIRONMENTS``, or the user's cache folder."""
    given = os.environ.get("BENTBEAM_ENVIRONMENTS")
    if given:
        return Path(given).resolve()
    cache = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(cache) / "bent-beam-impact" / "environments"


def shipped_adapters() -> dict[str, Adapter]:
    """The adapters that are shipped, by name."""
    with open(ADAPTERS / "adapters.toml", "rb") as stream:
        table = tomllib.load(stream)
    found = {}
    for name, values in table.items():
        found[name] = Adapter(
            name,
            ADAPTERS / values["file"],
            arguments=tuple(values.get("arguments", ())),
            module=values.get("module", ""),
            environment=values.get("environment", name),
            install=tuple(values.get("install", ())),
            debian=values.get("debian", ""),
            kinds=tuple(values.get("kinds", ())),
        )
    return found


def chosen_adapters(names: Sequence[str] = (), own: Sequence[Path] = ()) -> list[Adapter]:
    """Shipped adapters by name (all when neither is given), then one's own files.

    Raises :class:`InputError` for a name that none has and a file that is not there.
    """
    shipped = shipped_adapters()
    for name in names:
        if name not in shipped:
            raise InputError(f"solver: {name!r} is not known{nearest(name, shipped)}")
    chosen = [shipped[name] for name in names] if names else ([] if own else list(shipped.values()))
    for file in own:
        if not file.is_file():
            raise InputError(f"adapter: {file} is not a file")
        chosen.append(Adapter(file.stem, file.resolve()))
    return chosen


def install(name: str) -> str:
    """Make the environment of a shipped adapter from its pinned versions; what was done, in one line.

    Raises :class:`InputError` for a name that none has, and :class:`RuntimeError` when the packages cannot be had.
    """
    adapter = chosen_adapters([name])[0]
    if adapter.debian:
        return f"{name}: apt-get install {adapter.debian} (a package of the system's Python, not installed from here)"
    if not adapter.install:
        return f"{name}: runs with this Python, nothing to install"
    place = environments() / adapter.environment
    steps = [
        [sys.executable, "-m", "venv", "--clear", str(place)],
        [str(adapter.python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *adapter.install],
    ]
    place.parent.mkdir(parents=True, exist_ok=True)
    for step in steps:
        try:
            done = subprocess.run(step, capture_output=True, text=True, timeout=INSTALL_SECONDS, check=False)
        except subprocess.TimeoutExpired:
            raise RuntimeError(f"{name}: installing took more than {INSTALL_SECONDS:g} s") from None
        if done.returncode:
            lines = [line for line in done.stderr.splitlines() if line.strip()] or ["no message"]
            raise RuntimeError(f"{name}: {' '.join(lines[-1].split())}")
    return f"{name}: {', '.join(adapter.install)} in {place}"
