"""Numbers as they are written."""

import math

import pytest

from measure.measured import Band, Measured


@pytest.mark.parametrize(
    ("value", "error", "written"),
    [
        (171.445068e6, 8e5, "(1.714 ± 0.008)e+08"),
        (-0.004, 0.3, "0.0 ± 0.3"),
        (0.0243, 0.0003, "0.0243 ± 0.0003"),
        (12345.0, 210.0, "12300 ± 200"),
        (3.25, 0.0, "3.25"),
        (math.nan, 0.1, "-"),
    ],
)
def test_a_number_has_the_digits_of_its_error_bar(value: float, error: float, written: str) -> None:
    assert str(Measured(value, error)) == written


def test_a_band_that_is_not_known_is_missing() -> None:
    assert str(Band(2.0, 0.31, 5)) == "2.0 ± 0.3 (band of 5 runs)"
    assert str(Band(math.nan, math.nan, 5)) == "- (band of 5 runs)"
