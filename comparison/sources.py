"""Which code an answer comes from: digests of this project's sources, and of what somebody else's method is made of."""

from __future__ import annotations

import ast
import hashlib
import inspect
import sys
import sysconfig
from collections.abc import Iterable, Mapping
from functools import cache
from importlib.metadata import entry_points, packages_distributions, version
from importlib.util import find_spec
from pathlib import Path

from bent_beam.versions import versions

__all__ = ["PACKAGES", "behind", "source_digest", "source_of", "this_code"]

PACKAGES = ("bent_beam", "measure", "theory", "hermite_fe", "self_similar_fe", "exudyn_models", "comparison")
CODE = (".py", ".so", ".pyd")


def _digest_of_files(files: Iterable[Path], root: Path) -> str:
    digest = hashlib.sha256()
    for file in sorted(files):
        digest.update(file.relative_to(root).as_posix().encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()


@cache
def source_digest() -> str:
    """Digest of this project's own sources: a changed solver must not be served an old answer."""
    root = Path(__file__).resolve().parent.parent
    return _digest_of_files((f for package in PACKAGES for f in (root / package).rglob("*.py")), root)


def this_code() -> dict[str, str]:
    """Versions and digest of the sources that compute in this process."""
    return versions() | {"sources": source_digest()[:12]}


@cache
def source_of(kind: type) -> str:
    """A method's class, and what tells it from its older versions: for somebody else's method the digest of its whole
    package (or module), what that imports, and the version of its distribution."""
    name, top = f"{kind.__module__}.{kind.__qualname__}", kind.__module__.partition(".")[0]
    if top in PACKAGES:  # in every key
        return name
    try:
        # a class of a script comes to a worker by value: only its code still knows the file
        file = Path(inspect.getfile(kind.simulate if top == "__main__" and hasattr(kind, "simulate") else kind))
        root = next((parent for parent in file.parents if parent.name == top), None)
        files = [file] if root is None else _code_in(root)
        source = [_digest_of_files(files, (root or file).parent), *behind(files, (root or file).parent)]
    except (OSError, TypeError):  # made at a prompt
        source = [hashlib.sha256(repr(kind).encode()).hexdigest()]
    registered = (e for e in entry_points(group="bentbeam.methods") if e.module.partition(".")[0] == top)
    return " ".join([name, *source, *sorted({f"{e.dist.name} {e.dist.version}" for e in registered if e.dist})])


@cache
def _distributions() -> Mapping[str, list[str]]:
    """Which distributions a package comes from; to ask takes a second where many are installed."""
    return packages_distributions()


def _code_in(folder: Path) -> list[Path]:
    return [file for file in folder.rglob("*") if file.suffix in CODE]


def behind(files: Iterable[Path], folder: Path) -> list[str]:
    """What Python ``files`` import, and what that imports in turn: the digest of each module or package in ``folder``
    or elsewhere on the path, of an installed one its version. What is imported by a computed name is not seen."""
    waiting, seen, found = list(files), {*PACKAGES, *sys.stdlib_module_names}, set()
    installed = tuple(Path(sysconfig.get_path(kind)).resolve() for kind in ("purelib", "platlib"))
    while waiting:
        for name in _imported_by(waiting.pop()) - seen:
            seen.add(name)
            origin = next((f for f in (folder / f"{name}.py", folder / name / "__init__.py") if f.is_file()), None)
            if origin is None:
                spec = find_spec(name)
                origin = None if spec is None or not spec.has_location else Path(str(spec.origin))
            if origin is None:
                continue
            if any(origin.resolve().is_relative_to(place) for place in installed):
                found |= {f"{one} {version(one)}" for one in _distributions().get(name, ())}
                continue
            mine = _code_in(origin.parent) if origin.stem == "__init__" else [origin]
            found.add(f"{name} {_digest_of_files(mine, origin.parent)}")
            waiting += mine
    return sorted(found)


def _imported_by(file: Path) -> set[str]:
    """Top-level names of the modules that a file imports."""
    try:
        tree = ast.walk(ast.parse(file.read_bytes())) if file.suffix == ".py" else ()
    except (SyntaxError, ValueError):
        return set()
    names: set[str] = set()
    for node in tree:
        if isinstance(node, ast.Import):
            names |= {one.name.partition(".")[0] for one in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names.add(str(node.module).partition(".")[0])
    return names
