"""What is refused, how failures end, and when the contact states of a step have settled."""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

import exudyn_models
from bent_beam import Impact, SimulationError
from bent_beam.meshes import NodesMesh, UniformMesh
from bent_beam.method import method_from_tables
from exudyn_models import ExudynModel
from exudyn_models.contacts import Penalty, Rigid, SegmentFriction
from exudyn_models.contacts.penalty import SpringsRun
from exudyn_models.contacts.segment_friction import _Run as SegmentRun
from exudyn_models.elements import ANCFCable
from exudyn_models.geometry import TrueGeometry
from exudyn_models.integrators import RK44, GeneralizedAlpha, Newmark, VelocityVerlet
from exudyn_models.settling import ANY, Settling
from exudyn_models.solvers import NewtonSolver

SHORT, WHOLE = Impact.dimensionless(0.5, length=8.0), Impact.whole_beam(0.5)
HINGED = WHOLE.replace(left_end="hinged", right_end="hinged")
SHEARED = Impact.whole_beam(0.5, relative_damping=3e-3, shear_length=0.05, shear_ratio=0.2)
MESH, NODES = UniformMesh(0.1), NodesMesh((0.0, 1.0, 2.0))


@pytest.mark.parametrize("integrator", [RK44, VelocityVerlet])
def test_unstable_explicit_step_is_refused_with_the_stable_one(integrator):
    with pytest.raises(ValueError, match="stable step") as refusal:
        exudyn_models.simulate(SHORT, mesh=MESH, integrator=integrator(time_step=1e-2))
    stable = float(str(refusal.value).split("stable step ")[1].split()[0])
    history = exudyn_models.simulate(SHORT, mesh=MESH, integrator=integrator(time_step=0.99 * stable), save=5)
    assert np.isfinite(history.array("gap")).all()


def run(impact=SHORT, **parts):
    exudyn_models.simulate(impact, **({"mesh": MESH} | parts))


def table(part, **settings):
    method_from_tables("exudyn", {part: settings})


def asked(impact=WHOLE, **parts):
    """Before any run."""
    raise ValueError(ExudynModel(**parts).refuses(impact))


ONE_WALL, WAY = WHOLE.replace(opposite_wall=1.0), '.*model = "euler_bernoulli"'
REFUSED = [
    (lambda: run(contact=Rigid(), integrator=Newmark(gamma=0.5)), "gamma above 0.5"),
    (lambda: run(SHORT.replace(axial_force=1.0), contact=SegmentFriction()), "axial force does not act .*got .* 1.0"),
    (lambda: run(save=0), "save"),
    (lambda: run(mesh=NODES, end_time=5.0), r"mesh.places .* 4.0 .*got 2.0"),
    (lambda: run(mesh=NodesMesh((0.0, 2.0, 5.0))), r"end at the half length 4.0 \(got 5.0\)"),
    (lambda: run(mesh=UniformMesh(1.9e-5)), "200000 are the most"),
    (lambda: run(Impact.dimensionless(0.5, length=8.0), end_time=1.0, geometry=TrueGeometry()), "right angle"),
    # settings
    (lambda: table("integrator", kind="newmark", gamma=1e300), "integrator.gamma"),
    (lambda: table("contact", kind="penalty", relative_stiffness=-1.0), "relative_stiffness must be positive"),
    (lambda: table("geometry", kind="linear", amplitude=0.0), "amplitude"),
    (lambda: table("solver", kind="newton", halve_steps=1), "halve_steps must be true or false"),
    (lambda: Penalty(stiffness=1.0, relative_stiffness=1.0), "exclude each other"),
    (lambda: RK44(time_step=1e-3, safety=0.5), "safety has no effect next to time_step"),
    (lambda: asked(SHORT, contact=SegmentFriction(relative_friction_damping=2.0)), "friction_damping has no effect"),
    (lambda: asked(WHOLE, integrator=RK44(), solver=NewtonSolver(iterations=9)), "solver.iterations has no effect"),
    (lambda: asked(WHOLE, contact=Rigid(), solver=NewtonSolver(contact_iterations=9)), "contact_iterations has no"),
    # what a part cannot model
    (lambda: asked(ONE_WALL, contact=Rigid()), "one wall"),
    (lambda: asked(ONE_WALL, contact=SegmentFriction()), "one wall"),
    (lambda: asked(WHOLE.replace(first_touch=0.2), contact=SegmentFriction()), "first_touch 0.2"),
    (lambda: asked(WHOLE.replace(wall_stiffness=1e4), contact=Penalty()), "exudyn.contact has no effect"),
    (lambda: asked(ONE_WALL.replace(wall_stiffness=1e4)), "opposite_wall"),
    (lambda: asked(HINGED.replace(wall_to=0.1), contact=Rigid()), "must be penalty"),
    (lambda: asked(HINGED, geometry=TrueGeometry()), "free ends only"),
    (lambda: asked(HINGED.replace(axial_force=1.0)), "axial_force is not modelled together with ends"),
    (lambda: asked(HINGED.replace(opposite_wall=1.0)), "opposite_wall is not modelled together with ends"),
    (lambda: asked(WHOLE.replace(hysteretic_loss=0.1, loss_frequency=1.0)), "hysteretic_loss .*got 0.1.* Hermite"),
    (lambda: asked(SHEARED, element=ANCFCable()), "ancf_cable" + WAY),
    (lambda: asked(SHEARED, contact=SegmentFriction()), "cables" + WAY),
    (lambda: asked(SHORT, element=ANCFCable(axial_stiffness=1e5)), "axial_stiffness has no effect without axial_force"),
    (lambda: asked(SHORT.replace(axial_force=5.0), element=ANCFCable(axial_stiffness=10.0)), "must be 5000 N at least"),
    (lambda: ExudynModel().simulate_to_separation(HINGED), "supports bring the beam back"),
    # what only simulate can do
    *((lambda contact=contact: exudyn_models.build(SHORT, mesh=MESH, contact=contact), "use simulate")
      for contact in (Rigid(), Penalty(hold=4), Penalty(hold_start=0.01))),
    (lambda: exudyn_models.build(SHORT, integrator=GeneralizedAlpha(relative_step=0.01)), "steps of build are equal"),
    *((lambda solver=solver: exudyn_models.build(SHORT, mesh=MESH, solver=solver), "build repeats a step 5 times")
      for solver in (NewtonSolver(contact_iterations=9), NewtonSolver(contact_must_settle=False))),
    (lambda: exudyn_models.build(SHORT, mesh=MESH, save=0), "save must be"),
    # what no day is long enough for
    (lambda: exudyn_models.build(SHORT, integrator=GeneralizedAlpha(time_step=1e-11)), r"ask for 1e\+10 steps"),
]  # fmt: skip


