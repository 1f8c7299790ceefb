"""Whole beams drawn at random, by default: nothing pulls once waves may be back, and no energy is gained."""

import numpy as np
import pytest
from random_beams import hold_for_many

from bent_beam import Impact
from hermite_fe import HermiteFE
from hermite_fe.integrators import SignoriniPosition

AFTER = 0.005  # T*, from when on an end may be heard


def drawn(generator: np.random.Generator) -> Impact:
    """A beam of any size, κ/ν log-uniform from 0.01 to 3, a third each without load, pressed and lifted."""
    stiffness, mass = 10.0 ** generator.uniform(-2, 7), 10.0 ** generator.uniform(-2, 2.5)
    length, velocity = 10.0 ** generator.uniform(-1, 2), 10.0 ** generator.uniform(-1, 1.5)
    kappa = float(np.exp(generator.uniform(np.log(0.01), np.log(3.0))))
    bare = Impact(
        bending_stiffness=stiffness,
        mass_per_length=mass,
        length=length,
        velocity=velocity,
        curvature=kappa * velocity / np.sqrt(stiffness / mass),
    )
    load = float(generator.choice([0.0, 1.0, -1.0]) * generator.uniform(0.0, 3.0))
    return bare.replace(acceleration=load * velocity / bare.slow_time_scale)


def check(impact: Impact) -> None:
    scale = impact.slow_time_scale
    history = HermiteFE().simulate(impact, end_time=0.5 * scale, save=100)
    gathered = np.diff(history.array("impulse"), axis=0)[history.time[:-1] >= AFTER * scale]
    assert -gathered.min(initial=0.0) <= 1e-6 * gathered.max(initial=0.0)
    energy = history.array("kinetic_energy") + history.array("strain_energy") - history.array("work_of_loads")
    initial = history.array("kinetic_energy")[0] + history.array("strain_energy")[0]
    assert energy.max() - energy[0] <= 1e-9 * initial
    assert abs(history.energy_budget()["defect"]) <= 1e-9 * initial


@pytest.mark.parametrize("number", range(4))
def test_a_beam_is_never_pulled_and_gains_no_energy(number: int) -> None:
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
