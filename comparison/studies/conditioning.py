"""Conditioning of the step's matrix (thesis 3.3.2, (3.3.4)): why Δx = 10⁻⁴ m failed there, and does not here.

    S_T = [ M + h²βsK   Gᵀ ]
          [ G           0  ]

with the thesis's step, mesh and growth, at several element lengths, as it stands, in one unit for deflections and
rotations (rows and columns scaled to a unit diagonal, multipliers eliminated), and whether a run with these elements
finishes and how far it closes its energy budget.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_array, csc_array, dia_array
from scipy.sparse.linalg import LinearOperator, norm, onenormest, splu

from bent_beam.cases import Case
from bent_beam.errors import SimulationError
from bent_beam.meshes import GradedMesh
from bent_beam.method import Method
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.studies.base import Progress, Study, StudyResult
from comparison.studies.sentences import number
from comparison.studies.thesis import Settings, thesis_settings
from comparison.studies.variation import NotVaried, Setting
from hermite_fe.beam import HermiteBeam
from hermite_fe.contacts import NodeContact

__all__ = ["STUDY", "Conditioning", "conditioning", "sweep"]

FACTORS = (4.0, 2.0, 1.0, 0.4, 0.2, 0.1, 0.04)
UNCAPPED = 1e9
"""The thesis introduced its cap of 10³ on the ratio of lengths because of this: here there is none."""
LIMIT = 1.0 / np.finfo(float).eps
"""Condition at which no digit is left; Matlab's warning comes at this number."""


@dataclass(frozen=True)
class Conditioning:
    """element_length : m; elements : of the half beam; size_ratio : largest over smallest.

    raw : condition of S_T in the 1-norm; scaled : of M + h²βsK with a unit diagonal.
    defect : what the run's energy budget does not explain, over the largest loss (``None``: it did not finish).
    """

    element_length: float
    elements: int
    size_ratio: float
    raw: float
    scaled: float
    defect: float | None


def condition(matrix: Any) -> float:
    """Condition in the 1-norm (Higham and Tisseur's estimate)."""
    factors = splu(matrix)
    inverse = LinearOperator(
        matrix.shape, matvec=factors.solve, rmatvec=lambda b: factors.solve(b, trans="T"), dtype=float
    )
    return float(norm(matrix, 1) * onenormest(inverse))


def full(bands: NDArray[np.float64]) -> Any:
    """A lower banded matrix as a symmetric sparse one."""
    n = bands.shape[1]
    rows = [bands[0], *(bands[m, : n - m] for m in range(1, bands.shape[0]))]
    lower = sum(_diagonal(row, -m, n) for m, row in enumerate(rows))
    return csc_array(lower + sum(_diagonal(row, m, n) for m, row in enumerate(rows) if m))


def _diagonal(values: NDArray[np.float64], offset: int, n: int) -> Any:
    padded = np.zeros(n)
    start = max(offset, 0)
    padded[start : start + values.size] = values
    return dia_array((padded[None, :], [offset]), shape=(n, n)).tocsc()


def conditioning(case: Case, settings: Settings) -> Conditioning:
    """Of one mesh."""
    impact = case.impact
    nodes = settings.laid().nodes(impact.half_length)
    beam = HermiteBeam(nodes, impact.bending_stiffness, impact.mass_per_length)
    radius = settings.spectral_radius
    shift = (2.0 - radius) / (radius + 1.0)  # 1 − α_m (3.3.13)
    keep = 1.0 / (radius + 1.0)  # 1 − α_f (3.3.14)
    beta = 0.25 * (1.0 + radius / (radius + 1.0) - (2.0 * radius - 1.0) / (radius + 1.0)) ** 2  # (3.3.15–16)
    step = full(settings.mass.matrix(beam)) + settings.time_step**2 * beta * keep / shift * full(beam.stiffness())
    zone = int(np.searchsorted(nodes, settings.zone))
    rows = NodeContact().rows(beam, np.zeros(beam.dofs), full=False)
    G = csc_array((rows.factors[:zone, 0], (np.arange(zone), rows.dofs[:zone, 0])), shape=(zone, beam.dofs))
    free = np.arange(beam.dofs) != 1  # symmetry
    step, G = step[free][:, free], G[:, free]
    raw = condition(csc_array(block_array([[step, G.T], [G, None]])))
    scale = dia_array((1.0 / np.sqrt(step.diagonal())[None, :], [0]), shape=step.shape)
    scaled = condition(csc_array(scale @ step @ scale))
    lengths = np.diff(nodes)
    return Conditioning(
        settings.element_length,
        lengths.size,
        float(lengths.max() / lengths.min()),
        raw,
        scaled,
        _defect(case, settings),
    )


