"""The expanding mesh: self-similar impacts at rest in it, against the theory (thesis 2.6.21–22)."""

import re

import numpy as np
import pytest

from bent_beam import Impact, SimulationError
from bent_beam.measure.estimators import SIDE, leading_order
from bent_beam.measure.moments import first_front, moments
from self_similar_fe import ExpandingMesh, SelfSimilarFE
from self_similar_fe.run import Run, simulate_expanding
from self_similar_fe.similarity import similarity, worst_of_runs
from theory import contact_parameters

EXACT = contact_parameters(0.5)
slow = pytest.mark.verify
QUICK, SHORT = ExpandingMesh(decades=2.0), ExpandingMesh(decades=3.0, step_ratio=0.04)


@pytest.fixture(scope="module")
def half():
    """κ/ν = 0.5 without loads."""
    return simulate_expanding(Impact.dimensionless(0.5), QUICK, end_time=0.1)


@pytest.mark.parametrize("ratio", [0.25, 0.5, 2.0, pytest.param(0.05, marks=slow), pytest.param(0.8, marks=slow)])
def test_leading_order_to_a_few_hundred_thousandths(ratio, half):
    """Also because the far field does not come back."""
    history = half if ratio == 0.5 else simulate_expanding(Impact.dimensionless(ratio), QUICK, end_time=0.1)
    found = leading_order(moments(history))
    exact = contact_parameters(ratio)
    assert found.lambda0.value == pytest.approx(exact.lambda0, rel=5e-5)
    assert found.r0.value == pytest.approx(exact.r0, rel=3e-5)
    assert found.lift < 5e-5
    assert np.any(history.array("in_contact")[:, 1:]) == (ratio < 1.0)  # one point from there on


def test_a_refined_mesh_has_twice_the_elements_and_steps():
    mesh, fine = ExpandingMesh(), ExpandingMesh().refined(2.0)
    ratios = {name: getattr(fine, name) / getattr(mesh, name) for name in vars(mesh)}
    changed = dict.fromkeys(("elements_per_wave", "interior_elements"), 2.0)
    changed |= dict.fromkeys(("front_resolution", "growth", "step_ratio"), 0.5)
    assert {name: ratio for name, ratio in ratios.items() if ratio != 1.0} == changed
    assert SelfSimilarFE(mesh=mesh).refined(2.0).chosen_for(Impact.dimensionless(0.5), 0.1).mesh == fine
    assert SelfSimilarFE(refine=1e-3).refine == 1e-3  # any factor above 0


@pytest.mark.parametrize(("kappa_over_nu", "within"), [(1 / 1600, 1e-4), (0.8, 2e-3), (0.95, 2e-3)])
def test_the_held_start_lays_a_mesh_around_its_front_however_thin_or_short(kappa_over_nu, within):
    """No fixed mesh resolves the front at κ/ν = 1/1600; the free beam reaches 20 times as far as the zone at 0.95."""
    state, exact = similarity(kappa_over_nu, ExpandingMesh(front_resolution=0.05)), contact_parameters(kappa_over_nu)
    assert state.front == pytest.approx(exact.lambda0, rel=within)
    assert state.reaction.sum() / SIDE == pytest.approx(exact.r0, rel=within)
    ahead, thickness = np.searchsorted(state.zeta, state.front) + 1, 2.0 / np.sqrt(1.0 + state.front**2)
    assert np.diff(state.zeta)[ahead] == pytest.approx(0.05 * min(thickness, 2.0 * state.front), rel=0.02)


def test_energy_of_the_fast_part_is_the_work_of_the_wall(half):
    """½∫(z_t² + z_xx²) = V₀∫R dt less what the absorber took (theory.md, section 5): nothing is lost at the front."""
    budget = half.energy_budget()
    assert abs(budget["loss_algorithmic"]) < 2e-4 * budget["work_of_loads"]
    assert abs(budget["defect"]) < 1e-5 * budget["work_of_loads"]
    tense = Impact.dimensionless(0.5, epsilon_alpha=-0.02, epsilon_axial=0.04)
    budget = simulate_expanding(tense, QUICK, end_time=1.0).energy_budget()
    assert abs(budget["defect"]) < 3e-5 * budget["work_of_loads"]
    heavy = Impact(2.0, 8.0, 600.0, 0.5 / 3.0, 1.0 / 6.0).replace(fourth_derivative=1e-3 / 6.0)  # κ/ν = 0.5, ψ > 0
    history = simulate_expanding(heavy, QUICK, end_time=0.1 * heavy.time_scale)
    root = np.sqrt(0.05 * heavy.time_scale)  # √(ct)
    impulse = SIDE * 4.0 * 8.0 / 6.0 * root * float(EXACT.r0)  # of μV₀
    assert history.array("total_impulse")[-1] == pytest.approx(impulse, rel=1e-3)
    assert history.array("impulse_moment")[-1] == pytest.approx(impulse / 4.0 * float(EXACT.lambda0) * root, rel=2e-3)
    assert history.array("velocity", -1)[[0, -1]] == pytest.approx([0.0, 1.0 / 6.0], rel=1e-2, abs=1e-6)
    budget = history.energy_budget()
    assert abs(budget["defect"]) < 3e-5 * budget["work_of_loads"]
    slope = history.array("slope", -1)
    bow = -np.gradient(history.array("gap", -1), history.positions(-1), edge_order=2)
    assert bow == pytest.approx(slope, abs=3e-4 * np.ptp(slope))


