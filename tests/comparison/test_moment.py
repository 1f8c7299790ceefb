"""The largest bending moment of simulated impacts is that of theory, m(κ/ν), on two independent paths."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from comparison.figures.moment import (
    FLATTEST,
    FOLDER,
    KAPPAS,
    PATHS,
    MeasuredMoment,
    aitken,
    draw_moments,
    measure_moment,
)
from comparison.methods import default_methods
from hermite_fe import HermiteFE
from theory.moment import peak_moment

WITHIN = 0.005


def test_stored_points_are_within_half_a_percent_of_theory() -> None:
    points = [MeasuredMoment(**p) for p in json.loads((FOLDER / "peak-moment.json").read_text())["points"]]
    assert {p.kappa_over_nu for p in points} == set(KAPPAS)
    assert len({p.label for p in points}) == len(PATHS)
    for p in points:
        assert p.theory == pytest.approx(peak_moment(p.kappa_over_nu).largest)
        assert abs(p.value / p.theory - 1.0) < WITHIN, p


def test_extrapolation_knows_any_order() -> None:
    for factor in (0.25, 0.4, 0.5):
        assert aitken(*(2.0 - 0.1 * factor**k for k in range(3))) == pytest.approx(2.0, rel=1e-12)
    assert aitken(1.0, 1.1, 1.3) == 1.3
    assert aitken(1.0, 1.1, 1.05) == 1.05
    assert aitken(1.0, 1.0, 1.0) == 1.0


def test_moment_of_a_quick_run_is_that_of_theory_and_steady() -> None:
    found = measure_moment(HermiteFE(), 0.5)
    assert found.value == pytest.approx(found.theory, rel=WITHIN)
    assert found.error < 0.01 * found.theory


def test_figure_is_drawn_from_points(tmp_path: Path) -> None:
    exact = {kappa: float(peak_moment(kappa).largest) for kappa in KAPPAS}
    points = [MeasuredMoment("Hermite", kappa, 1.001 * m, 1e-3, m) for kappa, m in exact.items()]
    (file,) = draw_moments(points, tmp_path)
    assert file.stat().st_size > 10_000


@pytest.mark.verify
@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("kappa", KAPPAS)
def test_moment_is_that_of_theory(path: str, kappa: float) -> None:
    if kappa < FLATTEST[path]:
        pytest.skip("the front is thinner than this path's own mesh resolves")
    (method,) = default_methods([path])
    found = measure_moment(method, kappa)
    assert found.value == pytest.approx(found.theory, rel=WITHIN)
