"""Case files: a beam described as its owner knows it is that of its numbers; what clashes is refused by name."""

import math
import re

import pytest
from here import CASES

from bent_beam import InputError, load_case
from bent_beam.cases import case_from_tables, lay_over
from bent_beam.description import GRAVITY
from bent_beam.loads import wall_scales
from bent_beam.meshes import GradedMesh
from bent_beam.new_case import new_case
from bent_beam.section import General, Pipe, Rectangle, RoundBar

STEEL = {"youngs_modulus": 206e9, "density": 7850.0}
PIPE = {"kind": "pipe", "outer_diameter": 0.127, "wall_thickness": 0.0092, **STEEL}
WALLED = Pipe(outer_diameter=0.127, wall_thickness=0.0092, **STEEL)
BOW, FLIGHT = {"curvature": 0.002}, {"velocity": 2.0}
PLAIN = BOW | {"bending_stiffness": 2e6, "mass_per_length": 30.0}
ALONG, HINGED = {"tension_direction": "axis"}, BOW | {"ends": ["hinged", "free"]}


def case(beam=BOW, section=PIPE, impact=FLIGHT, **more):
    """Without the tables that are None."""
    tables = {"beam": {"length": 30.0, **beam}, "section": section, "impact": impact, **more}
    return case_from_tables({name: table for name, table in tables.items() if table is not None})


def test_pipe_is_outer_less_inner_bar_with_what_it_carries_along():
    pipe = Pipe(outer_diameter=0.127, inner_diameter=0.1086, **STEEL)
    outer, inner = RoundBar(diameter=0.127, **STEEL), RoundBar(diameter=0.1086, **STEEL)
    assert (outer.area, outer.second_moment) == pytest.approx((math.pi * 0.0635**2, math.pi * 0.0635**4 / 4.0))
    assert pipe.bending_stiffness == pytest.approx(outer.bending_stiffness - inner.bending_stiffness, rel=1e-13)
    assert pipe.mass_per_length == pytest.approx(outer.mass_per_length - inner.mass_per_length, rel=1e-13)
    assert WALLED.bore == pytest.approx(0.1086, rel=1e-13)
    assert pipe.section_modulus == pytest.approx(pipe.second_moment / 0.0635, rel=1e-13)
    wet = Pipe(outer_diameter=0.127, inner_diameter=0.1086, fluid_density=1000.0, added_mass=3.0, **STEEL)
    carried = 1000.0 * math.pi * 0.0543**2 + 3.0
    assert wet.mass_per_length - pipe.mass_per_length == pytest.approx(carried, rel=1e-12)


def test_shear_coefficients_are_cowpers():
    """Cowper 1966, Table 1: 6(1 + ν)/(7 + 6ν) and 10(1 + ν)/(12 + 11ν); a thin round tube; a tube without a bore."""
    bar, flat = RoundBar(diameter=0.1, **STEEL), Rectangle(width=1.0, thickness=0.1, **STEEL)
    thin, thick = (Pipe(outer_diameter=0.1, inner_diameter=bore, **STEEL) for bore in (0.0999, 0.0))
    for section, expected in ((bar, 0.8864), (flat, 0.8497), (thin, 2 * 1.3 / (4 + 3 * 0.3)), (thick, 0.8864)):
        assert section.shear_coefficient == pytest.approx(expected, rel=2e-3)
        modulus = section.youngs_modulus / 2.6  # E/(2(1 + ν))
        assert section.shear_stiffness == pytest.approx(expected * modulus * section.area, rel=2e-3)


def test_a_section_that_knows_its_shear_makes_timoshenko_s_beam_unless_euler_and_bernoulli_s_is_asked_for():
    found = case(BOW | {"model": "timoshenko"}).impact
    assert (found.model, found.shear_stiffness) == ("timoshenko", WALLED.shear_stiffness)
    assert found.rotary_inertia == pytest.approx(7850.0 * WALLED.second_moment, rel=1e-14)
    along = 12.0 * found.bending_stiffness / found.section_height**2  # EA of the rectangle that stands for it
    assert along == pytest.approx(206e9 * WALLED.area, rel=1e-12)
    assert found.shear_ratio == pytest.approx(WALLED.shear_coefficient / 2.6, rel=1e-12)  # κ_sG/E: nothing moves along
    assert case(BOW | {"model": "euler_bernoulli"}).impact == found.unsheared
    assert case(PLAIN, None).impact.model == "euler_bernoulli"
    stated = case(PLAIN | {"shear_stiffness": 5e7, "model": "timoshenko"}, None).impact
    assert stated.shear_length == pytest.approx(0.2) and stated.rotary_inertia == 0.0


