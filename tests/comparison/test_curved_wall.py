"""Deflections and slopes before a curved wall are those of the beam, not of what lies between it and the wall."""

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE
from measure.reduction import peak_moment

HOLLOW = Impact.whole_beam(0.4, relative_damping=1e-2).replace(wall_curvature=0.1)
ROCKING = HOLLOW.replace(rotation=0.2, first_touch=0.05)


@pytest.mark.parametrize("impact", [HOLLOW, ROCKING], ids=["middle", "beside it"])
@pytest.mark.parametrize("kind", [HermiteFE, ExudynModel])
def test_the_slope_is_that_of_the_deflection(kind, impact):
    method = kind(mesh=UniformMesh(1 / 40), full_beam=impact is ROCKING)
    history = method.simulate(impact, end_time=0.01, save=5)
    x, slope = history.positions(-1), history.array("slope", -1)
    deflection = -history.array("gap", -1) - 0.5 * impact.wall_curvature * (x - impact.first_touch) ** 2
    assert np.diff(deflection) / np.diff(x) == pytest.approx(0.5 * (slope[1:] + slope[:-1]), abs=5e-4)


@pytest.mark.parametrize("impact", [HOLLOW, ROCKING], ids=["middle", "beside it"])
def test_both_paths_find_the_same_largest_moment(impact):
    methods = (kind(mesh=UniformMesh(1 / 100), full_beam=impact is ROCKING) for kind in (HermiteFE, ExudynModel))
    mine, other = (peak_moment(method.simulate(impact, end_time=0.01, save=20)).moment for method in methods)
    assert mine == pytest.approx(other, rel=0.05)  # with a hundred elements each
