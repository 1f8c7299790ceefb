"""Whole beams drawn at random, each held to the same facts: what fails is named so that it can be drawn again."""

import os
import random
from collections.abc import Callable

import numpy as np

from bent_beam import Impact, ImpactHistory

AFTER = 0.005  # T*, from when on an end may be heard


def beam_with(
    generator: np.random.Generator, kappas: tuple[float, float], load: float, dampings: tuple[float, ...] = (0.0,)
) -> Impact:
    """A beam of any size, κ/ν log-uniform between ``kappas``, a third each without load, pressed and lifted by up to
    ``load`` V₀/T*, with one of ``dampings``, T*."""
    decades = ((-2.0, 7.0), (-2.0, 2.5), (-1.0, 2.0), (-1.0, 1.5), np.log10(kappas))
    stiffness, mass, length, velocity, kappa = (10.0 ** generator.uniform(*limits) for limits in decades)
    beam = Impact(stiffness, mass, length, kappa * velocity / np.sqrt(stiffness / mass), velocity)
    acceleration = generator.choice([0.0, 1.0, -1.0]) * generator.uniform(0.0, load) * velocity / beam.slow_time_scale
    damping = generator.choice(dampings) * beam.slow_time_scale
    return beam.replace(acceleration=float(acceleration), damping=float(damping))


def never_pulled_nor_driven(history: ImpactHistory, pull: float, gain: float, defect: float) -> None:
    """Shares: of the largest push that a node is pulled by once waves may be back, and of the energy."""
    late = history.time[:-1] >= AFTER * history.impact.slow_time_scale
    gathered = np.diff(history.array("impulse"), axis=0)[late]  # by a node between two saved instants
    assert -gathered.min(initial=0.0) <= pull * gathered.max(initial=0.0)
    held = history.array("held_impulse")[:-1][late]
    assert np.ptp(held) == 0.0
    energy = history.array("kinetic_energy") + history.array("strain_energy") - history.array("work_of_loads")
    budget = history.energy_budget()
    assert energy.max() - energy[0] <= gain * budget["initial_energy"]
    assert abs(budget["defect"]) <= defect * budget["initial_energy"]


def hold_for_many(drawn: Callable[[np.random.Generator], Impact], check: Callable[[Impact], None], count: int) -> None:
    """``check`` on ``count`` problems of ``drawn`` (``BEAMS`` of them) from a new seed (``BEAMS_SEED``), printed."""
    seed = int(os.environ.get("BEAMS_SEED", random.randrange(2**31)))
    print(f"seed {seed}")
    generator = np.random.default_rng(seed)
    for number in range(int(os.environ.get("BEAMS", count))):
        impact = drawn(generator)
        try:
            check(impact)
        except Exception as error:
            raise AssertionError(f"seed {seed}, problem {number}, {impact}: {error}") from error
