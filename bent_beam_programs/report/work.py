"""Work and precision of many methods, for the report and the README: rows and pictures, stored with what made them.

They take minutes, so the report shows what ``python -m bent_beam_programs.report.work [NAME]`` wrote to ``stored/``:
all integrators with all contacts at leading order, and the integrators at first order. Rows that are kept, of an
interrupted measurement too, are not run again.
"""

import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bent_beam import stored
from bent_beam.cases import EXAMPLES
from comparison.figures.work_precision import draw_work_precision
from comparison.matching import CODE, match
from comparison.methods import methods_from_file
from comparison.rows import First, questions
from comparison.store import RunStore

STORED = Path(__file__).with_name("stored")
LISTS = EXAMPLES / "methods"
KAPPA = 0.5
LIMIT = 120.0  # s, for one row
KEPT = ("label", "path", "kappa_over_nu", "alpha", "psi", "chi", "axial", "refine", "lambda0", "r0", "lambda1", "r1",
        "lift", "pull", "seconds", "steps", "reason")  # fmt: skip


@dataclass(frozen=True)
class Measurement:
    """What is measured. methods : files in cases/methods."""

    name: str
    title: str
    methods: tuple[str, ...]
    refines: tuple[float, ...]
    firsts: tuple[First, ...] = ()

    @property
    def command(self) -> str:
        """The same rows from the command line."""
        methods = " ".join(f"--methods cases/methods/{file}" for file in self.methods)
        firsts = "".join(f" --first-order={','.join(f'{v:g}' for v in first[:3])}" for first in self.firsts)
        asked = f"bentbeam match {methods} --kappa-over-nu {KAPPA:g}{firsts}"
        return f"{asked} --refine {','.join(f'{r:g}' for r in self.refines)} --limit {LIMIT:g} --jobs 2 --out out"


MEASUREMENTS = (
    Measurement("work-precision", "all integrators with all contacts, leading order", ("hermite.toml", "exudyn.toml"),
                (1.0, 2.0)),
    Measurement("work-precision-first-order", "integrators, first order", ("first_order.toml",), (0.5, 1.0),
                ((4.0, 0.0, 0.0, 0.0),)),
)  # fmt: skip


def stored_measurements() -> list[dict[str, Any]]:
    """What is stored, in the order of :data:`MEASUREMENTS`: title, command, date, picture; ``lost``: label and reason
    of the rows without a number; ``stale``: code has changed since."""
    found = []
    for measurement in MEASUREMENTS:
        document = stored.read(file := STORED / f"{measurement.name}.json")
        lost = {row["label"]: row["reason"] for row in document["rows"] if row["reason"]}
        shown = {"title": measurement.title, "lost": list(lost.items()), "picture": file.with_suffix(".png")}
        found.append(document | shown | {"stale": stored.is_stale(file)})
    return found


def main(names: Sequence[str]) -> None:
    """Measure what these names say (none: everything) and write rows and pictures to ``stored/``. Raises
    ``SystemExit`` for a name that no measurement has."""
    known = {measurement.name: measurement for measurement in MEASUREMENTS}
    if unknown := [name for name in names if name not in known]:
        raise SystemExit(f"{unknown[0]} is not a measurement (known: {', '.join(known)})")
    for one in [known[name] for name in dict.fromkeys(names or known)]:
        methods = methods_from_file(*(LISTS / file for file in one.methods))
        asked = questions(methods, [KAPPA], one.firsts, one.refines)
        rows = match(asked, store=RunStore.usual(), jobs=os.cpu_count() or 1, limit=LIMIT)
        draw_work_precision(rows, STORED)
        made_by = f"python -m bent_beam_programs.report.work {one.name}"
        settings = {row.label: row.settings for row in rows}
        data = {"command": one.command, "rows": [{name: row.to_dict()[name] for name in KEPT} for row in rows]}
        what = f"work and precision: {one.title}"
        print(stored.write(STORED / f"{one.name}.json", what, made_by, CODE, settings, data))


if __name__ == "__main__":
    main(sys.argv[1:])
