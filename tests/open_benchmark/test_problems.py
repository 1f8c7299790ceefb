"""Problems: what an id means, and the files that are shipped."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import open_benchmark
from bent_beam.parts import InputError
from open_benchmark import problem, shipped_ids
from open_benchmark.problem import SCHEMA, problem_text
from open_benchmark.references import reference


def test_a_shipped_file_is_what_its_id_says_and_tells_no_answer():
    assert {"leading-0.5", "ball", "bounce-2-1e-3"} <= set(shipped_ids())
    for name in shipped_ids():
        text = (Path(open_benchmark.__file__).parent / "problems" / f"{name}.toml").read_text()
        assert text == problem_text(problem(name)), name
        tables = tomllib.loads(text)
        assert tables["schema"] == SCHEMA and tables["id"] == name
        assert not any(word in text for word in ("lambda", "r0", "theory", "step", "mesh"))


def test_loads_in_the_file_are_the_scaled_groups():
    asked = problem("first-0.5--1--1-0.5")
    table = tomllib.loads(problem_text(asked))["impact"]
    assert asked.loads == (-1.0, -1.0, 0.5, 0.0) and asked.base_id == "leading-0.5"
    given = [table[name] / asked.epsilon for name in ("acceleration", "fourth_derivative", "curvature_rate")]
    assert given == pytest.approx([-1.0, -1.0, 0.5])


@pytest.mark.parametrize(
    ("name", "load"),
    [
        ("first-0.5--1--1-0.5", 0.0),  # the middle lifts off
        ("first-0.4--0.4-0-0-1", 0.0),  # tension in free flight: α = −κN
        ("first-0.4-0-0-0-1", 0.4),
        ("first-0.4-1-2-0", 3.0),
    ],
)
def test_the_resting_zone_carries_what_statics_says(name, load):
    asked = problem(name)
    assert asked.uniform_load == pytest.approx(load * asked.epsilon)


@pytest.mark.parametrize(
    "name",
    ["", "leading", "leading-1.5", "leading-0", "leading-nan", "first-0.5-0-0-0", "point-0.5", "bounce-1", "x" * 999],
)
def test_an_id_that_none_has_is_refused_in_one_line(name):
    with pytest.raises(InputError, match="problem: ") as error:
        problem(name)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("name", "momentum"),
    [
        ("ball", 20.0),  # ten impacts, each reverses unit speed of a unit mass
        ("bar", 2.0),  # arrives and leaves at unit speed
        ("string", 16.0),  # four landings of −2∫w_t dx = 4 each
    ],
)
def test_the_ladder_gives_the_momentum_that_it_has(name, momentum):
    asked = problem(name)
    exact = reference(asked).impulse
    assert exact is not None and exact(np.array([asked.end_time])) == pytest.approx([momentum])
