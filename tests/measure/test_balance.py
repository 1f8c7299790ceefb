"""Momentum, initial energy and gaps of pushes, from the state of a run: a falsified run shows."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from histories import history_of, pushed_until
from twins import in_units

from bent_beam import Impact, ImpactHistory
from bent_beam.measure.balance import Balance, balance_of
from bent_beam.measure.limits import limited_as
from bent_beam.measure.reduction import peak_moment
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from exudyn_models.integrators import GeneralizedAlpha
from hermite_fe import HermiteFE
from self_similar_fe import ExpandingMesh, SelfSimilarFE

WHOLE = Impact.whole_beam(0.5, relative_damping=1e-2)
TAUT = {"axial_force": 3.0}  # along x it takes nothing of the momentum, along the bow's ends −NKL t
LOADS = [{}, {"acceleration": 5.0}, TAUT | {"fourth_derivative": 2.0}, TAUT | {"tension_direction": "tangent"}]


def simulated(impact: Impact, end: float, save: int = 200) -> ImpactHistory:
    return HermiteFE(mesh=UniformMesh(1.0 / 50)).for_whole_beam(impact).simulate(impact, end_time=end, save=save)


@pytest.mark.parametrize("loads", LOADS)
def test_a_run_keeps_its_momentum_under_any_load(loads) -> None:
    impact = WHOLE.replace(**loads)
    sound = balance_of(simulated(impact, 0.3, 600))
    assert sound.momentum < 5e-4 and sound.gap_of_push < 1e-3 and sound.warnings == []
    assert (sound.second_moment is None) == (impact.axial_force != 0.0)
    assert impact.axial_force or sound.second_moment < 5e-4
    assert sound.middle_slope < 1e-9


def test_a_falsified_impulse_energy_gap_or_slope_shows_in_proportion() -> None:
    history = simulated(WHOLE.replace(acceleration=5.0), 0.3, 600)
    sound, data = balance_of(history), history.dataset

    def falsified(**fields: Any) -> Balance:
        return balance_of(ImpactHistory.of(data.assign(**fields)))

    more = falsified(total_impulse=1.1 * data["total_impulse"])
    assert more.momentum == pytest.approx(1.0 / 11.0, abs=1e-3) and more.points == pytest.approx(-1.0 / 11.0)
    assert "the residual is 9.1 % of the impulse" in more.warnings[0]
    late = falsified(total_impulse=data["total_impulse"].where(data["time"] > 0.05, 0.0))
    assert late.momentum == sound.momentum  # before, it does not count
    second = falsified(opposite_impulse=0.1 * data["impulse"], total_impulse=0.9 * data["total_impulse"])
    assert second.points == pytest.approx(0.0, abs=1e-9)
    less = falsified(kinetic_energy=0.97 * data["kinetic_energy"])
    assert less.initial_energy == pytest.approx(-0.03, abs=1e-9) and "mass is missing" in less.warnings[0]
    assert falsified(gap=data["gap"] + 0.01).gap_of_push > 0.03
    assert balance_of(ImpactHistory.of(data.isel(time=slice(2, None)))).initial_energy is None
    in_wall = falsified(gap=data["gap"] - 0.01)
    assert in_wall.penetration > 0.03 and any("in the wall" in line for line in in_wall.warnings)
    turned = falsified(slope=data["slope"] + 0.1 * float(np.abs(data["slope"]).max()))
    assert turned.middle_slope == pytest.approx(0.1, rel=0.15) and turned.warnings
    worked = falsified(work_of_loads=1.1 * data["work_of_loads"])
    assert worked.energy > 1e-2 and any("not accounted for" in line for line in worked.warnings)


def test_part_of_a_long_beam_an_expanding_mesh_and_a_beam_under_tension_keep_their_momentum_too() -> None:
    endless = in_units(Impact.dimensionless(0.5, epsilon_alpha=2.0), {"kg": 3.0, "m": 1.0, "s": 1.0})
    tense = WHOLE.replace(**TAUT)
    expanding = SelfSimilarFE(mesh=ExpandingMesh(front_resolution=0.05, growth=0.05, step_ratio=0.05, decades=2.0))
    runs = [one.simulate(endless, end_time=0.1) for one in (HermiteFE(domain=6.0), ExudynModel(refine=0.3), expanding)]
    assert max(balance_of(run).momentum for run in runs) < 5e-4
    rising = Impact.dimensionless(0.5, epsilon_psi=-3.0)  # its ends bear the shear force of its bow
    assert balance_of(HermiteFE(domain=6.0).simulate(rising, end_time=0.1)).momentum < 5e-4
    method = ExudynModel(mesh=UniformMesh(1.0 / 20))
    few, many = (method.simulate(tense, end_time=0.3, save=save) for save in (10, 300))
    assert balance_of(many).momentum < 5e-4
    assert peak_moment(few).moment == pytest.approx(peak_moment(many).moment, rel=1e-12)  # that of all steps
    data = runs[2].dataset  # near the zone its gap means something
    inside = balance_of(ImpactHistory.of(data.assign(gap=data["gap"] - 0.02 * data["time"])))
    assert inside.penetration == pytest.approx(0.02, rel=0.1)
    bent = tense.replace(fourth_derivative=2.0)  # its ends pull at a tangent that turns
    assert balance_of(method.simulate(bent, end_time=0.005, save=20)).momentum is None


def test_a_free_end_that_loses_its_rate_of_curvature_within_an_element_is_not_asked_for_momentum() -> None:
    long = Impact.dimensionless(0.5, epsilon_chi=-0.5)
    free = HermiteFE().simulate(long, end_time=0.1, save=100)
    assert balance_of(free).momentum is None and balance_of(free).warnings == []
    assert balance_of(HermiteFE(domain=6.0).simulate(long, end_time=0.1)).momentum < 5e-4  # ends that follow lose none
    assert 0.0 < balance_of(simulated(WHOLE.replace(curvature_rate=-0.5), 0.1)).momentum < 5e-4
    for end, asked in ((0.16, False), (0.36, True)):  # √(ct) is 0.4 and 0.6, the last element 0.5 long
        run = history_of(time := np.linspace(0.0, end, 11), [0.0, 0.5, 1.0], impact=WHOLE.replace(curvature_rate=-0.5),
                         velocity=np.ones((11, 3)), total_impulse=0.1 * time)  # fmt: skip
        assert (balance_of(run).momentum is not None) == asked


def test_momentum_that_a_layer_absorbs_however_late_is_not_missed() -> None:
    late = np.where(np.arange(41) < 40, 0.0, 1e-3)
    assert balance_of(pushed_until(0.5)).momentum == pytest.approx(0.0, abs=1e-12)
    assert balance_of(pushed_until(0.5, loss_absorbed=late)).momentum is None


@pytest.mark.parametrize("moves", [{"curvature_rate": 0.1}, {"rotation": 0.1}, {"left_end": "hinged"}])
def test_the_initial_energy_is_that_of_one_velocity_where_the_beam_has_one(moves) -> None:
    one = np.ones(3)
    for impact in (WHOLE, WHOLE.replace(**moves)):
        energy = balance_of(history_of(np.arange(3.0), np.arange(3.0) / 2.0, impact=impact, kinetic_energy=1.1 * one))
        assert energy.initial_energy == (pytest.approx(0.1) if impact is WHOLE else None)


def test_a_whole_beam_that_rocks_bears_its_load_over_its_length_and_keeps_its_spin() -> None:
    history = simulated(WHOLE.replace(acceleration=5.0, rotation=0.5, first_touch=0.2), 0.2)
    balance, x = balance_of(history), history.positions(0)
    assert max(balance.momentum, balance.second_moment, balance.energy) < 1e-3 and abs(balance.points) < 1e-9
    spin = np.trapezoid(history.array("velocity") * x, x, axis=1)
    assert spin + history.array("impulse") @ history.contact_positions(0) == pytest.approx(spin[0], abs=2e-3)
    assert history.array("kinetic_energy")[0] == pytest.approx(1.0 + 0.5**2 / 3.0, rel=1e-3)
    assert peak_moment(history).place < -0.1  # on its side


def test_a_pull_counts_where_nothing_is_said_to_be_held() -> None:
    """The start is held until 0.001 t*; what the wall takes back of its impulse after it is a pull."""
    history = ExudynModel(refine=0.3).simulate(Impact.dimensionless(0.5), end_time=0.1, save=60)
    assert history.settings["hold"]["pull"] > 0.01 and balance_of(history).pull == 0.0
    impulse = history.dataset["impulse"].copy()
    impulse[-1, 0] -= 0.1 * float(impulse.diff("time").max())
    taken = balance_of(ImpactHistory.of(history.dataset.assign(impulse=impulse)))
    assert taken.pull > 0.05 and any("the wall pulls" in line for line in taken.warnings)


def left(depth: float, *, pull: float = 0.1, behind_until: float = 0.0, again: float = 0.0) -> ImpactHistory:
    """Touches until 2 s, then round-off until 9 s. From 1 s on the node in the middle, which pushes, is in the wall by
    ``depth`` V₀t; from 1.8 to 1.9 s it takes back ``pull`` of its largest push. ``again`` : impulse at 8.5 s."""
    time, x, middle = np.linspace(0.0, 9.0, 91), np.linspace(0.0, 1.0, 3), np.array([1.0, 0.0, 0.0])
    gains = 0.1 * (time > 0.0) * (time < 2.05) * np.where(np.isclose(time, 1.9), -pull, 1.0)
    gains += again * np.isclose(time, 8.5) + 1e-12 * (time > 8.6)
    pressed = np.where((time > 0.95) & (time < 2.05), -depth * time, np.maximum(time - 2.0, 0.0) * (time < 8.45))
    behind = {"opposite_impulse": np.outer(np.minimum(time, behind_until), middle[::-1])} if behind_until else {}
    gap = pressed[:, None] + 9.0 * (1.0 - middle)
    return history_of(time, x, impact=WHOLE, gap=gap, impulse=np.outer(np.cumsum(gains), middle), **behind)


@pytest.mark.parametrize(("behind_until", "again"), [(0.0, 0.0), (4.4, 0.0), (0.0, 0.01)])
def test_a_beam_that_has_left_is_looked_at_late_in_its_contact_whether_it_touches_again_or_not(behind_until, again):
    """Of each wall by itself: half of the time to the last push of both, 4.4 s, is after the front wall's last push."""
    found = balance_of(left(0.02, behind_until=behind_until, again=again))
    assert (found.gap_of_push, found.penetration, found.pull) == pytest.approx((0.02, 0.02, 0.1))


