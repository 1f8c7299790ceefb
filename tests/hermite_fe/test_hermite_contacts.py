"""Facts of unilateral contact along the beam: complementarity, symmetry, momentum, energy, and what the hold
does."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from bent_beam import Impact, ImpactHistory
from bent_beam.meshes import ScaleFreeMesh, UniformMesh
from comparison.estimators import leading_order, moments
from hermite_fe import simulate
from hermite_fe.beam import shape_functions
from hermite_fe.contacts import CONTACTS, Contact, MeanContact, MiddleContact, NodeContact
from hermite_fe.contacts.element import element_rows
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import (
    GeneralizedAlphaPenalty,
    Integrator,
    MoreauJean,
    NonsmoothGeneralizedAlpha,
    SignoriniPosition,
)
from hermite_fe.simulate import hold_report

STEPS = {"time_step": 1e-5, "growth": 2e-3}
INTEGRATORS: dict[str, Integrator] = {
    "moreau_jean": MoreauJean(**STEPS),
    "moreau_jean_middle": MoreauJean(theta=0.6, **STEPS),
    "signorini_position": SignoriniPosition(**STEPS),
    "velocity": NonsmoothGeneralizedAlpha(levels="velocity", **STEPS),
    "position_velocity": NonsmoothGeneralizedAlpha(levels="position_velocity", **STEPS),
    "position_velocity_acceleration": NonsmoothGeneralizedAlpha(**STEPS),
    "penalty": GeneralizedAlphaPenalty(stiffness=1e5, damping=1e3, **STEPS),
}
MESH = ScaleFreeMesh(0.01, 1.02)
IMPACT = Impact.dimensionless(0.4, length=60.0)


def run(
    integrator: Integrator, contact: Contact | None = None, impact: Impact = IMPACT, **rest: object
) -> ImpactHistory:
    return simulate(impact, end_time=0.3, mesh=MESH, integrator=integrator, contact=contact, save=40, **rest)  # type: ignore[arg-type]


def relative_defect(history: ImpactHistory) -> float:
    fields = ("loss_impact", "loss_algorithmic", "loss_viscous")
    total = history.array("kinetic_energy") + history.array("strain_energy") - history.array("work_of_loads")
    total = total + sum(history.array(name) for name in fields)
    return float(np.abs(total - total[0]).max() / total[0])


@pytest.mark.parametrize("end", ["free", "following"])
@pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS)
def test_energy_closes_to_round_off(integrator: Integrator, end: str) -> None:
    impact = IMPACT.replace(acceleration=0.05, fourth_derivative=-0.02, curvature_rate=0.1)
    history = run(integrator, impact=impact, far_field=GridViscosity(end=end))
    assert relative_defect(history) < 1e-11


@pytest.mark.parametrize("kind", CONTACTS)
@pytest.mark.parametrize("name", [n for n in INTEGRATORS if n != "penalty"])
def test_complementarity_holds_to_round_off(name: str, kind: str) -> None:
    history = run(INTEGRATORS[name], CONTACTS[kind](hold=0, hold_until=0.0))
    assert history.array("smallest_reaction").min() > -1e-9
    assert history.array("complementarity_product").max() < 1e-9
    if name in ("signorini_position", "position_velocity", "position_velocity_acceleration"):
        assert history.array("smallest_gap").min() > -1e-12
    assert history.array("held_impulse")[-1] == 0.0


@pytest.mark.parametrize("contact", [NodeContact(), MiddleContact(), MeanContact()], ids=list(CONTACTS))
@pytest.mark.parametrize("name", ["moreau_jean", "signorini_position", "position_velocity_acceleration"])
def test_half_and_full_beam_agree(name: str, contact: Contact) -> None:
    half, full = run(INTEGRATORS[name], contact), run(INTEGRATORS[name], contact, full_beam=True)
    nodes = half.dataset.sizes["x"]
    assert np.abs(full.array("gap")[:, nodes - 1 :] - half.array("gap")).max() < 1e-9
    assert np.abs(full.array("gap") - full.array("gap")[:, ::-1]).max() < 1e-9
    assert full.array("total_impulse") == pytest.approx(half.array("total_impulse"), abs=1e-8)
    for name_ in ("kinetic_energy", "strain_energy", "loss_impact", "loss_algorithmic", "loss_viscous"):
        assert full.array(name_) == pytest.approx(half.array(name_), abs=1e-8)
    assert (half.dataset.attrs["symmetry"], full.dataset.attrs["symmetry"]) == ("half", "full")


@pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS)
def test_the_impulse_is_the_change_of_momentum(integrator: Integrator) -> None:
    history = run(integrator)
    x, v = history.dataset.x.values, history.array("velocity")
    # cubic elements: ∫v dx = Σ l(v₁ + v₂)/2 + l²(ω₁ − ω₂)/12; the last is O(Δx²) of the first
    momentum = 2.0 * np.trapezoid(v, x, axis=1)
    lost = momentum[0] - momentum
    assert lost[-1] == pytest.approx(history.array("total_impulse")[-1], rel=2e-3)


@pytest.mark.parametrize("contact", [NodeContact(), MiddleContact(), MeanContact()], ids=list(CONTACTS))
def test_contact_discretisations_agree(contact: Contact) -> None:
    history, reference = (
        run(INTEGRATORS["signorini_position"], contact),
        run(INTEGRATORS["signorini_position"]),
    )
    assert history.array("total_impulse")[-1] == pytest.approx(reference.array("total_impulse")[-1], rel=2e-3)


def test_the_zone_stays_on_the_wall_with_the_hold() -> None:
    for name, most in (
        ("signorini_position", 1e-9),
        ("position_velocity_acceleration", 1e-9),
        ("moreau_jean", 1e-4),
    ):
        history = simulate(IMPACT, end_time=0.3, integrator=INTEGRATORS[name], contact=NodeContact(hold=16))
        place = history.dataset.x.values[history.array("in_contact")[-1]].max()
        inside = history.dataset.x.values < 0.9 * place
        assert np.abs(history.array("gap")[-1][inside]).max() < most * 0.3
        assert history.array("held_impulse")[-1] < 0.0
        assert history.settings["hold"]["until"] == 0.3
        assert history.settings["hold"]["pull"] > 0.0


@pytest.mark.parametrize("integrator", [i for i in INTEGRATORS.values() if i.holds], ids=lambda i: type(i).__name__)
def test_nothing_pulls_after_the_start(integrator: Integrator) -> None:
    """The default is unilateral: what pulls ends with the hold of the start, a hundredth of the run at most."""
    history = run(integrator)
    late = history.time > 0.01 * 0.3
    held = history.array("held_impulse")[late]
    assert np.all(held == held[0])
    assert np.all(np.diff(history.array("impulse")[late], axis=0) >= -1e-12)
    hold = history.settings["hold"]
    assert hold is None or hold["until"] <= 0.01 * 0.3


def test_no_hold_acts_once_waves_may_be_back() -> None:
    """On a beam of T* = 1 everything is released at 0.005, whatever was asked for."""
    history = simulate(
        Impact.whole_beam(0.3), end_time=0.02, mesh=ScaleFreeMesh(0.002, 1.02), contact=NodeContact(hold=16), save=80
    )
    held = history.array("held_impulse")
    assert history.settings["hold"]["until"] == pytest.approx(0.005)
    assert held[-1] == held[np.searchsorted(history.time, 0.0052)] < 0.0


def test_a_pull_over_no_push_is_no_number() -> None:
    def report(pull: float, push: float) -> object:
        impulses = SimpleNamespace(
            time=np.array([0.0, 0.3]), impulse=np.array([[0.0], [push]]), held_impulse=np.array([[0.0], [-pull]])
        )
        return hold_report(IMPACT, NodeContact(hold=16), impulses)

    assert report(2.0, 0.0) == {"until": 0.3, "pull": None}
    assert report(2.0, 8.0) == {"until": 0.3, "pull": 0.25}
    assert report(0.0, 0.0) is None


def test_holds_without_effect_are_errors() -> None:
    with pytest.raises(ValueError, match="hold keeps rows closed"):
        NodeContact(restitution=0.5, hold=4)
    with pytest.raises(ValueError, match=r"contact\.hold has no effect"):
        run(INTEGRATORS["penalty"], NodeContact(hold=4))


def test_impact_loss_vanishes_under_refinement() -> None:
    losses = []
    for element in (0.04, 0.02, 0.01):
        history = simulate(
            IMPACT,
            end_time=0.3,
            mesh=ScaleFreeMesh(element, 1.01),
            integrator=SignoriniPosition(time_step=0.05 * element**2, growth=1e-3),
        )
        losses.append(history.energy_budget()["loss_impact"])
    assert losses[0] > 1.7 * losses[1] > 1.7**2 * losses[2] > 0.0


def test_discrete_contact_touches_at_one_point_with_r0_equal_to_nu() -> None:
    history = simulate(Impact(1.0, 1.0, 50.0, 25.0, 20.0))  # κ/ν = 1.25, in SI units
    impact = history.impact
    tau = history.time / impact.time_scale
    impulse = history.array("total_impulse") / (
        impact.mass_per_length * impact.velocity * impact.length_scale
    )
    assert history.array("in_contact").sum(axis=1).max() == 1
    assert impulse[-1] == pytest.approx(4.0 * math.sqrt(2.0 / math.pi) * math.sqrt(tau[-1]), rel=1e-3)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_a_full_restitution_loses_nothing_in_impacts(restitution: float) -> None:
    history = run(MoreauJean(theta=0.5, **STEPS), NodeContact(restitution=restitution))
    lost = history.energy_budget()["loss_impact"]
    assert (abs(lost) < 1e-10) if restitution == 1.0 else lost > 0.0


def test_penalty_contact_needs_nodes_and_no_restitution() -> None:
    with pytest.raises(ValueError, match=r"contact\.kind"):
        run(INTEGRATORS["penalty"], MiddleContact())
    with pytest.raises(ValueError, match=r"restitution must be 0 \(got 0.5\)"):
        run(INTEGRATORS["penalty"], NodeContact(restitution=0.5))
    with pytest.raises(ValueError, match=r"restitution must be 0 \(got 0.5\)"):
        run(INTEGRATORS["signorini_position"], NodeContact(restitution=0.5))


def test_contacts_validate_their_numbers() -> None:
    for kind in CONTACTS.values():
        with pytest.raises(ValueError, match=r"restitution must lie in \[0, 1\] \(got 1.5\)"):
            kind(restitution=1.5)
        with pytest.raises(ValueError, match=r"contact\.hold must be a whole number"):
            kind(hold=-1)
        with pytest.raises(ValueError, match=r"contact\.hold_until must not be negative"):
            kind(hold_until=-1.0)


@dataclass(frozen=True)
class QuarterContact(Contact):
    """Somebody's own: rows at a quarter of each element, counted from the middle of the beam."""

    def rows(self, beam, natural, *, full):  # type: ignore[no-untyped-def]
        s = np.where(beam.nodes[1:] > 0.0, 0.25, 0.75)
        weights = np.concatenate([shape_functions(a, b) for a, b in zip(s, beam.lengths)])
        return element_rows(beam, natural, weights, at=s, full=full)


