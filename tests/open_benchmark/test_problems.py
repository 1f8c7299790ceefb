"""Problems: what an id means, the files that are shipped, and the references that whole impacts are held against."""

import dataclasses
import json
import re
import tomllib
from functools import partial

import numpy as np
import pytest
from markdown_tables import lines_after
from scipy.interpolate import PPoly

from bent_beam.errors import InputError
from bent_beam_programs.open_benchmark.bounce_reference import agrees
from bent_beam_programs.open_benchmark.exact import computed, whole_impact
from bent_beam_programs.open_benchmark.problem import PROBLEMS, SCHEMA, document, problem, problem_text, shipped_ids
from bent_beam_programs.open_benchmark.references import REFERENCES, Reference, reference
from bent_beam_programs.open_benchmark.references import SCHEMA as REFERENCE_SCHEMA
from bent_beam_programs.open_benchmark.result import Result
from bent_beam_programs.open_benchmark.score import score


def test_the_schemas_are_frozen():
    """The keys of the files are those of the guide's two tables: whoever changes one changes guide and version."""
    assert (SCHEMA, REFERENCE_SCHEMA) == ("beam-impact/2", "beam-impact-references/2")
    page, files = "docs/guide/enter.md", [document(problem(name)) for name in shipped_ids()]
    told = [re.findall(r"\w+", row[0]) for row in lines_after(page, "| key |")[2:]]
    told += [re.findall(r"`(\w+)`", " ".join(row)) for row in lines_after(page, "| table | keys |")[2:]]
    found = {(table, key) for file in files for table in file.keys() - {"schema", "id"} for key in file[table]}
    assert found == {(table, key) for table, *keys in told for key in keys}
    for known in json.loads(REFERENCES.read_text())["problems"].values():
        assert known.keys() <= {"values", "errors", "impulse"}
        assert known.get("values", {}).keys() <= {"lambda0", "r0", "lambda1", "r1", "peak_force", "peak_time"}
        assert known.get("impulse", {}).keys() <= {"variable", "breaks", "coefficients"}


SOME = ("leading-0.5", "first-0.5--0.5-0-0-1", "chattering-ball", "bar", "released-bar", "bouncing-bar", "string")
SOME += ("elastic-stop-18000",)


@pytest.mark.parametrize("names", [SOME, pytest.param((), marks=pytest.mark.verify)], ids=["some", "all"])
def test_stored_references_are_what_the_theory_says(names):
    """To 1e-9, or to a hundredth of a stated error: the rest is rounding, which differs between processors."""
    shipped = json.loads(REFERENCES.read_text())["problems"]
    for name in names or shipped:
        stored, today = shipped[name], computed(problem(name))
        assert stored.keys() == today.keys()
        for key, error in stored.get("errors", {}).items():
            assert today["errors"][key] == pytest.approx(error, rel=0.01), (name, key)
        for key, value in stored.get("values", {}).items():
            near = 0.01 * stored["errors"][key] if "errors" in stored else 1e-9 * abs(value) + 1e-12
            assert today["values"][key] == pytest.approx(value, rel=0.0, abs=near), (name, key)
        if "impulse" in stored:
            before, now = (PPoly(np.transpose(one["impulse"]["coefficients"]), one["impulse"]["breaks"])
                           for one in (stored, today))  # fmt: skip
            assert stored["impulse"]["variable"] == today["impulse"]["variable"]
            at = np.linspace(before.x[0], before.x[-1], 2001)
            assert now(at) == pytest.approx(before(at), rel=1e-9, abs=1e-9 * np.abs(before(at)).max()), name


def test_the_largest_half_length_is_where_the_free_motion_closes_the_gap():
    asked = problem("first-0.5-1-1-1")
    far, load = asked.largest_half_length, asked.epsilon
    x = far * np.array([0.5, 0.999, 1.001])
    gap = 0.25 * x**2 - load * x**4 / 24 - (1 + load * x**2 / 2) * 0.1 - load * 0.1**2 / 2
    assert (gap > 0.0).tolist() == [True, True, False]


def test_a_shipped_file_is_what_its_id_says_and_tells_no_answer():
    for name, stored in json.loads(PROBLEMS.read_text())["problems"].items():
        text = problem_text(problem(name))
        assert tomllib.loads(text) == document(problem(name)) == stored and stored["id"] == name
        assert not any(word in text for word in ("lambda", "r0", "theory", "step", "mesh"))


