"""The page's tables say what the scores say."""

from __future__ import annotations

import numpy as np
import pytest

from open_benchmark.campaign import Row
from open_benchmark.page import PROPERTIES, errors_table, in_words
from open_benchmark.problem import problem
from open_benchmark.references import reference
from open_benchmark.result import Result
from open_benchmark.score import score


def test_the_table_of_errors_holds_those_of_the_ladder() -> None:
    """The impulse a hundredth too large at all times: an error of a hundredth of its mean over its largest."""
    asked = problem("bar")
    exact = reference(asked).impulse
    assert exact is not None
    tau = np.linspace(0.0, asked.end_time, 400)
    found = score(Result("completed", "", asked, {}, tau, 1.01 * exact(tau)))
    mean = np.mean(exact(tau)) / exact(tau).max()
    row = Row("mine", "bar", "fine", 2.0, found)
    assert errors_table([row], ["mine"]).splitlines()[-1] == f"| mine | {mean:+.3f} (2) |"


@pytest.mark.parametrize(("loads", "word"), [("-0.5-0-0-1", "tension"), ("0.5-0-0--1", "compression")])
def test_an_axial_force_is_called_by_its_sign(loads: str, word: str) -> None:
    assert in_words(problem(f"first-0.5-{loads}")).endswith(f": {word}")
    assert f"first order, {word}" in PROPERTIES
