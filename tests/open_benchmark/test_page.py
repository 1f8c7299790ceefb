"""The page's tables say what the scores say."""

import pytest

from measure.measured import Measured
from open_benchmark.campaign import Row
from open_benchmark.judgement import Score
from open_benchmark.page import properties


@pytest.mark.parametrize(
    ("errors", "verdict"),
    [
        ((3e-3, 1e-3), "1 of 1 problems"),
        ((1e-3, 1.5e-3), "0 of 1 problems"),
        ((1e-2, 5e-3), "0 of 1 problems"),
        ((), "no result"),
    ],
)
def test_a_code_converges_where_its_error_falls_and_ends_small(errors, verdict):
    scores = [Score("leading-0.5", "completed", measured={"r0": Measured(1.0 + e, None, 1.0)}) for e in errors]
    rows = [Row("mine", "leading-0.5", name, 1.0, found) for name, found in zip(("coarse", "fine"), scores)]
    rows += [] if errors else [Row("mine", "leading-0.5", "fine", 1.0, Score("leading-0.5", "timeout"))]
    table = properties(rows, "mine")
    assert table["converges"] == verdict and table["noise"] == ("not reported" if errors else "timeout")
