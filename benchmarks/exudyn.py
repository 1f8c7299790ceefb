"""How much of an Exudyn run is spent inside its solver (set-up and recording take the rest), and how long a run takes
that is right to 0.02 % in λ₀ and r₀. Goals in seconds are those of an idle machine.

python -m benchmarks.exudyn [--rounds 3] [--out benchmarks/results/exudyn.json]
"""

from __future__ import annotations

import math

import exudyn_models
from benchmarks.record import Row, keep, options, said
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from comparison.estimators import leading_order, moments
from exudyn_models.contacts import Penalty
from theory import contact_parameters

GOAL = 0.9
KAPPAS = (0.1, 0.25, 0.5)
RIGHT = 2e-4  # in λ₀ and r₀
REFINES = (0.7, 0.6, 0.5, 0.45, 0.4, 0.35, 0.3)  # elements and steps, from right to wrong
HOLD = 16  # elements behind the front: without it κ/ν = 0.1 is never right to 0.02 % (docs/exudyn.md)
SECONDS = 0.4


def measure(rounds: int) -> list[Row]:
    """The least share of some runs as they are chosen from κ/ν, and at 600 nodes."""
    cases: list[tuple[str, Impact, UniformMesh | None]] = [
        *((f"κ/ν = {kappa:g}", Impact.dimensionless(kappa), None) for kappa in KAPPAS),
        ("600 nodes", Impact.dimensionless(0.5, length=24.0), UniformMesh(0.02)),
    ]
    rows = []
    for label, impact, mesh in cases:
        shares, seconds = [], []
        for _ in range(rounds):
            history = exudyn_models.simulate(impact, end_time=0.1, mesh=mesh)
            shares.append(history.seconds / history.settings["wall_seconds"])
            seconds.append(history.settings["wall_seconds"])
        about = {"seconds": round(min(seconds), 3)}
        rows.append(said(Row(f"Exudyn, {label}: share of its solver", min(shares), GOAL, at_least=True, about=about)))
    return rows


def measure_precision(rounds: int) -> list[Row]:
    """Seconds of the coarsest run that is right, as is every finer one."""
    rows = []
    for kappa in KAPPAS:
        exact = contact_parameters(kappa)
        right = None
        for refine in REFINES:
            seconds = []
            for _ in range(rounds):
                history = exudyn_models.simulate(
                    Impact.dimensionless(kappa), end_time=0.1, contact=Penalty(hold=HOLD), refine=refine, save=250
                )
                seconds.append(history.settings["wall_seconds"])
            found = leading_order(moments(history))
            errors = found.lambda0.value / exact.lambda0 - 1.0, found.r0.value / exact.r0 - 1.0
            if max(map(abs, errors)) > RIGHT:
                break
            right = min(seconds), {"refine": refine, "errors": [round(error, 6) for error in errors]}
        least, about = right or (math.inf, {})
        rows.append(said(Row(f"Exudyn, κ/ν = {kappa:g}: λ₀, r₀ to 0.02 %, s", least, SECONDS, about=about)))
    return rows


def main(words: list[str] | None = None) -> list[Row]:
    arguments = options("exudyn", __doc__, rounds=3).parse_args(words)
    return keep(arguments.out, [*measure(arguments.rounds), *measure_precision(arguments.rounds)])


if __name__ == "__main__":
    main()
