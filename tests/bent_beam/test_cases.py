"""Case files: what is accepted, and the one line that a mistake gives."""

from pathlib import Path

import pytest

from bent_beam import InputError, load_case
from bent_beam.cases import case_from_tables
from bent_beam.meshes import GradedMesh

CASES = Path(__file__).parents[2] / "cases"
BEAM = dict(bending_stiffness=1.0, mass_per_length=1.0, length=50.0, curvature=0.0125)
GOOD = {"beam": BEAM, "impact": {"velocity": 20.0}}


def test_every_case_file_loads_and_the_thesis_sweep_is_complete():
    assert all(load_case(file).end_time > 0.0 for file in CASES.glob("*.toml"))
    ratios = sorted(load_case(f).impact.kappa_over_nu for f in CASES.glob("thesis_K*.toml"))
    assert ratios == pytest.approx([1 / 1600, 1 / 800, 1 / 400, 1 / 200, 1 / 100, 1 / 40, 1 / 20, 1 / 4, 1 / 2, 1.25])


def test_assignments_are_laid_over_and_a_mistake_for_one_path_is_found_with_another():
    case = load_case(
        CASES / "thesis_K10.toml",
        ["mesh.kind=graded", "mesh.element_length=2.5e-3", "mesh.growth=1.25", "hermite.contact.kind=node"],
    )
    assert case.mesh == GradedMesh(element_length=2.5e-3, growth=1.25)
    assert case.tables == {"hermite": {"contact": {"kind": "node"}}}
    assert case.method("hermite").mesh == case.mesh and case_from_tables(GOOD).method("hermite").mesh is None
    mistaken = case_from_tables({**GOOD, "exudyn": {"contact": {"kind": "rigit"}}})
    with pytest.raises(InputError, match="rigit"):
        mistaken.method("hermite")


def changed(table, **values):
    return {**GOOD, table: {**GOOD.get(table, {}), **values}}


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        (changed("beam", bending_stiffness=-1.0), r"beam.bending_stiffness must be positive \(got -1.0\)"),
        (changed("impact", velocity="fast"), r"impact.velocity must be a finite number \(got 'fast'\)"),
        (changed("beam", bendin_stiffness=1.0), r"beam.bendin_stiffness .* \(did you mean bending_stiffness\?\)"),
        ({**GOOD, "meshh": {}}, r"meshh is not a known setting \(did you mean mesh\?\)"),
        ({"beam": BEAM}, "impact is required"),
        (changed("mesh", kind="graded", element_length=-2.0), r"mesh.element_length must be positive \(got -2.0\)"),
        (changed("mesh", element_length=1.0), "mesh.kind is required"),
        (changed("run", end_time=1.0, duration=1.0), "exclude each other"),
        (changed("run", end_time=1e300), r"^run.end_time "),
    ],
)
def test_a_mistake_is_named_with_its_value(tables, message):
    with pytest.raises(InputError, match=message) as caught:
        case_from_tables(tables)
    assert "\n" not in str(caught.value)


def test_gravity_takes_the_place_of_an_acceleration_that_a_case_gives_and_the_other_way_round(tmp_path):
    file = tmp_path / "case.toml"
    for given, laid, found in (
        ("acceleration = 2.0", "gravity=9.81", 9.81),
        ("gravity = 9.81\ngravity_angle = 60.0", "acceleration=2.0", 2.0),
    ):
        beam = "\n".join(f"{key} = {value}" for key, value in BEAM.items())
        file.write_text(f"[beam]\n{beam}\n[impact]\nvelocity = 20.0\n{given}\n")
        assert load_case(file, [f"impact.{laid}"]).impact.acceleration == pytest.approx(found)
