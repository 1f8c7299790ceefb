"""hysteretic_loss: a loss that hardly depends on the frequency, by Maxwell branches."""

import math

import numpy as np
import pytest
from hermite_parts import account

from bent_beam import Impact
from bent_beam.hysteresis import first_mode
from bent_beam.meshes import UniformMesh
from hermite_fe.banded import product
from hermite_fe.constraints import ContactLaw
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import Midpoint, MoreauJean, SignoriniPosition
from hermite_fe.maxwell import step_branches, stiffen, strains_of
from hermite_fe.model import BeamModel, beam_model
from hermite_fe.run import integrate
from hermite_fe.stepping import problem_of, state_of


def lossy(kappa: float, loss: float, **more: object) -> Impact:
    """The free–free beam in units of its half length, its loss stated at the first mode."""
    beam = Impact.whole_beam(kappa)
    return beam.replace(hysteretic_loss=loss, loss_frequency=first_mode(beam), **more)


def modelled(impact: Impact, elements: int) -> BeamModel:
    nodes = UniformMesh(1.0 / elements).nodes(1.0)
    return beam_model(impact, nodes, NodeContact(), GridViscosity(viscosity=0.0), full=False)


def test_the_first_mode_swings_at_its_frequency_and_loses_in_each_period_what_is_asked_for() -> None:
    impact, loss = lossy(2.0, 0.05), 0.05
    model = modelled(impact, 12)
    x, z = model.beam.nodes, 4.730040744862704 / 2.0
    shape = np.cos(z * x) / np.cos(z) + np.cosh(z * x) / np.cosh(z)
    slope = z * (-np.sin(z * x) / np.cos(z) + np.sinh(z * x) / np.cosh(z))
    away = model.beam.interpolate(np.full(x.size, -50.0), np.zeros(x.size))
    period = 1.0 / first_mode(impact)
    scheme = SignoriniPosition(theta=0.5, time_step=period / 400.0, growth=0.0)
    run = integrate(model.system, away, model.beam.interpolate(shape, slope), scheme, 8.0 * period, save=3200)
    swing = run.q[:, -2] - run.q[:, 0]
    turns = np.flatnonzero(np.diff(np.sign(np.diff(swing))))[4:] + 1  # the branches have forgotten the start
    widths = np.abs(np.diff(swing[turns]))
    decrement = -2.0 * np.polyfit(np.arange(widths.size), np.log(widths), 1)[0]
    assert decrement == pytest.approx(math.pi * loss, rel=0.02)
    lasted = 2.0 * (run.time[turns[-1]] - run.time[turns[0]]) / (turns.size - 1)
    assert lasted == pytest.approx(period, rel=2e-3)
    # the moment is that of EI(1 + iη) at this frequency, not of the relaxed 0.87 EI
    curvature, sagitta = z**2 * (1.0 / np.cosh(z) - 1.0 / np.cos(z)), 2.0 - 1.0 / np.cos(z) - 1.0 / np.cosh(z)
    bent = 0.5 * widths[0] * curvature / sagitta
    assert run.sums["largest_midspan_moment"][turns[0] - 5 : turns[1] + 5].max() == pytest.approx(abs(bent), rel=0.05)


@pytest.mark.parametrize("step", [1e-6, 1e-2, 1.0, 100.0])
def test_a_branch_at_a_constant_rate_of_strain_stretches_as_its_dashpot_lets_it_whatever_the_step(step: float) -> None:
    """z = ėτ(1 − e^{−t/τ}) from slack, and so its mean over the second step, by which the beam is pulled."""
    system = modelled(lossy(0.5, 0.2), 3).system
    state = state_of(system, np.zeros(system.dofs), np.random.default_rng(1).normal(size=system.dofs))
    branches, v = state.branches, state.v
    stiffen(branches, step, 1.0, problem_of(system, ContactLaw()).solver)
    for _ in range(2):
        step_branches(branches, state.bending, v, step, state.stretch)
    pulled = np.ravel([strains_of(state.bending, v, e) for e in range(3)])[:, None] / branches.rates
    x = step * branches.rates
    assert branches.z == pytest.approx(-pulled * np.expm1(-2.0 * x), rel=1e-9)
    assert state.stretch == pytest.approx((pulled * (1.0 + np.exp(-x) * np.expm1(-x) / x)) @ branches.shares, rel=1e-6)


SCHEMES = [(MoreauJean(1e-3, 0.0, theta=0.7), 0.5, {}), (SignoriniPosition(1e-3, 1e-2), 0.0, {"axial_force": 3.0}),
           (Midpoint(2e-3, 0.0), 0.0, {"wall_stiffness": 1e3})]  # fmt: skip


@pytest.mark.parametrize(("integrator", "restitution", "more"), SCHEMES)
def test_energy_and_momentum_close_to_round_off_and_the_branches_take_their_share(integrator, restitution, more):
    model, law = modelled(lossy(0.5, 0.2, **more), 10), ContactLaw(restitution)
    run = integrate(model.system, model.displacement, model.velocity, integrator, 0.6, law=law, save=40)
    s, uniform = run.sums, np.zeros(model.system.dofs)
    assert np.abs(account(s) - account(s)[0]).max() < 1e-11 * s["kinetic_energy"][0]
    uniform[0::2] = 1.0
    momentum = run.v @ product(model.system.mass, uniform)
    gained = momentum - momentum[0] - float(uniform @ model.system.load[0]) * run.time
    assert np.abs(gained + run.impulse.sum(axis=1)).max() < 1e-11 * momentum[0]
    assert np.all(np.diff(s["loss_material"]) > 0.0) and s["branch_energy"][-1] > 0.0
    assert s["loss_material"][-1] > 0.05 * s["kinetic_energy"][0]
