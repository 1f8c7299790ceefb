"""A result that is not to be trusted says so where the number is: in the JSON's `warnings`."""

import pytest
from called import answered

CASE = """[beam]
bending_stiffness = 1.0
mass_per_length = 1.0
length = {length}
curvature = 0.5
[impact]
velocity = 1.0
[run]
duration = 0.1
[hermite.integrator]
kind = "signorini_position"
growth = 0.01
[exudyn.integrator]
kind = "generalized_alpha"
relative_step = 0.01
"""


def simulate(tmp_path, path, *settings, length=20.0):
    file = tmp_path / "case.toml"
    file.write_text(CASE.format(length=length))
    assigned = (item for setting in settings for item in ("--set", setting))
    return answered("simulate", file, "--path", path, "--save", 20, *assigned)


@pytest.mark.parametrize(
    ("path", "settings", "length", "words"),
    [
        ("hermite", ("run.duration=0.01",), 1.0, "ends of the beam"),
        ("hermite", ("mesh.kind=uniform", "mesh.element_length=2.0"), 20.0, "cannot resolve the contact front"),
        ("hermite", ("hermite.integrator.growth=3.0",), 20.0, "time steps cannot resolve"),
        ("hermite", ("run.duration=3.0",), 20.0, "ends of the beam"),
        ("exudyn", ("mesh.kind=uniform", "mesh.element_length=0.02"), 0.4, "reflected"),
        ("exudyn", ("mesh.kind=uniform", "mesh.element_length=1.0"), 20.0, "under-resolved front"),
        ("exudyn", ("mesh.kind=graded", "mesh.element_length=0.02", "mesh.growth=1.25"), 20.0, "grows by 25%"),
        (
            "exudyn",
            (
                *("mesh.kind=uniform", "mesh.element_length=0.05", "exudyn.contact.kind=penalty"),
                *("exudyn.contact.relative_stiffness=6e-5", "exudyn.contact.relative_damping=2e-4"),
            ),
            10.0,
            "enters the wall",
        ),
        (
            "exudyn",
            ("mesh.kind=uniform", "mesh.element_length=1.0", "exudyn.integrator.time_step=1.0"),
            20.0,
            "time steps",
        ),
    ],
)
def test_a_doubtful_run_says_so(path, settings, length, words, tmp_path):
    found = simulate(tmp_path, path, *settings, length=length)
    assert any(words in warning for warning in found["warnings"]), found["warnings"]


def test_a_beam_bent_beyond_the_linear_range_of_its_elements_says_so(tmp_path):
    """An amplitude that is chosen keeps it within."""
    settings = ("mesh.kind=uniform", "mesh.element_length=0.25", "beam.curvature=30.0")
    given = ("exudyn.geometry.kind=linear", "exudyn.geometry.amplitude=1e-3")
    for amplitude, warned in ((given, True), ((), False)):
        found = simulate(tmp_path, "exudyn", *settings, *amplitude, length=10.0)
        assert any("linear range" in warning for warning in found["warnings"]) == warned, found


def test_a_sound_run_has_nothing_to_warn_of(tmp_path):
    assert simulate(tmp_path, "hermite")["warnings"] == []


def test_the_lift_of_a_damped_beam_is_its_own_where_elements_resolve_its_damping(tmp_path):
    """η = 0.01 t*: bending runs 0.1 l* in that time. The converged lift is 0.42 V₀t and no defect of a scheme."""
    damped = ("beam.curvature=0.1", "beam.damping=0.01")
    for mesh, warned in (((), False), (("mesh.kind=uniform", "mesh.element_length=0.1"), True)):
        found = simulate(tmp_path, "hermite", *damped, *mesh)
        assert found["lift"] > 0.05
        assert any("lifts off the wall" in warning for warning in found["warnings"]) == warned, found["warnings"]
