"""Numbers as they are written."""

import math

import pytest

from bent_beam.measure.numbers import Band, Number, number_of


def test_a_number_has_the_digits_of_its_error_bar_and_powers_of_ten_below_1e_4_and_from_1e6_on():
    for number, written in (
        (Number(171.445068e6, 8e5), "(1.714 ± 0.008)e+08"), (Number(-0.004, 0.3), "0.0 ± 0.3"),
        (Number(0.0243, 0.0003), "0.0243 ± 0.0003"), (Number(12345.0, 210.0), "12300 ± 200"),
        (Number(0.149, 0.0149), "0.149 ± 0.015"), (Number(0.5, 0.0196), "0.50 ± 0.02"),
        (Number(0.2, 0.096), "0.20 ± 0.10"), (Number(3.25, 0.0), "3.25"), (Number(math.nan, 0.1), "-"),
        (Number(2e-4, 1e-5), "0.000200 ± 0.000010"), (Number(2e-5, 1e-6), "(2.00 ± 0.10)e-05"),
        (Number(9e5, 1e5), "900000 ± 100000"), (Number(1e6, 1e5), "(1.00 ± 0.10)e+06"),
        (Number(12.94, 53.0), "13 ± 50"), (Number(1018.0, 9051.0), "1000 ± 9000"), (Number(-9.6, 12.0), "-9.6 ± 12"),
        (Number(0.996, 2.0), "1.0 ± 2"), (Number(99.7, 300.0), "100 ± 300"),
        (Number(3.0, 53.0), "3.0 ± 50"), (Number(1.0, 53.0), "0 ± 50"),
        (Band(2.0, 0.31, 5), "2.0 ± 0.3 (band of 5 runs)"), (Band(math.nan, math.nan, 5), "- (band of 5 runs)"),
    ):  # fmt: skip
        assert str(number) == written


def test_a_difference_is_a_share_of_the_theory_or_of_the_least_size_that_counts() -> None:
    small = Number(0.05, 0.02, 0.04)
    assert (small.relative(), small.relative_bar()) == pytest.approx((0.25, 0.5))
    assert (small.relative(1.0), small.relative_bar(1.0)) == pytest.approx((0.01, 0.02))
    assert Number(0.05, 0.02, 0.0).relative() == 0.05
    assert (small.covered, Number(0.05, 0.005, 0.04).covered) == (True, False)
    for one in (Number(1.0, 0.1), Number(None, 0.1, 1.0)):  # without a theory, without a value
        assert (one.difference, one.relative(), one.covered) == (None, None, None)


def test_a_bar_holds_the_error_of_a_run_of_first_order_and_is_at_most_twice_as_wide() -> None:
    """2 + h: with twice the h a run changes by its error. Causes add up; what is known of an error counts as it is."""
    found = number_of(2.1, {"mesh_and_step": 2.2})
    assert found.bar == pytest.approx(1.25 * 0.1) and found.value == 2.1
    assert number_of(2.1, {"mesh_and_step": 2.2, "law": 2.0}, {"drift": 3.0}).bar == pytest.approx(2 * found.bar + 3.0)
    assert number_of(2.1, {"mesh_and_step": 2.2, "law": None}).bar is number_of(2.1, {}).bar is None
    assert number_of(2.0, {"mesh_and_step": 2.0 + 1e-9}).bar == pytest.approx(2e-5)  # chance gives no finer one
    assert number_of(200.0, {"mesh_and_step": 200.0 + 1e-5}).bar == pytest.approx(2e-3)
    assert number_of(2.0, {"mesh_and_step": 2.0}).bar == 0.0  # a count


def test_a_band_is_mean_and_standard_deviation_of_its_runs() -> None:
    assert Band.of([1.0, 2.0, 3.0]) == Band(2.0, 1.0, 3)
    assert Band.of([1.0, 2.0, 3.0]).scaled(2.0, -1.0) == Band(3.0, 2.0, 3)
    assert Band.of([1.0, 2.0, 3.0]).scaled(2.0) == Band(4.0, 2.0, 3)
    assert Number(0.3, 2.0, 0.2).scaled(2.0, 1.0) == Number(1.6, 4.0, 1.4)
    turned = Number(0.3, 2.0, parts={"mesh": 2.0}).scaled(-10.0, name="dN")
    assert turned == Number(-3.0, 20.0, unit="dN", parts={"mesh": 20.0})
