"""Whole beams drawn at random, by default: nothing pulls once waves may be back, and no energy is gained."""

import numpy as np
import pytest
from random_beams import beam_with, hold_for_many, never_pulled_nor_driven

from bent_beam import Impact
from hermite_fe import HermiteFE
from hermite_fe.integrators import SignoriniPosition


def drawn(generator: np.random.Generator) -> Impact:
    return beam_with(generator, (0.01, 3.0), 3.0)


def check(impact: Impact) -> None:
    history = HermiteFE().simulate(impact, end_time=0.5 * impact.slow_time_scale, save=100)
    never_pulled_nor_driven(history, 1e-6, 1e-9, 1e-9)


@pytest.mark.parametrize("number", [1, 2, 4, 5])
def test_a_beam_is_never_pulled_and_gains_no_energy(number: int) -> None:
    """Lifted, pressed, a lifted thin front, free."""
    check(drawn(np.random.default_rng([11, number])))


@pytest.mark.verify
def test_many_beams_are_never_pulled_and_gain_no_energy() -> None:
    """``BEAMS=10000`` for a long run; the seed is printed."""
    hold_for_many(drawn, check, 300)


@pytest.mark.parametrize("length", [1.0, 2.0, 3.0])
def test_long_steps_on_a_short_beam_settle(length: float) -> None:
    """Exchanging many rows at once runs in a circle there; the fall-back does not."""
    impact = Impact.dimensionless(0.5, length=length)
    history = HermiteFE(integrator=SignoriniPosition(growth=0.01)).simulate(impact, end_time=0.1, save=20)
    assert history.completed
    assert abs(history.energy_budget()["defect"]) < 1e-9
