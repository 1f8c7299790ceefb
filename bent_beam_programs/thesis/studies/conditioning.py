"""Conditioning of the step's matrix (thesis 3.3.2, (3.3.4)): why Δx = 10⁻⁴ m failed there, and does not here.

    S_T = [ M + h²βsK   Gᵀ ]
          [ G           0  ]

with the thesis's step, mesh and growth, at several element lengths: as it stands, and in one unit for deflections and
rotations (scaled to a unit diagonal, multipliers eliminated). The runs with these elements show their energy residual.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_array, csc_array, dia_array
from scipy.sparse.linalg import norm, splu

from bent_beam.cases import Case
from bent_beam.meshes import GradedMesh
from bent_beam_programs.thesis.sheet import Sheet
from bent_beam_programs.thesis.studies.base import Study
from bent_beam_programs.thesis.studies.of_methods import MethodOnCase, NotVaried
from bent_beam_programs.thesis.studies.outcome import Outcome
from bent_beam_programs.thesis.studies.thesis import Variant, thesis_settings
from comparison.figures import style
from comparison.readable import readable
from hermite_fe.beam import HermiteBeam
from hermite_fe.contacts import NodeContact
from hermite_fe.integrators.generalized_alpha import scheme_of

FACTORS = (4.0, 2.0, 1.0, 0.4, 0.2, 0.1, 0.04)
UNCAPPED = 1e9  # ratio of lengths, in place of the thesis's cap of 10³, which it introduced because of the conditioning
LIMIT = 1.0 / np.finfo(float).eps  # condition at which no digit is left; Matlab warns at this number
COLUMNS_AT_ONCE = 256  # of an inverse
COLUMNS = {
    "element_length": "Δx (m)",
    "elements": "elements of the half",
    "size_ratio": "largest/smallest",
    "raw": "condition of the step's matrix",
    "scaled": "condition, one unit",
    "defect": "energy defect/largest loss",
}


def condition(matrix: Any) -> float:
    """Condition in the 1-norm, ‖A‖₁ ‖A⁻¹‖₁: the inverse itself, some columns at a time, for an estimate is random."""
    factors, n = splu(matrix), matrix.shape[0]
    columns = (factors.solve(np.eye(n, min(COLUMNS_AT_ONCE, n - k), -k)) for k in range(0, n, COLUMNS_AT_ONCE))
    return float(norm(matrix, 1)) * max(float(np.abs(inverse).sum(axis=0).max()) for inverse in columns)


def full(bands: NDArray[np.float64]) -> Any:
    """A lower banded matrix, A[m, i] = A(i + m, i), as a symmetric sparse one."""
    order, n = bands.shape
    lower = dia_array((bands, -np.arange(order)), shape=(n, n))
    return csc_array(lower + lower.T - dia_array((bands[:1], [0]), shape=(n, n)))


def variants(case: Case) -> list[Variant]:
    """Conditioning of the step's matrix, nodes, lumped mass

    Condition of the step's matrix over the element length, as it stands and in one unit for deflections and rotations
    with the multipliers eliminated, and the energy residual of the runs: the ratio of the two conditions is that of the
    units, and no digit is left at 5·10¹⁵.
    """
    base = thesis_settings(case.impact, case.end_time).replace(contact="node")
    found = []
    for length in (factor * base.element_length for factor in FACTORS):
        mesh = GradedMesh(length, base.growth, zone=base.zone, size_ratio=UNCAPPED)
        method = base.replace(mesh=mesh).method()
        found.append(Variant(f"Δx = {readable(length, 2)} m", case.impact, case.end_time, method, length))
    return found


def conditions(variant: Variant, outcome: Outcome) -> dict[str, float | None]:
    """Both conditions of the step's matrix of a run, and its mesh."""
    impact = variant.impact
    settings = thesis_settings(impact, variant.end_time)
    method: Any = variant.method
    nodes = method.mesh.nodes(impact.half_length)
    beam = HermiteBeam(nodes, impact.bending_stiffness, impact.mass_per_length)
    scheme = scheme_of(settings.spectral_radius)
    step = full(settings.mass.matrix(beam)) + settings.time_step**2 * scheme.beta * scheme.s * full(beam.stiffness())
    zone = int(np.searchsorted(nodes, settings.zone))
    rows = NodeContact().rows(beam, np.zeros(beam.dofs), full=False)
    G = csc_array((rows.factors[:zone, 0], (np.arange(zone), rows.dofs[:zone, 0])), shape=(zone, beam.dofs))
    free = np.arange(beam.dofs) != 1  # symmetry
    step, G = step[free][:, free], G[:, free]
    scale = dia_array((1.0 / np.sqrt(step.diagonal())[None, :], [0]), shape=step.shape)
    lengths = np.diff(nodes)
    return {
        "element_length": variant.value,
        "elements": lengths.size,
        "size_ratio": float(lengths.max() / lengths.min()),
        "raw": condition(csc_array(block_array([[step, G.T], [G, None]]))),
        "scaled": condition(csc_array(scale @ step @ scale)),
    }


def draw(sheet: Sheet, outcomes: Sequence[Outcome]) -> None:
    lengths = [float(o.value or 0.0) for o in outcomes]
    with sheet.figure(width=4.2, height=3.0) as (_, axis):
        axis.set(xscale="log", yscale="log", xlabel=r"$\Delta x$  (m)", ylabel="condition  (1)")
        shown = {"raw": ("$S_T$ (3.3.4)", "vermilion"), "scaled": ("one unit, multipliers eliminated", "blue")}
        for name, (series, colour) in shown.items():
            values, shade = np.array([o.measures[name] for o in outcomes], float), style.COLOURS[colour]
            sheet.line(axis, lengths, values, series=series, color=shade, marker="o", ms=4, mfc="none")
        axis.axhline(LIMIT, color=style.COLOURS["grey"], ls=":", lw=1.0)
        axis.text(max(lengths), 0.4 * LIMIT, "no digit left", ha="right", va="top", fontsize=7)
        axis.legend(loc="center right")


def vary(on: MethodOnCase) -> list[Variant]:
    raise NotVaried("no method shows the matrix of its step; the study takes apart that of the thesis's scheme")


STUDY = Study("conditioning", "step's matrix", variants, vary, columns=COLUMNS, more=conditions, draw=draw)
