"""The doctor finds the one fault that was put in, and calls a good result good.

Thresholds were set on seeds 0 to 59; the checks use others.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from open_benchmark.doctor import NAMES
from open_benchmark.score import score

sys.path.insert(0, str(Path(__file__).parent))  # tests are imported one by one
import faults

CHECKED = 1000  # the first seed of the check


def diagnosis(name: str, seed: int) -> str:
    return score(faults.made(name, seed)).diagnosis[0].name


@pytest.mark.parametrize(
    "name", ["clean", "reflection", "front_unresolved", "adhesion", "soft_penalty", "rattling", "steps_too_long"]
)
def test_one_fault_is_found(name: str) -> None:
    seed = CHECKED if name != "clean" else CHECKED + 1
    assert diagnosis(name, seed) == name


def test_faults_and_names_are_the_same_words() -> None:
    assert {"clean", *faults.FAULTS} == set(NAMES)


def test_every_fault_comes_with_its_evidence_and_what_to_change() -> None:
    finding = score(faults.made("steps_too_long", CHECKED)).diagnosis[0]
    assert finding.evidence and "shorter" in finding.advice


@pytest.mark.verify
def test_at_least_95_of_100_faults_are_named_rightly() -> None:
    names = list(faults.FAULTS)
    cases = [(names[k % len(names)], CHECKED + k) for k in range(200)]
    wrong = [(name, seed, found) for name, seed in cases if (found := diagnosis(name, seed)) != name]
    assert len(wrong) <= 10, wrong


@pytest.mark.verify
def test_at_most_1_of_100_good_results_raises_an_alarm() -> None:
    alarms = [(seed, found) for seed in range(CHECKED, CHECKED + 200) if (found := diagnosis("clean", seed)) != "clean"]
    assert len(alarms) <= 2, alarms
