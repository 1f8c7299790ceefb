"""Impacts by Exudyn against the exact leading order, on small meshes; parts are swapped; axial force, curved walls."""

import itertools
import math
import re
from types import SimpleNamespace

import numpy as np
import pytest

import exudyn_models
from bent_beam import Impact
from bent_beam.measure.balance import balance_of
from bent_beam.measure.estimators import leading_order
from bent_beam.measure.moments import moments
from bent_beam.meshes import NodesMesh, ScaleFreeMesh, UniformMesh
from comparison.matching import answer
from comparison.rows import MatchQuestion
from comparison.store import RunStore
from exudyn_models import CONTACTS, ELEMENTS, INTEGRATORS, ExudynModel, stepping
from exudyn_models.contacts import Penalty, Rigid, SegmentFriction
from exudyn_models.contacts.base import HeldStrip
from exudyn_models.elements import ANCFCable, Beam
from exudyn_models.geometry import LinearLimit, Scaling, TrueGeometry
from exudyn_models.integrators import RK44, GeneralizedAlpha
from exudyn_models.method import held_for
from exudyn_models.segments import growing_segments
from theory import contact_parameters

HALF, SHORT = Impact.dimensionless(0.5), Impact.dimensionless(0.5, length=8.0)
IMPULSE = 4.0 * math.sqrt(0.2 / math.pi) * float(contact_parameters(0.5).r0)  # of these after 0.1 t*
PLAIN = UniformMesh(0.15)
verify = pytest.mark.verify


def coarse(impact=HALF, growth=1.02, elements=30):
    """A quarter of the default resolution and less."""
    scale = math.sqrt(0.1 * impact.time_scale * impact.wave_constant)
    return NodesMesh(tuple(ScaleFreeMesh(scale / elements, growth).nodes(exudyn_models.chosen_half_length(impact))))


def off(history):
    found, exact = leading_order(moments(history)), contact_parameters(history.impact.kappa_over_nu)
    return max(abs(getattr(found, name).value / float(getattr(exact, name)) - 1.0) for name in ("lambda0", "r0"))


@pytest.mark.parametrize(("first", "relative"), [(1e-3, 0.05), (0.013, 0.05), (1e-4, 0.01), (0.2, 0.1)])
def test_steps_grow_with_time_and_cover_the_run_none_shorter_but_for_a_round_number_at_its_end(first, relative):
    found = growing_segments(first, relative)
    assert found[0].start == 0.0 and found[-1].end == 1.0
    assert all(one.end == other.start for one, other in itertools.pairwise(found))
    for before, after in itertools.pairwise(found):
        room = 1.0 + 1.0 / after.steps
        assert before.length <= after.length * room and after.length <= relative * after.start * (1.0 + 1e-9)
    assert found[0].length <= first * (1.0 + 1e-9)
    even, growing = 1.0 / relative, math.log(max(relative / first, 1.0)) / relative  # steps that follow t alone
    assert sum(one.steps for one in found) < 1.3 * (even + growing)


def test_a_run_that_is_twice_as_fine_has_half_the_steps_and_elements_and_one_that_measures_a_load_shorter_steps():
    pressed = Impact.dimensionless(0.5, epsilon_alpha=1.0)
    runs = ((HALF, 1.0), (HALF, 2.0), (pressed, 1.0), (pressed, 2.0))
    chosen = [ExudynModel(refine=refine).chosen(impact, 0.1, for_loads=True) for impact, refine in runs]
    steps = [one.integrator.relative_step for one in chosen]
    assert steps[1::2] == [0.5 * steps[0], 0.5 * steps[2]] and steps[2] < 0.5 * steps[0]
    first, second = (one.mesh.places[1] for one in chosen[:2])
    assert second == pytest.approx(0.5 * first, rel=0.02)


@pytest.mark.parametrize(("explicit", "zone", "ahead"), [(False, 40.0, 10.0), (True, 2.5, 3.0)])
@pytest.mark.parametrize("kappa_over_nu", [0.1, 0.2, 0.5, 0.8, 0.93])
def test_elements_that_are_chosen_resolve_the_zone_and_the_bending_ahead_of_it(kappa_over_nu, explicit, zone, ahead):
    places = np.array(exudyn_models.chosen_mesh(Impact.dimensionless(kappa_over_nu), 0.4, explicit=explicit).places)
    front, lengths = float(contact_parameters(kappa_over_nu).lambda0) * math.sqrt(0.4), np.diff(places)
    assert front > zone * lengths[0] and places.size < 600
    assert math.sqrt(2.0 * kappa_over_nu * 0.4) > ahead * lengths[np.searchsorted(places, front)]


