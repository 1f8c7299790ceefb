"""The largest bending moment of simulated impacts is that of theory, m(κ/ν), on two independent paths; before a curved
wall deflections and slopes are those of the beam, not of what lies between it and the wall."""

import json

import numpy as np
import pytest

from benchmarks.figures.moment import FOLDER, KAPPAS, PATHS, MeasuredMoment, measure_moment
from bent_beam import Impact
from bent_beam.measure import reduction
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE
from theory.similarity import peak_moment

WITHIN = 0.005
HOLLOW = Impact.whole_beam(0.4, relative_damping=1e-2).replace(wall_curvature=0.1)
ROCKING = HOLLOW.replace(rotation=0.2, first_touch=0.05)


def test_stored_points_are_within_half_a_percent_of_theory() -> None:
    points = [MeasuredMoment(**p) for p in json.loads((FOLDER / "peak-moment.json").read_text())["points"]]
    assert {p.kappa_over_nu for p in points} == set(KAPPAS)
    assert len({p.label for p in points}) == len(PATHS)
    for p in points:
        assert p.theory == pytest.approx(peak_moment(p.kappa_over_nu).largest)
        assert abs(p.value / p.theory - 1.0) < WITHIN, p


def test_moment_of_a_quick_run_is_that_of_theory_and_steady() -> None:
    found = measure_moment(HermiteFE(), 0.5)
    assert found.value == pytest.approx(found.theory, rel=WITHIN)
    assert found.error < 0.01 * found.theory


@pytest.mark.parametrize("impact", [HOLLOW, ROCKING], ids=["middle", "beside it"])
def test_before_a_curved_wall_the_slope_is_that_of_the_deflection_and_both_paths_find_the_same_moment(impact) -> None:
    moments = []
    for kind in (HermiteFE, ExudynModel):
        method = kind(mesh=UniformMesh(1 / 100))  # of both halves where it rocks
        history = method.simulate(impact, end_time=0.01, save=20)
        x, slope = history.positions(-1), history.array("slope", -1)
        deflection = -history.array("gap", -1) - 0.5 * impact.wall_curvature * (x - impact.first_touch) ** 2
        assert np.diff(deflection) / np.diff(x) == pytest.approx(0.5 * (slope[1:] + slope[:-1]), abs=5e-4)
        moments.append(reduction.peak_moment(history).moment)
    assert moments[0] == pytest.approx(moments[1], rel=0.05)
