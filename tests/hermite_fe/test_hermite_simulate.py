"""``simulate``: the thesis's numbers with nothing set by hand, and what a user may get wrong."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from bent_beam import Impact, ImpactHistory, SimulationError
from bent_beam import meshes as mesh_kinds
from bent_beam.meshes import UniformMesh
from bent_beam.method import method_from_tables
from hermite_fe import INTEGRATORS, HermiteFE, simulate
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import GeneralizedAlphaPenalty, Integrator, MoreauJean, SignoriniPosition
from hermite_fe.resolution import end_warnings
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System

R = 4.0 * math.sqrt(2.0 / math.pi)
SHORT = Impact.dimensionless(0.5, length=40.0)


def scaled(history: ImpactHistory) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    impact = history.impact
    unit = impact.mass_per_length * impact.velocity * impact.length_scale
    return history.time / impact.time_scale, history.array("total_impulse") / unit


def slope(x: NDArray[np.float64], y: NDArray[np.float64]) -> float:
    return float(np.polyfit(x, y, 1)[0])


def reaction(history: ImpactHistory) -> float:
    """r₀ from I = c + 4√(2/π) r₀√τ over the last decade."""
    tau, impulse = scaled(history)
    late = tau >= 0.1 * tau[-1]
    return slope(np.sqrt(tau[late]), impulse[late]) / R


def spread(history: ImpactHistory) -> float:
    """λ₀ from the cube root of the gap ahead of the front."""
    impact = history.impact
    tau, x = history.time / impact.time_scale, history.dataset.x.values / impact.length_scale
    thickness, out = math.sqrt(2.0 * impact.kappa_over_nu), []
    for k in np.flatnonzero(tau >= 0.3 * tau[-1]):
        last = x[history.array("in_contact")[k]].max()
        near = (x > last + 0.1 * thickness * math.sqrt(tau[k])) & (
            x < last + 0.6 * thickness * math.sqrt(tau[k])
        )
        roots = np.roots(
            np.polyfit(x[near], np.cbrt(history.array("gap")[k][near] / impact.deflection_scale), 2)
        )
        real = roots[np.isreal(roots)].real
        out.append(real[np.argmin(np.abs(real - last))] / math.sqrt(tau[k]))
    return float(np.mean(out))


@pytest.mark.parametrize(
    ("curvature", "lambda0", "r0", "within"),
    [(10.0, 1.01886591389, 1.17721208090, 5e-4), (2.0, 4.25760478009, 2.74499113477, 1e-3)],
)
def test_auto_finds_the_leading_order_of_a_case_in_si_units(
    curvature: float, lambda0: float, r0: float, within: float
) -> None:
    history = simulate(Impact(1.0, 1.0, 50.0, curvature, 20.0))
    assert history.warnings == []
    assert history.completed and history.time[-1] == pytest.approx(2.5e-4)
    assert reaction(history) == pytest.approx(r0, rel=within)
    assert spread(history) == pytest.approx(lambda0, rel=within)
    inside = history.dataset.x.values < 0.9 * lambda0 * math.sqrt(0.1) * 0.05
    assert np.abs(history.array("gap")[-1][inside]).max() < 2e-3 * 20.0 * 2.5e-4


def test_only_what_a_load_changes_is_measured_on_a_cut_beam() -> None:
    """A long beam under load is cut, its ends following the free motion; without loads nothing is."""
    bare = Impact.dimensionless(0.3, length=400.0)
    chosen = HermiteFE().chosen_for(bare, 0.1)
    assert chosen.domain is None and chosen.far_field.end == "free"
    loaded = HermiteFE().chosen_for(bare.replace(acceleration=0.1), 0.1)
    assert 0.0 < loaded.domain < 100.0 and loaded.far_field.end == "following"


def test_a_free_motion_that_meets_the_wall_elsewhere_is_said_of_ends_that_follow_it() -> None:
    """q₀ > 0 bends the far ends into the wall: V₀t − Kx²/2 + q₀x⁴/24 = 0 again at x² = 12K/q₀."""
    impact, nodes = Impact.dimensionless(0.5, length=60.0).replace(fourth_derivative=0.02), np.linspace(0.0, 30.0, 601)

    def said(impact: Impact, end: str) -> list[str]:
        far = GridViscosity(end=end)
        return [w for w in end_warnings(impact, 0.1, nodes, far) if "meets the wall away" in w]

    (found,) = said(impact, "following")
    assert f"x = {math.ceil(math.sqrt(12.0 * 0.5 / 0.02) / 0.05) * 0.05:.3g} m" in found
    nodes = nodes[nodes < 17.4]  # where it is 0.8 m inside the wall
    assert said(impact, "following") == [found]
    assert said(impact, "free") == said(impact.replace(fourth_derivative=-0.02), "following") == []


def test_an_ensemble_is_drawn_within_a_factor_of_two_of_one_step() -> None:
    impact, random = Impact.whole_beam(0.5), np.random.default_rng(3)
    drawn = [HermiteFE().varied(impact, random) for _ in range(300)]
    steps = [m.integrator.time_step * impact.wave_constant / m.mesh.element_length**2 for m in drawn]
    assert 0.5 <= min(steps) < 0.55 and 1.8 < max(steps) <= 2.0
    assert {m.contact.restitution for m in drawn} == {0.0, 0.5, 1.0}
    elements = [impact.half_length / m.mesh.element_length for m in drawn]
    assert 79.5 < min(elements) < 90.0 and 150.0 < max(elements) < 160.5


def test_a_thin_front_is_resolved_too() -> None:
    impact = Impact(1.0, 1.0, 50.0, 1.0 / 10.0, 25.0)  # κ/ν = 1/250; r₀ → √(π/8)·√(2ν/κ)
    for contact in (None, NodeContact(hold=16)):
        history = simulate(impact, contact=contact)
        assert history.warnings == []
        assert reaction(history) == pytest.approx(math.sqrt(math.pi / 8.0 * 500.0), rel=5e-3)


@pytest.mark.parametrize(
    ("groups", "r1", "lambda0"),
    [
        ((4.0, 0.0, 0.0), 10.6928065607, 1.01886591389),
        ((1.0, 1.0, 0.0), 1.83706066099, 1.01886591389),
        ((-1.0, -1.0, 0.0), -4.18053010088, 0.0),
    ],
)
def test_first_order_reaction_at_kappa_one_half(
    groups: tuple[float, float, float], r1: float, lambda0: float
) -> None:
    """I₁ = (4√(2/π)/3 r₁ + (4/3)(α + ψ)₊λ₀) τ^{3/2}: loads of both signs, initial shape and rate
    simulated."""
    alpha, psi, chi = groups
    contact = NodeContact(hold=16 if alpha + psi >= 0 else 0)
    out = []
    for epsilon in (0.0, 2e-3, 4e-3):
        impact = Impact.dimensionless(
            0.5,
            epsilon_alpha=epsilon * alpha,
            epsilon_psi=epsilon * psi,
            epsilon_chi=epsilon * chi,
            length=60.0,
        )
        out.append(simulate(impact, end_time=1.0, contact=contact, far_field=GridViscosity(end="following")))
    tau, base = scaled(out[0])
    late = tau >= 0.1
    slopes = [
        slope(tau[late] ** 1.5, ((scaled(h)[1] - base) / e)[late]) for h, e in zip(out[1:], (2e-3, 4e-3))
    ]
    first = 2.0 * slopes[0] - slopes[1] - 4.0 / 3.0 * max(alpha + psi, 0.0) * lambda0
    assert first / (R / 3.0) == pytest.approx(r1, rel=5e-3)


def test_without_contact_the_free_motion_is_reproduced() -> None:
    impact = Impact.dimensionless(3.0, epsilon_alpha=0.4, epsilon_psi=0.3, epsilon_chi=-0.2, length=4.0)
    impact = impact.replace(velocity=1e-3, acceleration=-0.4)  # leaves before it touches anything
    history = simulate(
        impact,
        end_time=0.4,
        mesh=UniformMesh(0.1),
        far_field=GridViscosity(end="following"),
        integrator=INTEGRATORS["nonsmooth_generalized_alpha"](time_step=1e-2),
        contact=NodeContact(hold=0, hold_until=0.0),
    )
    t, x = history.time[:, None], history.dataset.x.values[None, 1:]
    exact = (
        impact.velocity * t
        - 0.5 * impact.curvature * x**2
        + 0.5 * impact.acceleration * t**2
        + 0.5 * impact.curvature_rate * x**2 * t
        + impact.fourth_derivative * x**4 / 24.0
    )
    assert (
        np.abs(history.array("gap")[:, 1:] + exact).max() < 2e-4
    )  # the middle node's first touch is all there is


def test_a_finite_free_beam_is_pressed_or_lifts_off() -> None:
    """The thesis's first-order case: L = 2 m, K = 0.35 1/m, V₀ = 3.5 m/s, a₀ = ±700 m/s² (Fig. 3.34)."""
    runs = {
        a: simulate(Impact(1.0, 1.0, 2.0, 0.35, 3.5, acceleration=a), end_time=2.5e-3)
        for a in (-700.0, 0.0, 700.0)
    }
    impulse = {a: history.array("total_impulse")[-1] for a, history in runs.items()}
    assert impulse[-700.0] < impulse[0.0] < impulse[700.0]
    assert runs[-700.0].array("gap")[-1][0] > 1e-4  # the middle is off the wall
    assert abs(runs[700.0].array("gap")[-1][0]) < 1e-9
    for history in runs.values():
        budget = history.energy_budget()
        assert abs(budget["defect"]) < 1e-11 * budget["initial_energy"]