@pytest.mark.parametrize("contact", [QuarterContact(), MiddleContact(), MeanContact()], ids=lambda c: type(c).__name__)
def test_contacts_between_nodes_are_booked_where_they_act(contact: Contact) -> None:
    """λ₀ = 1.018866, r₀ = 1.177212 at κ/ν = 0.5 (thesis 2.6.21–22); booked a quarter element off, λ₀ is 0.8 % off."""
    found = leading_order(moments(simulate(Impact.dimensionless(0.5, length=20.0), contact=contact)))
    assert found.lambda0.value == pytest.approx(1.01886591389, rel=1e-3)
    assert found.r0.value == pytest.approx(1.17721208090, rel=1e-3)
    assert found.lift < 1e-3


def test_a_quarter_contact_is_symmetric_on_the_full_beam() -> None:
    half, full = (run(INTEGRATORS["signorini_position"], QuarterContact(), full_beam=f) for f in (False, True))
    assert full.array("total_impulse") == pytest.approx(half.array("total_impulse"), abs=1e-8)
    assert np.allclose(full.contact_positions(0), -full.contact_positions(0)[::-1])


def test_a_zone_thrown_off_the_wall_is_warned_of() -> None:
    """κ/ν = 0.1, coarse elements and Moreau–Jean, which rattles: the zone lifts by several per cent."""
    history = simulate(
        Impact.dimensionless(0.1, length=20.0),
        end_time=0.1,
        mesh=UniformMesh(0.02),
        integrator=MoreauJean(time_step=1e-4),
        contact=NodeContact(hold=0, hold_until=0.0),
    )
    assert leading_order(moments(history)).lift > 1e-2
    assert any("off the wall" in warning for warning in history.warnings)
