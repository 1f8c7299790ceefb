"""A wall that gives way: elements and the beam's Green's function agree in the largest force."""

import pytest

from bent_beam import Impact
from bent_beam.measure.reduction import wall_peaks
from comparison.predict_text import wall_lines
from hermite_fe import HermiteFE
from theory import predict


@pytest.mark.parametrize(
    ("kappa_over_nu", "damping_ratio", "agree"),
    [(2.0, 0.5, 7e-3), pytest.param(0.5, 0.0, 3e-3, marks=pytest.mark.verify)],
)
def test_elements_and_theory_agree_in_the_largest_force(
    kappa_over_nu: float, damping_ratio: float, agree: float
) -> None:
    impact = Impact(1.0, 1.0, 120.0, kappa_over_nu, 1.0, wall_stiffness=1.0, wall_damping=2.0 * damping_ratio)
    wall = predict(impact).wall
    assert wall is not None and wall.peak_force is not None and wall.penetration is not None
    found = wall_peaks(HermiteFE(refine=0.5).simulate(impact, end_time=3.0, save=9))
    assert found is not None
    assert found.force == pytest.approx(wall.peak_force, rel=agree)
    assert found.penetration == pytest.approx(wall.penetration, rel=0.01)


def test_text_names_the_force_and_what_makes_the_beam_another() -> None:
    impact = Impact(1.2e6, 29.0, 4.0, 0.002, 2.0, wall_stiffness=2e8)
    lines = wall_lines(predict(impact).to_dict())
    assert "kN" in lines[0] and "ends" in lines[-1]
    assert wall_lines(predict(impact.replace(wall_stiffness=None)).to_dict()) == []
