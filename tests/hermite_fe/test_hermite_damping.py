"""Far fields: what leaves does not come back. hysteretic_loss: one that hardly depends on the frequency, by Maxwell
branches."""

import math
import re

import numpy as np
import pytest
from hermite_parts import account

from bent_beam import Impact
from bent_beam.hysteresis import first_mode
from bent_beam.meshes import ScaleFreeMesh, UniformMesh
from hermite_fe.banded import product
from hermite_fe.beam import HermiteBeam
from hermite_fe.constraints import ContactLaw
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity, Sponge
from hermite_fe.integrators import Midpoint, MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from hermite_fe.maxwell import step_branches, stiffen, strains_of
from hermite_fe.model import BeamModel, beam_model
from hermite_fe.run import integrate
from hermite_fe.stepping import problem_of, state_of
from hermite_fe.system import ContactRows, System
from hermite_fe.warnings_of_run import end_warnings

UNDAMPED = GridViscosity(viscosity=0.0)
GRADED = 2.0 * np.pi / (8.0 * 0.01)  # elements here are 1 % of it long: 8 in a wave
STEEP = 2.0 * np.pi / (15.0 * 0.02)


@pytest.mark.parametrize(
    ("x", "far_field", "k", "start", "turn", "least", "most"),
    [
        (ScaleFreeMesh(0.2, 1.01).nodes(12.0 * GRADED), GridViscosity(), 1.0, GRADED, np.pi / 0.01, 0.0, 1e-3),
        (ScaleFreeMesh(0.2, 1.02).nodes(12.0 * STEEP), UNDAMPED, 1.0, STEEP, np.pi / 0.02, 0.1, 2.0),
        (UniformMesh(2.0 * np.pi / 2.0 / 20.0).nodes(100.0), Sponge(viscosity=0.0), 2.0, 30.0, 100.0, 0.0, 1e-3),
        (UniformMesh(0.3).nodes(100.0), UNDAMPED, 1.0, 30.0, 100.0, 0.5, 2.0),
    ],
    ids=["growing elements with viscosity", "growing elements alone", "sponge", "free end"],
)
def test_a_packet_dies_in_viscosity_and_sponge_and_is_back_without(x, far_field, k, start, turn, least, most):
    """In elements that grow with viscosity a packet dies on its way to where a few of them make a wave; what the mesh
    carries to the end dies in a sponge. The packet, of unit amplitude and wave number k, is sent out at ``start``; what
    comes back to x < start is seen from when it would be at ``turn``, as far out as it gets, until it would be back
    twice."""
    beam, width = HermiteBeam(x, 1.0, 1.0), min(12.0 / k, start / 5.0)
    # u = Re f, f = exp(ikx − (x − start)²/2w²), and its velocity Re if″: every number in it runs outwards
    f = np.exp(1j * k * x - 0.5 * ((x - start) / width) ** 2)
    rate, change = 1j * k - (x - start) / width**2, -1.0 / width**2  # f′/f, and how that changes
    first, second, third = rate * f, (rate**2 + change) * f, (rate**3 + 3.0 * rate * change) * f
    q, v = beam.interpolate(f.real, first.real), beam.interpolate((1j * second).real, (1j * third).real)
    dampings = far_field.dampings(beam, Impact(1.0, 1.0, 2.0 * x[-1], 0.0, 1.0))
    away = ContactRows(dofs=[[0]], factors=[[-1.0]], gap=[1e9])
    system = System(mass=beam.mass(), stiffness=beam.stiffness(), dampings=dampings, contacts=away)
    end = 4.0 * (turn - start) / (2.0 * k)
    scheme = NonsmoothGeneralizedAlpha(0.05 / k**2, levels="velocity", spectral_radius=1.0)
    run = integrate(system, q, v, scheme, end, save=np.linspace(0.25, 1.0, 60) * end)
    assert run.failure == ""
    assert least <= np.abs(run.q[1:, 0::2][:, x < start]).max() < most


