"""What steps leave out, where no wave has arrived and where rows are far off the wall, changes nothing."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from half_beams import NODES, half_beam, stepper

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.contacts import Contact, MeanContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import (
    GeneralizedAlphaPenalty,
    Integrator,
    MoreauJean,
    NonsmoothGeneralizedAlpha,
    SignoriniPosition,
)
from hermite_fe.kernels.ahead import moving
from hermite_fe.model import beam_model

INTEGRATORS: dict[str, Integrator] = {
    "moreau_jean": MoreauJean(1e-3),
    "moreau_jean, middle, growing": MoreauJean(1e-4, growth=1e-2, theta=0.5),
    "signorini_position": SignoriniPosition(1e-3),
    "velocity": NonsmoothGeneralizedAlpha(1e-3, levels="velocity"),
    "position_velocity": NonsmoothGeneralizedAlpha(1e-3, levels="position_velocity"),
    "position_velocity_acceleration": NonsmoothGeneralizedAlpha(2e-4, growth=1e-2),
}
every = pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS)
MEANS = MeanContact(hold=0, hold_until=0.0)
STEPS = 120


beam = partial(half_beam, kappa=0.2, half_length=60.0, nodes=1201)


@every
@pytest.mark.parametrize("contact", [NODES, MEANS], ids=["nodes", "means"])
def test_a_beam_that_waves_have_not_reached_moves_as_if_it_were_computed(
    integrator: Integrator, contact: Contact
) -> None:
    """A load of no weight on the last dof has all of the beam computed."""
    model = beam(contact)
    load = np.zeros((1, model.system.dofs))
    load[0, -1] = 1e-280
    loaded = replace(model, system=replace(model.system, load=load))
    part, whole = stepper(model, integrator), stepper(loaded, integrator)
    for step in (1, 2, 30, 31, STEPS):
        assert part.advance_to(step) == whole.advance_to(step) == 0
        for name in ("q", "v", "impulse"):
            one, other = getattr(part.state, name), getattr(whole.state, name)
            assert np.abs(one - other).max() <= 1e-10 * np.abs(other).max(), (name, step)
        assert np.array_equal(part.state.closed, whole.state.closed)
    taken = [int(run.works[0].length[0]) for run in (part, whole)]
    assert taken[0] < 0.7 * model.system.dofs == 0.7 * taken[1]
    assert moving(part.problem.still, part.state.q, part.state.v) < taken[0]
    assert np.count_nonzero(part.state.impulse) > 3


@every
def test_the_waves_run_on_to_the_end_of_a_beam_and_back(integrator: Integrator) -> None:
    """From a part of the beam to all of it in one call, and in many: the same to round-off, nothing lost or gained."""
    model = beam(half_length=6.0, nodes=241)
    once, often = stepper(model, integrator), stepper(model, integrator)
    start = once.energy()
    last = min(1000, once.instants.size - 1)
    assert once.advance_to(last) == 0
    for step in range(25, last + 1, 25):
        assert often.advance_to(step) == 0
    assert often.advance_to(last) == 0
    assert moving(once.problem.still, once.state.q, once.state.v) == model.system.dofs
    assert np.abs(once.state.q - often.state.q).max() <= 1e-9 * np.abs(once.state.q).max()
    sums = once.sums()
    lost = sum(sums[name] for name in ("viscous", "material", "absorbed", "impact", "algorithmic"))
    assert sums["kinetic"] + sums["strain"] - sums["work"] + lost == pytest.approx(start, rel=1e-10)


@every
@pytest.mark.parametrize("contact", [NODES, MEANS], ids=["nodes", "means"])
def test_a_row_far_ahead_touches_when_its_gap_has_closed(integrator: Integrator, contact: Contact) -> None:
    """One row far ahead of the zone hits a bump of the wall: at the right instant, and it goes no further, in steps of
    which each looks at all rows, and in steps that do not."""
    model = beam(contact)
    rows = model.system.contacts
    bump, height = 700, 0.05  # V₀ = 1: it touches at t = 0.05
    gap = rows.gap.copy()
    gap[bump] = height
    model = replace(model, system=replace(model.system, contacts=replace(rows, gap=gap)))
    single, together = stepper(model, integrator), stepper(model, integrator)
    longest = float(np.diff(single.instants).max())
    first, last = None, int(np.searchsorted(single.instants, 0.1))
    for step in range(1, last + 1):
        assert single.advance_to(step) == 0
        if first is None and single.state.impulse[bump] > 0.0:
            first = float(single.instants[step])
        assert model.system.contacts.gaps(single.state.q).min() >= -2.0 * longest
    assert first is not None and abs(first - height) <= 2.1 * longest
    assert together.advance_to(last) == 0
    for run in (single, together):
        assert run.state.impulse[bump - 100] == 0.0 and run.state.impulse[bump + 100] == 0.0
        assert run.state.impulse[0] > 0.0
    for name in ("q", "v", "impulse"):
        one, other = getattr(single.state, name), getattr(together.state, name)
        assert np.abs(one - other).max() <= 1e-9 * np.abs(one).max()


def test_the_whole_of_a_loaded_or_turning_beam_is_computed() -> None:
    impacts = (
        Impact.dimensionless(0.2, length=120.0),
        replace(Impact.dimensionless(0.2, length=120.0), acceleration=0.1),
        replace(Impact.dimensionless(0.2, length=120.0), curvature_rate=1e-3),
    )
    mesh = UniformMesh(0.1).nodes(60.0)
    make = partial(beam_model, nodes=mesh, contact=NODES, far_field=GridViscosity(), full=False)
    moved = []
    for impact in impacts:
        run = stepper(make(impact), MoreauJean(1e-3))
        moved.append(moving(run.problem.still, run.state.q, run.state.v) / run.state.q.size)
    assert moved[0] == 0.0 and moved[1] > 0.99 and moved[2] > 0.99


def test_rows_of_a_penalty_are_looked_at_everywhere() -> None:
    model = beam()
    gap = model.system.contacts.gap.copy()
    gap[700] = 0.01
    model = replace(model, system=replace(model.system, contacts=replace(model.system.contacts, gap=gap)))
    run = stepper(model, GeneralizedAlphaPenalty(1e-3, stiffness=1e5, damping=1e3))
    assert run.advance_to(30) == 0
    assert run.state.impulse[700] > 0.0
