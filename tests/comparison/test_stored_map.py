"""The stored map of whole impacts: what it holds, and what lies between its points."""

import math

import numpy as np
import pytest
from comparison.bounce import NUMBERS
from comparison.whole_impact import map
from comparison.whole_impact.stored_map import bounce_from_map, stored_map

from bent_beam.impact import Impact
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE
from hermite_fe.integrators import MoreauJean, SignoriniPosition

ELEMENTS = 200  # of a half beam, the map's own


def numbers_at(kappa, damping, where="points"):
    return next(p["numbers"] for p in stored_map()[where] if (p["kappa_over_nu"], p["damping"]) == (kappa, damping))


def restitution(kappa, damping):
    return bounce_from_map(kappa, damping)["restitution"]


def test_the_map_holds_its_points_and_lies_between_them() -> None:
    found, point = bounce_from_map(2.0, 1e-2), numbers_at(2.0, 1e-2)
    assert all((found[name].value, found[name].error) == pytest.approx(tuple(point[name])) for name in NUMBERS)
    assert found["restitution"].value == pytest.approx(0.5663, abs=1e-4)
    low, between, high = (restitution(kappa, 1e-2) for kappa in (0.4, 0.447, 0.5))
    assert min(low.value, high.value) < between.value < max(low.value, high.value)
    assert between.error > max(low.error, high.error)
    assert bounce_from_map(0.01, 1e-2) is None and bounce_from_map(1.0, 1.0) is None
    assert restitution(0.5, 1e-5) == restitution(0.5, 0.0) and restitution(0.5, 0.0).runs == 24  # a band
    assert restitution(math.inf, 1e-2) == restitution(1e3, 1e-2)  # one point touches


def test_points_close_their_energy_and_those_of_another_path_agree_within_their_bars() -> None:
    table = stored_map()
    for point in table["points"]:
        assert point["left"] and point["energy_defect"] < 1e-6, point
        shares = sum(point["numbers"][name][0] for name in ("translation", "vibration", "dissipated"))
        assert shares == pytest.approx(1.0, abs=1e-6)
    assert len(table["others"]) >= 8
    for other in table["others"]:
        here = numbers_at(other["kappa_over_nu"], other["damping"])
        for name in ("restitution", "translation", "dissipated"):
            (value, error), (reference, bar) = other["numbers"][name], here[name]
            assert abs(value - reference) <= error + bar, (other["kappa_over_nu"], other["damping"], name)


@pytest.mark.verify
def test_numbers_between_the_points_of_the_map_lie_within_their_bars() -> None:
    random = np.random.default_rng(20)
    for _ in range(8):
        kappa, damping = math.exp(random.uniform(math.log(0.3), math.log(3.0))), 10.0 ** random.uniform(-3.5, -1.0)
        integrator = SignoriniPosition(theta=0.5, time_step=1.0 / ELEMENTS**2)
        impact = Impact.whole_beam(kappa, relative_damping=damping)
        found = whole_impact(HermiteFE(integrator=integrator).simulate_to_separation(impact))
        for name in ("restitution", "translation", "dissipated"):
            stated = bounce_from_map(kappa, damping)[name]
            assert abs(getattr(found, name) - stated.value) <= stated.error, (kappa, damping, name)


@pytest.mark.verify
@pytest.mark.parametrize(
    ("kappa", "damping"), [(0.05, 1e-2), (0.1, 1e-1), (0.2, 1e-2), (0.6, 3e-3), (1.0, 1e-3), (1.2, 1e-3), (4.0, 1e-4)]
)
def test_points_of_the_map_hold_what_finer_elements_and_another_scheme_give(kappa, damping) -> None:
    """Elements are 1.5 times finer, steps shorter, and Signorini's law is at velocity level: what that gives lies
    within the map's bars alone."""
    point = next(point for point in map.grid() if point[1:3] == (kappa, damping))
    elements = round(1.5 * point.refine * ELEMENTS)
    scheme = MoreauJean(theta=0.5, time_step=0.35 / elements**2)
    method = HermiteFE(mesh=UniformMesh(1.0 / elements), integrator=scheme)
    found = whole_impact(method.simulate_to_separation(Impact.whole_beam(kappa, relative_damping=damping)))
    for name in ("restitution", "impulse", "peak_moment", "translation", "dissipated"):
        value, error = numbers_at(kappa, damping)[name]
        assert abs(getattr(found, name) - value) <= error, (name, getattr(found, name), value, error)
