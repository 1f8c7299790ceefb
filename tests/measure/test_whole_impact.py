"""The whole impact, from the first touch to the last separation: restitution, momentum, hits, energy."""

import dataclasses

import numpy as np
import pytest
from histories import pushed_until, recorded

from bent_beam.impact import Impact
from bent_beam.measure.reduction import peak_moment
from bent_beam.measure.whole_impact import hits, peak_times, pushes, whole_impact
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE
from hermite_fe.integrators import MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from theory.stopped_beam import StoppedBeam

SCHEMES = [MoreauJean(theta=0.5), NonsmoothGeneralizedAlpha(), SignoriniPosition(theta=0.5)]
COARSE = HermiteFE(mesh=UniformMesh(1.0 / 50))
slow = pytest.mark.verify
every_scheme = pytest.mark.parametrize("integrator", SCHEMES, ids=lambda scheme: type(scheme).__name__)


@every_scheme
@pytest.mark.parametrize(("elements", "step", "within"), [(50, 1.0, 4e-4), pytest.param(200, 0.5, 1e-5, marks=slow)])
def test_first_release_and_impulse_until_then_are_the_stopped_beam_s(integrator, elements, step, within) -> None:
    """Released within two steps. With θ = ½ at position level impulses alternate, and the reaction is their mean over
    two steps: the wall lets go in the middle of the first two steps without a push."""
    exact, h = StoppedBeam(1e-3).release(), step / elements**2
    scheme = dataclasses.replace(integrator, time_step=h)
    impact = Impact.whole_beam(2.0, relative_damping=1e-3)
    count = round(0.0825 / h)
    times = h * np.arange(round(0.078 / h), count + 1)
    method = HermiteFE(mesh=UniformMesh(1.0 / elements), integrator=scheme).for_whole_beam(impact)
    history = method.simulate(impact, end_time=count * h, save=times)
    impulse = history.array("total_impulse")[1:]
    stopped = int(np.argmax(impulse[2:] - impulse[:-2] <= 0.0))
    assert abs(history.time[2 + stopped] - exact.time) <= 2.0 * h
    assert np.interp(exact.time, history.time[1:], impulse) == pytest.approx(exact.impulse, abs=within)


@every_scheme
@pytest.mark.parametrize(
    ("kappa", "damping", "elements", "e", "within"),
    [
        (2.0, 1e-2, 30, 0.5663, 3e-4),
        pytest.param(2.0, 1e-2, 200, 0.56630, 1e-4, marks=slow),
        pytest.param(1.5, 1e-3, 200, 0.6161, 2e-4, marks=slow),
        pytest.param(0.5, 1e-3, 400, 0.4563, 5e-4, marks=slow),
        pytest.param(0.5, 1e-2, 200, 0.3364, 2e-4, marks=slow),
        pytest.param(4.0, 1e-3, 200, 0.616598, 1e-4, marks=slow),  # by modes
    ],
)
def test_restitution_of_a_damped_beam_is_one_number_for_all_schemes(integrator, kappa, damping, elements, e, within):
    method = HermiteFE(mesh=UniformMesh(1.0 / elements), integrator=integrator)
    history = method.simulate_to_separation(Impact.whole_beam(kappa, relative_damping=damping))
    found = whole_impact(history)
    assert found.left and found.restitution == pytest.approx(e, abs=within)
    assert found.impulse == pytest.approx(2.0 * (1.0 + found.restitution), rel=1e-12)
    assert found.translation + found.vibration + found.dissipated == pytest.approx(1.0, abs=1e-6)
    assert found.translation == pytest.approx(found.restitution**2, rel=1e-6)
    assert max(found.energy_defect, found.energy_gain) < 1e-6