@pytest.mark.parametrize(
    ("pushes", "first"),
    [
        ([1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 0),  # the one push is looked at
        ([0.6, 0.4, 0.0, 0.0, 0.0, 1e-3], 1),  # 80 % are reached in the second interval
        ([0.85, 0.15, 0.0, 0.0, 0.0, 1e-3], 0),
        ([0.2, 0.2, 0.2, 0.2, 0.2, 0.0], 3),  # half of five
        ([0.2, 0.2, 0.2, 0.2, 0.2, 0.2], 3),
        ([0.1, 0.4, 0.2, 0.1, 0.1, 0.1], 3),
        ([0.5, 0.3, -0.3, 0.3, 0.0, 1e-3], 3),  # what is taken back was given
        ([0.9, 0.1, 1e-9, 1e-9, 1e-9, 1e-9], 0),  # round-off is no push
    ],
)
def test_the_late_contact_begins_with_half_of_the_time_to_the_last_push_or_four_fifths_of_the_impulse(pushes, first):
    """The node is off the wall at the end of one interval after another: it counts from ``first`` on, if it pushes."""
    time = np.arange(7.0)
    impulse = np.outer(np.cumsum([0.0, *pushes]), [1.0, 0.0])
    for k in range(6):
        gap = np.outer(time == k + 1, [0.5 * (k + 1), 0.0])
        found = balance_of(history_of(time, [0.0, 1.0], impact=WHOLE, gap=gap, impulse=impulse))
        assert (found.gap_of_push > 0.0) == (k >= first and pushes[k] > 1e-6 * max(pushes)), k


@pytest.mark.parametrize(
    ("depth", "pull", "bends", "shears"),
    [(9e-4, 9e-4, [], []), (0.049, 9e-4, ["in the wall"], []), (0.051, 2e-3, *2 * [["in the wall", "the wall pulls"]])],
)
def test_a_beam_that_shears_may_be_deeper_in_the_wall(depth, pull, bends, shears) -> None:
    found = balance_of(left(depth, pull=pull))
    for impact, said in ((WHOLE, bends), (WHOLE.replace(shear_stiffness=400.0), shears)):
        limits = limited_as(SimpleNamespace(path="hermite", settings={}, impact=impact))
        warnings = replace(found, path=limits, initial_energy=None).warnings
        assert len(warnings) == len(said) and all(part in line for part, line in zip(said, warnings))


def test_missing_energy_is_a_share_of_what_there_was_and_of_the_work_of_loads() -> None:
    """Of 2 J and 3 J of work half a joule is missing at the end: a tenth."""
    time, x = np.linspace(0.0, 1.0, 3), np.linspace(0.0, 1.0, 3)
    run = history_of(time, x, impact=WHOLE, kinetic_energy=2.0 + 2.5 * time, work_of_loads=3.0 * time)
    assert balance_of(run).energy == pytest.approx(0.1)


def test_a_beam_in_the_opposite_wall_is_in_a_wall() -> None:
    """Flat, 0.3 m behind the apex, at 0.25 m, of a beam before a curved wall."""
    x, time = np.linspace(-1.0, 1.0, 9), np.linspace(0.0, 1.0, 11)
    impact = WHOLE.replace(curvature=0.35, opposite_wall=0.3, wall_curvature=0.2, first_touch=0.25)
    front = -0.1 * (x - 0.25) ** 2
    for behind, depth in ((0.0, 0.0), (0.05, 0.05)):
        gap = np.outer(time, front + 0.3 + behind * (x == 0.5))
        gap[4] = -1.0  # nothing pushes: the first half of the run is its start
        run = history_of(time, x, impact=impact, symmetry="full", gap=gap)
        assert balance_of(run).penetration == pytest.approx(depth, abs=1e-12)


def test_pushes_that_act_elsewhere_than_the_motion_says_are_seen_by_their_second_moment() -> None:
    """Slowed down evenly, a beam of EI = μ = L/2 = 1 whose ends turn by θ has 2∫θ dt = (1/3 − a²)J, pushes ±a out."""
    time, x = np.linspace(0.0, 1.0, 11), np.linspace(-1.0, 1.0, 21)
    given, turned = 0.024 * time**2, np.outer(0.001 * time, x)  # a = 0.5
    for place, off in ((0.5, 0.0), (0.6, 0.11 / 0.36)):
        run = history_of(
            time, x, impact=WHOLE.replace(damping=0.0), symmetry="full",
            velocity=np.outer(1.0 - 0.5 * given, np.ones(x.size)),
            slope=turned - WHOLE.curvature * x, total_impulse=given,
            impulse=np.outer(given, 0.5 * np.isclose(np.abs(x), place)),
        )  # fmt: skip
        assert balance_of(run).second_moment == pytest.approx(off, abs=1e-9)
    between = WHOLE.replace(damping=0.0, opposite_wall=1.0)
    shares = {"impulse": 1.5, "opposite_impulse": 0.5}  # what the wall behind gives back counts against the front's
    walls = {name: run.array("impulse") * share for name, share in shares.items()}
    moved = {name: run.array(name) for name in ("velocity", "slope", "total_impulse")}
    both = history_of(time, x, impact=between, symmetry="full", **walls, **moved)
    assert balance_of(both).second_moment == pytest.approx(off, abs=1e-9)


MIDDLE = Impact.whole_beam(1.25, relative_damping=1e-3)  # whose impulses have no second moment to be off
# few nodes touch it
SOFT = Impact.whole_beam(3.93, relative_damping=8.6e-4).replace(wall_stiffness=24.7, wall_damping=0.5)
SWINGING = ExudynModel(integrator=GeneralizedAlpha(spectral_radius=0.95), refine=0.5)  # its means of the force
FAR = Impact.dimensionless(0.5, length=1000.0)
SHEARED = [
    Impact.whole_beam(ratio, relative_damping=1e-3).replace(shear_stiffness=s**-2, rotary_inertia=0.4 * s**2)
    for ratio, s in ((0.75, 0.06), (1.17, 0.015))
]


@pytest.mark.parametrize(
    ("method", "impact", "end"),
    [
        *((kind(refine=0.5).for_whole_beam(one), one, 0.15) for kind in (HermiteFE, ExudynModel) for one in SHEARED),
        (HermiteFE(mesh=UniformMesh(1.0 / 50)).for_whole_beam(MIDDLE), MIDDLE, 0.3),
        (HermiteFE(mesh=UniformMesh(1.0 / 22)).for_whole_beam(SOFT), SOFT, 0.0577),
        (SWINGING, Impact.dimensionless(0.25), 0.1),
        (ExudynModel(refine=0.3), FAR.replace(fourth_derivative=-3.0), 0.1),  # off the wall everywhere
        (ExudynModel(refine=0.3), FAR.replace(fourth_derivative=1.0), 0.1),  # into it far away, where it is linear
    ],
)
def test_a_sound_run_has_nothing_to_warn_of(method, impact, end) -> None:
    balance = balance_of(method.simulate(impact, end_time=end, save=100))
    assert balance.warnings == []
    if impact.shear_stiffness:
        assert balance.momentum < 1e-9 and balance.second_moment < 5e-3


ROUGH = "exudyn, explicit or ρ∞ > ½"
KINDS = [("Newmark", 0.5, 0.0, "exudyn"), ("Newmark", 0.5, 1.0, "exudyn, axial force"), ("RK44", 0.5, 1.0, ROUGH)]


@pytest.mark.parametrize(("kind", "radius", "force", "limits"), [*KINDS, ("GeneralizedAlpha", 0.8, 1.0, ROUGH)])
def test_a_run_by_exudyn_has_the_limits_of_its_integrator_and_load(kind, radius, force, limits) -> None:
    settings, impact = {"integrator": {"kind": kind, "spectral_radius": radius}}, WHOLE.replace(axial_force=force)
    of_segments, sheared = {"contact": {"kind": "SegmentFriction"}}, impact.replace(shear_stiffness=400.0)
    for more, beam, what in (({}, impact, ""), ({}, sheared, ", shear"), (of_segments, impact, ", segments")):
        assert limited_as(SimpleNamespace(path="exudyn", settings=settings | more, impact=beam)) == limits + what
