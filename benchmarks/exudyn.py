"""How much of an Exudyn run is spent inside its solver (set-up and recording take the rest), and how long a run takes
that is right to 0.02 % in λ₀ and r₀. Goals in seconds are those of an idle machine.
"""

import math
import time
from collections.abc import Iterator
from typing import Any

import exudyn_models
from benchmarks.record import Row
from bent_beam import Impact, ImpactHistory
from bent_beam.measure.estimators import leading_order
from bent_beam.measure.moments import moments
from bent_beam.meshes import UniformMesh
from exudyn_models.contacts import Penalty
from theory import contact_parameters

ROUNDS = 3
SHARE = 0.9  # of the solver, the least
KAPPAS = (0.1, 0.25, 0.5)
RIGHT = 2e-4  # in λ₀ and r₀
REFINES = (0.7, 0.6, 0.5, 0.45, 0.4, 0.35, 0.3)  # elements and steps, from right to wrong
HOLD = 16  # elements behind the front: without it κ/ν = 0.1 is never right to 0.02 % (docs/exudyn.md)
SECONDS = 0.4


def measure() -> Iterator[Row]:
    """Runs as they are chosen from κ/ν, one with 600 nodes, and the coarsest that is right, as is every finer one."""
    for kappa in KAPPAS:
        yield _share(f"κ/ν = {kappa:g}", Impact.dimensionless(kappa))
    yield _share("600 nodes", Impact.dimensionless(0.5, length=24.0), mesh=UniformMesh(0.02))
    for kappa in KAPPAS:
        yield _precision(kappa)


def _timed(impact: Impact, **settings: Any) -> list[tuple[ImpactHistory, float]]:
    """Histories, and how long each took, s."""
    found = []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        history = exudyn_models.simulate(impact, end_time=0.1, **settings)
        found.append((history, time.perf_counter() - began))
    return found


def _share(label: str, impact: Impact, **settings: Any) -> Row:
    found = _timed(impact, **settings)
    share = min(history.seconds / seconds for history, seconds in found)
    about = {"seconds": round(min(seconds for _, seconds in found), 3)}
    return Row(f"Exudyn, {label}: share of its solver", share, SHARE, at_least=True, about=about)


def _precision(kappa: float) -> Row:
    exact = contact_parameters(kappa)
    least, about = math.inf, {}
    for refine in REFINES:
        runs = _timed(Impact.dimensionless(kappa), contact=Penalty(hold=HOLD), refine=refine, save=250)
        found = leading_order(moments(runs[-1][0]))
        errors = found.lambda0.value / exact.lambda0 - 1.0, found.r0.value / exact.r0 - 1.0
        if max(map(abs, errors)) > RIGHT:
            break
        least = min(seconds for _, seconds in runs)
        about = {"refine": refine, "errors": [round(error, 6) for error in errors]}
    return Row(f"Exudyn, κ/ν = {kappa:g}: λ₀, r₀ to 0.02 %, s", least, SECONDS, about=about)
