"""The constants of the automatic choices, each halved and doubled alone, at κ/ν away from those it was chosen at.

On the Hermite path they leave λ₀ and r₀ within what the defaults are held to, 0.05 % of the theory (thesis 2.6.21–22)
from κ/ν = 0.25 on and 0.1 % at 0.1; on the Exudyn path within the error bar of ``bentbeam match``, whose companion has
half the resolution.
"""

from itertools import pairwise

import numpy as np
import pytest

from bent_beam import Impact, ImpactHistory
from bent_beam.measure.estimators import LeadingEstimate, leading_order
from bent_beam.measure.moments import moments
from bent_beam.method import Method
from comparison.matching import answer
from comparison.rows import MatchQuestion
from comparison.store import RunStore
from exudyn_models import ExudynModel
from exudyn_models import method as exudyn
from exudyn_models import resolution as of_exudyn
from exudyn_models.contacts import Penalty, base, penalty
from exudyn_models.elements import ANCFCable, beam
from exudyn_models.integrators import GeneralizedAlpha
from hermite_fe import HermiteFE, resolution
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import SignoriniPosition
from theory import contact_parameters

pytestmark = pytest.mark.verify


@pytest.fixture(params=[0.5, 2.0])
def factor(request):
    return request.param


@pytest.fixture
def change(factor, monkeypatch):
    def changed(where, name):
        value = getattr(where, name)
        scaled = tuple(factor * v for v in value) if isinstance(value, tuple) else type(value)(factor * value)
        monkeypatch.setattr(where, name, scaled)

    return changed


def simulated(method: Method, kappa: float) -> ImpactHistory:
    return method.simulate(Impact.dimensionless(kappa), end_time=0.1, save=250)


def leading(method: Method, kappa: float) -> LeadingEstimate:
    return leading_order(moments(simulated(method, kappa)))


PRESSED = (2.0, 0.5, 0.5)
OF_ROWS = [
    *((HermiteFE(), 0.42, PRESSED, resolution, name, 0.01) for name in ("LOADED", "PRESSED_HOLD", "DOMAIN")),
    *((ExudynModel(), 0.42, PRESSED, exudyn, name, 0.03) for name in ("FIRST_ORDER_HOLD", "FIRST_ORDER_STEPS")),
    (ExudynModel(), 0.01, None, penalty, "PLASTIC", 0.015),
    *((ExudynModel(), 0.01, None, of_exudyn, name, 0.015) for name in ("OF_THIN_FRONT", "LEAST_OF_ZONE", "PASSED")),
]


@pytest.mark.parametrize(("method", "kappa", "first", "where", "name", "within"), OF_ROWS)
def test_a_constant_of_loaded_runs_and_of_thin_fronts_halved_or_doubled(
    method, kappa, first, where, name, within, change
):
    """λ₁ and r₁ stay near theory under a load that presses, λ₀ and r₀ where the bending ahead of the front is not
    resolved."""
    change(where, name)
    row = answer(MatchQuestion(method, kappa, first, error_bars="drift"), RunStore(None))
    for number in (row.lambda1, row.r1) if first else (row.lambda0, row.r0):
        assert abs(number.relative(1.0 if first else 0.0)) < within


# --- the Hermite path -------------------------------------------------------------------------------------------------

WITHIN = {0.13: 1e-3, 0.42: 5e-4}  # of λ₀ and r₀, strictly unilateral
MESH = ("SMALLEST_ELEMENT", "ELEMENTS_IN_FRONT", "GROWTH", "GROWTH_OUTSIDE", "LARGEST_STEP", "LONGEST_FIRST_STEP")
CONSTANTS = [
    *((resolution, name, WITHIN) for name in MESH),
    (SignoriniPosition, "elements_in_first_front", WITHIN),
    (resolution, "THIN", dict.fromkeys((0.004, 0.012), 3e-3)),  # κ/ν on either side of it: where even elements begin
]


def agrees(found: LeadingEstimate, kappa: float, within: float) -> None:
    exact = contact_parameters(kappa)
    assert found.lambda0.value == pytest.approx(float(exact.lambda0), rel=within)
    assert found.r0.value == pytest.approx(float(exact.r0), rel=within)


@pytest.mark.parametrize(("where", "name", "within"), CONSTANTS)
def test_a_constant_halved_or_doubled(where, name, within, change):
    change(where, name)
    for kappa, share in within.items():
        agrees(leading(HermiteFE(), kappa), kappa, share)


