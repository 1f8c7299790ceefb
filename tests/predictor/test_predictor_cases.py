"""Case files on the page: read, or refused by name."""

import tomllib

import pytest
from here import ROOT
from histories import ROD
from page_model import NAMES, evaluated, in_si

from bent_beam.cases import case_from_tables
from bent_beam.errors import InputError

READ = "given.map((text) => { try { return Beam.impact(Case.read(text)); } catch (error) { return error.message; } })"


def test_cases_are_read_and_what_the_page_lacks_is_refused_by_name() -> None:
    """A drop is under standard gravity where none is stated; at 100° it draws away from the wall."""
    texts = {name: (ROOT / f"cases/{name}.toml").read_text(encoding="utf-8")
             for name in ("tube", "drill_pipe", "rail", "ruler", "two_walls", "tube_between_plates")}  # fmt: skip
    for fall in ("drop_height = 0.05\ngravity_angle = 30.0", "velocity = 1.0\ngravity = 9.81\ngravity_angle = 100.0"):
        texts[fall] = ROD.replace("velocity = 1.0", fall)
    texts["nonsense"] = texts["tube"].replace("[run]", "[exudyn]\nrun = true\n[run]")
    found = dict(zip(texts, evaluated(READ, list(texts.values())), strict=True))
    assert "beam.bending_stiffness is not on this page" in found.pop("two_walls")
    assert "beam.ends is not on this page" in found.pop("tube_between_plates")
    assert "run = true is not a number" in found.pop("nonsense")
    for name, read in found.items():
        impact = case_from_tables(tomllib.loads(texts[name])).impact
        for here, there in NAMES.items():
            assert (read[here] or 0.0) == pytest.approx(in_si(impact, there), rel=1e-9), (name, here)


GENERAL = 'kind = "general"\narea_of_section = 1e-4\nsecond_moment_of_area = 1e-9\nsection_height = 0.01'


REFUSED = [  # instead of a line of the rod, another: what the page says
    ("density = 7850.0", "", "section.density is missing"),
    ("diameter = 0.02", "", "section.diameter is missing"),
    ('kind = "round_bar"\ndiameter = 0.02', GENERAL, "needs a section that knows its shear"),
    ("diameter = 0.02", "diameter = 0.02\nwidth = 0.1", "section.width is none of a round_bar"),
    ("sagitta = 0.01", "", "give one of beam.sagitta, beam.curvature, beam.dogleg"),
    ("sagitta = 0.01", "sagitta = 0.01\ncurvature = 0.1", "give one of beam.sagitta"),
    ("sagitta = 0.01", "curvature = 0.1\nsagitta_length = 0.5", "sagitta_length has no effect"),
    ("velocity = 1.0", "", "give one of impact.velocity, impact.drop_height"),
    ("velocity = 1.0", "velocity = 1.0\ngravity = 9.81\nacceleration = 1.0", "say the same"),
    ("velocity = 1.0", "velocity = 1.0\ngravity_angle = 30.0", "gravity_angle has no effect"),
    ("velocity = 1.0", "velocity = 1.0\n[wall]\ndamping_ratio = 0.1", "wall.damping_ratio has no effect"),
]


def test_the_page_makes_nothing_up_of_a_case_that_bentbeam_refuses() -> None:
    sheared = ROD.replace("length", 'model = "timoshenko"\nlength')  # a general section has no shear
    texts = [(sheared if other == GENERAL else ROD).replace(line, other) for line, other, _ in REFUSED]
    for text, (_, _, said), found in zip(texts, REFUSED, evaluated(READ, texts), strict=True):
        with pytest.raises(InputError):
            case_from_tables(tomllib.loads(text))
        assert said in found