@pytest.mark.parametrize(
    "change",
    [
        {"left_end": "hinged", "axial_force": 20.0, "acceleration": -10.0, "damping": 0.05},
        {"left_end": "hinged", "acceleration": -2.0, "wall_clearance": 0.1, "damping": 0.02},
        {"wall_from": 0.9, "wall_to": 1.0, "acceleration": -2.0},
        {"curvature_rate": 1.5, "damping": 0.01},
    ],
)
def test_the_restitution_is_of_the_velocity_with_which_the_centre_of_mass_arrives(change) -> None:
    """Which is not V₀: the middle of a taut gate is faster, a load brakes a beam on its way to a wall, a bow opens."""
    history = COARSE.simulate_to_separation(Impact(1.0, 1.0, 2.0, 0.5, 1.0).replace(**change), save=1000)
    found, (first, *_) = whole_impact(history), hits(history)
    at = np.searchsorted(history.time, [first.begin, first.end])
    x = history.positions(0)
    before, after = (np.trapezoid(history.array("velocity", int(k)), x) / np.ptp(x) for k in at)
    assert first.before == pytest.approx(before, abs=5e-3) and abs(before - 1.0) > 0.05
    assert found.restitution == pytest.approx(-after / before, abs=0.01)


def test_what_a_hit_loses_is_what_loads_do_not_give_and_it_is_where_it_pushes() -> None:
    time = np.linspace(0.0, 1.0, 101)
    work, lost = 0.4 * time, 0.3 * np.minimum(time, 0.5)
    pushes, full = np.outer(np.minimum(time, 0.5), [0.0, 1.0, 0.0, 0.0, 3.0]), {"x": np.linspace(-1.0, 1.0, 5)}
    run = recorded(time, pushes, symmetry="full", kinetic_energy=1.0 + work - lost, work_of_loads=work, **full)
    (hit,) = hits(run)
    assert (hit.energy, hit.lost) == pytest.approx((1.0 + 0.2 - 0.15, 0.15))
    assert hit.place == pytest.approx((0.5 + 3.0 * 1.0) / 4.0)
    assert dataclasses.replace(hit, before=2.0, after=-1.0).restitution == 0.5
    found, given = whole_impact(run), 1.0 + 0.4 * 0.495
    assert (found.supplied, found.supplied_rate, found.energy_gain) == pytest.approx((given, 0.4 / given, 0.0))


def test_the_restitution_of_a_held_beam_is_of_its_mean_velocity_when_the_push_ends() -> None:
    """Its supports push, too: the velocity goes on changing, and the push ends between two saved instants."""
    time = np.linspace(0.0, 4.0, 81)
    velocity = np.where(time < 0.5, 1.0, -0.4 - 2.0 * (time - 0.5))[:, None]
    beam = Impact.whole_beam(2.0).replace(left_end="hinged")
    held = whole_impact(recorded(time, np.outer(np.minimum(time, 0.5), np.ones(5)), velocity=velocity, impact=beam))
    assert held.restitution == pytest.approx(0.4 + 2.0 * (held.last_contact - 0.5)) and held.last_contact != 0.5


def test_a_contact_before_one_wall_stays_one_while_the_other_pushes_too() -> None:
    """However often the run is saved: 0 to 0.5 T* in front, 0.2 to 0.4 T* behind."""
    for count in (41, 401):
        time = np.linspace(0.0, 1.0, count)
        front, behind = (np.outer(np.clip(time - at, 0.0, span), np.ones(5)) for at, span in ((0.0, 0.5), (0.2, 0.2)))
        total = 2.0 * (front - behind).sum(axis=1)
        found = hits(recorded(time, front, total_impulse=total, opposite_impulse=behind))
        assert [hit.wall for hit in found] == ["front", "opposite"]
        assert [end for hit in found for end in (hit.begin, hit.end)] == pytest.approx([0.0, 0.5, 0.2, 0.4], abs=0.03)


def test_hits_are_contacts_whose_gaps_are_shorter_than_a_period_of_the_first_mode() -> None:
    """Numbers are those of the first hit: a contact 2.5 T* later is another hit, one 0.5 T* later belongs to it."""
    twice = pushed_until(0.5, last=4.0, again=3.0)
    found = whole_impact(twice)
    assert found.contacts == ((0.0, pytest.approx(0.5, abs=2.0 * found.within)),)
    assert found.contacts[-1][1] == found.last_contact == hits(twice)[0].end  # one last contact
    assert found.restitution == pytest.approx(0.45)
    drawn = twice.impact.replace(acceleration=1e-9)  # it may come back again
    for later, gone in ((3.0, True), (1.0, False)):  # another hit tells that the first is over
        known = whole_impact(pushed_until(0.5, last=later + 0.6, again=later, impact=drawn))
        assert (known.left, known.separations, known.again, known.restitution is not None) == (False, 1, gone, gone)
    assert (found.until, whole_impact(pushed_until(0.5, last=1.0)).until) == (pytest.approx(4.0), pytest.approx(1.0))
    soon = whole_impact(pushed_until(0.5, last=4.0, again=1.0))
    assert soon.last_push == pytest.approx(1.45)  # over mV₀
    assert np.array(soon.contacts) == pytest.approx(np.array([[0.0, 0.5], [1.0, 1.5]]), abs=2.0 * soon.within)
    assert soon.restitution == pytest.approx(1.9)
    for hit, begin, before, after in zip(hits(twice), (0.0, 3.0), (1.0, -0.45), (-0.45, -1.9), strict=True):
        assert (hit.begin, hit.before, hit.after) == pytest.approx((begin, before, after))
        assert hit.impulse == pytest.approx(2.0 * (before - after))  # mass 2


