"""Whole runs: all paths on one impact, and how much of an Exudyn run is spent inside its solver."""

import pytest

import exudyn_models
import hermite_fe
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from self_similar_fe import SelfSimilarFE


@pytest.mark.parametrize("kappa", [0.5, 0.1])
def bench_self_similar(benchmark, kappa):
    impact = Impact.dimensionless(kappa)
    benchmark.pedantic(lambda: SelfSimilarFE().simulate(impact, end_time=0.1), rounds=3)


@pytest.mark.parametrize("kappa", [0.5, 0.1])
def bench_hermite(benchmark, kappa):
    impact = Impact.dimensionless(kappa, length=2000.0)
    benchmark.pedantic(lambda: hermite_fe.simulate(impact, end_time=0.1), rounds=3, warmup_rounds=1)


@pytest.mark.parametrize("kappa", [0.5, 0.1])
def bench_exudyn(benchmark, kappa):
    impact = Impact.dimensionless(kappa)
    benchmark.pedantic(lambda: exudyn_models.simulate(impact, end_time=0.1), rounds=3)


def bench_share_of_exudyn_solver(benchmark):
    """At 600 nodes: seconds inside Exudyn's solver over the wall time of the run (set-up and recording take the rest).
    """
    impact = Impact.dimensionless(0.5, length=24.0)
    shares = []

    def run():
        history = exudyn_models.simulate(impact, end_time=0.1, mesh=UniformMesh(0.02))
        shares.append(history.seconds / history.settings["wall_seconds"])

    benchmark.pedantic(run, rounds=2)
    benchmark.extra_info["solver_share"] = round(min(shares), 3)
    print(f"\nsolver share at 600 nodes: {min(shares):.1%}")