def test_far_fields_take_no_momentum_and_resist_bending_alone_by_their_constants() -> None:
    """Bent at the rate 1 they take ∫c Δx² dx √(EIμ), a sponge at each end ∫b w² s³ dx √(EIμ) = b w³/4 √(EIμ) more."""
    impact, half = Impact(3.0, 2.0, 20.0, 0.0, 1.0), ScaleFreeMesh(0.1, 1.02).nodes(10.0)
    beam = HermiteBeam(np.concatenate([-half[:0:-1], half]), 3.0, 2.0)
    grid = 0.3 * (beam.lengths**3).sum()
    for far_field, taken in ((GridViscosity(), grid), (Sponge(), grid + 2.0 * 0.03 * 5.0**3 / 4.0)):
        bands = sum(part for _, part in far_field.dampings(beam, impact))
        rigid, bent = beam.interpolate(np.ones(beam.nodes.size), 0.0 * beam.nodes), 0.5 * beam.nodes**2
        assert np.abs(product(bands, rigid)).max() < 1e-12 * np.abs(bands).max()
        rate = beam.interpolate(bent, beam.nodes)
        assert rate @ product(bands, rate) == pytest.approx(np.sqrt(6.0) * taken, rel=2e-3)


def test_waves_are_back_from_the_ends_at_the_same_time_however_long_the_run() -> None:
    impact, nodes = Impact.whole_beam(0.5), np.linspace(0.0, 1.0, 51)
    said = [end_warnings(impact, end, nodes, UNDAMPED) for end in (0.03, 0.1, 0.4)]
    times = [re.findall(r"be back at the contact from about t = (\S+) s", one[-1])[0] for one in said]
    assert len(set(times)) == 1 and 0.0 < float(times[0]) < 0.03
    assert end_warnings(impact, 0.5 * float(times[0]), nodes, UNDAMPED) == []


def lossy(kappa: float, loss: float, **more: object) -> Impact:
    """The free–free beam in units of its half length, its loss stated at the first mode."""
    beam = Impact.whole_beam(kappa)
    return beam.replace(hysteretic_loss=loss, loss_frequency=first_mode(beam), **more)


def modelled(impact: Impact, elements: int) -> BeamModel:
    nodes = UniformMesh(1.0 / elements).nodes(1.0)
    return beam_model(impact, nodes, NodeContact(), UNDAMPED, full=False)


def test_the_first_mode_swings_at_its_frequency_and_loses_in_each_period_what_is_asked_for() -> None:
    impact, loss = lossy(2.0, 0.05), 0.05
    model = modelled(impact, 12)
    x, z = model.beam.nodes, 4.730040744862704 / 2.0
    shape = np.cos(z * x) / np.cos(z) + np.cosh(z * x) / np.cosh(z)
    slope = z * (-np.sin(z * x) / np.cos(z) + np.sinh(z * x) / np.cosh(z))
    away = model.beam.interpolate(np.full(x.size, -50.0), np.zeros(x.size))
    period = 1.0 / first_mode(impact)
    run = integrate(
        model.system, away, model.beam.interpolate(shape, slope),
        SignoriniPosition(theta=0.5, time_step=period / 400.0, growth=0.0), 8.0 * period, save=3200,
    )  # fmt: skip
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


@pytest.mark.parametrize(
    ("integrator", "more"),
    [
        (MoreauJean(theta=0.7, time_step=1e-3, growth=0.0), {}),
        (SignoriniPosition(theta=1.0, time_step=1e-3, growth=1e-2), {"axial_force": 3.0}),
        (Midpoint(time_step=2e-3, growth=0.0), {"wall_stiffness": 1e3}),
    ],
)
def test_energy_and_momentum_close_to_round_off_and_the_branches_take_their_share(integrator, more) -> None:
    model = modelled(lossy(0.5, 0.2, **more), 10)
    law = ContactLaw(0.5 if isinstance(integrator, MoreauJean) else 0.0)
    run = integrate(model.system, model.displacement, model.velocity, integrator, 0.6, law=law, save=40)
    s, uniform = run.sums, np.zeros(model.system.dofs)
    assert np.abs(account(s) - account(s)[0]).max() < 1e-11 * s["kinetic_energy"][0]
    uniform[0::2] = 1.0
    momentum = run.v @ product(model.system.mass, uniform)
    gained = momentum - momentum[0] - float(uniform @ model.system.load[0]) * run.time
    assert np.abs(gained + run.impulse.sum(axis=1)).max() < 1e-11 * momentum[0]
    assert np.all(np.diff(s["loss_material"]) > 0.0) and s["branch_energy"][-1] > 0.0
    assert s["loss_material"][-1] > 0.05 * s["kinetic_energy"][0]