HEAVY = Impact(2.0, 8.0, 6.0, 2.0, 0.5)  # κ/ν = 2, ℓ = 3 m, T* = 18 s
SHEARED = Impact(2.0, 1.0, 2.0, 0.5, 1.0, shear_stiffness=400.0, wall_curvature=-0.5)


@pytest.mark.parametrize("again", [3.0, 0.6])
def test_what_springs_of_the_wall_hold_is_not_lost(again) -> None:
    time = np.linspace(0.0, 4.0, 81)
    held, lost, given = 0.05 * np.minimum(time, 1.1), 0.1 * (time > again), 0.03 * (time > 3.9)
    energies = {"contact_energy": held, "kinetic_energy": 1.0 - held - lost + given}
    run = pushed_until(0.5, last=4.0, again=again, **energies)
    found, hit = whole_impact(run), hits(run)[-1]
    assert found.energy_gain == pytest.approx(0.03) and (hit.energy, hit.lost) == pytest.approx((0.9, 0.1))
    assert found.drift["restitution"] == 0.0
    assert found.drift["dissipated"] == pytest.approx(0.05 * found.within)  # what springs take up


@pytest.mark.parametrize(
    ("changed", "moment", "element", "spread"),
    [
        ({}, 1.2, 0.3, 0.008),  # p = κ_sGA (2 − 1.2)/EI = 160 N/m, 2b = P/p = 0.02 m, Pb/4
        ({"shares": [0.5, 0.5]}, 1.2, 0.004, 0.0008),  # neighbours push less than they should
        ({}, 1.2, 0.004, 0.0016),  # nodes show what is wider than an element
        ({}, 2.0, 0.004, 0.0016),  # flat by its moment alone
        ({}, 1.9999, 0.004, 0.0016),
        ({"velocity": -1.0}, 1.2, 0.3, 0.0),  # a pull
        ({"shear_stiffness": None}, 1.2, 0.3, 0.0),
        ({"wall_stiffness": 1e4}, 1.2, 0.3, 0.0),
        ({"wall_from": 0.0, "wall_to": 0.0}, 1.2, 0.3, 0.0),  # a stop
    ],
)
def test_a_push_on_one_point_of_a_sheared_beam_spreads_over_less_than_an_element(changed, moment, element, spread):
    """EI = 2 N m², a push of 3.2 N, by half of the beam; shares of it beside the point, where contact is soft."""
    changed = changed.copy()
    push, shares = 1.6 * changed.pop("velocity", 1.0), np.array([*changed.pop("shares", [1.0]), *[0.0] * 4][:5])
    beam = SHEARED.replace(**changed)
    time, x = np.linspace(0.0, 1.0, 101), np.array([0.0, element, 0.5, 0.7, 1.0])
    moments = np.where(np.arange(101) == 50, moment, 0.1)
    run = recorded(time, push * time[:, None] * shares, x=x, impact=beam, moment=moments)
    assert peak_moment(run)[::4] == (moment, pytest.approx(spread))


