"""Pages made from the code while the site is built: every setting of a case file, and the modules of each package."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

ROOT = Path(__file__).parents[2]
PACKAGES = (
    "bent_beam",
    "theory",
    "hermite_fe",
    "self_similar_fe",
    "exudyn_models",
    "comparison",
    "open_benchmark",
)
#: Packages whose modules are read in place: scripts to run, commands, one file a figure or study.
IN_PLACE = {"scripts", "command_line", "gallery", "studies", "report", "adapters"}


def modules(package: str) -> list[str]:
    """The public modules of a package by name, in the order of its folders."""
    found = []
    for file in sorted((ROOT / package).rglob("*.py")):
        parts = file.relative_to(ROOT).with_suffix("").parts
        if parts[-1] == "__init__":
            parts = parts[:-1]
        if len(parts) > 1 and not any(p.startswith("_") or p in IN_PLACE for p in parts[1:]):
            found.append(".".join(parts))
    return sorted(set(found))


def api_page(package: str) -> str:
    """A page that mkdocstrings fills."""
    return "\n\n".join([f"# `{package}`", *(f"::: {name}" for name in modules(package))]) + "\n"


def pages() -> dict[str, str]:
    """Path in docs → Markdown."""
    from comparison.settings import settings_markdown

    return {"settings.md": settings_markdown()} | {f"api/{name}.md": api_page(name) for name in PACKAGES}


def on_files(files: Files, config: Any) -> Files:
    """MkDocs event: the generated pages join those in docs/."""
    for path, text in pages().items():
        files.append(File.generated(config, path, content=text))
    return files
