"""A physical problem and its dimensionless twin are one problem, and the same run again is the same, bit for bit."""

import math
import random
from functools import cache, partial

import numpy as np
import pytest
from here import FUZZ, SEED

import exudyn_models
import hermite_fe
from bent_beam import Impact, ImpactHistory
from bent_beam.meshes import UniformMesh
from comparison.compare import rerun_history
from exudyn_models.contacts import Penalty, Rigid, SegmentFriction
from exudyn_models.elements import GeometricallyExact
from exudyn_models.geometry import TrueGeometry
from exudyn_models.integrators import RK44, Newmark
from hermite_fe.integrators import MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from self_similar_fe.mesh import ExpandingMesh
from self_similar_fe.run import simulate_expanding
from theory import predict

TWINS = [
    (1e-12, 1e12, 1e6),
    (1e12, 1e-12, 1e6),
    (3.7e-5, 2.2e4, 17.0),
    (1e-12, 1e12, 1e-9),
    (1e12, 1e12, 1.0),
    (1.0, 1e-12, 1e-3),
]
if FUZZ:
    RANDOM = random.Random(SEED)
    POWERS = ((-12.0, 12.0), (-12.0, 12.0), (-9.0, 6.0))
    TWINS += [tuple(10.0 ** RANDOM.uniform(*limits) for limits in POWERS) for _ in range(6)]
LOADS = dict(epsilon_alpha=0.3, epsilon_psi=-0.02, epsilon_chi=0.01)


def twin(stiffness, mass, velocity, length, **loads):
    """κ/ν = ½ in other units."""
    wave = math.sqrt(stiffness / mass)
    unit, time = wave / velocity, wave / velocity**2
    return Impact(
        stiffness,
        mass,
        length * unit,
        0.5 / unit,
        velocity,
        acceleration=loads.get("epsilon_alpha", 0.0) * velocity / time,
        curvature_rate=loads.get("epsilon_chi", 0.0) * velocity / unit**2,
        fourth_derivative=loads.get("epsilon_psi", 0.0) / unit**3,
        section_height=0.01 * unit,
    )


@pytest.mark.parametrize("scales", TWINS)
@pytest.mark.parametrize("loads", [{}, LOADS])
def test_theory_gives_twins_the_same_answer_to_1e_10(scales, loads):
    one, other = Impact.dimensionless(0.5, length=30.0, **loads), twin(*scales, 30.0, **loads)
    a, b = predict(one, [0.05]), predict(other, [0.05 * other.time_scale])
    momentum = other.mass_per_length * other.velocity
    for name in ("lambda0", "r0", "lambda1", "r1", "epsilon", "alpha", "psi", "chi", "kappa_over_nu"):
        assert getattr(b, name) == pytest.approx(getattr(a, name), rel=1e-10, abs=1e-12), name
    units = {
        "half_contact_length": other.length_scale,
        "reaction": momentum * other.length_scale / other.time_scale,
        "impulse": momentum * other.length_scale,
    }
    for name, unit in units.items():
        assert getattr(b.times[0], name) / unit == pytest.approx(getattr(a.times[0], name), rel=1e-10)


def hermite(scheme, step, impact, full_beam=False, **more):
    end, mesh = 0.1 * impact.time_scale, UniformMesh(0.05 * impact.length_scale)
    steps = scheme(time_step=step * impact.time_scale, **more)
    return hermite_fe.simulate(impact, end_time=end, mesh=mesh, integrator=steps, save=10, full_beam=full_beam)


def expanding(impact):
    mesh = ExpandingMesh(front_resolution=0.05, decades=2.0)
    return simulate_expanding(impact, mesh, end_time=0.1 * impact.time_scale, save=10)


def exudyn(impact, **parts):
    mesh = UniformMesh(impact.half_length / 32)
    return exudyn_models.simulate(impact, end_time=0.1 * impact.time_scale, mesh=mesh, save=10, **parts)