@pytest.mark.parametrize("place", [0.0, 0.1, 0.2])
def test_a_push_beside_a_point_is_one_of_both_halves(place: float) -> None:
    """A pair stands for the pushes of one half and of its mirror image, wherever the largest moment is."""
    time, x, shares = np.linspace(0.0, 1.0, 101), np.array([0.0, 0.1, 0.2, 0.5]), np.array([0.4, 0.3, 0.1, 0.2])
    moment = np.where(np.arange(101) == 50, 1.2, 0.1)
    told = {"impact": SHEARED, "moment": moment, "largest_moment_place": place + 0.0 * time}
    both, mirrored = np.r_[-x[:0:-1], x], np.r_[shares[:0:-1], 2.0 * shares[:1], shares[1:]]
    half = recorded(time, np.outer(time, shares), x=x, **told)
    full = recorded(time, np.outer(time, mirrored), x=both, symmetry="full", **told)
    near, away = np.abs(both - place) < 0.25, np.abs(both - place)
    beside = 0.5 * mirrored[near] @ away[near] - 0.25 * mirrored[near].sum() ** 2 / 320.0
    expected = beside + 0.25 * mirrored[both == place].item() ** 2 / 320.0
    assert [peak_moment(run).spread for run in (half, full)] == pytest.approx([expected, expected], rel=1e-12)


def test_a_moment_counts_once_a_wave_has_passed_ten_of_the_shortest_elements() -> None:
    """Elements of ℓ/500: 4·10⁻⁴ T*. What the first touch of the mesh made before is left out, but where three elements
    lie within √(cη) and the beam's own damping makes it smooth; that of a damped beam may have been its largest."""
    time, x = np.linspace(0.0, 0.4, 4001), np.array([0.0, 0.002, 0.3, 0.6, 1.0])
    impulse = np.minimum(time, 0.2)[:, None] * (x == 0.0)
    cases = [(2.5e-4, 0.7, 0, False), (7.5e-4, 0.7, 0, True), (2.5e-4, 0.7, 3e-5, False), (2.5e-4, 0.7, 4e-5, True)]
    for peak, high, damping, counts in [*cases, (5e-5, 3.0, 3e-5, False)]:  # no more than V₀√(EIμ)
        impact = Impact.whole_beam(2.0, relative_damping=damping)
        moment = np.where(np.abs(time - peak) < 1e-4, high, 0.4)
        found = whole_impact(recorded(time, impulse, x=x, impact=impact, moment=moment))
        assert found.peak_moment == pytest.approx(high if counts else 0.4)
        assert found.moment_left_out == pytest.approx(min(high, 1.0) if damping and not counts else 0.0)
    # of coarse elements 2·10⁻³ T* at most is left out, and 2 % of what is looked at
    rough = {"x": np.array([0.0, 0.3, 0.6, 0.8, 1.0]), "impact": Impact.whole_beam(2.0)}
    for peak, until, counts in [(1.5e-3, None, False), (2.5e-3, None, True), (1.5e-3, 0.06, True)]:
        moment = np.where(np.abs(time - peak) < 5e-5, 0.7, 0.4)
        assert peak_moment(recorded(time, impulse, moment=moment, **rough), until).moment == (0.7 if counts else 0.4)
    few, moment = [0, 2000, 4000], np.array([0.0, 0.9, 0.4])  # saved: the first of them hides no maximum
    assert peak_moment(recorded(time[few], impulse[few], x=x, impact=impact, moment=moment)).moment == 0.9


def test_breaks_shorter_than_the_shortest_separation_are_none() -> None:
    impulse, time = np.array([0.0, 1.0, 2.0, 2.0, 3.0, 3.0, 3.0, 3.0, 4.0, 4.0]), np.arange(10.0)
    assert pushes(time, impulse, 0.5) == [(0, 2), (3, 4), (7, 8)]
    assert pushes(time, impulse, 2.0) == [(0, 4), (7, 8)]
    assert pushes(time, impulse, 9.0) == [(0, 8)]
    assert pushes(time, np.zeros(10), 1.0) == []
    with pytest.raises(ValueError, match="before the wall was touched"):
        whole_impact(pushed_until(0.0))


@pytest.mark.parametrize("reduced", [hits, whole_impact])
def test_a_beam_that_is_modelled_in_part_has_no_hits(reduced) -> None:
    """Its energy is that of the part; its velocity would be that of all of it."""
    with pytest.raises(ValueError, match=r"the run models 1.6 m of the beam: its energy"):
        reduced(pushed_until(0.3, x=np.linspace(0.0, 0.8, 5)))