@verify
def test_hits_of_a_damped_thin_front_take_no_impulse():
    """7 % were missing with the damping of hits that an undamped front needs. The Hermite path's, converged: 0.917."""
    history = exudyn_models.simulate(Impact.whole_beam(0.02, relative_damping=1e-3), end_time=1e-3, save=20)
    assert history.array("total_impulse")[-1] == pytest.approx(0.9172, rel=6e-3)


@pytest.mark.parametrize(("eta", "refine", "expected"), [(0.0, 1.0, 40.0), (0.0, 0.5, 20.0), (1e-3, 1.0, 3.0)])
def test_hits_are_plastic_at_a_thin_front_that_nothing_damps_the_less_so_in_the_coarser_run(eta, refine, expected):
    beam = Impact.whole_beam(0.02, relative_damping=eta)
    parts = {"mesh": UniformMesh(0.05), "integrator": GeneralizedAlpha(time_step=1e-5), "save": 2, "refine": refine}
    contact = exudyn_models.simulate(beam, end_time=1e-4, **parts).settings["contact"]
    assert contact["relative_damping"] == pytest.approx(expected * math.sqrt(contact["relative_stiffness"] / 10.0))


def test_a_hold_behind_the_front_says_until_when_and_how_hard_it_pulled():
    impact = Impact.dimensionless(0.25)
    mesh = exudyn_models.chosen_mesh(impact).refined(1 / 3)
    history = exudyn_models.simulate(impact, mesh=mesh, contact=Penalty(hold=16))
    assert off(history) < 1e-3
    hold = history.settings["hold"]
    assert hold["until"] == pytest.approx(0.1) and 0.0 < hold["pull"] < 0.3
    gains = np.diff(history.array("impulse"), axis=0)  # of each point; the scheme averages forces, the hold does not
    assert hold["pull"] == pytest.approx(-gains.min() / gains.max(), rel=0.03)
    held = history.array("held_impulse")
    assert held[-1] < 0.0 and np.all(np.diff(held) <= 0.0)
    assert held[-1] == pytest.approx(2.0 * np.minimum(gains, 0.0).sum(), rel=0.03)  # of both halves


def test_a_run_of_minutes_is_announced_where_every_path_says_what_its_user_should_know(monkeypatch, caplog):
    monkeypatch.setattr(stepping, "SECONDS", 1.0)
    exudyn_models.simulate(SHORT, mesh=PLAIN, save=2)
    (said,) = caplog.record_tuples
    assert said[0] == "bent_beam" and "minutes" in said[2]


def test_newton_goes_no_further_than_the_round_off_of_the_bow_as_it_is_laid():
    """Elements of 1e-5 of the beam's length at κ/ν = 0.99: a first step without load on any node."""
    parts = {"integrator": GeneralizedAlpha(relative_step=2e-3), "contact": Penalty(hold_start=0.0)}
    asked = {"save": np.array([1e-7, 0.1]), "until": lambda *found: found[1] > 0.0}
    taken = exudyn_models.simulate(Impact.dimensionless(0.99), **parts, **asked)
    assert taken.time[-1] == pytest.approx(1e-7, rel=0.05)


def test_nothing_is_held_once_waves_may_be_back():
    """The beam has left the wall when they are; waves change the impulse from 0.01 T* on."""
    beam = Impact(bending_stiffness=0.5, mass_per_length=0.2, length=0.3, curvature=0.05, velocity=1.0)
    mesh, until = UniformMesh(beam.length / 60), 0.01 * beam.slow_time_scale
    history = exudyn_models.simulate(beam, end_time=20.0 * until, mesh=mesh, contact=Penalty(hold=16))
    assert history.settings["hold"]["until"] == pytest.approx(until)
    assert np.ptp(history.array("held_impulse")[history.time >= 1.05 * until]) == 0.0


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("element", "integrator", "contact"), list(itertools.product(ELEMENTS, INTEGRATORS, CONTACTS)))
def test_a_combination_of_parts_meets_the_theory_or_is_refused_with_its_reason(element, integrator, contact, capfd):
    """Nothing is printed, and nothing deprecated used. Two elements in the zone of an explicit run, else 15 in √t."""
    parts = {"element": ELEMENTS[element](), "integrator": INTEGRATORS[integrator](), "contact": CONTACTS[contact]()}
    reason = ExudynModel(**parts).refuses(SHORT)
    if reason is not None:
        assert re.match(rf"exudyn\.contact\.kind {contact} (needs|works on)", reason)
        for kind in (exudyn_models.simulate, exudyn_models.build):
            with pytest.raises(ValueError, match=re.escape(reason)):
                kind(SHORT, **parts)
        return
    explicit = parts["integrator"].explicit
    history = exudyn_models.simulate(SHORT, mesh=PLAIN if explicit else coarse(SHORT, 1.04, 15), save=40, **parts)
    assert not any(capfd.readouterr())
    assert off(history) < (0.12 if explicit else 5e-3)
    assert history.array("total_impulse")[-1] == pytest.approx(IMPULSE, rel=0.02)
    budget = history.energy_budget()
    # explicit: the contact state is frozen for a step; 24 % when Exudyn repeats steps with a state of its own
    assert abs(budget["defect"]) < (0.03 if explicit else 1e-5) * (budget["loss_impact"] + budget["loss_viscous"])
    if contact != "rigid":
        steps = {} if explicit else {"integrator": INTEGRATORS[integrator](time_step=2e-4)}
        model = exudyn_models.build(SHORT, mesh=PLAIN, **(parts | steps))
        model.mbs.SolveDynamic(model.settings)
        impulse = model.mbs.GetSensorStoredData(model.sensors["impulse"])[-1, 1]
        assert impulse == pytest.approx(IMPULSE, rel=0.02)


