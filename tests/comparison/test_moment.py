"""The largest bending moment of simulated impacts is that of theory, m(κ/ν), on two independent paths."""

from __future__ import annotations

import json

import pytest

from comparison.figures.moment import (
    FLATTEST,
    FOLDER,
    KAPPAS,
    PATHS,
    MeasuredMoment,
    measure_moment,
)
from comparison.methods import default_methods
from hermite_fe import HermiteFE
from theory.similarity import peak_moment

WITHIN = 0.005


def test_stored_points_are_within_half_a_percent_of_theory() -> None:
    points = [MeasuredMoment(**p) for p in json.loads((FOLDER / "peak-moment.json").read_text())["points"]]
    assert {p.kappa_over_nu for p in points} == set(KAPPAS)
    assert len({p.label for p in points}) == len(PATHS)
    for p in points:
        assert p.theory == pytest.approx(peak_moment(p.kappa_over_nu).largest)
        assert abs(p.value / p.theory - 1.0) < WITHIN, p


def test_moment_of_a_quick_run_is_that_of_theory_and_steady() -> None:
    found = measure_moment(HermiteFE(), 0.5)
    assert found.value == pytest.approx(found.theory, rel=WITHIN)
    assert found.error < 0.01 * found.theory


@pytest.mark.verify
@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("kappa", KAPPAS)
def test_moment_is_that_of_theory(path: str, kappa: float) -> None:
    if kappa < FLATTEST[path]:
        pytest.skip("the front is thinner than this path's own mesh resolves")
    (method,) = default_methods([path])
    found = measure_moment(method, kappa)
    assert found.value == pytest.approx(found.theory, rel=WITHIN)