def test_stress_of_a_rectangle_under_moment_and_tension():
    section = Rectangle(width=0.03, thickness=0.002, **STEEL)
    assert section.stress(1.0) == pytest.approx(6.0 / (0.03 * 0.002**2), rel=1e-13)  # 6M/(b h²)
    assert section.stress(0.0, -600.0) == pytest.approx(600.0 / (0.03 * 0.002), rel=1e-13)
    assert section.radius_of_gyration == pytest.approx(0.002 / math.sqrt(12.0), rel=1e-13)
    sizes = {"area_of_section": section.area, "second_moment_of_area": section.second_moment, "section_height": 0.002}
    assert case(section={"kind": "general", **sizes, **STEEL}).section.stress(1.0) == section.stress(1.0)


def test_the_bow_by_its_sagitta_or_its_dogleg():
    """The circle through both ends and the middle; degrees in thirty metres."""
    radius = 1.0 / case({"sagitta": 0.3, "sagitta_length": 20.0}).impact.curvature
    assert radius - math.sqrt(radius**2 - 100.0) == pytest.approx(0.3, rel=1e-12)
    assert case({"dogleg": 3.0}).impact.curvature * 30.0 == pytest.approx(math.radians(3.0), rel=1e-14)


def test_a_beam_arrives_as_it_falls_on_or_swings():
    for impact, velocity, acceleration in (
        ({"drop_height": 0.5, "gravity": 9.0}, 3.0, 9.0), ({"drop_height": 0.5, "gravity": 0.04}, 0.2, 0.04),
        *(({"velocity": 1.0, "gravity": 9.0, "gravity_angle": at}, 1.0, g) for at, g in ((60.0, 4.5), (90.0, 0.0))),
        ({"angular_speed": 0.2, "angular_arm": 5.0}, 1.0, 0.0),
    ):  # fmt: skip
        found = case(impact=impact).impact
        assert found.velocity == pytest.approx(velocity, rel=1e-14)
        assert found.acceleration == pytest.approx(acceleration, rel=1e-12, abs=0.0)


def test_a_wall_that_gives_way_and_the_ends_are_what_the_tables_say():
    found = case(HINGED, wall={"stiffness": 1e6, "damping_ratio": 0.5}).impact
    assert found.wall_damping == pytest.approx(math.sqrt(1e6 * found.mass_per_length), rel=1e-14)
    assert (found.left_end, found.right_end, found.off_centre) == ("hinged", "free", True)
    assert case(HINGED, impact={"angular_speed": 0.2}).impact.velocity == pytest.approx(0.2 * 15.0)  # of its middle
    length, time = wall_scales(found)
    assert length**4 == pytest.approx(found.bending_stiffness / 1e6)
    assert time**2 == pytest.approx(found.mass_per_length / 1e6)
    stop = case(wall={"stiffness": 1e6, "from": 0.0, "to": 0.0}).impact
    assert wall_scales(stop).length ** 3 == pytest.approx(stop.bending_stiffness / 1e6)


def test_tension_straightens_the_bow_in_flight_and_along_the_axis_pulls_no_beam_to_its_wall():
    """Two forces along one line have no sum; along the bow's ends theirs is −NKL."""
    four = {"fourth_derivative": 1e-5}
    axis, tangent, held = (
        case({"curvature": 0.002, "axial_force": 1e5, **beam}, impact={"velocity": 2.0, **impact}).impact
        for beam, impact in (({}, four), ({"tension_direction": "tangent"}, {}), ({}, {"acceleration": 0.0}))
    )
    bends = 1e5 * 0.002 + 1e-5 * axis.bending_stiffness
    assert axis.acceleration == pytest.approx(-bends / axis.mass_per_length, rel=1e-12)
    assert axis.uniform_pressure == pytest.approx(0.0, abs=1e-9)
    assert held.uniform_pressure == pytest.approx(200.0, rel=1e-12)
    assert axis.tension_direction == "axis" and axis.net_load == pytest.approx(0.0, abs=1e-9)
    assert tangent.net_load == pytest.approx(-1e5 * 0.002, rel=1e-12)
    assert held.load_within(3.0, 2) == pytest.approx(200.0 * 2.0 * 3.0**3 / 3.0)


