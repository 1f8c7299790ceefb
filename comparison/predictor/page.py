"""The page and the panel, from their templates. Nothing in them refers to anything outside."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jinja2

from comparison.store import write_atomically
from theory import damped_zone, validity

TEMPLATES = Path(__file__).parent / "templates"
SCRIPTS = ("theory.js", "beam.js", "case.js", "view.js")


@dataclass(frozen=True)
class Panel:
    """The predictor as a part of another page: markup for its body, style, and script to run after the markup."""

    markup: str
    style: str
    script: str


def _source(name: str) -> str:
    return (TEMPLATES / name).read_text(encoding="utf-8")


def limits() -> dict[str, Any]:
    """The measured and chosen numbers of `theory.validity`, for the page to stop where `theory.predict` does."""
    return {
        "ends": json.loads(validity.DATA.read_text(encoding="utf-8")),
        "zone": json.loads(damped_zone.DATA.read_text(encoding="utf-8")),
        "share": validity.SHARE,
        "quiet": damped_zone.QUIET,
        "waiting": damped_zone.WAITING,
        "flat": damped_zone.FLAT,
        "unsure": damped_zone.UNSURE,
        "short": damped_zone.SHORT,
        "earlier": validity.EARLIER,
        "point": validity.POINT,
        "pulse": validity.PULSE,
        "third": validity.THIRD_ORDER,
        "flattest": validity.FLATTEST,
        "slope": validity.SLOPE_LIMIT,
        "shear": validity.SHEAR_TIMES,
    }


def panel(*, embedded: bool = True) -> Panel:
    """The predictor; everything in it lives under the element ``#predictor``. Embedded, it leaves the address alone."""
    markup = _source("panel.html")
    return Panel(
        markup=markup.replace('<div id="predictor">', '<div id="predictor" data-embedded>', 1) if embedded else markup,
        style=_source("predictor.css"),
        script="\n".join([f"const LIMITS = {json.dumps(limits())};", *(_source(name) for name in SCRIPTS)]),
    )


def page() -> str:
    """The page as text, complete in itself."""
    parts = panel(embedded=False)
    environment = jinja2.Environment(undefined=jinja2.StrictUndefined, trim_blocks=True, autoescape=False)
    template = environment.from_string(_source("predictor.html.j2"))
    return template.render(panel=parts.markup, style=parts.style, script=parts.script)


def write_page(file: str | Path) -> Path:
    """Write the page to ``file`` (its folder is made) and return the path."""
    path = Path(file)
    write_atomically(path, page())
    return path
