"""Adapters: which there are, the environment that each runs in, and how one is installed.

An adapter is one program, ``adapter PROBLEM.toml RESULT RESOLUTION [ARGUMENTS]``. The shipped ones stand in
``adapters/adapters.toml`` with the versions they were reviewed with; anybody's own is a file given on the command line.
"""

import ast
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import distributions
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from platformdirs import user_cache_path

from bent_beam.errors import InputError, nearest
from bent_beam.versions import versions
from comparison.store import PACKAGES, digest_of_files, installed, source_digest

ADAPTERS = Path(__file__).parent / "adapters"
RESOLUTIONS = ("coarse", "medium", "fine")
GIVEN = "given"  # one mesh for all: elements of 0.02 l*, 400 equal steps, or as many as a code needs to be stable
SHIPPED: dict[str, Any] = {"resolutions": [*RESOLUTIONS, GIVEN], "kinds": ["leading", "point", "first"]}
SHIPPED |= {"chosen": "uniform, the same in every problem"}  # where a table says nothing else
WINDOWS = os.name == "nt"
INSTALL_SECONDS = 900.0


@dataclass(frozen=True)
class Adapter:
    """One code; the head of ``adapters.toml`` says what the fields are, and what a table of it leaves out. Of an object
    without ``install`` and ``debian`` it runs with this Python, without ``kinds`` it is asked all problems."""

    name: str
    file: Path
    arguments: tuple[str, ...] = ()
    module: str = ""
    environment: str = ""
    install: tuple[str, ...] = ()
    debian: str = ""
    kinds: tuple[str, ...] = ()
    host: bool = False
    chosen: str = "not stated"
    manual: tuple[Sequence[str], ...] = ()
    resolutions: tuple[str, ...] = RESOLUTIONS

    @property
    def folder(self) -> Path:
        """Of its environment: in ``$BENTBEAM_ENVIRONMENTS``, or in the user's cache folder."""
        own = user_cache_path("bent-beam-impact", appauthor=False) / "environments"
        return Path(os.environ.get("BENTBEAM_ENVIRONMENTS") or own).resolve() / (self.environment or self.name)

    @property
    def python(self) -> Path:
        if self.debian:
            return Path("/usr/bin/python3")
        if not self.install:
            return Path(sys.executable)
        scripts = sysconfig.get_path("scripts", "nt_venv" if WINDOWS else "posix_venv", {"base": str(self.folder)})
        return Path(scripts) / ("python.exe" if WINDOWS else "python")

    def command(self, problem_file: Path, result_file: Path, resolution: str) -> list[str]:
        start = [str(self.python), str(self.file)] if self.file.suffix == ".py" else [str(self.file)]
        return [*start, str(problem_file), str(result_file), resolution, *self.arguments]

    def missing(self) -> str | None:
        """Why it cannot run here (``None``: it can)."""
        if not self.file.exists():
            return f"{self.file} does not exist"
        if self.file.suffix != ".py":
            return None if os.access(self.file, os.X_OK) else f"{self.file} is not executable"
        how = f"apt-get install {self.debian}" if self.debian else f"bentbeam benchmark --install {self.name}"
        if not self.python.exists():
            return how
        if not self.module:
            return None
        search = f"import importlib.util as u, sys; sys.exit(u.find_spec({self.module.split('.')[0]!r}) is None)"
        found = subprocess.run([str(self.python), "-c", search], capture_output=True, check=False)
        return how if found.returncode else None

    def made_by(self) -> dict[str, Any]:
        """What stands beside a result: digest of the adapter's source, its arguments, and the versions it runs with."""
        source = hashlib.sha256(self.file.read_bytes()).hexdigest() if self.file.is_file() else None
        return {"source": source, "arguments": list(self.arguments), "packages": self.packages or versions()}

    @property
    def packages(self) -> list[str]:
        """What is installed for it alone: pinned packages, or one of the system's."""
        return [*self.install, *([self.debian] if self.debian else [])]

    def digest(self) -> str:
        """Digest of source, arguments and pinned versions; for this project's own methods also of the solver's source
        and the installed versions, for a user's of what is :func:`behind` it."""
        text = repr((self.arguments, self.install, self.debian)).encode()
        if self.host:
            text += repr((source_digest(), versions())).encode()
        elif self.file.suffix == ".py" and not self.packages:  # with the modules beside it
            text += repr(behind(self.file)).encode()
        return hashlib.sha256(self.file.read_bytes() + text).hexdigest()


