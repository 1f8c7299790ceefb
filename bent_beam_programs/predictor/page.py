"""The page from its template. Nothing in it refers to anything outside."""

from __future__ import annotations

import json
from pathlib import Path

from bent_beam.files import write_atomically
from bent_beam_programs.predictor.coefficients import coefficients
from theory import validity

__all__ = ["page", "write_page"]

TEMPLATES = Path(__file__).parent / "templates"
SCRIPTS = ("theory.js", "limits.js", "beam.js", "case.js", "draw.js", "words.js", "view.js")


def constants() -> dict[str, float]:
    """Of `theory.validity`, what its formulas in limits.js need."""
    return {
        "tolerance": validity.TOLERANCE,
        "distance": validity.DISTANCE,
        "flat": validity.FLAT,
        "slope": validity.SLOPE_LIMIT,
        **{f"shear_{name}": times for name, times in validity.SHEAR_TIMES.items()},
        "shear_lengths": validity.SHEAR_LENGTHS,
        "flattest_sheared": validity.FLATTEST_SHEARED,
    }


def script(names: tuple[str, ...] = SCRIPTS) -> str:
    """The scripts, after the numbers that they read."""
    data = {"COEFFICIENTS": coefficients(), "VALIDITY": constants()}
    numbers = [f"const {name} = {json.dumps(value, separators=(',', ':'))};" for name, value in data.items()]
    return "\n".join([*numbers, *(_source(name) for name in names)])


def page() -> str:
    """The page as text, complete in itself."""
    text = _source("predictor.html")
    return text.replace("{{ style }}", _source("predictor.css")).replace("{{ script }}", script())


def write_page(file: str | Path) -> Path:
    """Write the page to ``file`` (its folder is made) and return the path."""
    path = Path(file)
    write_atomically(path, page())
    return path


def _source(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")
