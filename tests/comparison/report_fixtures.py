"""Made-up rows and real reduced impacts, small enough for every test of the report."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from bent_beam.meshes import ScaleFreeMesh
from comparison.compared import Compared
from comparison.match import MatchRow
from comparison.report.impacts import SHOWN, ShownImpact, show, theory_of
from comparison.report.noise import Noise
from comparison.report.page import Content, machine
from comparison.report.pipe import pipe_verdict
from comparison.report.studies import StudyNote
from hermite_fe import HermiteFE
from self_similar_fe import SelfSimilarFE
from theory import contact_parameters

NASTY = "<script>alert('x')</script> & \"quotes\" </script>"


LABELS = {"hermite": "Hermite", "exudyn": "Exudyn"}


def row(path: str, kappa: float, first: tuple[float, float, float] | None = None, off: float = 1e-4) -> MatchRow:
    """A row that is ``off`` (relative) from theory, with an error bar twice that."""
    alpha, psi, chi = first or (0.0, 0.0, 0.0)
    exact = contact_parameters(kappa, alpha, psi, chi)
    numbers = {
        name: Compared(value + sign * off * max(abs(value), least), 2 * off * max(abs(value), least), value)
        for name, sign, least in (("lambda0", 1, 0.0), ("r0", -1, 0.0), ("lambda1", 1, 1.0), ("r1", 1, 1.0))
        if (value := float(getattr(exact, name))) is not None and (first or name.endswith("0"))
    }
    return MatchRow(
        label=LABELS[path], path=path, settings={}, kappa_over_nu=kappa, alpha=alpha, psi=psi, chi=chi, axial=0.0,
        refine=1.0, regime=str(exact.regime), lift=1e-9, pull=0.0, seconds=0.5 if path == "hermite" else 5.0,
        epsilons=[0.1, 0.2] if first else [], **numbers,
    )  # fmt: skip


def lost(path: str, kappa: float, reason: str) -> MatchRow:
    """A row that failed."""
    return MatchRow(
        label=LABELS[path], path=path, settings={}, kappa_over_nu=kappa, alpha=1.0, psi=0.0, chi=0.0, axial=0.0,
        refine=1.0, reason=reason,
    )  # fmt: skip


def rows() -> list[MatchRow]:
    """Leading and first order on both paths; one row of each grade."""
    leading = [row(path, k) for k in (1 / 1600, 1 / 20, 0.25, 0.5) for path in ("hermite", "exudyn")]
    coarse = [replace(row(path, 0.5, off=4e-4), refine=0.5, seconds=0.1) for path in ("hermite", "exudyn")]
    return [
        *leading,
        *coarse,
        row("hermite", 0.5, (4, 0, 0), 2e-3),
        row("exudyn", 0.5, (4, 0, 0), 2.5e-2),
        row("hermite", 0.1, (1, 0, 0), 4e-2),
        row("hermite", 0.8, (-1, -1, 1), 0.2),
    ]


METHODS = (SelfSimilarFE(), HermiteFE(mesh=ScaleFreeMesh(element_length=4e-3, growth=1.02)))


@cache
def impacts() -> tuple[ShownImpact, ...]:
    """Every impact by two methods, on meshes of a second."""
    return tuple(show(shown, method) for shown in SHOWN for method in METHODS)


@cache
def noise() -> Noise:
    """A before and after without the minute that the real one takes: the same run with a scatter of a tenth."""
    after = impacts()[1]
    reaction = np.array(theory_of(after.shown)["reaction"])
    scatter = reaction * (1.0 + 0.1 * np.random.default_rng(1).standard_normal(reaction.size))
    before = {**after.data, "reaction": scatter.tolist(), "lift": [0.01] * reaction.size}
    return Noise(replace(after, label="settings of the thesis", data=before), replace(after, label="settings of today"))


def bounce() -> dict[str, object]:
    """A map of whole impacts of two points and a band."""
    points = [
        {"kappa_over_nu": k, "damping": d, "numbers": {"restitution": [e, 0.01]}}
        for k, d, e in ((0.5, 1e-3, 0.456), (1.5, 1e-3, 0.616), (0.5, 1e-2, 0.336), (1.5, 1e-2, 0.5626))
    ]
    bands = [{"kappa_over_nu": k, "band": {"restitution": [e, 0.03]}} for k, e in ((0.5, 0.43), (1.5, 0.64))]
    return {"date": "2026-01-01", "made_by": "a test", "damping": [1e-3, 1e-2], "points": points, "bands": bands}


def content(nasty: bool = False) -> Content:
    """All that a page shows; with ``nasty`` every string that comes from files holds markup."""
    every = rows()
    text = NASTY if nasty else "an ordinary warning"
    every[0].warnings.append(text)
    every.append(lost("exudyn", 0.3, text))
    return Content(
        rows=every, impacts=impacts(), lost_impacts=[text], noise=noise(), pipe=pipe_verdict(), bounce=bounce(),
        studies=[StudyNote("mesh", text, text)], seconds=12.0, jobs=2,
        machine={**machine(), "processor": text},
    )  # fmt: skip
