"""Constants of the automatic choices: one at a time halved and doubled, none moves λ₀ or r₀ by more than the error bar.

At a κ/ν at which nothing was chosen; the bar is that of ``bentbeam match``, with a companion of half the resolution.
"""

import pytest

from bent_beam import Impact
from bent_beam.measure.estimators import LeadingEstimate, leading_order
from bent_beam.measure.moments import Moments, moments
from comparison.matching import answer
from comparison.rows import MatchQuestion
from comparison.store import RunStore
from exudyn_models import ExudynModel, method, resolution
from exudyn_models.contacts import Penalty, base, penalty
from exudyn_models.elements import ANCFCable, beam
from exudyn_models.integrators import GeneralizedAlpha

pytestmark = pytest.mark.verify

IMPACT = Impact.dimensionless(0.33)
END = 0.1 * IMPACT.time_scale


def run(method: ExudynModel) -> Moments:
    return moments(method.simulate(IMPACT, end_time=END, save=250))


@pytest.fixture(scope="module")
def chosen() -> LeadingEstimate:
    return leading_order(run(ExudynModel()), companions=[run(ExudynModel().refined(0.5))])


def does_not_move(method: ExudynModel, chosen: LeadingEstimate) -> None:
    found = leading_order(run(method))
    assert abs(found.lambda0.value - chosen.lambda0.value) < chosen.lambda0.bar
    assert abs(found.r0.value - chosen.r0.value) < chosen.r0.bar


@pytest.mark.parametrize("factor", [0.5, 2.0])
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


@pytest.mark.parametrize("factor", [0.5, 2.0])
@pytest.mark.parametrize(
    "name", ["START", "GROWTH", "WAVES", "GROWTH_OF_WAVES", "OF_ZONE", "OF_BENDING", "REACH", "REACH_OF_FRONT"]
)
def test_a_constant_halved_or_doubled(name, factor, chosen, monkeypatch):
    module = base if name == "START" else resolution
    monkeypatch.setattr(module, name, getattr(module, name) * factor)
    does_not_move(ExudynModel(), chosen)


@pytest.mark.parametrize("factor", [0.5, 2.0])
@pytest.mark.parametrize("name", ["PLASTIC", "OF_THIN_FRONT", "LEAST_OF_ZONE", "PASSED"])
def test_a_constant_of_thin_fronts_halved_or_doubled(name: str, factor: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """λ₀ and r₀ stay within 1.5 % of theory where the bending ahead of the front is not resolved."""
    module = penalty if name == "PLASTIC" else resolution
    monkeypatch.setattr(module, name, getattr(module, name) * factor)
    row = answer(MatchQuestion(ExudynModel(), 1 / 100, error_bars="drift"), RunStore(None))
    for number in (row.lambda0, row.r0):
        assert number.value == pytest.approx(number.theory, rel=0.015)


@pytest.mark.parametrize("factor", [0.5, 2.0])
@pytest.mark.parametrize(("name", "ends"), [("ELEMENT_STEPS", (0.02, 0.08)), ("FEWEST", (2.0,))])
def test_uniform_elements_halved_or_doubled(name, ends, factor, monkeypatch):
    """Once waves are back: work of a run, and with it elements by a quarter and steps by half; the fewest elements."""
    impact = Impact.dimensionless(0.4, length=2.0, damping=1e-3)

    def impulse(end: float) -> float:
        return float(ExudynModel().simulate(impact, end_time=end, save=50).array("total_impulse")[-1])

    chosen = [impulse(end) for end in ends]
    monkeypatch.setattr(resolution, name, getattr(resolution, name) * factor)
    assert [impulse(end) for end in ends] == pytest.approx(chosen, rel=0.01)


@pytest.mark.parametrize("factor", [0.5, 2.0])
@pytest.mark.parametrize("name", ["FIRST_ORDER_HOLD", "FIRST_ORDER_STEPS"])
def test_a_constant_of_loaded_runs_halved_or_doubled(name: str, factor: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """λ₁ and r₁ stay within 3 % of theory under a load that presses."""
    value = getattr(method, name)
    monkeypatch.setattr(method, name, type(value)(factor * value))
    row = answer(MatchQuestion(ExudynModel(), 0.42, (2.0, 0.5, 0.5), error_bars="drift"), RunStore(None))
    for number in (row.lambda1, row.r1):
        assert number.value == pytest.approx(number.theory, abs=0.03 * max(abs(number.theory), 1.0))
