"""The constants of the automatic choices: halved and doubled they leave λ₀ and r₀ within what the defaults are held to,
0.05 % from κ/ν = 0.25 on and 0.1 % at 0.1, of the theory (thesis 2.6.21–22).

Each is changed alone, at κ/ν away from the points that anything was chosen at.
"""

from itertools import pairwise

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.measure.estimators import LeadingEstimate, leading_order
from bent_beam.measure.moments import moments
from comparison.matching import answer
from comparison.rows import MatchQuestion
from comparison.store import RunStore
from hermite_fe import HermiteFE, resolution
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import SignoriniPosition
from theory import contact_parameters

WITHIN = {0.13: 1e-3, 0.42: 5e-4}  # of λ₀ and r₀, strictly unilateral
CONSTANTS = [
    *((resolution, name) for name in ("SMALLEST_ELEMENT", "ELEMENTS_IN_FRONT", "GROWTH", "GROWTH_OUTSIDE")),
    *((resolution, name) for name in ("LARGEST_STEP", "LONGEST_FIRST_STEP")),
    (SignoriniPosition, "elements_in_first_front"),
]
pytestmark = pytest.mark.verify


def leading(kappa: float, **parts: object) -> LeadingEstimate:
    history = HermiteFE(**parts).simulate(Impact.dimensionless(kappa), end_time=0.1)  # type: ignore[arg-type]
    return leading_order(moments(history))


def agrees(found: LeadingEstimate, kappa: float, within: float) -> None:
    exact = contact_parameters(kappa)
    assert found.lambda0.value == pytest.approx(float(exact.lambda0), rel=within)
    assert found.r0.value == pytest.approx(float(exact.r0), rel=within)


@pytest.mark.parametrize("kappa", WITHIN)
@pytest.mark.parametrize("factor", [0.5, 2.0])
@pytest.mark.parametrize(("where", "name"), CONSTANTS)
def test_a_constant_halved_or_doubled(where, name, factor, kappa, monkeypatch):
    monkeypatch.setattr(where, name, getattr(where, name) * factor)
    agrees(leading(kappa), kappa, WITHIN[kappa])


@pytest.mark.parametrize("kappa", WITHIN)
@pytest.mark.parametrize("viscosity", [0.15, 0.6])
def test_grid_viscosity_halved_or_doubled(viscosity: float, kappa: float) -> None:
    agrees(leading(kappa, far_field=GridViscosity(viscosity=viscosity)), kappa, WITHIN[kappa])


@pytest.mark.parametrize("kappa", [0.9, 0.25, 0.33, 0.5, 0.71, 0.8, 0.1, 0.13, 0.05, 0.02])
def test_the_default_is_right_and_never_pulls(kappa: float) -> None:
    history = HermiteFE().simulate(Impact.dimensionless(kappa), end_time=0.1)
    found = leading_order(moments(history))
    agrees(found, kappa, 5e-4)
    assert found.lift < 1e-3
    assert np.diff(history.array("impulse"), axis=0).min() >= -1e-12 * history.array("impulse").max()


@pytest.mark.parametrize("kappa", [0.1, 0.05])
def test_errors_and_lift_fall_with_the_mesh_without_any_hold(kappa: float) -> None:
    exact = contact_parameters(kappa)
    runs = []
    for refine in (0.5, 1.0, 2.0):
        history = HermiteFE(refine=refine).simulate(Impact.dimensionless(kappa), end_time=0.1)
        runs.append(leading_order(moments(history)))
    for coarse, fine in pairwise(runs):
        assert abs(fine.lambda0.value - float(exact.lambda0)) < 0.6 * abs(coarse.lambda0.value - float(exact.lambda0))
        assert fine.lift < 0.5 * coarse.lift


@pytest.mark.parametrize("kappa", [1 / 100, 1 / 250, 1 / 400, 1 / 1600])
def test_thin_fronts_are_within_half_a_per_cent(kappa: float) -> None:
    agrees(leading(kappa), kappa, 2e-3)


@pytest.mark.parametrize("thin", [0.0025, 0.02])
def test_where_even_elements_begin_does_not_matter(thin: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """κ/ν on either side of ``THIN`` moved."""
    monkeypatch.setattr(resolution, "THIN", thin)
    for kappa in (0.004, 0.012):
        agrees(leading(kappa), kappa, 3e-3)


@pytest.mark.parametrize(
    ("name", "factor"),
    [(name, factor) for name in ("LOADED", "PRESSED_HOLD", "DOMAIN") for factor in (0.5, 2.0)],
)
def test_a_constant_of_loaded_runs_halved_or_doubled(name: str, factor: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """λ₁ and r₁ stay within 1 % of theory under a load that presses."""
    value = getattr(resolution, name)
    changed = tuple(factor * v for v in value) if isinstance(value, tuple) else type(value)(factor * value)
    monkeypatch.setattr(resolution, name, changed)
    row = answer(MatchQuestion(HermiteFE(), 0.42, (2.0, 0.5, 0.5), error_bars="drift"), RunStore(None))
    for number in (row.lambda1, row.r1):
        assert number.value == pytest.approx(number.theory, abs=0.01 * max(abs(number.theory), 1.0))