def test_rates_of_slopes_are_slopes_of_rates():
    run = Run(Impact.dimensionless(0.5), QUICK, 0.1, 20)
    rates = run.full_velocity()
    slopes = np.gradient(rates[0::2], run.state.zeta, edge_order=2)
    assert rates[1::2] == pytest.approx(slopes, abs=0.015 * np.ptp(slopes))  # what the front's jump leaves


def test_impulse_energies_and_front_grow_like_the_root_of_the_time_and_far_ahead_the_beam_flies_on(half):
    for name in ("total_impulse", "kinetic_energy", "strain_energy", "work_of_loads", "loss_absorbed"):
        shares = half.array(name) / np.sqrt(half.time)
        assert shares == pytest.approx(shares[-1], rel=1e-5), name
    for k in (0, 20, -1):
        x, gap = half.positions(k)[-1], half.array("gap", k)[-1]
        assert gap == pytest.approx(0.25 * x**2 - half.time[k], rel=1e-6)
        assert half.array("velocity", k)[[0, -1]] == pytest.approx([0.0, 1.0], abs=1e-6)
    assert half.array("complementarity_product").max() < 1e-10  # what pushes has no gap
    # the front at an instant, bare: from two centroids of what points gathered that move with it
    read, bent = first_front(half, 0.08)
    assert read == pytest.approx(float(EXACT.lambda0) * 0.08**0.5, rel=2e-3) and bent < 2e-3 * read


def test_a_curved_wall_takes_its_curvature_from_the_beams_and_the_method_runs_its_mesh(half):
    bulging = Impact.dimensionless(0.5).replace(curvature=0.2, wall_curvature=-0.3)
    found = SelfSimilarFE(mesh=QUICK).simulate(bulging, end_time=0.1)
    for name in ("gap", "total_impulse"):
        assert np.array_equal(found.array(name), half.array(name))


def test_the_middle_lifts_when_the_load_pulls_and_stays_unpulled_when_it_pushes():
    impacts = [Impact.dimensionless(0.5, epsilon_alpha=alpha) for alpha in (-0.5, 0.5)]
    pulled, pushed = (simulate_expanding(impact, SHORT, end_time=0.1) for impact in impacts)
    assert pulled.array("lift")[-1] / 0.1 > 1e-3
    short = simulate_expanding(Impact.dimensionless(0.9), SHORT, end_time=0.1)  # what lies beyond its rim is no lift
    assert pushed.array("lift")[-1] / 0.1 < 1e-5 and short.array("lift")[-1] / 0.1 < 1e-4
    scale = pushed.impact.velocity * pushed.time
    assert np.all(pushed.array("smallest_gap")[1:] >= -1e-6 * scale[1:])
    assert np.all((pushed.array("smallest_reaction") >= -1e-5 / np.sqrt(pushed.time))[1:])  # the start is held
    assert abs(pushed.array("held_impulse")[-1]) < 0.01 * pushed.array("total_impulse")[-1]


def test_the_wall_pulls_in_no_step_where_contacts_wander_and_widened_tolerances_are_warned_of(monkeypatch):
    """α = −1 pulls the beam off: the contact is one or two nodes, which exchanging all wrong ones never settles."""
    pulled, mesh = Impact.dimensionless(0.1, epsilon_alpha=-1.0), ExpandingMesh(step_ratio=0.02)
    history = SelfSimilarFE(mesh=mesh).simulate(pulled, end_time=0.05)
    assert history.settings["largest_pull"] < 1e-4 and history.settings["widened"] <= 10.0
    assert not history.warnings
    saved = history.time[-1] / history.time[0]
    assert saved == pytest.approx(1e3, rel=0.04)  # three of the four decades of steps
    monkeypatch.setattr("self_similar_fe.similarity.worst_of_runs", lambda excess, active: excess > 0.0)
    monkeypatch.setattr("self_similar_fe.similarity.ONE_BY_ONE", -1)
    worse = SelfSimilarFE(mesh=mesh).simulate(pulled, end_time=0.05)
    assert worse.settings["widened"] > 100.0 and worse.settings["largest_pull"] > 1e-4 and "pulls" in worse.warnings[-1]


def test_of_neighbours_that_are_wrong_alike_the_worst_is_exchanged_and_two_are_both() -> None:
    excess = np.array([-9.0, 0.1, 0.5, 0.2, 0.3, -9.0, 0.4, 0.2, 0.3, 0.7, 0.1, -9.0])
    active = np.array([True] * 8 + [False] * 4)  # the last three are wrong the other way
    chosen = np.array([0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 0], bool)
    assert np.array_equal(worst_of_runs(excess, active), chosen)