def test_coarse_meshes_and_steps_are_warned_of_by_how_much() -> None:
    history = simulate(
        Impact(1.0, 1.0, 50.0, 1.0 / 80.0, 20.0),
        mesh=UniformMesh(0.05),
        integrator=MoreauJean(time_step=5e-5),
        save=4,
    )
    mesh, step, *_ = history.warnings
    assert "mesh cannot resolve" in mesh and "1.8e+02 times shorter" in mesh
    assert "time steps cannot resolve" in step


def test_returning_waves_are_warned_of() -> None:
    history = simulate(
        Impact.dimensionless(0.5, length=4.0),
        end_time=1.0,
        mesh=UniformMesh(0.05),
        integrator=MoreauJean(time_step=1e-2),
        save=4,
    )
    assert any("ends of the beam" in warning for warning in history.warnings)


def test_settings_suffice_to_run_again() -> None:
    history = simulate(SHORT, end_time=0.05, integrator=MoreauJean(time_step=1e-3, theta=0.7), save=7)
    text = json.loads(json.dumps(history.settings))
    kinds = {c.__name__: c for r in (*HermiteFE.PARTS.values(), mesh_kinds.MESHES) for c in r.values()}
    parts = {
        name: kinds[text[name]["kind"]](**{k: v for k, v in text[name].items() if k != "kind"})
        for name in ("mesh", "integrator", "contact", "far_field")
    }
    again = simulate(
        history.impact, end_time=text["end_time"], full_beam=text["full_beam"], save=text["save"], **parts
    )
    assert np.array_equal(again.array("gap"), history.array("gap"))
    assert again.settings == history.settings


