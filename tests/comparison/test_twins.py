"""A run in other units is the same in every number of its record and of an instant; again, bit for bit.

Units that are even powers of two change no digit; in others twins agree to what their rounding leaves. What is read
from a record of the whole impact: ``measure/test_units.py``.
"""

import random

import pytest
from here import FUZZ, SEED
from twins import BEAM, EXACT, OF_HIT, OF_INSTANT, QUICK, RUNS, SHEARED, SOFT, agree, differences, in_units, once, run

from bent_beam import Impact, ImpactHistory
from bent_beam.measure.balance import balance_of
from bent_beam.measure.instant import instant
from bent_beam.measure.moments import moments
from bent_beam.meshes import UniformMesh
from bent_beam.method import separation_times
from comparison.bouncing import follow_hits
from comparison.compare import rerun_history
from exudyn_models import ExudynModel
from exudyn_models.contacts import Penalty
from hermite_fe import HermiteFE
from hermite_fe.integrators import Midpoint

BASES = [EXACT]
ROUNDED = [{"kg": 1e-9, "m": 1e-6, "s": 1e3}, {"kg": 3.7e11, "m": 1.7e-5, "s": 2.2e-8}]
if FUZZ:
    RANDOM = random.Random(SEED)
    BASES += [{unit: 4.0 ** RANDOM.randint(-15, 15) for unit in EXACT} for _ in range(6)]
    ROUNDED += [{unit: 10.0 ** RANDOM.uniform(-9.0, 9.0) for unit in EXACT} for _ in range(6)]


@pytest.mark.parametrize("base", BASES)
@pytest.mark.parametrize("kind", RUNS)
def test_every_number_of_a_run_changes_with_its_unit(kind, base):
    runs = once(kind), run(kind, base)
    found = differences(*runs, base)
    assert {"gap", "impulse", "total_impulse", "kinetic_energy", "strain_energy"} <= found.keys()
    assert max(found.values()) < 1e-9, found
    checks = [balance_of(one) for one in runs]
    agree(*checks)
    assert (checks[0].momentum or 0.0) < 0.02 and checks[0].energy < 3e-3  # coarse as they are
    agree(*(moments(one) for one in runs))
    agree(*(instant(one, 0.5 * one.time[-1]) for one in runs), OF_INSTANT, base)


# Bending takes second differences of deflections, which multiplies round-off by the square of the number of elements.
# Thousands of explicit steps, shear and large rotations add a digit. The gap to a circle is a difference of lengths of
# the order of its radius, thousands of times what the beam deflects.
NEAR = {"expanding, bare": 1e-7, "Exudyn, explicit": 1e-8}  # the former in 150 random units 2e-8 at most
NEAR |= {"Exudyn, sheared": 1e-4, "Exudyn, between two walls": 1e-7, "Exudyn, a circle for a wall": 1e-5}
# differences of nearly nothing, a place of two that are equal, the largest at samples whose places turn on the rounding
# of a zero: in units that are even powers of two all are held to 1e-9
NOISE = ("loss_algorithmic", "loss_impact", "held_impulse", "complementarity_product", "largest_moment_place",
         "peak_penetration", "peak_pressure")  # fmt: skip


@pytest.mark.parametrize("base", ROUNDED)
@pytest.mark.parametrize("kind", [kind for kind in QUICK if getattr(kind, "values", kind) != ("expanding",)])
def test_nothing_turns_on_the_rounding_of_units_that_are_no_powers_of_two(kind, base):
    found = differences(once(kind), run(kind, base), base)
    found = {name: value for name, value in found.items() if name not in NOISE}
    for name in ("impulse", "opposite_impulse"):
        found[name] = 0.01 * found.get(name, 0.0)  # how it spreads over the nodes is far more sensitive than its sum
    print(f"twins, {kind}: {max(found.values()):.1e}")
    assert max(found.values()) < NEAR.get(kind, 1e-9), found


