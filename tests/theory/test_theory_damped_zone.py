"""A damped zone: one point at first, the undamped zone at last; its table joins both."""

from __future__ import annotations

import numpy as np
import pytest

from theory import contact_parameters, damped_point, damped_zone

KAPPAS = (0.02, 0.1, 0.3, 0.5, 0.77, 0.93)


@pytest.mark.parametrize("kappa", KAPPAS)
def test_it_spreads_when_the_wall_has_straightened_the_point(kappa: float) -> None:
    point = damped_zone.age_of_spreading(kappa)
    r0 = contact_parameters(kappa).r0
    length, reaction, impulse = damped_zone.ratios(kappa, r0, point * np.array([0.5, 1.0, 1.05, 1.5]))
    assert np.all(length[:2] == 0.0) and 0.0 < length[2] < length[3]
    assert reaction[:2] * r0 == pytest.approx(damped_point.reaction_ratio(point * np.array([0.5, 1.0])), rel=1e-12)
    if point > 0.05:  # the measured part goes on where the exact one ends
        assert reaction[2] == pytest.approx(reaction[1], rel=0.05)
        assert impulse[2] == pytest.approx(impulse[1], rel=0.05)


@pytest.mark.parametrize("kappa", KAPPAS)
def test_damping_is_forgotten_in_the_end(kappa: float) -> None:
    r0 = contact_parameters(kappa).r0
    late = np.abs(damped_zone.ratios(kappa, r0, np.array([3e2, 3e5, 3e9])) - 1.0)
    assert np.all(late[:, 2] < 1e-3)
    assert np.all(late[2, 1:] <= late[2, :-1])


def test_impulse_is_the_integral_of_the_reaction() -> None:
    # J/J₀ = T^{−1/2} ∫ (R/R₀) d√T
    for kappa in KAPPAS:
        root = np.linspace(2.0, 12.0, 2001)
        _, reaction, impulse = damped_zone.ratios(kappa, contact_parameters(kappa).r0, root**2)
        gained = np.trapezoid(reaction, root)
        assert impulse[-1] * root[-1] - impulse[0] * root[0] == pytest.approx(gained, rel=5e-3)


def test_what_loads_add_dies_out_with_damping() -> None:
    early, late = (np.abs(damped_zone.load_rates(0.3, [age])).max() for age in (10.0, 1e8))
    assert late <= 1e-3 * early


def test_what_loads_make_of_a_short_zone_does_not_wait_for_it_to_spread() -> None:
    point = damped_zone.age_of_spreading(0.9)
    early, spreading, late, later = damped_zone.waiting(0.9, point * np.array([0.5, 1.5, 10.0, 1e6]))
    assert early == 0.0  # one point has no length
    assert spreading > late > later and later < 1e-6
    assert damped_zone.waiting(0.3, [5.0])[0] == 0.0  # there the rates of loads are measured


def test_a_pressed_flat_zone_bears_less_while_its_middle_is_lifted() -> None:
    # rates on elements half as long as the table's: 0.75, −1.13 and −0.41 at κ/ν = 0.2, t/η = 9.5
    found = damped_zone.press_factors(0.2, [9.5], 0.02)[:, 0]
    assert found == pytest.approx([1.0 + 0.02 * 0.75, 1.0 - 0.02 * 1.13, 1.0 - 0.02 * 0.41], abs=0.004)
    part = damped_zone.press_factors(0.225, [9.5], 0.02)[:, 0]
    whole = 1.0 + 0.02 * damped_zone.load_rates(0.225, [9.5])[damped_zone.LOADS.index("press"), :, 0]
    assert part - 1.0 == pytest.approx(0.5 * (whole - 1.0), rel=1e-9)
    assert np.all(damped_zone.press_factors(0.3, [9.5], 0.02) == 1.0)