@pytest.mark.parametrize("kappa", WITHIN)
def test_grid_viscosity_halved_or_doubled(kappa: float, factor: float) -> None:
    method = HermiteFE(far_field=GridViscosity(viscosity=factor * GridViscosity().viscosity))
    agrees(leading(method, kappa), kappa, WITHIN[kappa])


@pytest.mark.parametrize(
    ("kappa", "within"),
    [
        *((kappa, 5e-4) for kappa in (0.9, 0.25, 0.33, 0.5, 0.71, 0.8, 0.1, 0.13, 0.05, 0.02)),
        *((kappa, 2e-3) for kappa in (1 / 100, 1 / 250, 1 / 400, 1 / 1600)),
    ],
)
def test_the_default_is_right_and_never_pulls(kappa: float, within: float) -> None:
    history = simulated(HermiteFE(), kappa)
    found = leading_order(moments(history))
    agrees(found, kappa, within)
    assert found.lift < 1e-3
    assert np.diff(history.array("impulse"), axis=0).min() >= -1e-12 * history.array("impulse").max()


@pytest.mark.parametrize("kappa", [0.1, 0.05])
def test_errors_and_lift_fall_with_the_mesh_without_any_hold(kappa: float) -> None:
    exact = float(contact_parameters(kappa).lambda0)
    for coarse, fine in pairwise(leading(HermiteFE(refine=refine), kappa) for refine in (0.5, 1.0, 2.0)):
        assert abs(fine.lambda0.value - exact) < 0.6 * abs(coarse.lambda0.value - exact)
        assert fine.lift < 0.5 * coarse.lift


# --- the Exudyn path --------------------------------------------------------------------------------------------------

OF_ZONES = ("START", "GROWTH", "WAVES", "GROWTH_OF_WAVES", "OF_ZONE", "OF_BENDING", "REACH", "REACH_OF_FRONT")


@pytest.fixture(scope="module")
def chosen() -> LeadingEstimate:
    run, companion = (moments(simulated(method, 0.33)) for method in (ExudynModel(), ExudynModel().refined(0.5)))
    return leading_order(run, companions=[companion])


def does_not_move(method: ExudynModel, chosen: LeadingEstimate) -> None:
    found = leading(method, 0.33)
    assert abs(found.lambda0.value - chosen.lambda0.value) < chosen.lambda0.bar
    assert abs(found.r0.value - chosen.r0.value) < chosen.r0.bar


@pytest.mark.parametrize(
    "part",
    [
        lambda f: {"contact": Penalty(relative_stiffness=penalty.STIFFNESS * f)},
        lambda f: {"contact": Penalty(relative_damping=penalty.DAMPING * f)},
        lambda f: {"element": ANCFCable(viscosity=beam.VISCOSITY * f)},
        lambda f: {"integrator": GeneralizedAlpha(relative_step=GeneralizedAlpha.default_step * f)},
        lambda f: {"integrator": GeneralizedAlpha(spectral_radius=GeneralizedAlpha().spectral_radius * f)},
    ],
    ids=["C", "D", "viscosity", "relative_step", "spectral_radius"],
)
def test_a_setting_halved_or_doubled(part, factor: float, chosen: LeadingEstimate) -> None:
    does_not_move(ExudynModel(**part(factor)), chosen)


@pytest.mark.parametrize("name", OF_ZONES)
def test_a_constant_of_exudyn_s_choices_halved_or_doubled(name, chosen, change):
    change(base if name == "START" else of_exudyn, name)
    does_not_move(ExudynModel(), chosen)


@pytest.mark.parametrize(("name", "ends"), [("ELEMENT_STEPS", (0.02, 0.08)), ("FEWEST", (2.0,))])
def test_uniform_elements_halved_or_doubled(name, ends, change):
    """Once waves are back: work of a run, and with it elements by a quarter and steps by half; the fewest elements."""
    impact = Impact.dimensionless(0.4, length=2.0, damping=1e-3)

    def impulse(end: float) -> float:
        return float(ExudynModel().simulate(impact, end_time=end, save=50).array("total_impulse")[-1])

    chosen = [impulse(end) for end in ends]
    change(of_exudyn, name)
    assert [impulse(end) for end in ends] == pytest.approx(chosen, rel=0.01)