def shipped_adapters() -> dict[str, Adapter]:
    tables = tomllib.loads((ADAPTERS / "adapters.toml").read_text(encoding="utf-8"))
    found = {}
    for name, table in tables.items():
        table = SHIPPED | tables.get(table.get("environment"), {}) | table
        fields: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in table.items()}
        found[name] = Adapter(name, ADAPTERS / fields.pop("file"), **fields)
    return found


def chosen_adapters(names: Sequence[str] = (), own: Sequence[Path] = ()) -> list[Adapter]:
    """Shipped adapters by name (all when neither is given), then one's own files.

    Raises :class:`InputError` for a name that none has, a file that is not there, and two of one name: results are kept
    in folders of these names.
    """
    shipped = shipped_adapters()
    for name in names:
        if name not in shipped:
            raise InputError(f"solver: {name!r} is not known{nearest(name, shipped)}")
    chosen = [shipped[name] for name in dict.fromkeys(names)] if names or own else list(shipped.values())
    for file in own:
        if not file.is_file():
            raise InputError(f"adapter: {file} is not a file")
        if not re.fullmatch(r"[A-Za-z0-9_][\w.-]*", file.stem):
            raise InputError(
                f"adapter: {file}: its name must begin with a letter, a digit or _ and go on with these, . and -"
            )
        if file.stem in {one.name for one in chosen}:
            raise InputError(f"adapter: {file}: there is another adapter of the name {file.stem}; rename the file")
        chosen.append(Adapter(file.stem, file.resolve()))
    return chosen


def install(adapter: Adapter) -> str:
    """Make the environment of an adapter from its pinned versions; returns a line of text about it.

    Raises :class:`InputError` when the packages cannot be had.
    """
    name, folder = adapter.name, adapter.folder
    if adapter.debian:
        return f"{name}: apt-get install {adapter.debian} (a package of the system's Python, not installed from here)"
    if not adapter.install:
        return f"{name}: runs with this Python, nothing to install"
    folder.parent.mkdir(parents=True, exist_ok=True)
    for step in (
        [sys.executable, "-m", "venv", "--clear", str(folder)],
        [str(adapter.python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *adapter.install],
    ):
        try:
            done = subprocess.run(step, capture_output=True, text=True, timeout=INSTALL_SECONDS, check=False)
        except subprocess.TimeoutExpired:
            raise InputError(f"install: {name}: installing took more than {INSTALL_SECONDS:g} s") from None
        if done.returncode:
            last = " ".join((done.stderr.strip() or "no message").splitlines()[-1].split())
            raise InputError(f"install: {name}: {last}")
    return f"{name}: {', '.join(adapter.install)} in {folder}"


CODE = (".py", ".so", ".pyd")


def behind(program: Path) -> list[str]:
    """What a Python program may depend on: the versions of all that is installed, and the digest of each other module
    or package, beside it or elsewhere on the path, that it or these import. Computed names are not seen."""
    waiting, seen, places = [program], {"__main__", *PACKAGES, *sys.stdlib_module_names}, installed()
    found = {f"{one.name} {one.version}" for one in distributions()}
    while waiting:
        for name in _imported_by(waiting.pop()) - seen:
            seen.add(name)
            beside = (program.with_name(f"{name}.py"), program.with_name(name) / "__init__.py")
            origin = next(filter(Path.is_file, beside), None)
            if origin is None:
                spec = find_spec(name)
                origin = None if spec is None or not spec.has_location else Path(str(spec.origin))
            if origin is None or any(origin.resolve().is_relative_to(place) for place in places):
                continue
            package = origin.parent.rglob("*") if origin.stem == "__init__" else ()
            mine = [file for file in package if file.suffix in CODE] or [origin]
            found.add(f"{name} {digest_of_files(mine, origin.parent)}")
            waiting += mine
    return sorted(found)


def _imported_by(file: Path) -> set[str]:
    """Top-level names of the modules that a file imports."""
    try:
        nodes = [*ast.walk(ast.parse(file.read_bytes()))] if file.suffix == ".py" else []
    except (SyntaxError, ValueError):
        return set()
    names = {one.name for node in nodes if isinstance(node, ast.Import) for one in node.names}
    names |= {str(node.module) for node in nodes if isinstance(node, ast.ImportFrom) and not node.level}
    return {name.partition(".")[0] for name in names}
