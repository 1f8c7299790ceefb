"""The studies of error bars, of methods and of whole beams: they draw what they say, count what misses, and keep it."""

import tomllib

import numpy as np
import pytest

from benchmarks import beams
from benchmarks.coverage import Point, coverage, draw, write_misses
from bent_beam import Impact
from bent_beam.cases import case_from_tables
from bent_beam.loads import loads_of
from bent_beam.measure.numbers import Number
from comparison.methods import methods_from_file
from comparison.rows import MatchRow


def row(error, bar):
    number = Number(1.0 + error, bar, 1.0)
    return MatchRow("x", "x", {}, 0.5, 0.0, 0.0, 0.0, 0.0, 1.0, lambda0=number, r0=number)


def test_a_bar_that_misses_is_counted_and_kept_as_a_method_that_can_be_read(tmp_path):
    found = coverage([row(1e-3, 2e-3), row(1e-2, 2e-3), MatchRow("x", "x", {}, 0.5, 0, 0, 0, 0, 1.0)])
    assert (found.share, found.runs) == (0.5, 3)
    assert found.ratio == pytest.approx(1.1)  # of bars over errors: 2, 2, 0.2, 0.2
    assert found.lost == pytest.approx(1 / 3)
    random = np.random.default_rng(11)
    asked = [draw(random) for _ in range(3)]
    file, other = write_misses(found, asked, tmp_path)
    assert methods_from_file(file) == methods_from_file(other) == [asked[1].question.method]
    assert f"--kappa-over-nu {asked[1].kappa_over_nu!r}" in file.read_text() and "off by 1.00e-02" in file.read_text()
    assert f"--duration {asked[1].duration!r}" in file.read_text()


@pytest.mark.parametrize(
    ("misses", "holds"), [([], True), ([1.5e-3] * 6, True), ([1.5e-3] * 7, False), ([2.1e-3], False)]
)
def test_error_bars_hold_with_94_of_100_numbers_covered_and_none_two_bars_off(misses, holds):
    covered = [row(5e-4, 1e-3)] * (100 - len(misses))
    assert coverage([*covered, *(row(error, 1e-3) for error in misses)]).holds == holds


def test_every_stratum_is_what_it_is_called():
    random, found = np.random.default_rng(5), {}
    for stratum in beams.STRATA:
        drawn = [case_from_tables(tomllib.loads(beams.draw(random, stratum))) for _ in range(20)]
        found[stratum] = [case.impact for case in drawn]
    assert all(one.damping for beam in found.values() for one in beam), "without damping there are bands, no bars"
    assert {one.shear_stiffness is None for one in found["rigid"]} == {False, True}
    assert all(one.wall_stiffness for one in found["wall"])
    assert {one.wall_damping > 0.0 for one in found["wall"]} == {False, True}
    assert all(one.supported or one.wall_in_part for one in found["support"])
    assert all(one.wall_curvature or any(getattr(one, load) for load in loads_of(Impact)) for one in found["loads"])
    for values in ([one.acceleration for one in found["loads"]], [one.axial_force for one in found["loads"]]):
        assert min(values) < 0.0 < max(values) and 0.0 in values
    assert max(one.damping for one in found["light"]) < np.median([one.damping for one in found["rigid"]])


def test_a_number_beyond_its_bar_fails_its_stratum_and_its_beam_stays_as_a_case_file(tmp_path, monkeypatch):
    def found(row, stratum, file):
        return [Point(row, 0.5, stratum, "impulse", 0.06 if row == 1 else 0.01, 0.05)]

    monkeypatch.setattr(beams, "run_all", lambda what, rows, **_: [found(*row) for row in rows])
    out = tmp_path / "out"
    assert beams.main(["--rows", "20", "--seed", "1", "--out", str(out)]) == 1, "3 of 4 elastic walls are not 90 %"
    assert [file.name for file in out.iterdir()] == ["beam-1.toml"]
    monkeypatch.setattr(beams, "run_all", lambda what, rows, **_: [found(20, *row[1:]) for row in rows])
    assert beams.main(["--rows", "20", "--seed", "1", "--out", str(out)]) == 0