@pytest.mark.parametrize("friction", [0.0, 0.3, 1e3])  # smooth, sliding, sticking
def test_segment_contact_loses_what_its_forces_do(friction):
    """A step's forces are those of the states that it was solved with: gaps at its end would hide 2 % of the losses.
    Where it slides, waves along the beam bend a sloping cable, whose viscosity takes 5e-4 of the losses."""
    mesh = coarse(growth=1.04, elements=15)
    history = exudyn_models.simulate(HALF, mesh=mesh, save=10, contact=SegmentFriction(friction))
    budget = history.energy_budget()
    assert abs(budget["defect"]) < 1e-6 * sum(value for name, value in budget.items() if name.startswith("loss"))
    assert history.array("total_impulse")[-1] == pytest.approx(IMPULSE, rel=2e-3)  # friction changes nothing
    assert balance_of(history).warnings == []  # its chords open and close by forces of no consequence


@verify
def test_a_real_beam_under_tension_gives_the_impulse_of_the_linear_limit():
    """Viscosity works on the change of curvature, not of deflections: 0.5 % of the losses."""
    impact = Impact.dimensionless(0.5, epsilon_axial=20.0, epsilon_alpha=-10.0).replace(section_height=1e-2)
    kinds = LinearLimit(), TrueGeometry()
    linear, true = (exudyn_models.simulate(impact, end_time=1e-3, geometry=g, save=50) for g in kinds)
    assert true.array("total_impulse")[-1] == pytest.approx(linear.array("total_impulse")[-1], rel=5e-3)
    budget = true.energy_budget()
    assert abs(budget["defect"]) < 1e-5 * sum(value for name, value in budget.items() if name.startswith("loss"))


@verify
@pytest.mark.parametrize("kappa_over_nu", [1 / 40, 1 / 100, 1 / 400, 1 / 1600])
def test_a_thin_front_is_met_within_its_error_bars_and_nothing_is_held(kappa_over_nu):
    row = answer(MatchQuestion(ExudynModel(), kappa_over_nu), RunStore(None))
    for number in (row.lambda0, row.r0):
        assert abs(number.relative()) < min(0.003, number.relative_bar())
    assert row.hold is None and row.lift < 0.02


@verify
@pytest.mark.parametrize(("kappa_over_nu", "elements"), [(0.5, 140), (0.8, 300)])
def test_constraints_meet_the_theory_on_a_flat_wall(kappa_over_nu, elements):
    """Nodes are led back to the wall: what is left of their depths, here 2e-8, would press and pull without end."""
    impact = Impact.dimensionless(kappa_over_nu)
    rigid = exudyn_models.simulate(impact, mesh=coarse(impact, 1.012, elements), contact=Rigid(), save=100)
    assert off(rigid) < 5e-3 and rigid.warnings == []
    inside = rigid.array("x") < 0.9 * float(contact_parameters(kappa_over_nu).lambda0) * math.sqrt(0.1)
    assert np.abs(rigid.array("gap")[-1, inside]).max() < 1e-6 * 0.1


def test_so_many_nodes_behind_the_front_are_held_until_waves_may_be_back():
    wall = SimpleNamespace(nodes=np.arange(8), centre=0, explicit=False, lifts=False, waves_return=0.5)
    strip = HeldStrip(wall, hold=2, start=0.1)
    strip.captured[:5] = True
    held = [np.flatnonzero(strip.wanted(time)).tolist() for time in (0.05, 0.3, 0.5)]
    assert held == [[0, 1, 2, 3, 4], [3, 4], []]


