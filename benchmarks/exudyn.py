"""How much of an Exudyn run is spent inside its solver: set-up and recording take the rest.

python -m benchmarks.exudyn [--rounds 3] [--out benchmarks/results/exudyn.json]
"""

from __future__ import annotations

import exudyn_models
from benchmarks.record import Row, keep, options, said
from bent_beam import Impact
from bent_beam.meshes import UniformMesh

GOAL = 0.9
KAPPAS = (0.1, 0.25, 0.5)


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


def main(words: list[str] | None = None) -> list[Row]:
    arguments = options("exudyn", __doc__, rounds=3).parse_args(words)
    return keep(arguments.out, measure(arguments.rounds))


if __name__ == "__main__":
    main()
