"""The first instants of a beam that shears: the Hermite path is where `theory.shear` says it is."""

import numpy as np
import pytest

from benchmarks.figures.shear import over_theory, stopped_run
from benchmarks.shear import QUIET, lacking, peak, run
from bent_beam import Impact
from bent_beam.measure.moments import half_contact_length
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE
from hermite_fe.integrators import MoreauJean
from theory import contact_parameters
from theory.shear import StoppedPoint, early_until, first_instants, forgotten_after


@pytest.mark.parametrize("kappa", [0.3, 0.8, 1.0, 3.0])
def test_impulse_and_rim_are_within_two_per_cent_from_the_stated_time_on(kappa: float) -> None:
    found = lacking(kappa, forgotten_after(kappa), 0.1, 0.3)
    assert abs(found["impulse"]) < 0.02 and abs(found.get("rim", 0.0)) < 0.2


def test_an_early_zone_takes_momentum_as_a_string_does() -> None:
    """κ/ν = 0.5: nothing has run ahead of the rim but bending waves, which move little."""
    time = early_until(0.5)
    history = run(0.5, 1.1 * time, 0.01, 0.2)
    found = np.interp(time, history.time, history.array("total_impulse"))
    assert found == pytest.approx(2.0 * np.sqrt(2.0 * time / 0.5), rel=0.01)


def test_a_stopped_point_has_its_impulse_moment_and_mean_reaction() -> None:
    """Reaction as the mean over a tenth of the time before and after."""
    history = stopped_run("hermite", 0.04, 12.0)
    for name in ("impulse", "moment"):
        assert over_theory(history, name)[history.time > 2.9] == pytest.approx(1.0, rel=2e-3)
    for time in (3.0, 10.0):
        around = np.array([0.9, 1.1]) * time
        mean = np.diff(np.interp(around, history.time, history.array("total_impulse")))[0]
        assert mean == pytest.approx(float(np.diff(StoppedPoint(0.2).impulse(around))[0]), rel=2e-3)


def test_damping_keeps_the_zone_of_one_point_short() -> None:
    """Material damping of 5 t_s and κ/ν = 2: without it the zone would be 0.4 l_s long at 3 t_s."""
    impact = Impact(1.0, 1.0, 60.0, 2.0, 1.0, shear_stiffness=1.0, rotary_inertia=0.2, damping=5.0)
    scheme = MoreauJean(theta=0.6, time_step=0.02, growth=0.0)
    method = HermiteFE(mesh=UniformMesh(0.02), integrator=scheme, far_field=QUIET)
    history = method.simulate(impact, end_time=6.0, save=[1.0, 3.0, 6.0])
    for k, time in ((1, 1.0), (2, 3.0), (3, 6.0)):
        place, _, impulse = first_instants(2.0, contact_parameters(2.0), 0.2, time, 5.0)
        assert half_contact_length(history, k) == pytest.approx(place, abs=0.04)
        assert history.array("total_impulse")[k] == pytest.approx(impulse, rel=0.03)


def test_a_soft_wall_rules_the_largest_force() -> None:
    assert peak(5.0, 10.0, 0.2, 0.2) == pytest.approx(1.0, rel=0.02)
