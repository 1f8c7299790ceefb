"""What the code of an adapter depends on: the modules and packages that its files import."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterable, Mapping
from functools import cache
from importlib.metadata import packages_distributions, version
from importlib.util import find_spec
from pathlib import Path

from comparison.store import PACKAGES, digest_of_files, installed

CODE = (".py", ".so", ".pyd")


@cache
def _distributions() -> Mapping[str, list[str]]:
    """Which distributions a package comes from; to ask takes a second where many are installed."""
    return packages_distributions()


def _code_in(folder: Path) -> list[Path]:
    return [file for file in folder.rglob("*") if file.suffix in CODE]


def behind(files: Iterable[Path], folder: Path) -> list[str]:
    """What Python ``files`` import, and what that imports in turn: the digest of each module or package in ``folder``
    or elsewhere on the path, of an installed one its version. What is imported by a computed name is not seen."""
    waiting, seen, found = list(files), {"__main__", *PACKAGES, *sys.stdlib_module_names}, set()
    places = installed()
    while waiting:
        for name in _imported_by(waiting.pop()) - seen:
            seen.add(name)
            origin = next((f for f in (folder / f"{name}.py", folder / name / "__init__.py") if f.is_file()), None)
            if origin is None:
                spec = find_spec(name)
                origin = None if spec is None or not spec.has_location else Path(str(spec.origin))
            if origin is None:
                continue
            if any(origin.resolve().is_relative_to(place) for place in places):
                found |= {f"{one} {version(one)}" for one in _distributions().get(name, ())}
                continue
            mine = _code_in(origin.parent) if origin.stem == "__init__" else [origin]
            found.add(f"{name} {digest_of_files(mine, origin.parent)}")
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
