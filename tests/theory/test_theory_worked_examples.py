"""Perturbed roots and Duffing's oscillator: the orders of accuracy the two expansions promise."""

from __future__ import annotations

import numpy as np
import pytest

from theory import worked_examples as examples


def test_perturbed_roots_are_third_order_exact() -> None:
    # the next terms are −ε⁴/128 and +ε⁴/128
    epsilon = np.array([0.4, 0.2, 0.1])
    error = np.abs(examples.perturbed_roots(epsilon) - examples.exact_roots(epsilon))
    np.testing.assert_allclose(error, np.tile(epsilon**4 / 128.0, (2, 1)), rtol=0.02)
    for root in examples.exact_roots(epsilon):
        np.testing.assert_allclose(root**2 - epsilon * root - 1.0, 0.0, atol=1e-15)


def test_direct_integration_conserves_the_oscillator_energy() -> None:
    times = np.linspace(0.0, 60.0, 2001)
    y = examples.duffing_numerical(times, 0.2)
    rate = np.gradient(y, times, edge_order=2)
    energy = rate**2 / 2.0 + y**2 / 2.0 + 0.05 * y**4
    assert np.max(np.abs(energy[2:-2] - 0.55)) < 1e-3
    assert np.max(np.abs(y)) == pytest.approx(1.0, abs=1e-3)


def test_multiple_scales_stay_true_where_the_regular_expansion_grows() -> None:
    times, epsilon = np.linspace(0.0, 60.0, 2001), 0.1
    exact = examples.duffing_numerical(times, epsilon)
    regular = np.abs(examples.duffing_regular(times, epsilon) - exact)
    scales = np.abs(examples.duffing_multiple_scales(times, epsilon) - exact)
    assert np.max(np.abs(examples.duffing_regular(times, epsilon))) > 2.0
    assert np.max(np.abs(examples.duffing_multiple_scales(times, epsilon))) < 1.0 + 1e-12
    assert np.max(scales) < 0.2 < 1.5 < np.max(regular)


def test_both_expansions_are_second_order_at_fixed_time() -> None:
    times = np.linspace(0.0, 3.0, 31)
    for expansion in (examples.duffing_regular, examples.duffing_multiple_scales):
        errors = [np.max(np.abs(expansion(times, e) - examples.duffing_numerical(times, e))) for e in (0.02, 0.01)]
        assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
