"""The parameter studies on the thesis's own cases, stored for the report: they take minutes.

``python -m bent_beam_programs.thesis.stored_studies`` writes ``studies.json`` in ``bent_beam_programs/stored_studies``,
{"studies": [{"name", "title", "case", "columns", "rows", "conclusion", "says", "failed", "reason", "date"}]}, and
``NAME.png`` beside it.
"""

import argparse
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from PIL import Image

from bent_beam import SimulationError, stored
from bent_beam.cases import Case, case_from_tables
from bent_beam.files import write_atomically
from bent_beam.versions import today
from bent_beam_programs.thesis.studies import STUDIES, run_study
from comparison.matching import CODE
from comparison.workers import run_all

FILE = Path(__file__).resolve().parents[1] / "stored_studies" / "studies.json"
PACKAGES = (*CODE, "bent_beam_programs.thesis")
COLOURS = 256  # of a picture: a quarter of the bytes
BEAM = {"bending_stiffness": 1.0, "mass_per_length": 1.0}


def of_leading_order(name: str, curvature: float, ratio: str, tau: float) -> dict[str, Any]:
    """A case of the thesis at V₀ = 20 m/s, L = 50 m; name : of its curvature (1/m); ratio : of κ/ν."""
    return {
        "title": f"thesis, K = {name} 1/m, V₀ = 20 m/s (κ/ν = {ratio}), τ = {tau:g}",
        "beam": {**BEAM, "length": 50.0, "curvature": curvature},
        "impact": {"velocity": 20.0},
        "run": {"duration": tau},
    }


BENT = of_leading_order("10", 10.0, "0.5", 0.1)
STEPPED = of_leading_order("1", 1.0, "0.05", 0.01)
FIRST_ORDER: dict[str, Any] = {
    "title": "thesis, V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m (κ/ν = 0.1)",
    "beam": {**BEAM, "length": 2.0, "curvature": 0.35},
    "impact": {"velocity": 3.5, "acceleration": 700.0},
    "run": {"duration": 0.05},
}
CASES: dict[str, dict[str, Any]] = dict.fromkeys(STUDIES, BENT) | {  # those that the thesis made: its own cases
    "time-step": STEPPED,  # 3.3.1
    "mesh": STEPPED,  # 3.3.2
    "conditioning": STEPPED,  # 3.3.2
    "damping": of_leading_order("1/40", 1.0 / 40.0, "1/800", 0.01),  # 3.3.3
    "restitution": of_leading_order("1/40", 1.0 / 40.0, "1/800", 0.1),  # 3.3.4
    "contact-point": of_leading_order("1/80", 1.0 / 80.0, "1/1600", 0.1),  # 3.3.5
    "first-order-case": FIRST_ORDER,  # 3.5
}
SAYS = {  # what the thesis says of a study, and whether it is so, on its own case
    "time-step": "The thesis (3.3.1) sees the lift whatever h, and rules out 10⁻⁶ and 10⁻⁷ s by their reactions. Here "
    "neither lift nor r₀ depends on h from 10⁻⁷ s down; its reactions do, because of its filter.",
    "mesh": "The thesis (3.3.2) sees lifts of one order whatever Δx, no effect of e, and too large a reaction with "
    "5 mm: so it is here, and r₀ is too large with its other lengths too.",
    "damping": "The thesis (3.3.3) sees no major change with ρ∞, and little dissipation against the loss in impacts: "
    "so it is here.",
    "restitution": "The thesis (3.3.4) sees more lift with 1 than with 0, and takes the loss with 0 for that of a "
    "real impact: the first is so here, the second is not so in theory.",
    "contact-point": "The thesis (3.3.5) has a tenth of the lift with nodes, and less noise with middles: so it is "
    "with lumped masses, while with the consistent matrix nodes and middles are alike.",
    "conditioning": "The thesis (3.3.2) gives up Δx = 10⁻⁴ m, where its matrix is close to singular: here it runs and "
    "closes its energy budget.",
    "first-order-case": "The thesis (3.5) fits 227 and −270.8 m/s^1.5, does not say over which part of its run, and "
    "has no value of theory to compare with.",
}


def case_of(name: str) -> Case:
    return case_from_tables(CASES[name])


def small_picture(file: Path, width: int | None = None) -> bytes:
    """A PNG in few colours, and so many pixels wide. By median cut thin lines would lose theirs: blue became green."""
    stream = BytesIO()
    with Image.open(file) as image:
        size = image.size if width is None else (width, round(width * image.height / image.width))
        small = image.convert("RGB").resize(size).quantize(COLOURS, Image.Quantize.MAXCOVERAGE, kmeans=1)
        small.save(stream, format="PNG", optimize=True)
    return stream.getvalue()


def note_of(name: str, folder: Path) -> dict[str, Any]:
    """Run one study; its picture, made small, goes to ``folder``."""
    note = lost(name, "")
    try:
        with TemporaryDirectory() as work:
            found = run_study(name, case_of(name), out=Path(work)).to_dict()
            picture = small_picture(Path(work) / f"{name}.png")
    except (ArithmeticError, ValueError, OSError, SimulationError) as error:
        return note | {"reason": " ".join(str(error).split())}
    write_atomically(folder / f"{name}.png", picture)
    return note | {"columns": found["columns"], "rows": found["rows"], "failed": False}


def lost(name: str, reason: str) -> dict[str, Any]:
    """The note of a study that could not be run."""
    study, case = STUDIES[name], case_of(name)
    said = {"name": name, "title": study.title, "case": case.title, "conclusion": study.conclusion}
    found = {"columns": {}, "rows": [], "failed": True, "reason": reason, "date": today()}
    return said | {"says": SAYS.get(name, "")} | found


def store_studies(*, file: Path = FILE, jobs: int = 1) -> Path:
    """Run the studies, ``jobs`` at the same time, and store them."""
    file.parent.mkdir(parents=True, exist_ok=True)
    calls = [(name, file.parent) for name in STUDIES]
    notes = run_all(note_of, calls, jobs=jobs, on_death=lambda i, why: lost(calls[i][0], why))
    made_by = "python -m bent_beam_programs.thesis.stored_studies"
    what, data = "parameter studies of the thesis", {"studies": notes}
    return stored.write(file, what, made_by, PACKAGES, {"cases": CASES}, data)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jobs", type=int, default=1, help="studies at the same time")
    store_studies(jobs=parser.parse_args().jobs)


if __name__ == "__main__":
    main()