def _defect(case: Case, settings: Settings) -> float | None:
    try:
        history = settings.method().simulate(case.impact, end_time=case.end_time, save=20)
    except (SimulationError, ArithmeticError):
        return None
    budget = history.energy_budget()
    largest = max(abs(v) for k, v in budget.items() if k.startswith("loss_"))
    return abs(budget["defect"]) / largest


def sweep(case: Case, progress: Progress | None = None) -> list[Conditioning]:
    """One for each element length, the step and the growth as they are."""
    base = thesis_settings(case.impact, case.end_time).replace(contact="node")
    found = []
    for k, factor in enumerate(FACTORS):
        length = factor * base.element_length
        mesh = GradedMesh(length, base.growth, zone=base.zone, size_ratio=UNCAPPED)
        found.append(conditioning(case, base.replace(element_length=length, mesh=mesh)))
        if progress is not None:
            progress(k + 1, len(FACTORS))
    return found


def conclude(found: Sequence[Conditioning]) -> str:
    finest = found[-1]
    finished = [c for c in found if c.defect is not None]
    text = (
        f"The thesis reports a matrix close to singular at Δx = 10⁻⁴ m. At Δx = {finest.element_length:.2g} m "
        f"the condition of the step's matrix is {number(finest.raw)}; {number(LIMIT)} is where the last digit goes. "
        "Deflections and rotations in one unit and the multipliers eliminated, it is "
        f"{number(finest.scaled)}: most of it is units"
    )
    if len(finished) == len(found):
        worst = max(c.defect for c in finished if c.defect is not None)
        return f"{text}. Every run finishes and closes its energy budget to {number(worst)} of its largest loss."
    return f"{text}. {len(found) - len(finished)} of {len(found)} runs do not finish."


def draw(sheet: Sheet, found: Sequence[Conditioning]) -> None:
    """Both conditions over the element length."""
    lengths = np.array([c.element_length for c in found])
    with sheet.figure(width=4.2, height=3.0) as (_, axis):
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel(r"$\Delta x$  (m)")
        axis.set_ylabel("condition  (1)")
        line: dict[str, Any] = {"marker": "o", "ms": 4, "mfc": "none"}
        sheet.line(
            axis, lengths, [c.raw for c in found], series="$S_T$ (3.3.4)", color=style.COLOURS["vermilion"], **line
        )
        sheet.line(
            axis,
            lengths,
            [c.scaled for c in found],
            series="one unit, multipliers eliminated",
            color=style.COLOURS["blue"],
            **line,
        )
        axis.axhline(LIMIT, color=style.COLOURS["grey"], ls=":", lw=1.0)
        axis.text(lengths.max(), 0.4 * LIMIT, "no digit left", ha="right", va="top", fontsize=7)
        axis.legend(loc="center right")


COLUMNS = {
    "element_length": "Δx (m)",
    "elements": "elements of the half",
    "size_ratio": "largest/smallest",
    "raw": "condition of the step's matrix",
    "scaled": "condition, one unit",
    "defect": "energy defect/largest loss",
}


def own(case: Case, jobs: int, progress: Progress | None) -> tuple[StudyResult, Sheet]:
    found = sweep(case, progress)
    rows = [{key: getattr(c, key) for key in COLUMNS} for c in found]
    for row in rows:
        row["label"] = f"Δx = {row['element_length']:.2g} m"
    sheet = Sheet()
    draw(sheet, found)
    return StudyResult(STUDY.name, STUDY.title, case.title, COLUMNS, rows, conclude(found)), sheet


def vary(method: Method, case: Case) -> list[Setting]:
    raise NotVaried("no method shows the matrix of its step; the study takes apart that of the thesis's scheme")


STUDY = Study("conditioning", "Conditioning of the step's matrix", own=own, vary=vary, heading="step's matrix")
