"""Whole beams drawn at random, by the default methods: no wall pulls, and none gives energy."""

import random

import numpy as np
import pytest

from bent_beam import Impact
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE

# κ/ν, load in V₀/T* and dampings (T*; steel damps a little) of the beams, instants, what is let pass: of the largest
# push that a node is pulled by, of the energy that is gained, and that is missing from the budget
PATHS = {
    HermiteFE: ((0.01, 3.0), 3.0, (0.0,), 100, (1e-6, 1e-9, 1e-9)),
    ExudynModel: ((0.05, 5.0), 1.0, (0.0, 1e-4, 1e-3, 1e-2), 200, (1e-9, 1e-3, 1e-2)),
}


def drawn(path, generator):
    """A beam of any size, κ/ν log-uniform, a third each without load, pressed and lifted."""
    kappas, load, dampings, *_ = PATHS[path]
    decades = ((-2.0, 7.0), (-2.0, 2.5), (-1.0, 2.0), (-1.0, 1.5), np.log10(kappas))
    stiffness, mass, length, velocity, kappa = (10.0 ** generator.uniform(*limits) for limits in decades)
    beam = Impact(stiffness, mass, length, kappa * velocity / np.sqrt(stiffness / mass), velocity)
    acceleration = generator.choice([0.0, 1.0, -1.0]) * generator.uniform(0.0, load) * velocity / beam.slow_time_scale
    damping = generator.choice(dampings) * beam.slow_time_scale
    return beam.replace(acceleration=float(acceleration), damping=float(damping))


FIXED = [(HermiteFE, [11, number], 1.0, 1) for number in (2, 4, 5)] + [(ExudynModel, 1, 0.5, 1)]
FRESH = [(HermiteFE, None, 1.0, 300), (ExudynModel, None, 1.0, 20)]


@pytest.mark.parametrize(
    ("path", "seed", "refine", "count"),
    [*FIXED, *(pytest.param(*one, marks=pytest.mark.verify) for one in FRESH)],
    ids=["pressed", "a lifted thin front", "free", "Exudyn", "many", "many, Exudyn"],
)
def test_the_wall_never_pulls_and_gives_no_energy(path, seed, refine, count):
    """Without a seed one is drawn and printed; the last beam printed fails."""
    *_, save, (pull, gain, defect) = PATHS[path]
    seed = random.randrange(2**31) if seed is None else seed
    generator = np.random.default_rng(seed)
    for number in range(count):
        impact = drawn(path, generator)
        print(f"seed {seed}, problem {number}: {impact}")
        history = path(refine=refine).simulate(impact, end_time=0.5 * impact.slow_time_scale, save=save)
        late = history.time[:-1] >= 0.005 * impact.slow_time_scale  # from when on an end may be heard
        gathered = np.diff(history.array("impulse"), axis=0)[late]  # by a node between two saved instants
        assert -gathered.min(initial=0.0) <= pull * gathered.max(initial=0.0)
        assert np.ptp(history.array("held_impulse")[:-1][late]) == 0.0
        energy = history.array("kinetic_energy") + history.array("strain_energy") - history.array("work_of_loads")
        budget = history.energy_budget()
        assert energy.max() - energy[0] <= gain * budget["initial_energy"]
        assert abs(budget["defect"]) <= defect * budget["initial_energy"]
