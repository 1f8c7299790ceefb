"""Two hundred thousand steps at two thousand nodes: flat memory, and an energy budget that still closes to 1e-9."""

import os
import resource

import pytest

import hermite_fe
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.integrators import MoreauJean

FUZZ = bool(os.environ.get("FUZZ"))


def largest_memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


@pytest.mark.parametrize(
    "steps",
    [
        500,
        pytest.param(20_000, marks=pytest.mark.verify),
        pytest.param(200_000, marks=pytest.mark.skipif(not FUZZ, reason="a run of minutes: FUZZ=1")),
    ],
)
def test_the_budget_closes_and_memory_stays_flat(steps):
    impact = Impact.dimensionless(0.5, length=20.0)
    mesh = UniformMesh(10.0 / 1999)

    def run(count):
        integrator = MoreauJean(time_step=0.1 / steps)
        return hermite_fe.simulate(impact, end_time=0.1 * count / steps, mesh=mesh, integrator=integrator, save=20)

    assert run(max(steps // 100, 10)).dataset.sizes["x"] == 2000  # kernels are loaded then, and xarray is imported
    before = largest_memory()
    history = run(steps)
    budget = history.energy_budget()
    defect = abs(budget["defect"]) / budget["initial_energy"]
    print(f"{history.steps} steps, {history.seconds:.0f} s, budget defect {defect:.2g}, +{largest_memory() - before} B")
    assert history.steps == steps and history.dataset.sizes["x"] == 2000
    assert defect < 1e-9
    assert largest_memory() - before < 20e6 + 40 * steps  # the instants, 8 bytes a step, and copies of them
