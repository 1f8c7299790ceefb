"""The expanding mesh: self-similar impacts at rest in it, held against literal values of the theory (thesis 2.6.21–22).
"""

import numpy as np
import pytest

from bent_beam import Impact, SimulationError
from comparison.estimators import SIDE, first_order, leading_order, moments
from self_similar_fe import ExpandingMesh, SelfSimilarFE
from self_similar_fe.run import _Run, similarity, simulate_expanding
from self_similar_fe.similarity import Similarity

EXACT = {  # κ/ν: λ₀, r₀
    1 / 1600: (56.5684099145, 35.4490354773),
    0.05: (6.23692857563, 3.93727884942),
    0.1: (4.25760478009, 2.74499113477),
    0.25: (2.26148623298, 1.66800147203),
    0.5: (1.01886591389, 1.17721208090),
    0.8: (0.296846693037, 1.01915199895),
}
QUICK = ExpandingMesh(decades=2.0)


@pytest.mark.parametrize("ratio", [0.05, 0.1, 0.25, 0.5, 0.8])
def test_leading_order_to_a_few_hundred_thousandths(ratio):
    found = leading_order(moments(simulate_expanding(Impact.dimensionless(ratio), QUICK, end_time=0.1)))
    lambda0, r0 = EXACT[ratio]
    assert found.lambda0.value == pytest.approx(lambda0, rel=5e-5)
    assert found.r0.value == pytest.approx(r0, rel=3e-5)
    assert found.lift < 5e-5


def test_a_nearly_flat_beam():
    """κ/ν = 1/1600, where no fixed mesh resolves the front: the held start alone is right to 0.01 %."""
    state = similarity(1 / 1600, ExpandingMesh(front_resolution=0.05))
    lambda0, r0 = EXACT[1 / 1600]
    assert state.front == pytest.approx(lambda0, rel=1e-4)
    assert state.reaction.sum() / SIDE == pytest.approx(r0, rel=1e-4)


def test_a_strongly_bent_beam_touches_at_one_point():
    history = simulate_expanding(Impact.dimensionless(2.0), QUICK, end_time=0.1)
    assert np.all(history.array("in_contact")[:, 1:] == 0)
    assert leading_order(moments(history)).r0.value == pytest.approx(1.0, rel=5e-5)


def test_the_far_field_does_not_come_back():
    """Doubling the clear distance and the absorber moves λ₀ and r₀ by less than 0.01 %."""
    near = similarity(0.5, ExpandingMesh())
    far = similarity(0.5, ExpandingMesh(absorber_start=16.0, absorber_length=32.0))
    assert near.front == pytest.approx(far.front, rel=1e-4)
    assert near.reaction.sum() == pytest.approx(far.reaction.sum(), rel=1e-4)


def test_energy_of_the_fast_part_is_the_work_of_the_wall():
    """½∫(z_t² + z_xx²) = V₀∫R dt less what the absorber took (theory.md, section 5): nothing is lost at the front."""
    budget = simulate_expanding(Impact.dimensionless(0.5), QUICK, end_time=0.1).energy_budget()
    assert abs(budget["loss_algorithmic"]) < 2e-4 * budget["work_of_loads"]
    assert abs(budget["defect"]) < 1e-5 * budget["work_of_loads"]


@pytest.mark.parametrize("term", ["strain", "reaction", "velocity"])
def test_a_falsified_energy_shows_as_a_defect(term, monkeypatch):
    """The algorithmic loss is found from the state, not from the balance: what is wrong elsewhere stays visible."""
    if term == "strain":
        strain = _Run._strain
        monkeypatch.setattr(_Run, "_strain", lambda self, tau: 1.1 * strain(self, tau))
    elif term == "reaction":
        step = Similarity.step

        def pressed(self, obstacle):
            step(self, obstacle)
            self.reaction = 1.1 * self.reaction

        monkeypatch.setattr(Similarity, "step", pressed)
    else:
        power = _Run.absorber_power
        monkeypatch.setattr(_Run, "absorber_power", lambda self: 1.5 * power(self))
    budget = simulate_expanding(Impact.dimensionless(0.5), QUICK, end_time=0.1).energy_budget()
    assert abs(budget["defect"]) > 0.02 * budget["work_of_loads"]


def test_what_breaks_self_similarity_is_refused_by_name():
    impact = Impact.dimensionless(0.5)
    for name in ("damping", "rotation", "first_touch", "opposite_wall"):
        other = impact.replace(**{name: 1e-3})
        assert name in SelfSimilarFE().refuses(other)
        with pytest.raises(ValueError, match=name):
            SelfSimilarFE().simulate(other, end_time=0.1)


def test_a_curved_wall_takes_its_curvature_from_the_beams():
    bent = simulate_expanding(Impact.dimensionless(0.5), QUICK, end_time=0.1)
    bulging = simulate_expanding(
        Impact.dimensionless(0.5).replace(curvature=0.2, wall_curvature=-0.3), QUICK, end_time=0.1
    )
    assert np.array_equal(bulging.array("gap"), bent.array("gap"))
    assert np.array_equal(bulging.array("total_impulse"), bent.array("total_impulse"))


