"""Beams under an axial force."""

import pytest

import exudyn_models
from bent_beam import Impact
from exudyn_models import ExudynModel
from exudyn_models.elements import ANCFCable
from exudyn_models.geometry import LinearLimit, TrueGeometry

verify = pytest.mark.verify


@pytest.mark.parametrize(("end", "refine"), [(0.005, 0.25), pytest.param(0.1, 1.0, marks=verify)])
def test_a_very_small_axial_force_changes_nothing(end, refine):
    """Its stiff bar has a round-off far above the residual of an unpulled beam."""
    beam, method = Impact.whole_beam(2.0), ExudynModel(refine=refine)
    pulled, free = (method.simulate(beam.replace(axial_force=n), end_time=end, save=5) for n in (1e-8, 0.0))
    assert pulled.array("total_impulse")[-1] == pytest.approx(free.array("total_impulse")[-1], rel=1e-6)


def test_an_axial_stiffness_may_be_given_beside_an_axial_force_however_small():
    weak = Impact.whole_beam(2.0).replace(axial_force=1e-8)
    assert ExudynModel(element=ANCFCable(axial_stiffness=1.0)).refuses(weak) is None


@verify
def test_a_real_beam_under_tension_gives_the_impulse_of_the_linear_limit():
    impact = Impact.dimensionless(0.5, epsilon_axial=20.0, epsilon_alpha=-10.0).replace(section_height=1e-2)
    end = 1e-3
    kinds = LinearLimit(), TrueGeometry()
    linear, true = (exudyn_models.simulate(impact, end_time=end, geometry=g, save=50) for g in kinds)
    assert true.array("total_impulse")[-1] == pytest.approx(linear.array("total_impulse")[-1], rel=5e-3)