def test_damping_ratio_and_loss_factor_are_the_same_time_constant():
    ratio = case({"curvature": 0.002, "damping_ratio": 0.01}).impact
    first = (4.730040744862704 / 30.0) ** 2 * ratio.wave_constant  # rad/s
    assert ratio.damping == pytest.approx(2 * 0.01 / first, rel=1e-9)
    loss = case({"curvature": 0.002, "loss_factor": 0.02, "loss_frequency": first / (2 * math.pi)}).impact
    assert loss.damping == pytest.approx(ratio.damping, rel=1e-9)


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ({"beam": {"curvature": 0.1, "sagitta": 0.1}}, "beam.curvature = 0.1 and beam.sagitta = 0.1"),
        ({"beam": {}}, "beam.curvature is required"),
        ({"beam": {"sagitta": 20.0}}, "beam.sagitta must be less than half"),
        ({"beam": {"sagitta": 0.1, "sagitta_length": 40.0}}, "must not exceed beam.length"),
        ({"beam": {"curvature": 0.1, "bending_stiffness": 1.0}}, "beam.bending_stiffness = 1.0 and"),
        ({"section": None}, "beam.bending_stiffness is required"),
        ({"section": PIPE | {"wall_thickness": 0.1}}, "walls cross"),
        ({"section": PIPE | {"inner_diameter": 0.1}}, "say the same"),
        ({"section": PIPE | {"poisson_ratio": 0.51}}, "poisson_ratio"),
        ({"section": PIPE | {"poisson_ratio": -1.0}}, "poisson_ratio"),
        ({"section": {"kind": "round_bar", "diameter": 1e55, **STEEL}}, "section: bending_stiffness must not exceed"),
        ({"impact": {"drop_height": 1.0, "gravity_angle": 90.0}}, "needs gravity towards the wall"),
        ({"beam": {"curvature": 0.1, "hysteretic_loss": 0.1}}, "hysteretic_loss .got 0.1 alone.* is at [0-9.]+ Hz"),
        ({"beam": {"curvature": 0.1, "hysteretic_loss": 0.1, "loss_frequency": 1e9}}, "loss_frequency .*got 10{9}.0"),
        ({"beam": {"curvature": 0.1, "loss_frequency": 10.0}}, "loss_frequency has no effect"),
        ({"beam": BOW | ALONG}, "tension_direction has no effect"),
        ({"beam": BOW | ALONG | {"axial_force": 1, "ends": "clamped"}}, "beam.tension_direction .* without a free end"),
        ({"beam": {"curvature": 0.1, "sagitta_length": 1.0}}, "sagitta_length has no effect"),
        ({"impact": {"velocity": 1.0, "angular_arm": 1.0}}, "angular_arm has no effect"),
        ({"impact": {"angular_speed": 0.2}}, "angular_arm, m, is required .*got 0.2 alone"),
        ({"impact": {"velocity": 1.0, "gravity_angle": 1.0}}, "no effect .*or set impact.gravity_angle to 0"),
        ({"impact": {"amplitude": 0.01}}, "impact.frequency, Hz, is required"),
        ({"impact": {"velocity": 1.0, "frequency": 5.0}}, "frequency has no effect without impact.amplitude"),
        ({"wall": {"clearance": 0.01}}, "wall.clearance has no effect on a free beam"),
        ({"impact": {"velocity": 1.0, "gravity": 1.0, "acceleration": 1.0}}, "acceleration = 1.0 and impact.gravity"),
        ({"wall": {"curvature": 0.002}}, "wall.curvature must be less"),
        ({"wall": {"damping": 1.0}}, "wall.damping has no effect on a rigid wall"),
        ({"wall": {"stiffness": 1e6, "damping_ratio": 0.1, "from": 15.0}}, "nothing at a stop"),
        ({"section": 0}, "section"),
        ({"section": STEEL | {"kind": "general", "poisson_ratio": 0.3}}, "poisson_ratio is not a known setting"),
        ({"wall": {"from": 16.0}}, "wall.from must lie on the beam"),
        ({"beam": {"curvature": 0.1, "ends": ["free", "glued"]}}, "beam.ends must be one of .*'glued'"),
        ({"beam": {"curvature": 0.1, "ends": "hinged"}, "impact": {"angular_speed": 1.0}}, "needs one hinge"),
        ({"beam": HINGED | {"axial_force": 1e3}, "impact": {"angular_speed": 1.0}}, "bends it"),
        # what contradicts the model of the beam
        ({"beam": PLAIN | {"model": "timoshenko"}, "section": None}, "needs beam.shear_stiffness"),
        ({"beam": PLAIN | {"rotary_inertia": 1.0}, "section": None}, "no effect without"),
        ({"beam": BOW | {"shear_stiffness": 1.0}}, 'the same thing: give one of them; of a comp.*kind = "general"'),
        ({"section": PIPE | {"shear_modulus": 5e9}}, 'shear_modulus is not a known .*kind = "general" and beam.shear'),
        ({"beam": BOW | {"model": "rayleigh"}}, "beam.model must be one of"),
        ({"beam": BOW | {"length": -1.0}}, r"^beam.length must be positive \(got -1.0\)"),
        ({"beam": BOW | {"lengt": 1.0}}, r"beam.lengt .* \(did you mean length\?\)"),
        ({"beam": BOW | {"length": "40cm"}}, r"^beam.length must be a finite number in m, .*without its unit .*'40cm'"),
        ({"beam": BOW | {"damping_ratio": "1 %"}}, r"finite number, with a decimal point and without its unit .*'1 %'"),
        ({"impact": None}, "impact is required"),
        ({"impact": None, "impcat": {}}, r"impcat is not a known setting \(did you mean impact\?\)"),
        ({"meshh": {}}, r"meshh is not a known setting \(did you mean mesh\?\)"),
        ({"mesh": {"element_length": 1.0}}, "mesh.kind is required"),
        ({"run": {"end_time": 1.0, "duration": 1.0}}, "exclude each other"),
        ({"run": {"end_time": 1e300}}, r"^run.end_time "),
    ],
)
def test_what_clashes_or_is_mistaken_is_named_with_its_value(tables, message):
    with pytest.raises(InputError, match=message) as caught:
        case(**tables)
    assert "\n" not in str(caught.value)


