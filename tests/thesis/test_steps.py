"""The reaction of every step, the thesis's filter, and numbers as a reader writes them."""

from __future__ import annotations

import json

import numpy as np
import pytest

from comparison.readable import readable
from thesis.gallery.runs import case, every_step, thesis, thesis_history
from thesis.stored_studies import FILE
from thesis.studies.outcome import CUT_OFF, MEASURES, Steps
from thesis.studies.thesis import thesis_settings


@pytest.mark.parametrize("share", [0.25, 1.0, 4.0])
def test_the_filter_is_that_of_butterworth_both_ways(share: float) -> None:
    """Of order 1 it passes 1/(1 + (tan πf/2 / tan πf_c/2)²) of an amplitude both ways, without a shift: ½ at f_c."""
    n = np.arange(6000.0)
    wave = np.cos(np.pi * share * CUT_OFF * n)
    passed = 1.0 / (1.0 + (np.tan(0.5 * np.pi * share * CUT_OFF) / np.tan(0.5 * np.pi * CUT_OFF)) ** 2)
    middle = slice(2000, 4000)
    assert Steps(n, wave).filtered()[middle] == pytest.approx(passed * wave[middle], abs=1e-6)
    assert Steps(n, np.ones_like(n)).filtered() == pytest.approx(1.0)


def test_taking_every_step_by_itself_gives_the_same_run_and_its_impulse() -> None:
    given = case(10.0, 0.002)
    method = thesis_settings(given.impact, given.end_time).method()
    saved = np.linspace(0.0, given.end_time, 6)
    history, steps = every_step(given.impact, given.end_time, method, saved)
    whole = method.simulate(given.impact, end_time=given.end_time, save=saved)
    for name in ("time", "gap", "total_impulse", "kinetic_energy", "loss_impact"):
        assert np.array_equal(history.array(name), whole.array(name))
    impulse = float(whole.array("total_impulse")[-1])
    assert 2.0 * float(steps.reaction @ np.diff(steps.time, prepend=0.0)) == pytest.approx(impulse, rel=1e-12)


def test_report_and_gallery_show_one_result() -> None:
    """The stored study of 3.3.3, on the thesis's own case, is the run that the gallery draws."""
    (study,) = (s for s in json.loads(FILE.read_text())["studies"] if s["name"] == "damping")
    (row,) = (r for r in study["rows"] if r["label"] == "ρ∞ = 0.8")
    found = thesis("", 1.0 / 40.0, 0.01).measures
    assert thesis_history(1.0 / 40.0, 0.01).steps == row["steps"]
    for name in ("contact_length_error", "reaction_error", "lift", "lost_impact"):
        assert found[name] == pytest.approx(row[name], rel=1e-6), MEASURES[name]


def test_numbers_are_written_with_powers_of_ten() -> None:
    shown = {2.5e-8: "2.5·10⁻⁸", 1e-6: "10⁻⁶", -1e-6: "−10⁻⁶", 0.0025: "0.0025", 0.0: "0", 12345.6: "12350", None: "–"}
    assert {value: readable(value) for value in shown} == shown
