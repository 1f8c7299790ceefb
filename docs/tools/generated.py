"""Pages made from the code while the site is built: the settings of a case file, the public names of each package."""

import importlib
from typing import Any

from mkdocs.structure.files import File, Files

#: Page → the modules whose public names (``__all__``) it documents.
API = {
    "bent_beam": ("bent_beam", "bent_beam.meshes"),
    "measure": ("bent_beam.measure.numbers", "bent_beam.measure.moments", "bent_beam.measure.estimators"),
    "theory": ("theory",),
    "hermite_fe": (
        "hermite_fe",
        "hermite_fe.integrators",
        "hermite_fe.contacts",
        "hermite_fe.masses",
        "hermite_fe.far_fields",
    ),
    "self_similar_fe": ("self_similar_fe",),
    "exudyn_models": (
        "exudyn_models",
        "exudyn_models.elements",
        "exudyn_models.integrators",
        "exudyn_models.contacts",
    ),
    "comparison": (
        "comparison.doors",
        "comparison.methods",
        "comparison.rows",
        "comparison.matching",
        "comparison.bouncing",
        "comparison.bounced",
        "comparison.sweeping",
    ),
    "open_benchmark": tuple(
        f"bent_beam_programs.open_benchmark.{room}" for room in ("problem", "result", "reading", "score", "judgement")
    ),
}


def api_page(package: str) -> str:
    """A page that mkdocstrings fills with the public names of its modules."""
    text = f"# `{package}`\n"
    for name in API[package]:
        text += f"\n::: {name}\n    options:\n      members: {importlib.import_module(name).__all__}\n"
    return text


def pages() -> dict[str, str]:
    """Path in docs → Markdown."""
    from comparison.settings_text import settings_markdown

    return {"settings.md": settings_markdown()} | {f"api/{name}.md": api_page(name) for name in API}


def on_files(files: Files, config: Any) -> Files:
    """MkDocs event: the generated pages join those in docs/."""
    for path, text in pages().items():
        files.append(File.generated(config, path, content=text))
    return files