def test_hits_are_followed_until_so_many_are_over_or_the_beam_comes_to_rest_and_change_with_their_units(monkeypatch):
    """A bar that its wall throws off with 0.44 V is back after 0.88 V/g, until its flights are too short to be any."""
    bar = Impact(1.0, 1.0, 2.0, 0.0, 1.0, damping=1e-2, acceleration=0.25, wall_stiffness=64.0, wall_damping=4.8)
    sizes = [(0.5 * one["m"], 5e-3 * one["s"]) for one in ({"m": 1.0, "s": 1.0}, EXACT)]
    few, tiny = (HermiteFE(mesh=UniformMesh(element), integrator=Midpoint(step, 0.0)) for element, step in sizes)
    both = [(bar, few), (in_units(bar, EXACT), tiny)]
    firsts, ends, simulate = [method.simulate_to_separation(one) for one, method in both], [], HermiteFE.simulate
    monkeypatch.setattr(HermiteFE, "simulate", lambda *a, **how: ends.append(how["end_time"]) or simulate(*a, **how))
    found = [follow_hits(*one, 2, first=first) for one, first in zip(both, firsts)]
    for one, other in zip(*found, strict=True):
        agree(one, other, OF_HIT)
    assert max(ends) < 10.0 * EXACT["s"], "it is followed no longer than it must be"
    one, other = follow_hits(*both[0], 9, first=firsts[0])
    assert ends[-1] < 50.0 and other.begin == pytest.approx(one.end + 0.88 / 0.25, rel=0.02)


OF_PARTS = dict.fromkeys(("element_length", "zone", "domain", "places"), "m")
OF_PARTS |= dict.fromkeys(("time_step", "flight_step", "hold_until"), "s")
TO_CHOOSE = {
    "a front": BEAM.replace(curvature=0.7, damping=0.0, length=240.0),
    "an early lift": BEAM.replace(curvature=0.7, damping=0.05, first_touch=0.2),
    "a thin front": BEAM.replace(curvature=0.006),
    "one point": BEAM.replace(curvature=3.0, fourth_derivative=0.5, length=240.0),
    "sheared": SHEARED.replace(curvature=0.7),
    "a soft wall": BEAM.replace(**SOFT),
    "a very soft wall": BEAM.replace(wall_stiffness=1e-3),
    **{kind: beam for kind, (beam, _) in RUNS.items()},
}


@pytest.mark.parametrize("method", [HermiteFE(), ExudynModel()], ids=lambda method: method.path)
@pytest.mark.parametrize("kind", TO_CHOOSE)
def test_elements_and_steps_that_are_chosen_change_with_their_units(kind, method):
    given = TO_CHOOSE[kind]
    impacts = given, in_units(given, EXACT)
    agree(*map(method.for_whole_beam, impacts), OF_PARTS)
    for both in zip(*(method.cross_checks(impact).values() for impact in impacts), strict=True):
        agree(*both, OF_PARTS)
    if not (given.supported or given.wall_in_part or given.opposite_wall):  # which no separation ends
        times = [separation_times(impact, save=20) for impact in impacts]
        assert times[1] == pytest.approx(times[0] * EXACT["s"], rel=1e-12)
    for end in (share * given.slow_time_scale for share in (1e-3, 0.3, 3.0)):
        pairs = tuple(zip(impacts, (end, end * EXACT["s"])))
        agree(*(method.chosen_for(*pair) for pair in pairs), OF_PARTS)
        if isinstance(method, HermiteFE):
            agree(*(method.for_whole_beam(*pair) for pair in pairs), OF_PARTS)


@pytest.mark.parametrize("kind", QUICK)
def test_a_stored_history_is_enough_to_run_it_again_and_then_is_the_same_bit_for_bit(kind, tmp_path):
    titled = once(kind).described("a tube", None).save(tmp_path / "run.nc")
    found = rerun_history(ImpactHistory.load(titled), tmp_path / "again.nc")
    assert ImpactHistory.load(tmp_path / "again.nc").attrs["title"] == "a tube"
    assert found["identical"], found


@pytest.mark.parametrize(("wall", "contact"), [(None, Penalty(stiffness=1e5)), (1e3, None)])
def test_an_exudyn_run_to_separation_is_run_again_as_far_as_it_went(wall, contact):
    method = ExudynModel(mesh=UniformMesh(1 / 16), contact=contact)
    falling = Impact.whole_beam(2.0, relative_damping=1e-2).replace(wall_stiffness=wall)
    history = method.simulate_to_separation(falling, save=100)
    assert history.settings["save"][-1] == pytest.approx(history.time[-1], rel=1e-2)
    assert rerun_history(history)["identical"]
