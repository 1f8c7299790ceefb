"""Beams of which nothing is one: both paths say the same, and a half of a beam is half of it, by every part."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from twins import in_units

from bent_beam import Impact
from bent_beam.files import UNITS
from bent_beam.meshes import NodesMesh, UniformMesh
from exudyn_models import ExudynModel, build, chosen_mesh, simulate
from exudyn_models.contacts import Penalty, Rigid, SegmentFriction
from exudyn_models.elements import ANCFCable, GeometricallyExact
from exudyn_models.geometry import LinearLimit
from exudyn_models.integrators import RK44, Newmark
from hermite_fe import HermiteFE

NO_WALL = Penalty(relative_stiffness=1e-20, relative_damping=0.0, hold_start=0.0)
OTHER = {"kg": 3.0, "m": 0.5, "s": 4.0}
BEAM = Impact(2.0, 3.0, 2.4, 1.8, 1.25, damping=4e-3, acceleration=0.8)
BOW = BEAM.replace(curvature_rate=0.6, fourth_derivative=0.5)
SOFT = BEAM.replace(wall_stiffness=6e3, wall_damping=40.0)
SHEARED = BEAM.replace(shear_stiffness=150.0, rotary_inertia=5e-3)
STOP = {"wall_from": 0.5, "wall_to": 0.5, "wall_stiffness": 900.0}
TAKEN = ("loss_impact", "loss_material", "loss_viscous", "loss_algorithmic", "contact_energy")
EXACT = {"element": GeometricallyExact()}


def followed(impact, end, method):
    """To a share of T*, as a whole impact where waves return."""
    end *= impact.slow_time_scale
    whole = method.for_whole_beam(impact) if end > 0.01 * impact.slow_time_scale else method
    return whole.simulate(impact, end_time=end, save=np.linspace(0.0, end, 13))


@pytest.mark.parametrize(
    ("impact", "end", "element", "parts"),
    [
        (BOW, 0.15, 0.04, {}),
        (BOW, 0.15, 0.03, EXACT),
        (BEAM.replace(natural_curvature=0.4, wall_curvature=-0.3), 0.15, 0.04, {}),
        (BEAM.replace(axial_force=2.5, tension_direction="tangent"), 0.15, 0.04, {}),
        (BEAM.replace(axial_force=20.0), 0.009, 0.012, {}),
        (BEAM.replace(axial_force=-2.5), 0.15, 0.04, {}),
        (BEAM.replace(rotation=0.3, first_touch=0.2), 0.15, 0.04, {}),
        (BEAM.replace(rotation=-0.3, first_touch=-0.2), 0.15, 0.04, {}),
        (SHEARED.replace(axial_force=1.5), 0.15, 0.02, {}),
        (SOFT.replace(wall_from=-0.4, wall_to=0.3), 0.1, 0.03, {}),
        (SOFT.replace(curvature=0.3, left_end="hinged", right_end="clamped"), 0.1, 0.03, {}),
        (SOFT.replace(shear_stiffness=150.0, rotary_inertia=5e-3), 0.1, 0.02, {}),
        (SOFT.replace(axial_force=-2.5, tension_direction="tangent", curvature=1.0), 0.1, 0.03, {}),
        (SHEARED.replace(curvature=0.0, left_end="hinged", **STOP), 0.1, 0.02, {}),
    ],
)
def test_both_paths_say_the_same_of_a_beam_of_which_nothing_is_one(impact, end, element, parts):
    """What beam, loads and contact have and lose of energy, too, but for which of them took what a hit takes."""
    mesh = UniformMesh(element)
    exudyn, hermite = (followed(impact, end, kind) for kind in (ExudynModel(mesh=mesh, **parts), HermiteFE(mesh=mesh)))
    within = {"gap": 2e-3, "slope": 3e-3, "angle": 3e-3, "velocity": 2e-2, "total_impulse": 1e-3, "work_of_loads": 1e-3,
              "largest_moment": 0.02, "strain_energy": 0.01, "bending_moment": 0.01, "angular_velocity": 0.02,
              "kinetic_energy": 5e-3, "peak_force": 4e-3, "peak_pressure": 2e-3, "peak_penetration": 2e-3,
              "loss_wall": 1e-2}  # fmt: skip
    for name in within.keys() & exudyn.dataset.keys():
        ours, theirs = exudyn.array(name)[-1], hermite.array(name)[-1]
        assert np.abs(ours - theirs).max() <= within[name] * np.abs(theirs).max(), name
    runs, initial = (exudyn, hermite), hermite.energy_budget()["initial_energy"]
    ours, theirs = (sum(run.array(name)[-1] for name in TAKEN if name in run.dataset) for run in runs)
    assert ours == pytest.approx(theirs, abs=4e-3 * initial)
    assert exudyn.settings["ends"] == "free"
    assert max(abs(run.energy_budget()["defect"]) for run in runs) < 1e-6 * initial


@pytest.mark.parametrize(
    ("impact", "end", "parts"),
    [
        (BOW.replace(damping=0.0), 0.008, {}),
        (BOW, 0.008, {"contact": Penalty(hold=4, hold_start=0.01)}),
        (BOW, 0.1, {"contact": Rigid(hold=3), "integrator": Newmark()}),
        (BOW, 0.1, {"contact": SegmentFriction(friction=0.2)}),
        (BOW, 0.003, {"integrator": RK44()}),
        (BOW.replace(axial_force=1.5), 0.1, EXACT),
        (SHEARED.replace(curvature_rate=0.6, fourth_derivative=0.5), 0.1, {}),
        (BEAM.replace(axial_force=-1.5, wall_curvature=-0.3), 0.005, {}),
        (SOFT.replace(wall_from=-0.6, wall_to=0.6), 0.02, {}),
        (SOFT.replace(wall_from=0.0, wall_to=0.0, left_end="clamped", right_end="clamped"), 0.003, {}),
        (BEAM.replace(acceleration=-8.0, curvature=0.1, opposite_wall=0.15), 0.4, {}),
    ],
)
def test_a_beam_is_its_half_and_the_image_of_it_however_small_its_deflections_are_made(impact, end, parts):
    small = {} if isinstance(parts.get("contact"), SegmentFriction) else {"geometry": LinearLimit(amplitude=2e-5)}
    halves = {"full_beam": True, **small}, {}
    whole, half = (followed(impact, end, ExudynModel(mesh=UniformMesh(0.12), **parts, **more)) for more in halves)
    for name in (UNITS.keys() & half.dataset.keys()) - {"x", "contact_x", "largest_moment_place"}:
        theirs, images = half.array(name), [whole.array(name)]
        unit = half.array("kinetic_energy")[0] if UNITS[name] == "J" else np.abs(theirs).max(initial=0.0)
        if theirs.ndim == 2:
            middle, sign = theirs.shape[1] - 1, -1.0 if name in ("slope", "angle", "angular_velocity") else 1.0
            images = [images[0][:, middle:].copy(), sign * images[0][:, middle::-1]]
        if name in ("impulse", "opposite_impulse"):
            images[0][:, 0] /= 2.0
            images[1][:, 0] /= 2.0
        for ours in images:
            assert np.abs(ours - theirs).max() <= 1e-4 * unit, name


@pytest.mark.parametrize(
    ("element", "psi", "chi", "tension", "more"),
    [
        *((kind(), 0.3, 0.2, 0.0, {}) for kind in (ANCFCable, GeometricallyExact)),
        *((kind(), 0.0, 0.0, tension, {}) for kind in (ANCFCable, GeometricallyExact) for tension in (1.0, -1.0)),
        (GeometricallyExact(), 0.3, 0.2, 0.0, {"shear_stiffness": 4.0, "rotary_inertia": 0.1}),
    ],
)
def test_without_contact_y0_is_the_motion(element, psi, chi, tension, more):
    """In units in which nothing is one, damped."""
    loads = {"epsilon_alpha": 0.4, "epsilon_psi": psi, "epsilon_chi": chi, "epsilon_axial": tension, "damping": 0.05}
    impact = in_units(Impact.dimensionless(0.5, **loads).replace(**more), OTHER)
    mesh = NodesMesh(tuple(np.linspace(0.0, 1.0, 41)))
    parts = {"mesh": mesh, "element": element, "contact": NO_WALL}  # both ends of cables, half a beam of the others
    parts |= {"end_time": 2.0, "full_beam": element == ANCFCable()}
    history = simulate(impact, **parts)
    x, t = history.array("x") / 0.5, history.time[-1] / 4.0
    y0 = t - 0.25 * x**2 + 0.2 * t**2 + 0.5 * chi * x**2 * t + psi * x**4 / 24
    slope = -0.5 * x + chi * x * t + psi * x**3 / 6.0 + (psi * x / 4.0 if more else 0.0)  # and l_s² y‴
    exact = psi and element == ANCFCable()  # but for its shape: cubics under a quartic, no axial force
    assert_allclose(-history.array("gap")[-1] / 0.5, y0, atol=2e-5 if exact else 2e-4)
    assert_allclose(history.array("velocity")[-1] / 0.125, 1.0 + 0.4 * t + 0.5 * chi * x**2, atol=1e-3)
    assert_allclose(history.array("angle" if more else "slope")[-1], slope, atol=1e-3)
    budget = history.energy_budget()
    assert abs(budget["defect"]) < 1e-6 * budget["initial_energy"]
    assert (history.settings["ends"] == "free") is (psi == 0.0)
    if tension:  # it arrives unbent, however stretched
        assert history.array("strain_energy")[0] < 1e-12 and history.array("largest_moment")[0] < 1e-9


@pytest.mark.parametrize(
    ("impact", "end", "parts"),
    [
        (BOW, 0.15, {}),
        (BEAM.replace(rotation=0.3, first_touch=0.2), 0.15, {}),
        (Impact.whole_beam(2.0, relative_damping=1e-2), 0.9, {}),  # until it has left
        (SOFT.replace(wall_damping=0.0), 0.1, {}),
        (SOFT.replace(wall_damping=0.0, curvature=0.3, left_end="hinged", right_end="clamped"), 0.05, {}),
        (BOW, 0.05, {"contact": SegmentFriction(friction=0.2)}),
    ],
)
def test_what_plain_exudyn_reads_at_the_end_is_what_simulate_reads(impact, end, parts):
    mesh = UniformMesh(0.06)
    history = followed(impact, end, ExudynModel(mesh=mesh, **parts))
    model = build(impact, end_time=end * impact.slow_time_scale, mesh=mesh, **parts)
    model.mbs.SolveDynamic(model.settings)
    read = {name: model.mbs.GetSensorStoredData(number)[:, 1:] for name, number in model.sensors.items()}
    middle = int(np.argmin(np.abs(history.positions(-1))))
    energies = [history.array(f"{kind}_energy")[-1] for kind in ("kinetic", "strain", "contact")]
    assert read["energy"][-1] == pytest.approx(energies, rel=0.015)
    place, velocity = -history.array("gap")[-1, middle], history.array("velocity")[-1, middle]
    assert read["midpoint"][-1] == pytest.approx([place, velocity], rel=0.015)
    assert ("impulse" in read) is not impact.supported
    if "impulse" in read:
        assert read["impulse"][-1, 0] == pytest.approx(history.array("total_impulse")[-1], rel=2e-3)
    if "peak_force" in history:
        assert read["force"].max() == pytest.approx(history.array("peak_force")[-1], rel=5e-3)


def test_a_very_small_axial_force_changes_nothing_and_an_axial_stiffness_may_be_given_beside_it():
    """Its stiff bar has a round-off far above the residual of an unpulled beam."""
    weak, method = Impact.whole_beam(2.0).replace(axial_force=1e-8), ExudynModel(refine=0.25)
    pulled, free = (method.simulate(weak.replace(axial_force=n), end_time=0.005, save=5) for n in (1e-8, 0.0))
    assert pulled.array("total_impulse")[-1] == pytest.approx(free.array("total_impulse")[-1], rel=1e-6)
    assert ExudynModel(element=ANCFCable(axial_stiffness=1.0)).refuses(weak) is None


@pytest.mark.parametrize("full", [False, True])
def test_what_a_run_under_way_is_asked_for_is_what_its_record_says(full):
    told = []
    asked = {"full_beam": full, "until": lambda run, t, q, v: told.append(run.whole_beam(q, v))}
    history = simulate(BOW, end_time=0.1, save=3, mesh=UniformMesh(0.12), **asked)
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    for k, (x, gap, velocity, whole) in enumerate(told, 1):
        record = history.positions(k), history.array("gap", k), history.array("velocity", k)
        assert_allclose((x, gap, velocity), record, rtol=1e-12, atol=1e-12)
        assert whole == pytest.approx(energy[k], rel=1e-12)
    assert len(told) == 3


@pytest.mark.parametrize(("kappa_over_nu", "elements"), [(0.1, 300), (0.008, 375), (0.004, 750), (0.002, 800)])
def test_elements_of_a_thin_front_are_a_third_of_the_bending_length_ahead_of_it_within_limits(kappa_over_nu, elements):
    """That length is √(2κ/ν), the front's bound √(2ν/κ), both times √(t/t*)."""
    first = chosen_mesh(Impact.dimensionless(kappa_over_nu), 0.4).places[1]
    assert math.sqrt(2.0 / kappa_over_nu * 0.4) / first == pytest.approx(elements, rel=2e-3)  # of whole elements