# Name → how to run, length, loads, and how near twins come. Bending takes second differences of deflections, which
# multiplies round-off by the square of the number of elements: 32² · 2·10⁻¹⁶ ~ 2·10⁻¹³. Thousands of explicit steps,
# shear and large rotations add a digit. The gap to a circle is a difference of lengths of the order of its radius,
# thousands of times what the beam deflects. A hundred times as much is let pass.
RUNS = {
    "hermite": (partial(hermite, SignoriniPosition, 1e-5, growth=5e-3), 30.0, {}, 1e-10),
    "hermite, full beam": (partial(hermite, MoreauJean, 1e-4, full_beam=True), 10.0, {}, 1e-10),
    "hermite, generalised-α": (partial(hermite, NonsmoothGeneralizedAlpha, 2e-3, growth=0.0), 30.0, {}, 1e-10),
    "expanding mesh": (expanding, 30.0, {}, 1e-8),
    "exudyn": (exudyn, 5.0, LOADS, 1e-10),
}
EXUDYN = {
    "rigid contact": (dict(contact=Rigid(), integrator=Newmark()), 1e-10),
    "explicit steps": (dict(integrator=RK44()), 1e-9),
    "geometrically exact": (dict(element=GeometricallyExact()), 1e-9),
    "true geometry": (dict(geometry=TrueGeometry()), 1e-9),
    "a circle for a wall": (dict(contact=SegmentFriction(friction=0.2)), 1e-6),
}
for name, (parts, near) in EXUDYN.items():
    RUNS[f"exudyn, {name}"] = (partial(exudyn, **parts), 5.0, LOADS, near)
QUICK = ("hermite", "hermite, generalised-α", "expanding mesh", "exudyn")
KINDS = [kind if kind in QUICK else pytest.param(kind, marks=pytest.mark.verify) for kind in RUNS]


@cache
def simulated(kind):
    run, length, loads, _ = RUNS[kind]
    return run(Impact.dimensionless(0.5, length=length, **loads))


def fields(history):
    impact = history.impact
    momentum = impact.mass_per_length * impact.velocity * impact.length_scale
    energies = ("strain_energy", "kinetic_energy", "work_of_loads", "loss_absorbed")
    units = {"velocity": impact.velocity, "slope": 1.0} | dict.fromkeys(energies, momentum * impact.velocity)
    units |= dict.fromkeys(("position", "gap"), impact.length_scale)
    units |= dict.fromkeys(("impulse", "total_impulse"), momentum)
    found = {name: history.array(name) / unit for name, unit in units.items() if name in history}
    return {name: values for name, values in found.items() if values.any()}


@pytest.mark.parametrize("scales", TWINS if FUZZ else [TWINS[0], TWINS[3]])
@pytest.mark.parametrize("kind", KINDS)
def test_twins_have_the_same_history_to_round_off(kind, scales):
    run, length, loads, near = RUNS[kind]
    one, other = fields(simulated(kind)), fields(run(twin(*scales, length, **loads)))
    assert one["total_impulse"][-1] > 0.0 and one.keys() == other.keys()
    differences = {name: float(np.abs(one[name] - other[name]).max() / np.abs(one[name]).max()) for name in one}
    differences["impulse"] *= 0.01  # how it spreads over the nodes is a hundred times as sensitive as its sum
    print(f"twins, {kind}: {max(differences.values()):.1e}")
    assert max(differences.values()) < near


@pytest.mark.parametrize("kind", KINDS)
def test_a_stored_history_is_enough_to_run_it_again_and_then_is_the_same_bit_for_bit(kind, tmp_path):
    found = rerun_history(ImpactHistory.load(simulated(kind).save(tmp_path / "run.nc")))
    assert found["identical"], found


@pytest.mark.parametrize(("wall", "contact"), [(None, Penalty(stiffness=1e5)), (1e3, None)])
def test_an_exudyn_run_to_separation_is_run_again_as_far_as_it_went(wall, contact):
    method = exudyn_models.ExudynModel(mesh=UniformMesh(1 / 16), contact=contact)
    impact = Impact.whole_beam(2.0, relative_damping=1e-2).replace(wall_stiffness=wall)
    history = method.simulate_to_separation(impact, save=100)
    assert history.settings["save"][-1] == pytest.approx(history.time[-1], rel=1e-2)
    assert rerun_history(history)["identical"]


def test_a_history_that_is_another_by_its_last_bit_is_not_the_same():
    dataset = simulated("hermite").dataset
    found = rerun_history(ImpactHistory.of(dataset.assign(gap=np.nextafter(dataset["gap"], 1.0))))
    assert not found["identical"] and 0.0 < found["largest_difference"].pop("gap") < 1e-15
    assert not found["largest_difference"]
