"""The doctor finds the one fault that was put in, and calls a good result good.

Faults are drawn anew in each run; the seed is printed, and BENTBEAM_SEED repeats it.
"""

import os
import secrets
import sys
from pathlib import Path

import pytest

from bent_beam_programs.open_benchmark import score
from bent_beam_programs.open_benchmark.doctor import NAMES

sys.path.insert(0, str(Path(__file__).parent))  # tests are imported one by one
import faults

SEED = int(os.environ.get("BENTBEAM_SEED") or secrets.randbelow(2**31))


def diagnosis(name, *seed):
    return score(faults.faulty(name, *seed)).diagnosis[0]


@pytest.mark.parametrize("name", [name for name in NAMES if name not in ("energy_gained", "rectified_noise")])
def test_one_fault_is_found_with_its_evidence_and_what_to_change(name):
    assert {"clean", *faults.FAULTS} == set(NAMES)
    found = diagnosis(name, 1001)
    assert found.name == name
    assert bool(found.evidence and found.advice) == (name != "clean")


@pytest.mark.verify
def test_at_least_95_of_100_faults_are_named_rightly():
    cases = [(faults.FAULTS[k % len(faults.FAULTS)], k) for k in range(200)]
    named = [(name, k, diagnosis(name, SEED, k).name) for name, k in cases]
    wrong = [case for case in named if case[0] != case[2]]
    print(f"BENTBEAM_SEED={SEED}: {200 - len(wrong)} of 200 faults named rightly; wrong: {wrong}")
    assert len(wrong) <= 10, wrong
    assert not [case for case in wrong if case[2] == "clean"], wrong


@pytest.mark.verify
def test_at_most_1_of_100_good_results_raises_an_alarm():
    found = [(k, diagnosis("clean", SEED, k)) for k in range(200)]
    alarms = [(k, one) for k, one in found if one.name != "clean"]
    print(f"BENTBEAM_SEED={SEED}: {len(alarms)} of 200 good results raise an alarm: {alarms}")
    assert len(alarms) <= 2, alarms
