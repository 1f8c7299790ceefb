"""The parameter studies for the report: conclusions and pictures, stored with their date.

They take minutes, so the report shows what ``python -m comparison.report.studies`` has measured and written to
``stored/studies.json`` and the pictures beside it; the page says when, and with which versions. Given names, the
command measures those studies again and keeps the others with their dates.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from PIL import Image

from bent_beam.cases import Case, case_from_tables
from bent_beam.errors import SimulationError
from bent_beam.versions import stamp, today, versions
from comparison.store import write_atomically
from comparison.workers import run_all

__all__ = ["STORED", "StudyNote", "known_studies", "store_studies", "stored_studies"]

STORED = Path(__file__).with_name("stored")

BEAM = {"bending_stiffness": 1.0, "mass_per_length": 1.0}
USUAL: dict[str, Any] = {
    "title": "thesis, K = 10 1/m, V₀ = 20 m/s (κ/ν = 0.5)",
    "beam": {**BEAM, "length": 50.0, "curvature": 10.0},
    "impact": {"velocity": 20.0},
    "run": {"duration": 0.1},
}
FIRST_ORDER: dict[str, Any] = {
    "title": "thesis, V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m (κ/ν = 0.1)",
    "beam": {**BEAM, "length": 2.0, "curvature": 0.35},
    "impact": {"velocity": 3.5, "acceleration": 700.0},
    "run": {"duration": 0.05},
}
OWN_CASES = {"first-order-case": FIRST_ORDER}


@dataclass(frozen=True)
class StudyNote:
    """A study's title, its case and its conclusion, or why it is left out; the date of its measurement."""

    name: str
    title: str
    conclusion: str
    case: str = ""
    failed: bool = False
    date: str = ""

    @property
    def picture(self) -> Path:
        """Its picture, where it is stored."""
        return STORED / f"{self.name}.png"


def known_studies() -> dict[str, str]:
    """Name → title of every study."""
    from comparison.studies import STUDIES

    return {name: study.title for name, study in STUDIES.items()}


def case_of(name: str) -> Case:
    """The thesis's case that a study is shown on."""
    return case_from_tables(OWN_CASES.get(name, USUAL))


def stored_studies() -> list[StudyNote]:
    """The notes of the stored studies, in the order of the studies; none where nothing is stored."""
    file = STORED / "studies.json"
    if not file.exists():
        return []
    document = json.loads(file.read_text(encoding="utf-8"))
    return [StudyNote(**note) for note in document["studies"]]


def store_studies(names: Sequence[str], *, jobs: int = 1) -> Path:
    """Run the studies and write their conclusions and pictures to ``stored/``; returns the file of conclusions.

    Studies that are not named stay as they are stored. Raises ``ValueError`` for an unknown name, and where stored
    studies would be kept that were measured with other versions than today's.
    """
    titles = known_studies()
    if unknown := sorted(set(names) - set(titles)):
        raise ValueError(f"no study is called {', '.join(unknown)}; there are {', '.join(titles)}")
    kept = {note.name: note for note in stored_studies() if note.name in titles and note.name not in names}
    file = STORED / "studies.json"
    if kept and json.loads(file.read_text(encoding="utf-8"))["versions"] != versions():
        raise ValueError(f"{', '.join(kept)}: measured with other versions; run all studies again")
    wanted = [(name, titles[name]) for name in titles if name in names]
    notes = run_all(_note, wanted, jobs=jobs, on_death=lambda i, why: lost(*wanted[i], why))
    kept = {note.name: note for note in stored_studies() if note.name in kept}  # another run may have written since
    found = kept | {note.name: note for note in notes}
    document = {
        "what": "conclusions of the parameter studies, for the report",
        **stamp("python -m comparison.report.studies"),
        "date": max(note.date for note in found.values()),
        "studies": [asdict(found[name]) for name in titles if name in found],
    }
    write_atomically(file, json.dumps(document, indent=1, ensure_ascii=False) + "\n")
    return file


def _note(name: str, title: str) -> StudyNote:
    """One study in a worker, its picture made small."""
    from comparison.studies import run_study

    case = case_of(name)
    try:
        with TemporaryDirectory() as folder:
            conclusion = run_study(name, case, out=Path(folder)).conclusion
            picture = Path(folder) / f"{name}.png"
            if picture.exists():
                small_picture(picture, STORED / picture.name)
    except (ArithmeticError, ValueError, SimulationError) as error:
        return lost(name, title, " ".join(str(error).split()))
    return StudyNote(name, title, conclusion, case.title, date=today())


def small_picture(file: Path, target: Path) -> None:
    """A copy of a PNG in 64 colours: enough for lines and a third of the bytes."""
    with Image.open(file) as image:
        stream = BytesIO()
        image.convert("RGB").quantize(64).save(stream, format="PNG", optimize=True)
    write_atomically(target, stream.getvalue())


def lost(name: str, title: str, why: str) -> StudyNote:
    """The note of a study that could not be run."""
    return StudyNote(
        name,
        title,
        f"Left out ({why}). To run it alone: bentbeam study {name} cases/thesis_K10.toml",
        failed=True,
        date=today(),
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="studies to measure again (all)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    rounds = [given.names[i : i + given.jobs] for i in range(0, len(given.names), given.jobs)]
    for names in rounds or [list(known_studies())]:  # what is measured one by one is kept one by one
        print(store_studies(names, jobs=given.jobs), *names, flush=True)