def test_a_decimal_comma_in_a_file_is_named(tmp_path):
    for text, said in (("length = 0,40\n", "decimal point, no comma"), ("length = 4 m # 0,40\n", r"column 12\)$")):
        (tmp_path / "case.toml").write_text(f"[beam]\n{text}")
        with pytest.raises(InputError, match=said):
            load_case(tmp_path / "case.toml")


def test_a_beam_buckles_under_the_critical_load_of_its_ends():
    shares = [("free", 1.0), ("hinged", 1.0), (["clamped", "free"], 0.25), (["free", "hinged"], 0.0), ("clamped", 4.0)]
    for ends, share in (*shares, (["hinged", "clamped"], (4.493409458 / math.pi) ** 2)):
        bow = {"curvature": 0.002, "ends": ends}
        limit = share * math.pi**2 * case(bow).impact.bending_stiffness / 30.0**2
        case(bow | {"axial_force": -0.999 * limit})
        with pytest.raises(InputError, match="axial_force must not press with more than"):
            case(bow | {"axial_force": -1.001 * limit - 1.0})


def test_a_duration_is_in_units_of_the_beams_own_time():
    found = case(run={"duration": 0.05})
    assert found.impact.time_scale != pytest.approx(1.0, rel=0.1)
    assert found.end_time == pytest.approx(0.05 * found.impact.time_scale)


def test_every_case_file_loads_the_thesis_sweep_is_complete_and_the_other_beams_spread():
    shipped = {file.stem: load_case(file) for file in CASES.glob("*.toml")}
    assert all(found.end_time > 0.0 for found in shipped.values())
    ratios = sorted(found.impact.kappa_over_nu for name, found in shipped.items() if name.startswith("thesis_K"))
    assert ratios == pytest.approx([1 / 1600, 1 / 800, 1 / 400, 1 / 200, 1 / 100, 1 / 40, 1 / 20, 1 / 4, 1 / 2, 1.25])
    for found in (shipped[name] for name in ("drill_pipe", "ruler", "glass_fibre_rod", "rail")):
        assert 0.0 < found.impact.kappa_over_nu < 1.0 and found.end_time < 0.03 * found.impact.slow_time_scale
    rail = shipped["rail"].section
    assert isinstance(rail, General) and rail.mass_per_length == pytest.approx(60.21, rel=1e-3)


