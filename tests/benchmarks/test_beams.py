"""Whole beams drawn at random: what is drawn, and how it is counted."""

import numpy as np

import benchmarks.beams
from benchmarks.beams import STRATA, draw, main
from benchmarks.coverage import Point
from bent_beam.cases import load_case


def drawn(tmp_path, stratum, number=20):
    random, file = np.random.default_rng(5), tmp_path / "drawn.toml"
    found = []
    for _ in range(number):
        file.write_text(draw(random, stratum))
        found.append(load_case(file).impact)
    return found


def test_every_stratum_is_what_it_is_called(tmp_path):
    beams = {stratum: drawn(tmp_path, stratum) for stratum in STRATA}
    assert all(one.damping for beam in beams.values() for one in beam), "without damping there are bands, no bars"
    assert {one.shear_stiffness is None for one in beams["rigid"]} == {False, True}
    assert all(one.wall_stiffness for one in beams["wall"])
    assert {one.wall_damping > 0.0 for one in beams["wall"]} == {False, True}
    assert all(one.supported or one.wall_in_part for one in beams["support"])
    assert all(one.acceleration or one.axial_force or one.wall_curvature for one in beams["loads"])
    for values in ([one.acceleration for one in beams["loads"]], [one.axial_force for one in beams["loads"]]):
        assert min(values) < 0.0 < max(values) and 0.0 in values
    assert max(one.damping for one in beams["light"]) < np.median([one.damping for one in beams["rigid"]])


def test_a_number_beyond_its_bar_fails_its_stratum_and_its_beam_stays_as_a_case_file(tmp_path, monkeypatch):
    def found(row, stratum, file):
        return [Point(row, 0.5, stratum, "impulse", 0.06 if row == 1 else 0.01, 0.05)]

    monkeypatch.setattr(benchmarks.beams, "run_all", lambda what, rows, jobs: [found(*row) for row in rows])
    out = tmp_path / "out"
    assert main(["--rows", "20", "--seed", "1", "--out", str(out)]) == 1, "3 of 4 elastic walls are not 90 %"
    assert [file.name for file in out.iterdir()] == ["beam-1.toml"]
    monkeypatch.setattr(benchmarks.beams, "run_all", lambda what, rows, jobs: [found(20, *row[1:]) for row in rows])
    assert main(["--rows", "20", "--seed", "1", "--out", str(out)]) == 0