def test_energy_closes_under_tension():
    impact = Impact.dimensionless(0.5, epsilon_alpha=-0.02, epsilon_axial=0.04)
    budget = simulate_expanding(impact, QUICK, end_time=1.0).energy_budget()
    assert abs(budget["defect"]) < 3e-5 * budget["work_of_loads"]


@pytest.mark.verify
@pytest.mark.parametrize(
    ("kappa", "lambda_n", "r_n"), [(0.1, -0.20733738067, -1.06665409542), (0.5, -0.948751775325, -1.66028391137)]
)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_tension_alone_moves_the_contact_as_first_order_says(kappa, lambda_n, r_n, sign):
    """A stress-free bow in free flight, α = −κN: the response λ_N, r_N (an independent derivation's closed form)."""

    def run(n):
        impact = Impact.dimensionless(kappa, epsilon_alpha=-kappa * sign * n, epsilon_axial=sign * n)
        return moments(method.simulate(impact, end_time=1.0), uniform=True)

    method = SelfSimilarFE().chosen_for(Impact.dimensionless(kappa, epsilon_alpha=-kappa, epsilon_axial=1.0), 1.0)
    base = run(0.0)
    found = first_order([(n, run(n)) for n in (0.01, 0.02, 0.04)], base, leading_order(base))
    assert sign * found.lambda1.value == pytest.approx(lambda_n, abs=3e-3)
    assert sign * found.r1.value == pytest.approx(r_n, abs=3e-3 * max(1.0, -r_n))


def test_nothing_pulls_and_nothing_penetrates():
    history = simulate_expanding(
        Impact.dimensionless(0.5, epsilon_alpha=0.2), ExpandingMesh(decades=3.0, step_ratio=0.04), end_time=0.1
    )
    scale = history.impact.velocity * history.time
    assert np.all(history.array("smallest_gap")[1:] >= -1e-6 * scale[1:])
    assert np.all((history.array("smallest_reaction") >= -1e-5 / np.sqrt(history.time))[1:])  # the start is held
    assert abs(history.array("held_impulse")[-1]) < 0.01 * history.array("total_impulse")[-1]


def test_the_middle_lifts_when_the_load_pulls_and_stays_when_it_pushes():
    def lift(alpha):
        mesh = ExpandingMesh(decades=3.0, step_ratio=0.04)
        history = simulate_expanding(Impact.dimensionless(0.5, epsilon_alpha=alpha), mesh, end_time=0.1)
        return history.array("lift")[-1] / 0.1

    assert lift(-0.5) > 1e-3
    assert lift(+0.5) < 1e-5


def test_physical_units_and_their_dimensionless_twin_agree():
    pipe = Impact(1.2e6, 29.0, 90.0, 0.002, 2.0, acceleration=0.1)
    twin = Impact.dimensionless(pipe.kappa_over_nu, epsilon_alpha=pipe.epsilon_alpha)
    a = simulate_expanding(pipe, QUICK, end_time=1e-3 * pipe.time_scale, save=20)
    b = simulate_expanding(twin, QUICK, end_time=1e-3, save=20)
    unit = pipe.mass_per_length * pipe.length_scale * pipe.velocity
    assert np.allclose(a.array("total_impulse") / unit, b.array("total_impulse"), rtol=1e-9)
    assert np.allclose(a.positions(-1) / pipe.length_scale, b.positions(-1), rtol=1e-12)


def test_the_method_runs_its_mesh():
    impact = Impact.dimensionless(0.5)
    a = SelfSimilarFE(mesh=QUICK).simulate(impact, end_time=0.1, save=50)
    b = simulate_expanding(impact, QUICK, end_time=0.1, save=50)
    assert a.dataset.drop_attrs().equals(b.dataset.drop_attrs())


@pytest.mark.parametrize(
    "settings",
    [{"front_resolution": 0.0}, {"growth": -0.1}, {"step_ratio": 0.9}, {"decades": 0.1}, {"elements_per_wave": 2}],
)
def test_impossible_settings_are_refused_by_name(settings):
    with pytest.raises(ValueError, match=next(iter(settings))):
        ExpandingMesh(**settings)


def test_a_flat_beam_is_refused():
    with pytest.raises(ValueError, match="curvature"):
        simulate_expanding(Impact(1.0, 1.0, 1.0, 0.0, 1.0), QUICK, end_time=0.1)


def test_a_front_that_runs_out_of_its_mesh_is_an_error_with_what_was_reached():
    with pytest.raises(SimulationError, match="finely meshed zone") as caught:
        simulate_expanding(
            Impact.dimensionless(0.5, epsilon_chi=40.0), ExpandingMesh(decades=3.0, step_ratio=0.04), end_time=0.1
        )
    assert caught.value.history is not None