@pytest.mark.parametrize("kind", ["pipe", "round_bar", "rectangle", "general"])
def test_a_new_case_can_be_used_once_its_damping_is_stated(kind, tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(text := new_case(kind))
    marks = [line.index("  # ") for line in text.split("\n") if "  # " in line and len(line.partition("  # ")[0]) < 30]
    assert set(marks) == {marks[0]}  # comments stand below each other
    with pytest.raises(InputError, match=r"beam\.damping_ratio .*0\.0002 bare steel, 0\.002 as held"):
        load_case(file)
    file.write_text(new_case(kind, 0.01))
    assert load_case(file).section is not None and load_case(file).impact.damping > 0.0


def test_an_amplitude_at_a_frequency_is_a_velocity_and_what_is_laid_over_a_case_replaces_what_says_the_same():
    tables = {"beam": {"length": 2.0, "bending_stiffness": 1.0, "mass_per_length": 1.0, "sagitta": 0.01,
                       "sagitta_length": 1.0, "loss_factor": 0.1, "loss_frequency": 5.0},
              "impact": {"amplitude": 0.002, "frequency": 40.0}}  # fmt: skip
    assert case_from_tables(tables).impact.velocity == pytest.approx(2.0 * math.pi * 40.0 * 0.002)
    lay_over(tables, ["beam.curvature=0.3", "beam.damping=0.5", "impact.velocity=3"])
    impact = case_from_tables(tables).impact
    assert (impact.curvature, impact.damping, impact.velocity) == (0.3, 0.5, 3.0)
    fallen = {"impact": {"drop_height": 0.5}}
    lay_over(fallen, ["impact.velocity=1"])
    assert fallen["impact"] == {"velocity": 1, "gravity": GRAVITY}  # it falls on
    inclined = {"gravity": 9.81, "gravity_angle": 60.0}
    for given, laid, found in (({"acceleration": 2.0}, "gravity=9", 9.0), (inclined, "acceleration=2", 2.0)):
        tables = {"impact": FLIGHT | given}
        lay_over(tables, [f"impact.{laid}"])
        assert case(**tables).impact.acceleration == pytest.approx(found)
    for way in ({"gravity": 1.62}, {"gravity_angle": 60.0}):
        with pytest.raises(InputError, match="how it fell"):  # the velocity would be another
            lay_over({"impact": {"drop_height": 1.0, **way}}, ["impact.acceleration=2"])
    for way, amount in (("hysteretic_loss", 0.0), ("damping", 0.0), ("loss_factor", 0.0)):
        undamped = case(BOW | {way: amount} | ({"loss_frequency": 5.0} if way == "loss_factor" else {}))
        assert undamped.damping_stated and undamped.impact.damping == undamped.impact.hysteretic_loss == 0.0


def test_two_settings_that_say_the_same_are_refused() -> None:
    both = ("beam.curvature=0.3, beam.dogleg=1", "beam.ends=free, beam=1", "impact.velocity=3, impact . velocity=3")
    for pair in (*both, "run.end_time=1, run.duration=1", "section.inner_diameter=1, section.wall_thickness=1"):
        with pytest.raises(InputError, match=re.escape(pair.partition("=")[0])):
            lay_over({}, pair.split(", "))


def test_assignments_are_laid_over_and_a_mistake_for_one_path_is_found_with_another():
    laid = ["mesh.kind=graded", "mesh.element_length=2.5e-3", "mesh.growth=1.25", "hermite.contact.kind=node"]
    found = load_case(CASES / "thesis_K10.toml", laid)
    assert found.mesh == GradedMesh(element_length=2.5e-3, growth=1.25)
    assert found.tables == {"hermite": {"contact": {"kind": "node"}}}
    assert found.method("hermite").mesh == found.mesh and case().method("hermite").mesh is None
    with pytest.raises(InputError, match="rigit"):
        case(exudyn={"contact": {"kind": "rigit"}}).method("hermite")
