"""Each fault, put into a copy of the code as one changed line, is seen by a check; the code as it is passes all."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOUND = {"momentum": 3e-3, "second_moment": 5e-3, "points": 1e-9, "initial_energy": 1e-9, "mass": 1e-9, "energy": 1e-3}
"""What a sound run of 16 elements keeps to."""

TOTAL = "copies * run.impulse @ towards"
POINTS = 'run.impulse[:, front]),\n        "in_contact"'
STEP = "state.impulse[j] += conditions.p[j]"
MASS = "self.element(beam.lengths, beam.mass_per_length)"
LOST = "np.where(np.arange({}.size) == 3, 0.5, 1.0)[:, None, None]"  # half of an element's mass: that of half a node
MOMENTUM = 'self.start_momentum + after["load_impulse"] - v @ self.momentum'
GAIN = "gain + (missing / np.where(whole > 0.0, whole, 1.0))[:, None] * weight"
PER_LENGTH = "1.0"
IMPULSE = 'saved["impulse"] * s.impulse'
WORK = "blocks += w * tested[:, :, None] * trial[:, None, :]"

# path → (what is wrong, the checks that see it, file, code, what stands in its place); every third in the quick suite
FAULTS = {
    "hermite_fe": [
        ("impulses of the steps", "momentum", "stepping.py", STEP, "state.impulse[j] += 0.99 * conditions.p[j]"),
        ("total impulse", "momentum", "simulate.py", TOTAL, f"0.99 * {TOTAL}"),
        ("impulses of the points", "points", "simulate.py", POINTS, f"0.99 * {POINTS}"),
        ("half a node's mass", "initial_energy mass", "masses.py", MASS, f"{MASS} * {LOST.format('beam.lengths')}"),
        ("points mixed up", "second_moment", "simulate.py", POINTS, POINTS.replace("front", "::-1")),
        ("pulls recorded as pushes", "momentum", "stepping.py", STEP, "state.impulse[j] += abs(conditions.p[j])"),
    ],
    "exudyn_models": [
        ("total impulse", "momentum", "recording.py", MOMENTUM, f"0.99 * ({MOMENTUM})"),
        ("impulses of the points", "points", "recording.py", IMPULSE, f"0.99 * {IMPULSE}"),
        ("points mixed up", "second_moment", "recording.py", GAIN, f"np.roll({GAIN}, 1, axis=1)"),
        ("pulls recorded as pushes", "energy", "contacts/penalty.py", "self.signs * force, 0.0)", "abs(force), 0.0)"),
        ("half a node's mass, in Exudyn", "mass", "elements/ancf_cable.py", f"massPerLength={PER_LENGTH}",
         f"massPerLength={PER_LENGTH} * (0.5 if i == 3 else 1.0)"),
        ("half a node's mass, recorded", "momentum", "elements/beam.py", "mass, _, _ = self.element_matrices()",
         f"mass = self.element_matrices()[0] * {LOST.format('self.lengths')}"),
    ],
    "self_similar_fe": [
        ("total impulse", "momentum", "run.py", "2.0 * float(self.impulse.sum())", "1.98 * float(self.impulse.sum())"),
        ("impulses of the steps", "momentum", "run.py", "+ mean * roots", "+ 0.99 * mean * roots"),
        ("impulses of the points", "points", "run.py", "self.impulse * push", "0.99 * self.impulse * push"),
        ("half a node's mass", "mass", "similarity.py", WORK, f"{WORK} * {LOST.format('length')}"),
    ],
}  # fmt: skip


@pytest.mark.parametrize("every", [3, pytest.param(1, marks=pytest.mark.verify)])
def test_a_changed_line_shows_and_the_code_as_it_is_is_sound(tmp_path, every):
    """All runs in one process: starting it takes longer than any of them."""
    words = []
    for path, faults in FAULTS.items():
        words += [path, ROOT]
        for number, (_, _, file, code, other) in enumerate(faults[::every]):
            words += [path, tmp_path / f"{path}-{number}"]
            copy = words[-1] / path
            shutil.copytree(ROOT / path, copy, ignore=shutil.ignore_patterns("__pycache__"))
            text = (copy / file).read_text()
            assert text.count(code) == 1
            (copy / file).write_text(text.replace(code, other))
    command = [sys.executable, Path(__file__).with_name("faulty_runs.py"), *words]
    told = subprocess.run(
        command, cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT)}, check=True, capture_output=True
    )
    lines = iter(told.stdout.splitlines())
    for path, faults in FAULTS.items():
        sound = json.loads(next(lines))
        assert wrong(sound) == set() and sound["warnings"] == [], path
        for fault, checks, *_ in faults[::every]:
            found = json.loads(next(lines))
            assert set(checks.split()) <= wrong(found), (path, fault)
            assert checks in ("mass", "energy") or found["warnings"], (path, fault)  # whoever runs it is told


def wrong(found):
    """Checks that a run does not keep to."""
    return {name for name, most in SOUND.items() if abs(found[name] or 0.0) > most}
