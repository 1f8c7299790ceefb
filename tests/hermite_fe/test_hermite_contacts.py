"""Facts of unilateral contact along the beam: complementarity, symmetry, momentum, energy, and what the hold
does."""

from dataclasses import dataclass

import numpy as np
import pytest
from hermite_parts import ALL

from bent_beam import Impact, ImpactHistory
from bent_beam.measure.estimators import leading_order
from bent_beam.measure.moments import moments
from bent_beam.meshes import ScaleFreeMesh, UniformMesh
from hermite_fe import simulate
from hermite_fe.beam import shape_functions
from hermite_fe.contacts import CONTACTS, Contact, MeanContact, MiddleContact, NodeContact, element_rows
from hermite_fe.integrators import Integrator, MoreauJean, SignoriniPosition

STEP, GROWTH = 2e-5, 3e-3
verify = pytest.mark.verify
INTEGRATORS = {name: make(STEP, growth=GROWTH) for name, make in ALL.items()}
MESH = ScaleFreeMesh(0.01, 1.02)
IMPACT = Impact.dimensionless(0.4, length=60.0)


PAIRS = [(name, kind) for name in INTEGRATORS for kind in CONTACTS if name != "penalty" or kind == "node"]


def run(integrator: Integrator, contact: Contact | None = None, **rest: object) -> ImpactHistory:
    return simulate(IMPACT, end_time=0.3, mesh=MESH, integrator=integrator, contact=contact, save=40, **rest)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("name", "kind"),
    [p if "node" in p or "signorini_position" in p else pytest.param(*p, marks=verify) for p in PAIRS],
)
def test_the_wall_pushes_where_the_beam_touches_and_takes_its_momentum(name: str, kind: str) -> None:
    """0 ≤ p ⊥ g ≥ 0 to round-off, strictly unilateral; the impulse is the change of momentum; the budget closes."""
    history = run(INTEGRATORS[name], CONTACTS[kind]())
    x, v = history.dataset.x.values, history.array("velocity")
    # cubic elements: ∫v dx = Σ l(v₁ + v₂)/2 + l²(ω₁ − ω₂)/12; the last is O(Δx²) of the first
    momentum = 2.0 * np.trapezoid(v, x, axis=1)
    assert momentum[0] - momentum[-1] == pytest.approx(history.array("total_impulse")[-1], rel=2e-3)
    budget = history.energy_budget()
    assert abs(budget["defect"]) < 1e-11 * budget["initial_energy"]
    assert history.array("held_impulse")[-1] == 0.0 and history.settings["hold"] is None
    if name != "penalty":
        assert np.all(np.diff(history.array("impulse"), axis=0) >= -1e-9)
        assert history.array("smallest_reaction").min() > -1e-9
        assert history.array("complementarity_product").max() < 1e-9
    if name in ("signorini_position", "position_velocity", "position_velocity_acceleration"):
        assert history.array("smallest_gap").min() > -1e-12


@dataclass(frozen=True)
class QuarterContact(Contact):
    """Somebody's own: rows at a quarter of each element, counted from the middle of the beam."""

    def rows(self, beam, natural, *, full):  # type: ignore[no-untyped-def]
        s = np.where(beam.nodes[1:] > 0.0, 0.25, 0.75)
        weights = np.concatenate([shape_functions(a, b) for a, b in zip(s, beam.lengths)])
        return element_rows(beam, natural, weights, at=s, full=full)


