"""Problems: what an id means, and the files that are shipped."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

import open_benchmark
from bent_beam.parts import InputError
from open_benchmark import problem, shipped_ids
from open_benchmark.problem import SCHEMA, problem_text
from open_benchmark.references import reference


@pytest.mark.parametrize("name", shipped_ids())
def test_a_shipped_file_is_what_its_id_says_and_tells_no_answer(name: str) -> None:
    text = (Path(open_benchmark.__file__).parent / "problems" / f"{name}.toml").read_text()
    assert text == problem_text(problem(name))
    tables = tomllib.loads(text)
    assert tables["schema"] == SCHEMA and tables["id"] == name
    assert not any(word in text for word in ("lambda", "r0", "theory", "step", "mesh"))


def test_loads_in_the_file_are_the_scaled_groups() -> None:
    asked = problem("first-0.5--1--1-0.5")
    table = tomllib.loads(problem_text(asked))["impact"]
    assert asked.loads == (-1.0, -1.0, 0.5, 0.0) and asked.base_id == "leading-0.5"
    assert [table[n] / asked.epsilon for n in ("acceleration", "fourth_derivative", "curvature_rate")] == pytest.approx(
        [-1.0, -1.0, 0.5]
    )
    assert asked.uniform_load == 0.0  # the middle lifts off


def test_tension_in_free_flight_puts_no_load_on_the_resting_zone() -> None:
    assert problem("first-0.4--0.4-0-0-1").uniform_load == 0.0  # α = −κN
    held = problem("first-0.4-0-0-0-1")
    assert held.uniform_load == pytest.approx(0.4 * held.epsilon)


@pytest.mark.parametrize(
    "name",
    ["", "leading", "leading-1.5", "leading-0", "leading-nan", "first-0.5-0-0-0", "point-0.5", "bounce-1", "x" * 999],
)
def test_an_id_that_none_has_is_refused_in_one_line(name: str) -> None:
    with pytest.raises(InputError, match="problem: ") as error:
        problem(name)
    assert "\n" not in str(error.value)


def test_the_ladder_gives_the_momentum_that_it_has() -> None:
    end = {
        name: float(reference(problem(name)).impulse(np.array([problem(name).end_time]))[0])
        for name in ("ball", "bar", "string")
    }
    assert end["ball"] == pytest.approx(20.0)  # ten impacts, each reverses unit speed of a unit mass
    assert end["bar"] == pytest.approx(2.0)  # arrives and leaves at unit speed
    assert end["string"] == pytest.approx(16.0)  # four landings of −2∫w_t dx = 4 each
