"""What the theory refuses, by name and value."""

import numpy as np
import pytest

from bent_beam import Impact
from theory import ImpactFields, contact_parameters, damped_point, kernel, predict
from theory.bars import DroppedBar, ReleasedBar
from theory.elastic_stop import SwungBeam
from theory.elastic_wall import peak_force
from theory.second_order import second_order
from theory.sideways import sideways
from theory.stopped_beam import StoppedBeam

HALF, TWO = contact_parameters(0.5, -1.0, -1.0), contact_parameters([0.5, 0.6])
PIPE = Impact(1.224e6, 29.02, 90.0, 0.002, 2.0)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: contact_parameters(0.0), r"kappa_over_nu must be positive and finite \(got 0.0\)"),
        (lambda: contact_parameters("0.5"), r"kappa_over_nu must be a number, or an array of numbers \(got '0.5'\)"),
        (lambda: contact_parameters(0.5, alpha=-1e200), r"alpha must not exceed 1e\+100 in size \(got -1e\+200\)"),
        (lambda: contact_parameters(0.5, alpha=np.nan), r"alpha must be finite \(got nan\)"),
        (lambda: second_order(TWO), "one impact"),
        (lambda: kernel.K(0.2, -1.0), "tau"),
        (lambda: ImpactFields(HALF, epsilon=-0.1), "epsilon"),
        (lambda: ImpactFields(HALF, tolerance=0.0), "tolerance"),
        (lambda: ImpactFields(TWO), "parameters"),
        (lambda: ImpactFields(HALF).beam(0.0, -1.0), "tau must not be negative"),
        (lambda: ImpactFields(HALF).beam(np.nan, 1.0), "xi must be finite"),
        (lambda: ImpactFields(HALF, epsilon=0.1).beam(0.0, 5.0), "turns the front back"),
        (lambda: ImpactFields(HALF).complementarity_residual(1.5, 0.1), r"a must lie in \[-1, 1\]"),
        (lambda: StoppedBeam(0.0), r"damping must be positive and finite \(got 0.0\).*divergent series"),
        (lambda: StoppedBeam(1e-20), "damping must be larger"),
        (lambda: StoppedBeam(1e-3).reaction([0.0, 0.1]), "the reaction is infinite"),
        (lambda: StoppedBeam(1e-3).impulse(-1.0), "times must be finite and not negative"),
        (lambda: damped_point.impulse_ratio(0.0), "age must be positive"),
        (lambda: predict(PIPE.replace(left_end="hinged"), [1e-3]), "left_end"),
        (lambda: predict(PIPE.replace(wall_from=-0.1, wall_to=0.1), [1e-3]), "wall_from"),
        (lambda: sideways(PIPE, -1.0, 0.3), "surface_speed"),
        (lambda: sideways(PIPE, 1.0, 0.0), "friction"),
        (lambda: sideways(PIPE, 1.0, 0.3, radius=0.0), "radius"),
        (lambda: peak_force(0.0), "kappa_over_nu"),
        (lambda: peak_force(0.5, -0.1), "wall_damping_ratio"),
        (lambda: SwungBeam(1e4, 0.5, 0.8, -2.0, 300.0), "angular_velocity must be positive"),
        (lambda: DroppedBar().impulse(-1.0), "times must not be negative"),
        (lambda: ReleasedBar().displacement(1.2, 0.0), r"x must lie in \[0, 1.0\]"),
        (lambda: SwungBeam(1e4, 0.5, 0.8, 2.0, 300.0).peak_force(0.01), "end must lie after the largest force"),
    ],
)
def test_refusals_name_what_is_wrong(call, said):
    with pytest.raises(ValueError, match=said):
        call()