@pytest.mark.parametrize(("made", "said"), REFUSED, ids=[said for _, said in REFUSED])
def test_what_has_no_effect_or_cannot_be_modelled_is_refused_by_name(made, said):
    with pytest.raises(ValueError, match=said):
        made()


@pytest.mark.parametrize(
    ("solver", "advice"),
    [
        (NewtonSolver(absolute_tolerance=1e-18, relative_tolerance=1e-18, iterations=1), "; try"),
        (NewtonSolver(contact_iterations=1), "settled.*contact_iterations"),
    ],
)
def test_a_step_that_fails_carries_time_advice_and_partial_history(solver, advice, capfd):
    with pytest.raises(SimulationError, match=advice) as failure:
        exudyn_models.simulate(SHORT, mesh=MESH, solver=solver)
    error = failure.value
    assert error.time >= 0.0 and error.history is not None and not error.history.completed
    assert np.isfinite(error.history.array("gap")).all()
    assert not any(capfd.readouterr())


def test_divergence_ends_as_an_error_and_never_as_a_history(monkeypatch):
    monkeypatch.setattr(RK44, "limit", 40.0)  # a stability bound that lies
    with pytest.raises(SimulationError, match=r"finite|unstable"):
        exudyn_models.simulate(SHORT, mesh=MESH, integrator=RK44(safety=1.0))


def test_a_run_whose_contact_need_not_settle_says_how_often_it_did_not():
    solver = NewtonSolver(contact_iterations=1, contact_must_settle=False)
    history = exudyn_models.simulate(SHORT, mesh=MESH, solver=solver, save=20)
    assert history.settings["unsettled_steps"] > 0
    assert any(f"of {history.steps} steps the contact state had not" in warning for warning in history.warnings)


class Pressed:
    """0 ≤ p ⊥ M p − c ≥ 0 in the place of a system and its contact: p are forces, M p − c gaps."""

    states, imposes = 1, True

    def __init__(self, flexibility, penetration):
        self.flexibility, self.penetration, self.systemData = flexibility, penetration, self
        self.data, self.hook = np.ones(penetration.size), lambda *_: None
        self.GetDataCoordinates, self.SetDataCoordinates = lambda: self.data, partial(setattr, self, "data")
        self.GetODE2Coordinates, self.GetODE2Coordinates_t = lambda: self.forces, lambda: self.gaps
        self.SetPreNewtonResidualUserFunction = partial(setattr, self, "hook")

    def solve(self):
        self.hook(self, 0.0, 0, 0)
        closed = self.data <= 0.0
        self.forces = np.zeros(closed.size)
        self.forces[closed] = np.linalg.solve(self.flexibility[np.ix_(closed, closed)], self.penetration[closed])
        self.gaps = np.where(closed, 0.0, self.flexibility @ self.forces - self.penetration)

    def closed_by(self, forces, gaps):
        return (forces > 0.0) | (gaps < 0.0)

    def contradictions(self, forces, gaps, closed):
        return np.maximum(np.where(closed, -forces, -gaps), 0.0)