@pytest.mark.parametrize(
    ("name", "contact"),
    [
        ("moreau_jean", NodeContact()),
        pytest.param("position_velocity_acceleration", MiddleContact(), marks=verify),
        pytest.param("signorini_position", MeanContact(), marks=verify),
        ("signorini_position", QuarterContact()),
    ],
    ids=str,
)
def test_half_and_full_beam_agree(name: str, contact: Contact) -> None:
    half, full = run(INTEGRATORS[name], contact), run(INTEGRATORS[name], contact, full_beam=True)
    nodes = half.dataset.sizes["x"]
    assert np.abs(full.array("gap")[:, nodes - 1 :] - half.array("gap")).max() < 1e-9
    assert np.abs(full.array("gap") - full.array("gap")[:, ::-1]).max() < 1e-9
    energies = ("kinetic_energy", "strain_energy", "loss_impact", "loss_algorithmic", "loss_viscous")
    for quantity in ("total_impulse", *energies):
        assert full.array(quantity) == pytest.approx(half.array(quantity), abs=1e-8)
    assert np.allclose(full.contact_positions(0), -full.contact_positions(0)[::-1])
    assert (half.dataset.attrs["symmetry"], full.dataset.attrs["symmetry"]) == ("half", "full")


def test_the_zone_stays_on_the_wall_with_the_hold() -> None:
    for name, most in (("signorini_position", 1e-9), ("position_velocity_acceleration", 1e-9), ("moreau_jean", 1e-4)):
        history = run(INTEGRATORS[name], NodeContact(hold=16))
        place = history.dataset.x.values[history.array("in_contact")[-1]].max()
        inside = history.dataset.x.values < 0.9 * place
        assert np.abs(history.array("gap")[-1][inside]).max() < most * 0.3
        assert history.array("held_impulse")[-1] < 0.0
        assert history.settings["hold"]["until"] == 0.3
        assert history.settings["hold"]["pull"] > 0.0


def test_no_hold_acts_once_waves_may_be_back() -> None:
    """On a beam of T* = 1 everything is released at 0.005, whatever was asked for."""
    history = simulate(
        Impact.whole_beam(0.3), end_time=0.02, mesh=ScaleFreeMesh(0.002, 1.02), contact=NodeContact(hold=16), save=80
    )
    held = history.array("held_impulse")
    assert history.settings["hold"]["until"] == pytest.approx(0.005)
    assert held[-1] == held[np.searchsorted(history.time, 0.0052)] < 0.0


def test_impact_loss_vanishes_under_refinement() -> None:
    losses = []
    for element in (0.08, 0.04, 0.02):
        scheme = SignoriniPosition(time_step=0.05 * element**2, growth=1e-3)
        history = simulate(IMPACT, end_time=0.3, mesh=ScaleFreeMesh(element, 1.01), integrator=scheme)
        losses.append(history.energy_budget()["loss_impact"])
    assert losses[0] > 1.7 * losses[1] > 1.7**2 * losses[2] > 0.0


@pytest.mark.parametrize(
    "contact",
    [QuarterContact(), pytest.param(MiddleContact(), marks=verify), pytest.param(MeanContact(), marks=verify)],
    ids=lambda c: type(c).__name__,
)
def test_contacts_between_nodes_are_booked_where_they_act(contact: Contact) -> None:
    """λ₀ = 1.018866, r₀ = 1.177212 at κ/ν = 0.5 (thesis 2.6.21–22); booked a quarter element off, λ₀ is 0.8 % off."""
    found = leading_order(moments(simulate(Impact.dimensionless(0.5, length=20.0), contact=contact)))
    assert found.lambda0.value == pytest.approx(1.01886591389, rel=1e-3)
    assert found.r0.value == pytest.approx(1.17721208090, rel=1e-3)
    assert found.lift < 1e-3


def test_a_zone_thrown_off_the_wall_is_warned_of() -> None:
    """κ/ν = 0.1, coarse elements and Moreau–Jean, which rattles: the zone lifts by several per cent."""
    parts = {"mesh": UniformMesh(0.02), "integrator": MoreauJean(time_step=1e-4), "contact": NodeContact()}
    history = simulate(Impact.dimensionless(0.1, length=20.0), end_time=0.1, **parts)
    assert leading_order(moments(history)).lift > 1e-2
    assert any("off the wall" in warning for warning in history.warnings)