BREAKS = [*({name: 1e-3} for name in ("damping", "rotation", "first_touch", "opposite_wall", "shear_stiffness"))]
BREAKS += [{"wall_from": -0.1, "wall_to": 0.1}, {"left_end": "hinged"}, {"hysteretic_loss": 0.1, "loss_frequency": 1.0}]
IMPOSSIBLE = {"front_resolution": 0.0, "growth": -0.1, "step_ratio": 0.9, "decades": 0.1, "elements_per_wave": 2}
REFUSED = [
    *((lambda change=change: SelfSimilarFE().simulate(Impact.dimensionless(0.5).replace(**change)), next(iter(change)))
      for change in BREAKS),
    (lambda: SelfSimilarFE(mesh=QUICK).simulate(Impact(1.0, 1.0, 1.0, 0.0, 1.0), end_time=0.1), "curvature"),
    *((lambda name=name: ExpandingMesh(**{name: IMPOSSIBLE[name]}), name) for name in IMPOSSIBLE),
]  # fmt: skip


def test_what_breaks_self_similarity_is_refused_with_what_to_do_instead():
    """A damping ratio becomes a time that nobody has typed."""
    damped = Impact.dimensionless(0.5).replace(damping=1e-3 / 7.0)
    assert "(got 0.0001429): set beam.damping = 0, or take the path hermite" in (SelfSimilarFE().refuses(damped) or "")


@pytest.mark.parametrize(("made", "said"), REFUSED, ids=[said for _, said in REFUSED])
def test_what_breaks_self_similarity_or_is_impossible_is_refused_by_name(made, said):
    with pytest.raises(ValueError, match=said):
        made()


def test_waves_reach_as_far_as_the_root_of_time_and_beyond_a_short_beam_it_is_said():
    short, mesh = Impact.dimensionless(0.5, length=4.0), ExpandingMesh(decades=1.0)
    runs = [simulate_expanding(short, mesh, end_time=end, save=n) for end, n in ((0.1, 2), (0.9, 4))]
    words = r"reach ([\d.]+) m, beyond the half length 2 m"
    early, late = (float(re.findall(words, found.warnings[0])[0]) for found in runs)
    assert (*runs[0].time, runs[1].time[-1]) == pytest.approx((0.01, 0.1, 0.9))
    assert all(np.array_equal(runs[1].dataset[name], runs[1].positions(-1)) for name in ("x", "contact_x"))
    assert (3.0 * early, runs[1].positions(-1)[-1]) == pytest.approx((late, late), rel=1e-2)


def test_a_front_that_runs_out_of_its_mesh_is_an_error_with_what_was_reached():
    with pytest.raises(SimulationError, match="finely meshed zone") as caught:
        simulate_expanding(Impact.dimensionless(0.5, epsilon_chi=40.0), QUICK, end_time=0.1)
    assert caught.value.history is not None


def test_a_load_chooses_when_a_run_starts_how_fine_its_front_is_and_how_long_its_steps_are():
    """A load on the zone needs an early start; one that pushes closes what the start has left open, in long steps;
    one that pulls leaves a point or two, which the front must not pass in a step. α = −¼ takes NK off the zone."""
    loads = {}, {"epsilon_alpha": 1.0}, {"epsilon_alpha": -1.0}, {"epsilon_alpha": -0.25, "epsilon_axial": 0.5}
    impacts = (Impact.dimensionless(0.5, **load) for load in loads)
    bare, pushed, pulled, tense = (SelfSimilarFE().chosen_for(impact, 0.1).mesh for impact in impacts)
    assert min(pushed.decades, pulled.decades) > max(bare.decades, tense.decades)
    assert pushed.front_resolution < tense.front_resolution < pulled.front_resolution < bare.front_resolution
    assert max(pulled.step_ratio, tense.step_ratio) < bare.step_ratio < pushed.step_ratio


@pytest.mark.parametrize("front", [0.3, 2.0])
def test_elements_are_fine_at_the_front_and_nowhere_longer_than_a_share_of_the_zone(front):
    nodes, absorbs = ExpandingMesh(front_resolution=0.02, interior_elements=20).lay(front)
    sizes, k = np.diff(nodes), int(np.searchsorted(nodes, front))
    assert nodes[0] == 0.0 and nodes[k] == pytest.approx(front) and absorbs == pytest.approx(front + 8.0)
    assert sizes[:k].max() <= 1.001 * front / 20 and sizes[k] == pytest.approx(sizes.min(), rel=0.1)
    thickness = 2.0 / np.sqrt(1.0 + front**2)  # of the front
    assert sizes[k] == pytest.approx(0.02 * min(thickness, 2.0 * front))
    assert np.max(np.diff(sizes[k:]) / sizes[k:-1]) == pytest.approx(ExpandingMesh.growth)