def test_a_straight_beam_lands_all_at_once_on_defaults() -> None:
    """κ = 0: no front, the wall takes the momentum μLV₀ of a beam without bounce."""
    history = simulate(Impact(1.0, 1.0, 2.0, 0.0, 1.0), end_time=0.01)
    assert history.array("total_impulse")[-1] == pytest.approx(2.0, rel=1e-3)
    assert not any("front" in warning for warning in history.warnings)


def test_a_mesh_that_cannot_be_laid_is_the_user_s_own() -> None:
    with pytest.raises(ValueError, match=r"^mesh\.element_length is too small"):
        simulate(SHORT, mesh=UniformMesh(1e-9))


def test_a_whole_beam_that_rebounds_is_stepped_by_schemes_with_an_impact_law() -> None:
    method = HermiteFE(contact=NodeContact(restitution=0.5))
    impact = Impact.whole_beam(2.0, relative_damping=1e-2)
    assert isinstance(method.for_whole_beam(impact).integrator, MoreauJean)
    assert all(isinstance(other.integrator, MoreauJean) for other in method.cross_checks(impact).values())
    rocking = impact.replace(rotation=0.1)
    assert method.simulate(rocking, end_time=0.01, save=5).completed


def test_saved_times_and_progress() -> None:
    fractions: list[float] = []
    wanted = [0.01, 0.02, 0.05]
    history = simulate(
        SHORT, end_time=0.05, integrator=MoreauJean(time_step=1e-3), save=wanted, progress=fractions.append
    )
    assert history.time == pytest.approx([0.0, *wanted])
    assert fractions[-1] == 1.0 and fractions == sorted(fractions)


def test_a_run_that_fails_keeps_its_partial_history() -> None:
    class Breaking(MoreauJean):
        def advance(self, problem, state, memory, times, first, last):  # type: ignore[no-untyped-def]
            status, reached = super().advance(problem, state, memory, times, first, last)
            if times[reached] > 0.03:
                state.q[3] = np.nan
            return status, reached

    with pytest.raises(SimulationError, match="not finite") as caught:
        simulate(SHORT, end_time=0.05, integrator=Breaking(time_step=1e-3), save=20)
    partial = caught.value.history
    assert partial is not None and not partial.completed
    assert 0.0 < partial.time[-1] <= 0.03 < caught.value.time
    assert caught.value.step > 0


