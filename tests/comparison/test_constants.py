"""The constants of the automatic choices, each halved and doubled alone, at κ/ν away from those it was chosen at.

On the Hermite path they leave λ₀ and r₀ within what the defaults are held to, 0.05 % of the theory (thesis 2.6.21–22)
from κ/ν = 0.25 on and 0.1 % at 0.1; on the Exudyn path within the error bar of ``bentbeam match``, whose companion has
half the resolution.
"""

from dataclasses import replace
from itertools import pairwise

import pytest

from bent_beam import Impact
from comparison.matching import answer
from comparison.rows import MatchQuestion, MatchRow
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
from self_similar_fe import SelfSimilarFE

pytestmark = pytest.mark.verify


@pytest.fixture(params=[0.5, 2.0])
def changed(request, monkeypatch):
    """A method after a constant of a module, or a setting of one of its parts, has been halved or doubled."""

    def change(method, where, name):
        if isinstance(where, str):
            part = getattr(method, where)
            return replace(method, **{where: replace(part, **{name: request.param * getattr(part, name)})})
        value = getattr(where, name)
        many = isinstance(value, tuple)
        scaled = tuple(request.param * v for v in value) if many else type(value)(request.param * value)
        monkeypatch.setattr(where, name, scaled)
        return method

    return change


def row_of(method, kappa, first=None, error_bars="drift") -> MatchRow:
    return answer(MatchQuestion(method, kappa, first, error_bars=error_bars), RunStore(None))


PRESSED, LOADS = (2.0, 0.5, 0.5), ((4.0, 0.0, 0.0), (1.0, 1.0, 1.0))
MESH = ("SMALLEST_ELEMENT", "ELEMENTS_IN_FRONT", "GROWTH", "GROWTH_OUTSIDE", "LARGEST_STEP", "LONGEST_FIRST_STEP")
OF_HERMITE = [
    *((HermiteFE(), resolution, name) for name in MESH),
    (HermiteFE(), SignoriniPosition, "elements_in_first_front"),
    (HermiteFE(far_field=GridViscosity()), "far_field", "viscosity"),
]
HELD_AGAINST_THEORY = [
    *((*one, kappa, None, within) for one in OF_HERMITE for kappa, within in ((0.13, 1e-3), (0.42, 5e-4))),
    *((HermiteFE(), resolution, "THIN", kappa, None, 3e-3) for kappa in (0.004, 0.012)),  # on both sides of it
    *((HermiteFE(), resolution, name, 0.42, PRESSED, 0.01) for name in ("LOADED", "PRESSED_HOLD", "DOMAIN")),
    *((ExudynModel(), exudyn, name, 0.42, PRESSED, 0.03) for name in ("FIRST_ORDER_HOLD", "FIRST_ORDER_STEPS")),
    (ExudynModel(), penalty, "PLASTIC", 0.01, None, 0.015),
    *((ExudynModel(), of_exudyn, name, 0.01, None, 0.015) for name in ("OF_THIN_FRONT", "LEAST_OF_ZONE", "PASSED")),
    *((SelfSimilarFE(), SelfSimilarFE, "perturbation", 0.5, first, 3e-3) for first in LOADS),
    (SelfSimilarFE(), SelfSimilarFE, "perturbation", 0.8, (-1.0, -1.0, 0.0), 3e-3),
]


@pytest.mark.parametrize(("method", "where", "name", "kappa", "first", "within"), HELD_AGAINST_THEORY)
def test_a_constant_halved_or_doubled_leaves_the_theory_s_numbers(method, where, name, kappa, first, within, changed):
    """λ₀ and r₀; under a load λ₁ and r₁, for which ε → 0 is extrapolated to from loads of any size."""
    for number in row_of(changed(method, where, name), kappa, first).compared().values():
        assert abs(number.relative(1.0 if first else 0.0)) < within


OF_DEFAULT = {5e-4: (0.9, 0.25, 0.33, 0.5, 0.71, 0.8, 0.1, 0.13, 0.05, 0.02), 2e-3: (0.01, 1 / 250, 1 / 400, 1 / 1600)}


@pytest.mark.parametrize(("kappa", "within"), [(k, within) for within, kappas in OF_DEFAULT.items() for k in kappas])
def test_the_default_is_right_and_never_pulls(kappa: float, within: float) -> None:
    row = row_of(HermiteFE(), kappa)
    assert max(abs(row.lambda0.relative()), abs(row.r0.relative())) < within
    assert row.lift < 1e-3 and row.pull < 1e-12


@pytest.mark.parametrize("kappa", [0.1, 0.05])
def test_errors_and_lift_fall_with_the_mesh_without_any_hold(kappa: float) -> None:
    for coarse, fine in pairwise(row_of(HermiteFE(refine=refine), kappa) for refine in (0.5, 1.0, 2.0)):
        assert abs(fine.lambda0.relative()) < 0.6 * abs(coarse.lambda0.relative()) and fine.lift < 0.5 * coarse.lift


ZONES = ("GROWTH", "WAVES", "GROWTH_OF_WAVES", "OF_ZONE", "OF_BENDING", "REACH", "REACH_OF_FRONT")
STEPS = (("integrator", "spectral_radius"), (GeneralizedAlpha, "default_step"))
OF_EXUDYN = [
    (ExudynModel(), base, "START"),
    *((ExudynModel(), of_exudyn, name) for name in ZONES),
    (ExudynModel(contact=Penalty(relative_stiffness=penalty.STIFFNESS)), "contact", "relative_stiffness"),
    (ExudynModel(contact=Penalty(relative_damping=penalty.DAMPING)), "contact", "relative_damping"),
    (ExudynModel(element=ANCFCable(viscosity=beam.VISCOSITY)), "element", "viscosity"),
    *((ExudynModel(integrator=GeneralizedAlpha()), *one) for one in STEPS),
]


@pytest.fixture(scope="module")
def chosen() -> MatchRow:
    return row_of(ExudynModel(), 0.33, error_bars="quick")


@pytest.mark.parametrize(("method", "where", "name"), OF_EXUDYN)
def test_a_choice_of_exudyn_s_path_halved_or_doubled_moves_nothing_beyond_its_bar(method, where, name, chosen, changed):
    found = row_of(changed(method, where, name), 0.33)
    for one, usual in zip(found.compared().values(), chosen.compared().values()):
        assert abs(one.known - usual.known) < usual.bar


@pytest.mark.parametrize(("name", "ends"), [("ELEMENT_STEPS", (0.02, 0.08)), ("FEWEST", (2.0,))])
def test_uniform_elements_halved_or_doubled(name, ends, changed):
    """Once waves are back: work of a run, and with it elements by a quarter and steps by half; the fewest elements."""
    impact = Impact.dimensionless(0.4, length=2.0, damping=1e-3)

    def impulses(method: ExudynModel) -> list[float]:
        return [float(method.simulate(impact, end_time=end, save=50).array("total_impulse")[-1]) for end in ends]

    usual = impulses(ExudynModel())
    assert impulses(changed(ExudynModel(), of_exudyn, name)) == pytest.approx(usual, rel=0.01)