@pytest.mark.parametrize("wall", [{}, {"wall_stiffness": 1e4}])
def test_what_is_chosen_for_an_impact_runs_it(wall):
    impact, method = SHORT.replace(**wall), ExudynModel(refine=0.3)
    run, chosen = (one.simulate(impact, end_time=0.1, save=5) for one in (method, method.chosen_for(impact, 0.1)))
    assert np.array_equal(run.array("total_impulse"), chosen.array("total_impulse"))


def test_the_bow_s_own_slope_far_from_the_contact_does_not_scale_deflections_down_and_what_a_load_bends_does():
    """The bow is part of the linear beam's natural shape; only its slope over what moves counts."""
    loads = {"bare": {}, "bent": {"curvature_rate": 0.5}}
    scales = {name: Scaling(HALF.replace(**load), 0.1) for name, load in loads.items()}
    near, far = ({name: LinearLimit().amplitude_of(s, reach) for name, s in scales.items()} for reach in (40.0, 400.0))
    assert far["bare"] == near["bare"] and far["bent"] < 0.2 * near["bent"]


def test_forces_and_loads_are_those_that_act_where_a_scheme_averages_both_and_a_wrong_one_shows(monkeypatch):
    """Of the load one per cent more than acts in Exudyn's system."""
    pressed, loads = Impact.dimensionless(0.5, epsilon_alpha=2.0), Beam.loads
    asked = {"mesh": coarse(pressed, 1.04, 15), "save": 20, "integrator": GeneralizedAlpha(spectral_radius=0.2)}
    sound = balance_of(exudyn_models.simulate(pressed, **asked))
    monkeypatch.setattr(Beam, "loads", lambda self, of: 1.01 * loads(self, of))
    amiss = balance_of(exudyn_models.simulate(pressed, **asked))
    assert abs(sound.points) < 1e-9 and abs(sound.law) < 1e-7 and not sound.warnings
    assert abs(amiss.law) > 1e-3 and any("do not agree" in warning for warning in amiss.warnings)


@pytest.mark.parametrize(
    ("damping", "force", "end", "within", "fastest"),
    [
        (1e-3, 1.0, 0.002, 1e-4, {"element": ANCFCable(axial_stiffness=1e6)}),
        (0.0, 1.0, 0.1, 1e-2, {"element": ANCFCable(axial_stiffness=1e5)}),
        (0.0, 0.0, 0.1, 1e-2, {"contact": Penalty(relative_stiffness=3e3, relative_damping=0.0)}),
    ],
)
def test_explicit_steps_stay_stable_where_axial_waves_or_contact_are_fastest(damping, force, end, within, fastest):
    """At the very bound, of elements whose free ends swing at √170 of their axial wave's rate, shorter than Λ."""
    beam = Impact.whole_beam(0.5, relative_damping=damping).replace(axial_force=force)
    parts = {"mesh": UniformMesh(beam.length / 16), "integrator": RK44(safety=1.0), "save": 20, **fastest}
    history = exudyn_models.simulate(beam, end_time=end * beam.slow_time_scale, **parts)
    assert abs(history.energy_budget()["defect"]) < within


def test_a_beam_that_is_nearly_buckled_or_whose_wall_is_stiff_gets_more_elements():
    beam = Impact.whole_beam(2.0)
    beams = [beam.replace(axial_force=force) for force in (0.0, 1.8, -1.8)] + [beam.replace(wall_stiffness=1e8)]
    free, taut, pressed, stiff = (ExudynModel().for_whole_beam(beam).mesh.nodes(1.0).size for beam in beams)
    assert free == taut and pressed - 1 == 1.5 * (free - 1) and stiff == 401  # four in (EI/k)^¼


def test_what_no_theory_of_a_zone_needs_is_left_alone():
    """One point is not held; ends that a load bends up do not touch, the beam does out to 1.5 times its reach."""
    point, zone = (Impact.dimensionless(kappa, epsilon_psi=0.3) for kappa in (1.1, 0.3))
    assert held_for(None, point).hold == 0 < held_for(None, zone).hold
    mesh = exudyn_models.chosen_mesh(zone, 0.1).refined(1 / 4)
    history = exudyn_models.simulate(zone, mesh=mesh, end_time=0.1, save=5)
    assert history.array("gap")[-1].min() < -1.0  # of what would be inside the wall without one, and far away
    assert history.contact_positions(-1).max() == pytest.approx(1.5 * math.sqrt(2.0 * 0.1 / 0.3), rel=0.1)
