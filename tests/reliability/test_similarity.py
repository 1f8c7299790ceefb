"""A physical problem and its dimensionless twin are one problem; so are the two halves of a beam."""

import math

import numpy as np
import pytest

import hermite_fe
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.expanding import ExpandingMesh, simulate_expanding
from hermite_fe.integrators import SignoriniPosition
from theory import predict

TWINS = [
    (1e-12, 1e12, 1e6),
    (1e-12, 1e12, 1e-9),
    (1e12, 1e-12, 1e6),
    (1e12, 1e12, 1.0),
    (3.7e-5, 2.2e4, 17.0),
    (1.0, 1e-12, 1e-3),
]
LOADS = dict(epsilon_alpha=0.3, epsilon_psi=-0.02, epsilon_chi=0.01)


def twin(stiffness, mass, velocity, kappa=0.5, length=30.0, **loads):
    wave = math.sqrt(stiffness / mass)
    unit, time = wave / velocity, wave / velocity**2
    return Impact(
        stiffness,
        mass,
        length * unit,
        kappa / unit,
        velocity,
        acceleration=loads.get("epsilon_alpha", 0.0) * velocity / time,
        curvature_rate=loads.get("epsilon_chi", 0.0) * velocity / unit**2,
        fourth_derivative=loads.get("epsilon_psi", 0.0) / unit**3,
    )


@pytest.mark.parametrize("scales", TWINS)
@pytest.mark.parametrize("loads", [{}, LOADS])
def test_theory_gives_twins_the_same_answer_to_1e_10(scales, loads):
    one, other = Impact.dimensionless(0.5, length=30.0, **loads), twin(*scales, **loads)
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


def fields(history, names):
    impact = history.impact
    unit = {
        "gap": impact.length_scale,
        "velocity": impact.velocity,
        "total_impulse": impact.mass_per_length * impact.velocity * impact.length_scale,
        "strain_energy": impact.mass_per_length * impact.velocity**2 * impact.length_scale,
    }
    return {name: history.array(name) / unit[name] for name in names}


def largest_difference(a, b):
    return max(float(np.abs(a[name] - b[name]).max() / np.abs(a[name]).max()) for name in a)


def fixed(impact):
    unit, time = impact.length_scale, impact.time_scale
    steps = SignoriniPosition(time_step=1e-5 * time, growth=5e-3)
    return hermite_fe.simulate(impact, end_time=0.1 * time, mesh=UniformMesh(0.05 * unit), integrator=steps, save=10)


@pytest.mark.parametrize("scales", TWINS)
def test_hermite_gives_twins_the_same_history_to_round_off(scales):
    names = ("gap", "velocity", "total_impulse", "strain_energy")
    one = fields(fixed(Impact.dimensionless(0.5, length=30.0)), names)
    assert largest_difference(one, fields(fixed(twin(*scales)), names)) < 1e-8


@pytest.mark.parametrize("scales", TWINS)
def test_the_expanding_mesh_gives_twins_the_same_history_to_round_off(scales):
    def run(impact):
        mesh = ExpandingMesh(front_resolution=0.05, decades=2.0)
        history = simulate_expanding(impact, mesh, end_time=0.1 * impact.time_scale, save=10)
        return fields(history, ("gap", "total_impulse"))

    assert largest_difference(run(Impact.dimensionless(0.5)), run(twin(*scales))) < 1e-8


def test_the_full_beam_moves_symmetrically_to_round_off():
    impact = Impact.dimensionless(0.3, length=20.0, epsilon_alpha=0.5)
    history = hermite_fe.simulate(
        impact,
        end_time=0.1,
        mesh=UniformMesh(0.05),
        integrator=SignoriniPosition(time_step=1e-5, growth=5e-3),
        full_beam=True,
        save=10,
    )
    for name in ("gap", "velocity", "impulse"):
        values = history.array(name)
        assert np.abs(values - values[:, ::-1]).max() < 1e-9 * np.abs(values).max(), name
    slope = history.array("slope")
    assert np.abs(slope + slope[:, ::-1]).max() < 1e-9 * np.abs(slope).max()
