"""This project's integrators on problems of the benchmark (:mod:`bent_beam_programs.open_benchmark.ladder`)."""

import pytest

from bent_beam_programs.open_benchmark.ladder import INTEGRATORS, LAWS, PROBLEMS, bar, errors_of, stopped_beam

QUICK = ("Moreau–Jean θ = ½", "Signorini, new position")
NAMES = [pytest.param(name, marks=() if name in QUICK else pytest.mark.verify) for name in INTEGRATORS]


@pytest.mark.parametrize("name", NAMES)
def test_the_wall_gives_the_impulse_of_the_closed_form(name):
    for rung in (bar, stopped_beam) if name != "massless boundary" else (bar,):  # which refuses damping
        (coarse, _), (fine, energy) = (rung(INTEGRATORS[name], refine) for refine in (1, 4))
        assert fine < 0.7 * coarse < 0.02, rung
        assert energy <= 1.0 + 1e-9, rung


def test_a_law_on_gaps_keeps_the_first_order_that_a_law_on_velocities_loses():
    """Without loads both are as good; with them the roughness of the law on velocities is of the order of the
    answer."""
    (bare_rough, *rough), (bare_smooth, *smooth) = (errors_of(law, 0.02, PROBLEMS[1:2]) for law in LAWS)
    assert max(abs(error) for error, _ in bare_rough + bare_smooth) < 4e-3
    assert max(abs(error) for pair in smooth for error, _ in pair) < 0.08
    assert max(abs(error) for pair in rough for error, _ in pair) > 0.2
