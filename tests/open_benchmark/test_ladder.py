"""This project's integrators against the closed forms of the ladder."""

import pytest

from tests.open_benchmark.ladder import INTEGRATORS, RUNGS, cell

QUICK = ("Moreau–Jean θ = ½", "Signorini, new position")
NAMES = [pytest.param(name, marks=() if name in QUICK else pytest.mark.verify) for name in INTEGRATORS]


@pytest.mark.parametrize("name", NAMES)
def test_the_wall_gives_the_impulse_of_the_closed_form(name):
    for rung in ("bar", "stopped-beam"):
        if rung == "stopped-beam" and "massless" in name:  # refuses damping
            continue
        (coarse, _), (fine, energy) = (RUNGS[rung](INTEGRATORS[name], refine) for refine in (1, 4))
        assert fine < 0.7 * coarse < 0.02, rung
        assert energy <= 1.0 + 1e-9, rung


def test_an_integrator_without_an_impact_law_says_so():
    ball, bar = (cell(INTEGRATORS["Signorini, new position"], rung, (1,)) for rung in ("ball", "bar"))
    assert "restitution must be 0" in ball and "round-off" in bar
