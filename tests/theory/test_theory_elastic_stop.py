"""A hinged beam that swings onto an elastic stop."""

import numpy as np
import pytest

from theory.elastic_stop import SwungBeam


def test_a_stiff_beam_is_a_rigid_one_and_its_energy_is_all_in_the_spring():
    rod = SwungBeam(1e4, 0.5, 0.8, 2.0, 300.0, modes=6)
    mass = 0.5 * 0.8 / 3.0  # of the end that has the moment of inertia of the rod
    force, when = rod.peak_force(0.08)
    assert force == pytest.approx(2.0 * 0.8 * np.sqrt(300.0 * mass), rel=2e-3)
    assert when == pytest.approx(0.5 * np.pi * np.sqrt(mass / 300.0), rel=2e-2)  # short waves sit on the flat top
    time, tip = rod.tip(0.3)
    free = time > 1.1 * np.pi * np.sqrt(mass / 300.0)
    assert np.polyfit(time[free], tip[free], 1)[0] == pytest.approx(-1.6, rel=0.01), "off as fast as it came"


def test_modes_converge_and_a_bending_beam_hits_its_stop_again():
    """Code_Aster's SDNL32 with k = 45 kN/m: two contacts in 12 ms, the second the harder."""
    few, many = (SwungBeam(214.49, 0.4704, 0.783, 3.8, 45e3, modes=n) for n in (40, 120))
    assert few.peak_force(0.012) == pytest.approx(many.peak_force(0.012), rel=1e-4)
    touching = np.diff((many.tip(0.012)[1] > 0.0).astype(int))
    assert touching.tolist().count(1) == 2, "at the start and once more"
    assert many.peak_force(0.005)[0] < many.peak_force(0.012)[0]


def test_a_force_that_still_grows_is_not_the_largest():
    with pytest.raises(ValueError, match="end must lie after the largest force"):
        SwungBeam(1e4, 0.5, 0.8, 2.0, 300.0, modes=6).peak_force(0.01)
