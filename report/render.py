"""All that the report shows, put into ``templates/report.html.j2`` with plotly.js inside."""

from __future__ import annotations

import base64
import json
import os
import platform
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from bent_beam.versions import processor, versions
from comparison.figures.style import marks
from comparison.rows import MatchRow, failures
from report.impacts import ENERGIES, ShownImpact, theory_of
from report.pipe import COLUMNS, Pipe
from report.plots import plots
from report.rows import first_order_rows, labels, leading_rows
from report.stills import grouped
from report.studies import StoredStudy
from report.summary import acceleration_rows, headline, percent, summary
from report.work import StoredMeasurement

__all__ = ["Content", "render"]

TEMPLATES = Path(__file__).resolve().parent / "templates"


@dataclass(frozen=True)
class Content:
    """All that the page shows."""

    rows: Sequence[MatchRow]
    impacts: Sequence[ShownImpact] = ()
    lost_impacts: Sequence[str] = ()
    pipe: Pipe | None = None
    studies: Sequence[StoredStudy] = ()
    work: Sequence[StoredMeasurement] = ()
    pictures: Sequence[Path] = ()
    seconds: float = 0.0
    jobs: int = 1


def render(content: Content) -> str:
    """The whole page as text. Nothing in it refers to anything outside it; every string is escaped."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"percent": percent, "picture": picture}
    leading, first = leading_rows(content.rows), first_order_rows(content.rows)
    return environment.get_template("report.html.j2").render(
        content=content,
        headline=headline(leading, first, len(failures(content.rows))),
        summary=summary(leading, first),
        leading=leading,
        first=first,
        failures=[row for row in content.rows if row.reason],
        warnings=[(r, w) for r in [*leading, *first] for w in r.row.warnings],
        methods=labels(content.rows),
        colours={label: mark["color"] for label, mark in marks(labels(content.rows)).items()},
        groups=grouped(content.impacts),
        shown_methods=list(dict.fromkeys(i.label for i in content.impacts)),
        energies=[
            style
            for name, style in ENERGIES.items()
            if any(any(i.data["energy"].get(name, ())) for i in content.impacts)
        ],
        acceleration=acceleration_rows(content.impacts),
        pipe_headings=[heading for heading, _ in COLUMNS.values()],
        pictures={file.stem: picture(file) for file in content.pictures},
        facts=facts(content),
        settings=settings(content),
        data={
            "plots": plots(leading, first),
            "energies": ENERGIES,
            "impacts": [impact_data(runs) for runs in grouped(content.impacts).values()],
        },
        plotly=inline_script(get_plotlyjs()),
        script=inline_script((TEMPLATES / "report.js").read_text(encoding="utf-8")),
        style=Markup((TEMPLATES / "report.css").read_text(encoding="utf-8")),
    )


def inline_script(text: str) -> Markup:
    """Our own or plotly's script, safe between script tags."""
    return Markup(text.replace("</script", "<\\/script").replace("<!--", "<\\!--"))


def picture(file: Path) -> str:
    """A PNG as a data URL; empty where there is none."""
    return "data:image/png;base64," + base64.b64encode(file.read_bytes()).decode("ascii") if file.exists() else ""


def impact_data(runs: Sequence[ShownImpact]) -> dict[str, Any]:
    """An impact as the page's script reads it: theory and every method on one timeline."""
    shown = runs[0].shown
    colours = marks(run.label for run in runs)
    return {
        "name": shown.name,
        "title": shown.title,
        "kappa": shown.kappa_over_nu,
        "epsilon": shown.epsilon,
        "theory": theory_of(shown),
        "methods": [{"label": run.label, "colour": colours[run.label]["color"], **run.data} for run in runs],
    }


def facts(content: Content) -> dict[str, str]:
    """Versions, machine and times."""
    return {
        "written": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "rows": f"{len(content.rows)} asked for, {len(failures(content.rows))} failed",
        "time for this report": f"{content.seconds:.0f} s, {content.jobs} processes at most",
        "time in the rows": f"{sum(r.seconds or 0.0 for r in content.rows):.0f} s "
        "(runs kept from before count what they took then)",
        "processor": processor(),
        "cores": str(os.cpu_count() or "unknown"),
        "system": f"{platform.system()} {platform.release()} ({platform.machine()})",
        "Python": platform.python_version(),
        **versions(),
        "plotly": version("plotly"),
    }


def settings(content: Content) -> dict[str, str]:
    """Settings of the runs: title → JSON text."""
    found: dict[str, Any] = {f"Method: {row.label}": row.settings for row in content.rows}
    found |= {f"Shown impact: {i.label}, {i.shown.title}": dict(i.settings) for i in content.impacts}
    return {title: json.dumps(value, indent=1, ensure_ascii=False) for title, value in found.items()}