def test_the_largest_force_is_told_in_half_the_beams_momentum_a_period() -> None:
    """μℓV₀/T*, the unit in which the rigid beam of two half lengths is pushed with 5.8."""
    peaks = dict.fromkeys(("peak_force", "peak_force_time", "peak_penetration", "peak_pressure"), np.full(41, 5.8))
    rigid, soft = whole_impact(pushed_until(0.3)), whole_impact(pushed_until(0.3, **peaks))
    assert rigid.peak_force is None and soft.peak_force == pytest.approx(5.8)
    told = dataclasses.replace(rigid, peak_force_time=0.5, peak_force_place=0.25, push_time=0.125)
    assert list(peak_times(told, HEAVY).values()) == pytest.approx([9.0, 0.75, 2.25, 0.18])


def test_the_largest_push_of_a_wall_that_gives_way_lies_between_saved_instants() -> None:
    """A force of 2 − 50(t − 0.203)², saved at every hundredth of T*: over as much it gives most about its top."""
    time, soft = np.linspace(0.0, 0.4, 41), Impact.whole_beam(2.0).replace(wall_stiffness=1e3)
    given = time - 25.0 / 3.0 * ((time - 0.203) ** 3 + 0.203**3)  # by half of the beam
    found = whole_impact(recorded(time, np.outer(given, np.eye(5)[0]), impact=soft))
    assert found.push == pytest.approx(0.02 - 50.0 / 3.0 * 2.0 * 0.005**3, rel=1e-9)
    assert found.push - found.push_rise == pytest.approx(0.02 - 50.0 / 3.0 * (0.003**3 + 0.007**3), rel=1e-9)


def test_the_last_contact_is_half_a_saved_interval_about_its_end_or_before_springs_one() -> None:
    """A rigid wall lets go between two saved instants, springs at the step that is taken for the end."""
    impacts = (Impact.whole_beam(2.0).replace(wall_stiffness=stiffness) for stiffness in (None, 1e3))
    assert [whole_impact(pushed_until(0.3, impact=one)).within for one in impacts] == pytest.approx([0.025, 0.05])


def test_a_beam_returns_where_it_is_nearest_to_the_wall_and_as_slowly_as_it_has_left_since() -> None:
    """Off the wall from 0.3 T* on, V₀T* times 1 − cos 4πt/T* + 0.1: nearest at 0.5 and 1 T*; at 1.5 T* it is over."""
    time = np.linspace(0.0, 2.0, 41)
    gap = 9.0 * np.where(time > 0.3, 1.1 - np.cos(4.0 * np.pi * time), 0.0)[:, None]
    pushes = np.outer(np.minimum(time, 0.3), np.eye(5)[0])
    found = whole_impact(recorded(18.0 * time, pushes, x=np.linspace(0.0, 3.0, 5), impact=HEAVY, gap=gap))
    assert np.array(found.returns) == pytest.approx(np.array([[0.5, 0.5], [1.0, 0.1 / 0.7]]), rel=1e-6)
    assert found.contacts == ((0.0, pytest.approx(0.275)),)


def test_the_largest_push_begins_when_the_wall_begins_to_push_within_its_window() -> None:
    """A slap between two saved instants; a steady force for a hundredth of T*, or for a saved interval longer."""
    time, x = np.linspace(0.0, 0.4, 401), np.linspace(0.0, 3.0, 5)
    slap = np.outer(time > 0.2995, 12.0 * np.eye(5)[0])  # half of the beam's momentum, N s
    found = whole_impact(recorded(18.0 * time, slap, x=x, impact=HEAVY))
    assert found.push == pytest.approx(2.0) and found.push_time == pytest.approx(0.299)
    steady = whole_impact(pushed_until(0.3))
    assert steady.push - steady.push_rise == pytest.approx(0.01 * 5.8)
    assert steady.push + steady.push_rise == pytest.approx((0.01 + 0.05) * 5.8)


@pytest.mark.parametrize(("apart", "separations"), [(1.5e-3, 1), (2.5e-3, 2)])
def test_the_wall_must_rest_for_two_thousandths_of_the_unit_of_time_to_have_been_left(apart, separations) -> None:
    time = np.linspace(0.0, 3.0, 6001)
    impulse = np.minimum(time, 0.5) + np.clip(time - 0.5 - apart, 0.0, 0.5)
    run = recorded(time, np.outer(impulse, np.eye(5)[0]), gap=np.maximum(time - 1.0, 0.0)[:, None], velocity=-1.0)
    assert whole_impact(run).separations == separations