def settled(contact: Pressed) -> Settling:
    """The judge after as many solutions as it asked for."""
    settling = Settling(contact, 300, 1e-9)
    contact.solve()
    while settling(contact, 1.0)[0] > ANY and not settling.unsettled:
        contact.solve()
    return settling


def test_a_stiff_chain_pressed_at_random_settles():
    """Sixty contacts a fourth derivative apart: exchanging all that are wrong at once runs out of repetitions."""
    count = 60
    bending = np.diff(np.eye(count + 4), 4, axis=0)[:, :count]
    flexibility = np.linalg.inv(1e-5 * np.eye(count) + bending.T @ bending)
    for seed in range(10):
        contact = Pressed(flexibility, np.random.default_rng(seed).normal(size=count))
        settling = settled(contact)
        assert settling.unsettled == settling.cycles == 0
        assert contact.forces.min() >= -1e-9 and contact.gaps.min() >= -1e-9


def test_exchanges_that_go_in_a_circle_are_no_proof_that_no_state_is_consistent():
    """Murty (1974): a P-matrix, so that one state is consistent. From the first alone closed, all wrong ones at once
    lead from two closed to the next two for ever."""
    contact = Pressed(np.array([[1.0, 2.0, 0.0], [0.0, 1.0, 2.0], [2.0, 0.0, 1.0]]), np.ones(3))
    contact.data[0] = -1.0
    settling = settled(contact)
    assert settling.unsettled == settling.cycles == 0
    assert contact.forces == pytest.approx(np.full(3, 1 / 3), rel=1e-12)


def test_a_chord_contradicts_its_state_by_the_force_of_its_spring_on_its_gap():
    """In the wall and open; off the wall and closed without a push. Two sound ones are between them."""
    contact = SimpleNamespace(stiffness=np.array([2.0, 2.0, 2.0, 4.0]))
    gap, push = np.array([-0.5, -0.5, 0.25, 0.25]), np.array([1.0, 1.0, 0.5, 0.0])
    contact._pushes = lambda q, v: (gap, push, None)
    found = SegmentRun.contradictions(contact, None, None, np.array([False, True, False, True]))
    assert found.tolist() == [1.0, 0.0, 0.0, 1.0]


@pytest.mark.parametrize("late", [0.1, 0.9])
def test_a_plate_that_lands_at_once_does_so_early_or_late_in_a_step_but_not_bit_by_bit(late):
    """c b V of its dashpots; a difference of the depths of 1e-3 of what it falls in the step is no such landing."""
    scaling = SimpleNamespace(impact=SimpleNamespace(damping_at_landing=3.0, wall_damping=2.0))
    wall = SimpleNamespace(damping=4.0, weights=np.array([0.5, 1.0]))
    contact, speed = SimpleNamespace(beam=SimpleNamespace(scaling=scaling), wall=wall), np.full((2, 2), 7.0)
    for apart, force in ((0.0, [[21.0, 42.0]]), (1e-3, [[0.0, 0.0]])):
        depth = np.array([[-late, -late - apart], [1.0 - late, 1.0 - late - apart]])
        assert SpringsRun.landing(contact, depth, speed) == pytest.approx(np.array(force))


def test_a_contact_without_a_consistent_state_is_counted_and_ends():
    """Closed it pulls, open it has entered the wall."""
    settling = settled(Pressed(-np.eye(1), np.ones(1)))
    assert (settling.cycles, settling.unsettled) == (1, 0)


def test_a_spectral_radius_from_full_to_no_damping_is_taken_and_none_beyond() -> None:
    """0 ≤ ρ∞ ≤ 1: averages of second order, γ = ½ + α_f − α_m, to which a stiff force is kept as −ρ∞."""
    for radius in (0.0, 0.3, 1.0):
        found = GeneralizedAlpha(spectral_radius=radius).averages()
        assert found.gamma == pytest.approx(0.5 + found.alpha_f - found.alpha_m)
        assert found.alpha_f / (1.0 - found.alpha_f) == pytest.approx(radius)  # f⁺(1 − α_f) + f α_f = 0
    for radius in (-1e-9, 1.0 + 1e-9):
        with pytest.raises(ValueError, match=r"spectral_radius must lie in \[0, 1\]"):
            GeneralizedAlpha(spectral_radius=radius)
