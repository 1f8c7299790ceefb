"""The energy budget of every integrator: it closes to round-off, and what is falsified shows as a defect."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.contacts import MeanContact, NodeContact
from hermite_fe.far_fields import GridViscosity, Sponge
from hermite_fe.integrators import (
    GeneralizedAlphaPenalty,
    Integrator,
    MoreauJean,
    NonsmoothGeneralizedAlpha,
    SignoriniPosition,
)
from hermite_fe.model import beam_model
from hermite_fe.run import Stepper
from hermite_fe.simulate import simulate
from hermite_fe.system import ContactRows, System

STEP, END = 1e-3, 0.2
INTEGRATORS: dict[str, Integrator] = {
    "moreau_jean": MoreauJean(STEP, theta=0.7),
    "signorini_position": SignoriniPosition(STEP),
    "velocity": NonsmoothGeneralizedAlpha(STEP, levels="velocity"),
    "position_velocity": NonsmoothGeneralizedAlpha(STEP, levels="position_velocity"),
    "position_velocity_acceleration": NonsmoothGeneralizedAlpha(STEP),
    "penalty": GeneralizedAlphaPenalty(STEP, stiffness=1e5, damping=1e3),
}
every = pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS)


def stepper(integrator: Integrator) -> Stepper:
    """The whole beam at κ/ν = 0.5 with damping of all kinds, pressed on; strictly unilateral."""
    impact = Impact.dimensionless(0.5, length=2.0, damping=1e-3, epsilon_alpha=0.5)
    nodes = UniformMesh(0.05).nodes(1.0)
    model = beam_model(impact, nodes, NodeContact(hold=0, hold_until=0.0), Sponge(), full=False)
    return Stepper(model.system, model.displacement, model.velocity, integrator, END)


def balance(run: Stepper) -> float:
    s = run.sums()
    return (
        s["kinetic"] + s["strain"] - s["work"]
        + s["viscous"] + s["material"] + s["absorbed"] + s["impact"] + s["algorithmic"]
    )  # fmt: skip


@every
def test_every_cause_takes_its_share_and_the_budget_closes(integrator: Integrator) -> None:
    run = stepper(integrator)
    start = balance(run)
    assert run.advance_to(run.instants.size - 1) == 0
    sums = run.sums()
    assert sums["work"] > 1e-3 * start
    for cause in ("viscous", "material", "absorbed", "impact"):
        assert sums[cause] > 1e-6 * start, cause
    assert abs(balance(run) - start) < 1e-11 * start


@every
@pytest.mark.parametrize("share", [0.01, 0.04])
def test_a_falsified_velocity_shows_as_the_energy_it_brings(integrator: Integrator, share: float) -> None:
    run = stepper(integrator)
    start = balance(run)
    run.advance_to(run.instants.size // 2)
    brought = ((1.0 + share) ** 2 - 1.0) * run.sums()["kinetic"]
    run.state.v[:] *= 1.0 + share
    run.advance_to(run.instants.size - 1)
    # generalised-α also misses the damping force of what v̇ was not told of
    assert balance(run) - start == pytest.approx(brought, rel=1e-3)


@every
def test_a_falsified_loss_shows_as_a_defect_of_its_size(integrator: Integrator) -> None:
    """The damping matrix that is booked is 3 % off the one that damps."""
    run = stepper(integrator)
    start = balance(run)
    matrices = run.problem.matrices
    run.problem = run.problem._replace(matrices=matrices._replace(parts=1.03 * matrices.parts))
    run.advance_to(run.instants.size - 1)
    sums = run.sums()
    false = 0.03 / 1.03 * (sums["viscous"] + sums["material"] + sums["absorbed"])
    assert balance(run) - start == pytest.approx(false, rel=1e-8)


@every
def test_a_falsified_force_shows_in_proportion(integrator: Integrator) -> None:
    """Steps solved with pivots that are a little too small: every acceleration is wrong by that much."""

    def defect(share: float) -> float:
        run = stepper(integrator)
        start = balance(run)
        run.advance_to(10)
        run.problem.solver.U[0] *= 1.0 + share
        run.advance_to(40)
        return balance(run) - start

    small, large = defect(1e-4), defect(2e-4)
    assert abs(small) > 1e-7
    assert large == pytest.approx(2.0 * small, rel=0.05)


@pytest.mark.parametrize("kappa", [0.1, 0.5, 1.5])
@pytest.mark.parametrize("step", [2e-4, 1e-3])
@pytest.mark.parametrize("radius", [0.0, 0.8, 1.0])
@pytest.mark.parametrize("levels", ["velocity", "position_velocity", "position_velocity_acceleration"])
def test_the_wall_brings_no_energy(levels: str, radius: float, step: float, kappa: float) -> None:
    """An undamped beam, its shortest waves unresolved by the steps: neither more energy than at the start, nor a loss
    in impacts below zero."""
    history = simulate(
        Impact.dimensionless(kappa, length=2.0),
        end_time=0.3,
        integrator=NonsmoothGeneralizedAlpha(step, spectral_radius=radius, levels=levels),
        mesh=UniformMesh(0.02),
        contact=NodeContact(hold=0, hold_until=0.0),
        far_field=GridViscosity(viscosity=0.0),
        save=100,
    )
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    assert energy.max() <= energy[0] * (1.0 + 1e-9)
    assert np.diff(history.array("loss_impact")).min() > -1e-2 * energy[0]
    assert history.array("loss_impact")[-1] > 0.05 * energy[0] * (kappa < 1.0)


@pytest.mark.parametrize(
    "integrator", [i for i in INTEGRATORS.values() if not isinstance(i, GeneralizedAlphaPenalty)]
)
def test_the_budget_closes_with_rows_of_several_dofs(integrator: Integrator) -> None:
    budget = simulate(
        Impact.dimensionless(0.5, length=2.0), end_time=0.1, integrator=integrator, mesh=UniformMesh(0.02),
        contact=MeanContact(hold=0, hold_until=0.0),
    ).energy_budget()  # fmt: skip
    assert abs(budget["defect"]) < 1e-10 * budget["initial_energy"]


def test_lasting_contact_is_second_order_with_reactions_in_the_smooth_motion() -> None:
    system = System(
        mass=[[1.0, 2.0]],
        stiffness=[[3.0, 2.0], [-1.0, 0.0]],
        damping=[[0.1, 0.2]],
        load=[[-10.0, 0.0], [-1.0, 0.3], [1.0, 0.0]],
        contacts=ContactRows(dofs=[[0]], factors=[[1.0]], gap=[0.0]),
    )

    def end(step: float) -> np.ndarray:
        run = Stepper(system, np.array([0.0, 0.5]), np.array([0.0, 1.0]), NonsmoothGeneralizedAlpha(step), 2.0)
        run.advance_to(run.instants.size - 1)
        return np.array([run.state.q[1], run.state.v[1], run.state.impulse[0]])

    exact = end(2e-4)
    errors = [np.abs(end(h) - exact) for h in (0.02, 0.01, 0.005)]
    for coarse, fine in pairwise(errors):
        assert np.all(np.log2(coarse / fine) > 1.7)


def test_dampings_are_checked() -> None:
    rows = ContactRows(dofs=[[0]], factors=[[1.0]], gap=[0.0])

    def make(**more: Any) -> System:
        return System(mass=[[1.0]], stiffness=[[1.0]], contacts=rows, **more)

    assert make(damping=[[2.0]]).dampings[0][0] == "viscous"
    both = make(dampings=(("material", [[1.0]]), ("absorbed", [[0.5]]), ("viscous", [[0.0]])))
    assert both.damping[0, 0] == 1.5 and [cause for cause, _ in both.dampings] == ["material", "absorbed"]
    with pytest.raises(ValueError, match=r"system\.dampings must name each of"):
        make(dampings=(("friction", [[1.0]]),))
    with pytest.raises(ValueError, match="must be the sum"):
        make(damping=[[2.0]], dampings=(("material", [[1.0]]),))
    with pytest.raises(ValueError, match=r"system\.dampings\['material'\] must have shape"):
        make(dampings=(("material", [[1.0, 2.0]]),))
