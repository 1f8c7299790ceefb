"""Made-up rows and real reduced impacts, small enough for every test of the report."""

import tempfile
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from bent_beam.measure.numbers import Number
from bent_beam.meshes import ScaleFreeMesh
from bent_beam.method import method_from_tables
from bent_beam.stored import write
from bent_beam_programs.report.impacts import SHOWN, ShownImpact, show
from bent_beam_programs.report.whole import PIPE, pipe_prediction
from comparison.rows import MatchQuestion, MatchRow, lost_row
from comparison.store import RunStore
from hermite_fe import HermiteFE
from self_similar_fe import ExpandingMesh, SelfSimilarFE

Load = tuple[float, float, float]  # α, ψ, χ


def row(path: str, kappa: float, first: Load | None = None, off: float = 1e-4) -> MatchRow:
    """A row that is ``off`` (relative) from theory, with an error bar twice that."""
    blank, numbers = lost(path, kappa, "", first), {}
    for name, sign, least in (("lambda0", 1, 0.0), ("r0", -1, 0.0), ("lambda1", 1, 1.0), ("r1", 1, 1.0)):
        if (value := getattr(blank, name).theory) is not None:
            wrong = off * max(abs(value), least)
            numbers[name] = Number(value + sign * wrong, 2.0 * wrong, value)
    told = {"seconds": 0.5 if path == "hermite" else 5.0, "lift": 1e-9, "pull": 0.0}
    return replace(blank, reason=None, epsilons=[0.1, 0.2] if first else [], **told, **numbers)


def lost(path: str, kappa: float, reason: str, first: Load | None = (1.0, 0.0, 0.0)) -> MatchRow:
    return lost_row(MatchQuestion(method_from_tables(path, {}), kappa, first), reason)


def rows() -> list[MatchRow]:
    """Leading and first order on both paths; one row of each grade."""
    leading = [row(path, k) for k in (1 / 1600, 1 / 20, 0.25, 0.5) for path in ("hermite", "exudyn")]
    coarse = [replace(row(path, 0.5, off=4e-4), refine=0.5, seconds=0.1) for path in ("hermite", "exudyn")]
    first = [("hermite", 0.5, 2e-3), ("exudyn", 0.5, 2.5e-2), ("hermite", 0.7, 1.5e-2), ("hermite", 0.8, 0.2)]
    return [*leading, *coarse, *(row(path, kappa, (4.0, 0.0, 0.0), off) for path, kappa, off in first)]


FOLDER = Path(tempfile.mkdtemp())
KEPT = RunStore(FOLDER / "store")


@cache
def pipe() -> dict[str, Any] | None:
    """As the page shows it, on coarser elements."""
    coarse = FOLDER / "pipe.toml"
    coarse.write_text(PIPE.read_text() + "\n[hermite]\nrefine = 0.05\n")
    return pipe_prediction(coarse, store=KEPT)


ROUGH = ScaleFreeMesh(element_length=4e-3, growth=1.02)
METHODS = (SelfSimilarFE(mesh=ExpandingMesh(decades=3.0)), HermiteFE(mesh=ROUGH))


@cache
def impacts() -> tuple[ShownImpact, ...]:
    """Every impact by two methods, on meshes of a second."""
    return tuple(show(shown, method) for shown in SHOWN for method in METHODS)


def studies(folder: Path, text: str) -> Path:
    """A file of stored studies with every kind of cell, and one study that failed."""
    study = {"name": "made-up", "title": "Mesh", "case": "κ/ν = 0.5", "conclusion": text, "failed": False,
             "reason": None, "date": "2026-01-02", "columns": {"element": "length", "lambda0": "λ₀", "note": "note"},
             "rows": [{"element": 0.05, "lambda0": 0.98, "note": None}]}  # fmt: skip
    failed = study | {"name": "failing", "title": "Penalty", "rows": [], "failed": True, "reason": text}
    return write(folder / "studies.json", "studies", "a test", ["bent_beam.measure"], {}, {"studies": [study, failed]})
