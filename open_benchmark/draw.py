"""Problems whose parameters are drawn at run time: nobody can have their answers ready.

A drawn problem is one of the standard kind near it: κ/ν, ζ and the stiffness of a stop within 15 %, each load within
30 %, tension with the free motion that belongs to it. Problems with one κ/ν get one κ/ν, so that they share their base.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from open_benchmark.problem import IDS, Problem, problem

__all__ = ["drawn"]


def drawn(names: Sequence[str], seed: int) -> list[str]:
    """Ids of drawn problems like those named; none for the ladder and the whole impacts, which are what they are."""
    kept = [problem(name) for name in names]
    near = (_near(one, seed) for one in kept if one.is_front or one.kind.startswith("elastic"))
    return list(dict.fromkeys(near))


def _near(asked: Problem, seed: int) -> str:
    if not asked.is_front:
        found, draw = IDS[asked.kind].fullmatch(asked.id), random.Random(f"{seed} {asked.id}")
        numbers = [float(f"{float(word) * draw.uniform(0.85, 1.15):.4g}") for word in (found.groups() if found else ())]
        return "-".join([asked.kind, *(f"{value:.12g}" for value in numbers)])
    kappa = asked.kappa_over_nu * random.Random(f"{seed} {asked.kappa_over_nu:g}").uniform(0.85, 1.15)
    kappa = float(f"{min(kappa, 0.95) if asked.kappa_over_nu < 1.0 else max(kappa, 1.05):.4g}")
    if asked.kind != "first":
        return f"{asked.kind}-{kappa:g}"
    draw = random.Random(f"{seed} {asked.id}")
    alpha, psi, chi, axial = (float(f"{load * draw.uniform(0.7, 1.3):.3g}") for load in asked.loads)
    if math.isclose(asked.loads[0], -asked.kappa_over_nu * asked.loads[3]) and axial:
        alpha = float(f"{-kappa * axial:.6g}")  # tension lets go of the bow
    loads = [alpha, psi, chi, axial] if axial else [alpha, psi, chi]
    return "-".join(["first", f"{kappa:g}", *(f"{load:g}" for load in loads)])