def test_an_overflow_is_found_in_the_step_where_it_happens() -> None:
    system = System(
        mass=[[1.0]],
        stiffness=[[0.0]],
        load=[[0.0], [1e308]],
        contacts=ContactRows(dofs=[[0]], factors=[[1.0]], gap=[1.0]),
    )
    run = integrate(system, np.zeros(1), np.zeros(1), MoreauJean(time_step=1.0), 100.0, save=[100.0])
    assert run.failure == "the solution is not finite"
    assert run.steps < 10


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"end_time": 0.0}, r"end_time must be positive \(got 0.0\)"),
        ({"end_time": float("nan")}, "end_time must be a finite number"),
        ({"save": 1}, "save must be"),
        ({"mesh": UniformMesh(1e-9)}, "element_length is too small"),
    ],
)
def test_bad_arguments_are_named(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        simulate(SHORT, **arguments)  # type: ignore[arg-type]


def test_a_beam_bent_into_the_wall_is_refused() -> None:
    with pytest.raises(ValueError, match="into the wall before the impact"):
        simulate(Impact.dimensionless(0.5, epsilon_psi=1.0, length=40.0))


def test_a_straight_beam_on_a_flat_wall_is_nowhere_inside_it() -> None:
    parts = {"mesh": UniformMesh(0.1), "integrator": SignoriniPosition(theta=0.5, time_step=1e-4)}
    found = simulate(Impact(1.0, 1.0, 2.0, 0.0, 1.0), end_time=1e-3, **parts)
    assert np.all(found.array("gap")[0] == 0.0) and found.array("total_impulse")[-1] > 0.0


def test_parts_come_from_case_tables() -> None:
    table = {
        "integrator": {"kind": "nonsmooth_generalized_alpha", "spectral_radius": 0.5, "time_step": 1e-3},
        "contact": {"kind": "mean", "restitution": 0.0},
        "far_field": {"kind": "sponge", "width": 0.5},
    }
    history = method_from_tables("hermite", table).simulate(SHORT, end_time=0.02)
    assert history.settings["far_field"]["width"] == 0.5



@settings(max_examples=25, deadline=None)
@given(
    kappa=st.floats(0.05, 3.0),
    restitution=st.floats(0.0, 1.0),
    element=st.floats(0.02, 0.5),
    step=st.floats(1e-4, 5e-2),
)
def test_any_sound_run_is_finite_and_closes_its_budget(
    kappa: float, restitution: float, element: float, step: float
) -> None:
    history = simulate(
        Impact.dimensionless(kappa, length=8.0),
        end_time=0.1,
        mesh=UniformMesh(element),
        integrator=MoreauJean(time_step=step, theta=0.5),
        contact=NodeContact(restitution=restitution),
        save=5,
    )
    budget = history.energy_budget()
    assert abs(budget["defect"]) < 1e-10 * budget["initial_energy"]
    assert budget["loss_impact"] > -1e-10


@settings(max_examples=60, deadline=None)
@given(
    value=st.floats(allow_nan=True, allow_infinity=True),
    field=st.sampled_from(["theta", "time_step", "growth"]),
)
def test_numbers_are_refused_or_kept(value: float, field: str) -> None:
    allowed = {"theta": 0.5 <= value <= 1.0, "time_step": value > 0.0, "growth": value >= 0.0}[field]
    try:
        part = SignoriniPosition(**{field: value})
    except ValueError as error:
        assert field in str(error)
        assert not (allowed and math.isfinite(value))
    else:
        assert getattr(part, field) == value and allowed and math.isfinite(value)


def test_a_penalty_that_nobody_gave_is_refined_with_the_steps_of_a_whole_beam() -> None:
    impact = Impact.whole_beam(0.5)
    one, finer = (
        HermiteFE(integrator=GeneralizedAlphaPenalty(), refine=refine).for_whole_beam(impact).integrator
        for refine in (1.0, 2.0)
    )
    longer = HermiteFE(integrator=GeneralizedAlphaPenalty()).cross_checks(impact)["step"].integrator
    for other in (finer, longer):
        shorter = one.time_step / other.time_step
        assert shorter == pytest.approx(4.0 if other is finer else 0.5)
        assert (other.stiffness, other.damping) == pytest.approx((one.stiffness * shorter**2, one.damping * shorter))


@pytest.mark.parametrize("integrator", [None, MoreauJean(), SignoriniPosition(theta=0.5)])
def test_beside_a_whole_beam_stands_another_impact_law(integrator: Integrator | None) -> None:
    impact = Impact.whole_beam(0.5)
    chosen = HermiteFE(integrator=integrator).for_whole_beam(impact).integrator
    other = HermiteFE(integrator=integrator).cross_checks(impact)["contact_law"].integrator
    assert {type(chosen), type(other)} == {MoreauJean, SignoriniPosition}
    assert other.time_step == pytest.approx(2.0 * chosen.time_step)
