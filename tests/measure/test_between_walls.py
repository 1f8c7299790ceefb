"""Hits of a beam between two walls."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from histories import recorded

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.measure.reduction import peak_moment
from bent_beam.measure.whole_impact import hits
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE

slow = pytest.mark.verify


def between_walls(path: Any, elements: int, kappa: float, damping: float, distance: float, end: float) -> ImpactHistory:
    impact = Impact.whole_beam(kappa, relative_damping=damping).replace(opposite_wall=distance)
    method = path(mesh=UniformMesh(1.0 / elements)).for_whole_beam(impact)
    return method.simulate(impact, end_time=end, save=np.linspace(0.0, end, round(400 * end) + 1)[1:])


@pytest.mark.parametrize(
    ("path", "asked", "least", "closes"),
    [
        (HermiteFE, (20, 0.5, 1e-2, 0.6, 6.0), 3, 1e-9),
        pytest.param(HermiteFE, (40, 1.5, 1e-3, 1.0, 60.0), 10, 1e-6, marks=slow),
        pytest.param(ExudynModel, (10, 1.5, 1e-3, 1.0, 80.0), 10, 1e-3, marks=slow),
    ],
)
def test_each_hit_between_two_walls_gives_the_beam_its_impulse(path, asked, least, closes):
    history = between_walls(path, *asked)
    found = hits(history)
    assert len(found) >= least and [hit.wall for hit in found[:2]] == ["front", "opposite"]
    after = [1.0, *(hit.after for hit in found)]
    for before, hit, now in zip(after, found, after[1:]):
        sign = -1.0 if hit.wall == "front" else 1.0
        assert 2.0 * (now - before) == pytest.approx(sign * hit.impulse, rel=1e-6, abs=1e-9)
        assert hit.lost > -1e-9
    assert max(hit.moment for hit in found) == peak_moment(history).moment > 1.01 * min(hit.moment for hit in found)
    assert sum(hit.lost for hit in found) < 1.0 and abs(history.energy_budget()["defect"]) < closes
    if path is HermiteFE:
        gap = history.array("gap")
        assert (gap.min(), gap.max()) == pytest.approx((0.0, history.impact.opposite_wall), abs=5e-3)


def test_of_hits_that_overlap_each_has_the_largest_moment_of_its_own_time() -> None:
    impact = Impact.whole_beam(0.5, relative_damping=1e-2).replace(opposite_wall=0.26, wall_stiffness=20.0)
    history = HermiteFE(mesh=UniformMesh(0.1)).for_whole_beam(impact).simulate(impact, end_time=4.0, save=400)
    found = hits(history)
    assert any(one.end > other.begin for one, other in pairwise(found))
    for hit, until in zip(found, [*(hit.begin for hit in found[1:]), 4.0]):
        within = (history.time > hit.begin) & (history.time <= max(hit.end, until))
        assert hit.moment == pytest.approx(history.moment[within].max(), rel=0.02)  # the last is cut at its middle
    assert found[0].moment < 0.7 * peak_moment(history).moment
    time, wall = np.linspace(0.0, 4.0, 41), np.eye(5)  # pushed in front until 2 s, behind from 1 to 3 s, ever more bent
    pushes = (np.outer(np.clip(time - begin, 0.0, 2.0), wall[0]) for begin in (0.0, 1.0))
    rising = recorded(time, next(pushes), opposite_impulse=next(pushes), moment=time, impact=impact)
    assert [hit.moment for hit in hits(rising)] == pytest.approx([2.0, 4.0])


@slow
def test_both_paths_give_the_first_hits_between_two_walls_alike() -> None:
    """Later ones are not comparable: which part of a vibrating beam meets a wall when is chaotic."""
    hermite, exudyn = (hits(between_walls(path, 50, 1.5, 1e-2, 1.0, 6.0))[:3] for path in (HermiteFE, ExudynModel))
    for one, other in zip(hermite, exudyn, strict=True):
        assert one.wall == other.wall and one.impulse == pytest.approx(other.impulse, rel=5e-3)
        assert (one.after, one.lost) == pytest.approx((other.after, other.lost), abs=5e-3)
