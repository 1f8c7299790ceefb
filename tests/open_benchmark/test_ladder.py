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


def test_without_mass_at_its_end_a_bar_keeps_its_energy_and_a_law_that_damps_does_not():
    massless, damped = (RUNGS["bar"](INTEGRATORS[name], 1) for name in ("massless boundary", "Moreau–Jean θ = 1"))
    assert massless[0] < 0.3 * damped[0] and abs(massless[1] - 1.0) < 1e-3 < 0.05 < 1.0 - damped[1]


def test_the_bouncing_bar_has_the_period_and_the_impulse_of_its_closed_form():
    """The closed form and finite elements, two ways to one answer: half the error with twice the mesh."""
    scheme = INTEGRATORS["Moreau–Jean θ = ½"]
    (coarse, _), (fine, _) = (RUNGS["bar"](scheme, refine, "bouncing-bar") for refine in (1, 2))
    assert fine < 0.7 * coarse < 0.02
