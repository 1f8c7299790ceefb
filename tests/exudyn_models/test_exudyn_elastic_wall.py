"""A wall that gives way: its springs and dashpots are the wall's own."""

import math

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.free_flight import has_left
from bent_beam.measure.balance import balance_of
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE

STIFFNESS = 1e4  # EI = μ = V₀ = 1


def run(kappa_over_nu: float, ratio: float = 0.0, refine: float = 1.0, end: float = 4.0, path=ExudynModel):
    wall = {"wall_stiffness": STIFFNESS, "wall_damping": 2.0 * ratio * math.sqrt(STIFFNESS)}
    impact = Impact.dimensionless(kappa_over_nu).replace(**wall)
    return path(refine=refine).simulate(impact, end_time=end / math.sqrt(STIFFNESS), save=40)


def share(history, name: str) -> float:
    budget = history.energy_budget()
    return budget[name] / budget["initial_energy"]


def test_springs_give_back_what_they_took_and_dashpots_take_energy_and_push_earlier() -> None:
    elastic, damped = run(2.0, refine=0.5, end=6.0), run(2.0, 0.5, refine=0.5, end=6.0)
    held = elastic.array("contact_energy")
    assert held[0] == 0.0 and held.max() > 0.01 * elastic.energy_budget()["initial_energy"]
    assert held[-1] < 0.5 * held.max()
    assert abs(share(elastic, "loss_impact")) < 1e-5 and share(elastic, "loss_wall") == 0.0
    assert elastic.array("peak_pressure")[-1] == pytest.approx(STIFFNESS * elastic.array("peak_penetration")[-1])
    assert share(damped, "loss_wall") > 0.01 > abs(share(damped, "loss_impact"))
    assert max(abs(share(history, "defect")) for history in (elastic, damped)) < 1e-6
    for name in ("peak_force", "peak_force_time"):
        assert damped.array(name)[-1] < elastic.array(name)[-1]


@pytest.mark.parametrize(("ratio", "refine", "exact"), [(0.0, 0.4, 4.596), (0.0, 0.8, 4.596), (1.0, 0.8, 3.392)])
def test_the_largest_force_before_an_elastic_wall_does_not_depend_on_the_mesh(ratio, refine, exact):
    """F = f V₀√μ(EI k)^¼ with f(0.5, ζ) of the theory; a penalty of the elements' own would grow with 1/Δx, and
    dashpots of whole elements push 2.6 % more."""
    force = run(0.5, ratio, refine=refine).array("peak_force")[-1] / STIFFNESS**0.25
    assert force == pytest.approx(exact, rel=3e-3)


WITHIN = {"peak_force": 5e-4, "peak_force_time": 8e-3, "peak_penetration": 5e-4, "peak_pressure": 1e-3}


@pytest.mark.parametrize(
    ("seed", "refine"), [(44, 0.7), *(pytest.param(seed, 1.0, marks=pytest.mark.verify) for seed in (45, 46))]
)
def test_both_paths_agree_on_every_number_of_a_damped_wall(seed: int, refine: float) -> None:
    """The pressure is that of spring and dashpot."""
    draw = np.random.default_rng(seed)
    drawn = float(draw.uniform(0.1, 2.0)), float(draw.uniform(0.1, 1.0))
    exudyn, hermite = (run(*drawn, refine=refine, path=path) for path in (ExudynModel, HermiteFE))
    for name, within in (WITHIN | {"total_impulse": 2e-4}).items():
        ours, theirs = exudyn.array(name)[-1], hermite.array(name)[-1]
        assert ours == pytest.approx(theirs, rel=within), (name, drawn)


def test_a_beam_that_leaves_a_soft_wall_under_a_load_has_its_restitution() -> None:
    """What a contact that changes by little pushes on would end the run before its time; Hermite has the number."""
    found = []
    for method in (ExudynModel(mesh=UniformMesh(1.0 / 20)), HermiteFE(mesh=UniformMesh(1.0 / 20))):
        impact = Impact.whole_beam(0.5, relative_damping=1e-2).replace(wall_stiffness=20.0, acceleration=0.3)
        run = method.simulate_to_separation(impact)
        assert has_left(run) and balance_of(run).warnings == []
        found.append(whole_impact(run))
    assert found[0].restitution == pytest.approx(found[1].restitution, abs=2e-3)
    assert found[0].last_contact == pytest.approx(found[1].last_contact, abs=5e-3)


@pytest.mark.verify
def test_the_edge_of_a_damped_plate_lets_go_when_spring_and_dashpot_do() -> None:
    """Literal values of an explicit code with 600 nodes: the last contact 12.567 s, 10.151 % dissipated."""
    impact = Impact(
        7.7737719754314165, 0.024782017163759006, 30.0, 0.16655347140413423, 4.916431704077783,
        damping=0.23258460796437663, shear_stiffness=3.4550097668584074, rotary_inertia=0.011151907723691554,
        wall_stiffness=0.07654609727540396, wall_damping=0.1 * math.sqrt(0.07654609727540396 * 0.024782017163759006),
        wall_from=4.5, wall_to=5.25,
    )  # fmt: skip
    found = whole_impact(ExudynModel().simulate_to_separation(impact))
    assert found.last_contact * impact.slow_time_scale == pytest.approx(12.567, abs=0.01)
    assert found.dissipated == pytest.approx(0.10151, abs=1.5e-4)
