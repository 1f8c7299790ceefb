"""Numbers that were measured once and are shipped. Each file says what made it, and shows when it is stale.

A file is JSON: ``what`` it holds, the command that makes it anew, the day, the versions, the packages and settings that
its numbers come from, and the digest of both. The digest is that of what is computed: of the parsed code without
docstrings, comments and texts, so that rewording a message leaves a file fresh and moving a line out of its loop does
not. A stale file is measured again, or confirmed: a sample is measured anew, agrees within its error bars, and the file
gets today's digest.
"""

import ast
import hashlib
import json
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from bent_beam.as_json import json_text, plain
from bent_beam.files import write_atomically
from bent_beam.versions import stamp, today

ROOT = Path(__file__).resolve().parent.parent


def write(
    file: Path, what: str, made_by: str, packages: Sequence[str], settings: Mapping[str, Any], data: Mapping[str, Any]
) -> Path:
    """Write ``data`` to ``file`` with what made it.

    made_by : the command that makes the file anew. packages : of this project (dotted), or modules, whose code the
    numbers depend on. settings : JSON-ready.
    """
    made = {"what": what, **stamp(made_by), "packages": list(packages), "settings": plain(settings)}
    made["digest"] = digest_of(packages, made["settings"])
    write_atomically(file, json_text(made | dict(data), indent=1) + "\n")
    return file


def read(file: Path) -> dict[str, Any]:
    """The whole document. Raises ``OSError`` or ``ValueError`` where there is none."""
    return dict(json.loads(file.read_text(encoding="utf-8")))


def is_stale(file: Path) -> bool:
    """Whether code or settings that made ``file`` are others today, or unknown: it has no digest."""
    stored = read(file)
    return "digest" not in stored or bool(stored["digest"] != digest_of(stored["packages"], stored["settings"]))


def confirm(file: Path, packages: Sequence[str] | None = None) -> None:
    """Give ``file`` today's digest. Call it after a sample of it was measured again and found inside its bars.

    packages : those of today, unless they are as written.
    """
    stored = read(file)
    stored["packages"] = list(packages or stored["packages"])
    stored |= {"digest": digest_of(stored["packages"], stored["settings"]), "confirmed": today()}
    write_atomically(file, json_text(stored, indent=1) + "\n")


def digest_of(packages: Sequence[str], settings: Mapping[str, Any]) -> str:
    """Digest of the code of packages, or of single modules, and of settings."""
    digest = hashlib.sha256(json.dumps(settings, sort_keys=True).encode())
    for package in packages:
        place = ROOT.joinpath(*package.split("."))
        for file in sorted(place.rglob("*.py")) or [place.with_suffix(".py")]:
            digest.update(file.relative_to(ROOT).as_posix().encode())
            digest.update(_code(file).encode())
    return digest.hexdigest()


@cache
def _code(file: Path) -> str:
    """What the code of ``file`` computes."""
    return _meaning(ast.parse(file.read_text(encoding="utf-8")))


def _meaning(node: Any, said: bool = False) -> str:
    """A syntax tree as text, the same in every Python; docstrings and texts left out. said : inside an error."""
    if isinstance(node, list):
        return f"[{','.join(_meaning(item, said) for item in node if not _is_remark(item))}]"
    if not isinstance(node, ast.AST):
        return repr(node)
    if _is_text(node, said):
        return "text"
    said = said or isinstance(node, ast.Raise)
    fields = (f"{name}={_meaning(value, said)}" for name, value in ast.iter_fields(node) if value not in (None, []))
    return f"{type(node).__name__}({','.join(fields)})"


def _is_remark(node: Any) -> bool:
    """Whether a statement is a string alone: a docstring."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def _is_text(node: ast.AST, said: bool) -> bool:
    """Whether a string is for people: what an error says, and whatever has a space in it. Names and keys have none."""
    parts = node.values if isinstance(node, ast.JoinedStr) else [node]
    words = [part.value for part in parts if isinstance(part, ast.Constant) and isinstance(part.value, str)]
    return (said and (bool(words) or isinstance(node, ast.JoinedStr))) or any(" " in word for word in words)