def test_loads_in_the_file_are_the_scaled_groups_and_a_base_is_one_however_its_number_is_written():
    asked = problem("first-0.5--1--1-0.5")
    assert asked.loads == (-1.0, -1.0, 0.5, 0.0) and asked.base_id == "leading-0.5"
    given = [document(asked)["impact"][name] for name in ("acceleration", "fourth_derivative", "curvature_rate")]
    assert given == pytest.approx([-asked.epsilon, -asked.epsilon, 0.5 * asked.epsilon])
    assert problem(str(problem("first-1e15-1-0-0").base_id)).kappa_over_nu == 1e15


def test_the_resting_zone_carries_what_statics_says():
    """Nothing where the middle lifts off, and under tension in free flight: α = −κN."""
    loads = {"first-0.5--1--1-0.5": 0.0, "first-0.4--0.4-0-0-1": 0.0, "first-0.4-0-0-0-1": 0.4, "first-0.4-1-2-0": 3.0}
    for name, load in loads.items():
        assert problem(name).uniform_load == pytest.approx(load * problem(name).epsilon), name


NONE = ["", "leading-1.5", "leading-0", "leading-nan", "first-0.5-0-0-0", "point-0.5", "bounce-1", "x" * 999]
NONE += ["elastic-stop-1e3", "elastic-stop-1e12", "elastic-wall-1e-9-0", "elastic-wall-0.5-50"]  # beyond the theory


@pytest.mark.parametrize("name", NONE)
def test_an_id_that_none_has_is_refused_in_one_line(name):
    with pytest.raises(InputError, match="problem: ") as error:
        problem(name)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("name", ["elastic-stop-3e3", "elastic-wall-1e-6-5"])  # a softer stop is pressed even later
def test_an_elastic_problem_has_its_largest_force_within_its_record(name):
    assert 0.0 < computed(problem(name))["values"]["peak_time"] < problem(name).end_time


SHIPPED = [name for name in shipped_ids() if name.startswith("bounce-")]


def left_with(name, restitution, drift=0.0):
    """A wall that has given the beam 2(1 + e) by half of the record, and ``drift`` on it from there."""
    asked = problem(name)
    share = np.linspace(0.0, 1.0, 600)
    push = 2.0 * (1.0 + restitution) * np.minimum(2.0 * share, 1.0) + 20.0 * drift * np.maximum(share - 0.9, 0.0)
    return Result("completed", "", asked, {}, asked.end_time * share, push)


@pytest.mark.parametrize("name", SHIPPED)
def test_a_restitution_is_held_against_its_reference_within_bars_and_tolerance(name):
    exact = reference(problem(name))
    value, error = exact.values["restitution"], exact.errors["restitution"]
    assert value is not None and 0.0 < error < 1e-3
    right = score(left_with(name, 1.008 * value))
    assert right.outcome == "completed" and right.measured["restitution"].theory == value
    assert right.reference["restitution"] == {"error": error, "source": exact.source} and "python -m" in exact.source
    wrong = score(left_with(name, 0.985 * value))
    assert wrong.outcome == "completed, off" and "reference" in str(wrong.reason)
    # one that is still changing says so in its own error bar
    unsure = score(left_with(name, 0.985 * value, drift=0.03))
    assert "within its bar" in unsure.outcome
    assert unsure.measured["restitution"].bar == pytest.approx(0.03, rel=0.05)


def test_other_bounces_are_held_against_a_run_with_a_bar_and_none_against_a_band(monkeypatch):
    monkeypatch.setattr("bent_beam_programs.open_benchmark.exact.whole_impact", partial(whole_impact, elements=50))
    coarse = dataclasses.replace(problem(SHIPPED[-1]), id="bounce-2.0-1e-3")  # not shipped under this name
    found, known = reference(coarse), reference(problem(SHIPPED[-1]))
    assert abs(found.values["restitution"] - known.values["restitution"]) <= found.errors["restitution"] < 1e-3
    assert "Hermite" in found.source
    assert reference(problem("bounce-0.7-0")) == Reference()
    assert score(left_with("bounce-0.7-0", 0.2)).measured["restitution"].theory is None


@pytest.mark.verify
def test_the_stored_reference_is_what_a_coarser_mesh_tends_to():
    assert all([agrees(name) for name in SHIPPED])
