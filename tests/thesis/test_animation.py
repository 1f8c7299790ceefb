"""The animation of an impact."""

from __future__ import annotations

import csv
import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest

from bent_beam import Impact, ImpactHistory
from self_similar_fe import SelfSimilarFE
from thesis.gallery import draw_all
from thesis.gallery.animation import impact_frames


def test_the_beam_without_the_wall_is_drawn_over_a_curved_wall_too() -> None:
    """A wall bent like the beam and a beam bent more, by as much, are the same impact."""
    flat = SelfSimilarFE().simulate(Impact.dimensionless(0.5, length=20.0), end_time=0.1, save=20)
    dataset = flat.dataset.copy()
    bent = flat.impact.replace(curvature=0.8, wall_curvature=0.3)
    dataset.attrs["impact"] = json.dumps(dataclasses.asdict(bent))
    for over_flat, over_curved in zip(impact_frames(flat, 4), impact_frames(ImpactHistory(dataset), 4), strict=True):
        far = np.abs(over_flat.x) > 0.9 * over_flat.x.max()
        assert np.allclose(over_curved.free, over_flat.free, rtol=0.0, atol=1e-12)
        assert np.allclose(over_curved.y, over_flat.y, rtol=0.0, atol=1e-12)
        assert np.all(over_flat.free[far] < 0.0)


@pytest.mark.verify
def test_the_animation_moves(tmp_path: Path) -> None:
    draw_all(["animation"], tmp_path)
    assert (tmp_path / "animation.gif").stat().st_size > 50_000
    fronts = [float(r["half contact length (m)"]) for r in csv.DictReader((tmp_path / "animation.csv").open())]
    assert fronts == sorted(fronts) and fronts[-1] > 0.0
