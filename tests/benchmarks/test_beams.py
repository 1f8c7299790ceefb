"""Whole beams drawn at random: what is drawn, and how it is counted."""

import numpy as np
import pytest

import benchmarks.beams
from benchmarks.beams import beams, draw, main
from bent_beam.cases import load_case
from bent_beam.measure.numbers import Number


def test_beams_are_damped_and_not_pressed_and_lifted_pulled_and_pushed_before_flat_and_curved_walls(tmp_path):
    random, drawn = np.random.default_rng(5), []
    for k in range(60):
        file = tmp_path / f"{k}.toml"
        file.write_text(draw(random))
        drawn.append(load_case(file).impact)
    assert {bool(one.damping) for one in drawn} == {False, True}
    for values in ([one.acceleration for one in drawn], [one.axial_force for one in drawn]):
        assert min(values) < 0.0 < max(values) and 0.0 in values
    assert {one.tension_direction for one in drawn} == {"axis", "tangent"}
    assert len({one.wall_curvature for one in drawn}) > 8


def test_a_beam_on_which_the_codes_differ_by_more_than_their_bars_stays_as_a_case_file(tmp_path, monkeypatch):
    def told(file, path):
        off = 0.1 if path == "exudyn" and file.name == "beam-1.toml" else 0.0
        return dict.fromkeys(benchmarks.beams.NAMES, Number(1.0 + off, 0.03))

    monkeypatch.setattr(benchmarks.beams, "run_all", lambda what, asked, jobs: [told(*one) for one in asked])
    assert main(["--rows", "3", "--seed", "1", "--out", str(tmp_path)]) == 1
    assert [file.name for file in tmp_path.iterdir()] == ["beam-1.toml"]
    found = beams([tmp_path / "beam-1.toml"])
    assert found.points[0].error / found.points[0].bar == pytest.approx(0.1 / (0.03 * 2.0**0.5))
