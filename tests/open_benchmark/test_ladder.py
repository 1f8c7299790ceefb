"""This project's integrators against the closed forms of the ladder."""

import pytest

from bent_beam_programs.open_benchmark.ladder import INTEGRATORS, RUNGS, cell

QUICK = ("Moreau–Jean θ = ½", "Signorini, new position")
NAMES = [pytest.param(name, marks=() if name in QUICK else pytest.mark.verify) for name in INTEGRATORS]
ELASTIC = [name for name in NAMES if "Signorini" not in name.values[0] and "penalty" not in name.values[0]]


@pytest.mark.parametrize("name", ELASTIC)
def test_ten_elastic_impacts_of_a_ball_are_found_to_first_order(name):
    make = INTEGRATORS[name]
    coarse, fine = (RUNGS["ball"](make, refine) for refine in (1, 8))
    assert fine[0] < 0.4 * coarse[0] < 0.03
    assert fine[1] == pytest.approx(1.0, abs=0.05), "an elastic impact keeps the ball's energy"


@pytest.mark.parametrize("name", NAMES)
def test_the_wall_gives_the_impulse_of_the_closed_form(name):
    for rung in ("bar", "stopped-beam"):
        (coarse, _), (fine, energy) = (RUNGS[rung](INTEGRATORS[name], refine) for refine in (1, 4))
        assert fine < 0.7 * coarse < 0.02, rung
        assert energy <= 1.0 + 1e-9, rung


def test_an_integrator_without_an_impact_law_says_so():
    ball, bar = (cell(INTEGRATORS["Signorini, new position"], rung, (1,)) for rung in ("ball", "bar"))
    assert "restitution must be 0" in ball and "round-off" in bar


def test_the_bouncing_bar_has_the_period_and_the_impulse_of_its_closed_form():
    """The closed form and finite elements, two ways to one answer: half the error with twice the mesh."""
    scheme = INTEGRATORS["Moreau–Jean θ = ½"]
    (coarse, _), (fine, _) = (RUNGS["bar"](scheme, refine, "bouncing-bar") for refine in (1, 2))
    assert fine < 0.7 * coarse < 0.02
