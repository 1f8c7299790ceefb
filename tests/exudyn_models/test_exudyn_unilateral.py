"""The wall pushes and never pulls, and no energy comes from it: random physical problems, default method."""

import numpy as np
import pytest
from random_beams import hold_for_many

import exudyn_models
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from exudyn_models.integrators import GeneralizedAlpha


def problem(generator):
    """A steel-like pipe or rod: κ/ν from 0.05 to 5, damped a little, pressed, lifted or free."""
    stiffness, mass, length = (10 ** generator.uniform(low, high) for low, high in ((-1, 6), (-1, 2), (-1, 2)))
    velocity = 10 ** generator.uniform(-1, 1)
    kappa = 10 ** generator.uniform(np.log10(0.05), np.log10(5.0))
    wave = np.sqrt(stiffness / mass)
    period = (length / 2) ** 2 / wave
    return Impact(
        bending_stiffness=stiffness,
        mass_per_length=mass,
        length=length,
        curvature=kappa * velocity / wave,
        velocity=velocity,
        acceleration=generator.choice([0.0, 1.0, -1.0]) * generator.uniform(0, 1) * velocity / period,
        damping=generator.choice([0.0, 1e-4, 1e-3, 1e-2]) * period,
    )


def check(impact):
    end = 0.5 * impact.slow_time_scale
    history = exudyn_models.simulate(impact, end_time=end, save=200)
    late = history.time >= 0.005 * impact.slow_time_scale
    gathered = np.diff(history.array("impulse")[late], axis=0)  # by a node between two saved instants
    assert -gathered.min() <= 1e-9 * gathered.max()
    assert np.ptp(history.array("held_impulse")[late]) == 0.0
    energy = history.array("kinetic_energy") + history.array("strain_energy") - history.array("work_of_loads")
    assert energy.max() <= energy[0] * (1 + 1e-3)
    budget = history.energy_budget()
    assert abs(budget["defect"]) < 1e-2 * budget["initial_energy"]


def test_the_wall_never_pulls_and_gives_no_energy():
    check(problem(np.random.default_rng(1)))


def test_steps_too_long_for_the_contact_give_energy_and_the_run_says_so():
    """A reaction that a step starts with acts on, half as strong, after the node has left."""
    impact = Impact.dimensionless(1.128, length=2.0)
    history = exudyn_models.simulate(
        impact, end_time=0.5, mesh=UniformMesh(0.01), integrator=GeneralizedAlpha(), save=100
    )
    assert history.array("loss_impact").min() < -0.01 * history.energy_budget()["initial_energy"]
    assert any("the contact gave" in warning for warning in history.warnings)


@pytest.mark.verify
def test_the_wall_never_pulls_and_gives_no_energy_in_many_problems():
    """``BEAMS=300`` for a long run; the seed is printed."""
    hold_for_many(problem, check, 20)
