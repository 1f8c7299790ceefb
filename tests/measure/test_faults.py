"""Each fault, put into a copy of the code as one changed line, is seen by a check; the code as it is passes all."""

import shutil
import sys
from collections.abc import Iterator
from dataclasses import asdict
from importlib import import_module
from pathlib import Path
from typing import Any

import numba
import pytest
from here import ROOT

from bent_beam import Impact, ImpactHistory
from bent_beam.measure.balance import balance_of
from bent_beam.meshes import UniformMesh

WHOLE, END = Impact.whole_beam(0.5, relative_damping=1e-2), 0.1
MESH = UniformMesh(1.0 / 16)
SOUND = {"momentum": 3e-3, "second_moment": 5e-3, "points": 1e-9, "initial_energy": 1e-9, "energy": 1e-3,
         "penetration": 2e-3, "middle_slope": 1e-6}  # fmt: skip
"""What a sound run of 16 elements keeps to."""

POINTS = 'run.impulse[:, front]),\n        "in_contact"'
ANY, STEP = "conditions.candidate[j] = True", "state.impulse[j] += conditions.p[j]"
LOST = "np.where(np.arange({}.size) == 3, 0.5, 1.0)[:, None, None]"  # half of an element's mass: that of half a node
MOMENTUM = 'self.start_momentum + after["load_impulse"] - v @ self.momentum'
GAIN = "gain + (missing / np.where(whole > 0.0, whole, 1.0))[:, None] * weight"

# path → (what is wrong, the checks that see it, file, code, what stands in its place, {} being the code)
FAULTS = {
    "hermite_fe": [
        ("impulses of the steps", "momentum", "stepping.py", STEP, "state.impulse[j] += 0.99 * conditions.p[j]"),
        ("impulses of the points", "points", "simulate.py", POINTS, "0.99 * {}"),
        ("half a node's mass", "initial_energy", "masses.py", "self.element(beam)",
         "{} * " + LOST.format("beam.lengths")),
        ("points mixed up", "second_moment", "simulate.py", POINTS, POINTS.replace("front", "::-1")),
        ("pulls recorded as pushes", "momentum", "stepping.py", STEP, "state.impulse[j] += abs(conditions.p[j])"),
        ("nodes that may not close", "penetration", "constraints.py", ANY, ANY.replace("True", "j % 3 > 0")),
        ("a free slope in the middle", "middle_slope", "model.py", "if full else (1,)", "if full else ()"),
        ("material loss", "energy", "stepping.py", "h * dot(damped_v, scratch)", "0.9 * {}"),
        ("steps of the wrong velocity", "energy", "integrators/theta.py", "q[i] += h * v_theta[i]", "q[i] += h * v[i]"),
    ],
    "exudyn_models": [
        ("total impulse", "momentum", "recording.py", MOMENTUM, "0.99 * ({})"),
        ("impulses of the points", "points", "recording.py", 'saved["impulse"] * s.impulse', "0.99 * {}"),
        ("points mixed up", "second_moment", "recording.py", GAIN, "np.roll({}, 1, axis=1)"),
        ("pulls recorded as pushes", "energy", "contacts/penalty.py", "self.signs * force, 0.0)", "abs(force), 0.0)"),
        ("half a node's mass, recorded", "momentum", "elements/beam.py", "self.element_matrices()[0]",
         "{} * " + LOST.format("self.lengths")),
    ],
    "self_similar_fe": [
        ("total impulse", "momentum", "run.py", "2.0 * float(self.impulse.sum())", "1.98 * float(self.impulse.sum())"),
        ("impulses of the points", "points", "run.py", "self.impulse * push", "0.99 * self.impulse * push"),
    ],
}  # fmt: skip


def simulated(package: Any) -> ImpactHistory:
    """Of a whole beam, held for a fifth of the run, so that some constraints pull; self-similar, of an infinite one."""
    if package.__name__ == "self_similar_fe":
        mesh = package.ExpandingMesh(front_resolution=0.05, growth=0.05, step_ratio=0.05, decades=2.0)
        return package.SelfSimilarFE(mesh=mesh).simulate(Impact.dimensionless(0.5), end_time=0.1, save=60)
    contacts = import_module(f"{package.__name__}.contacts")
    if package.__name__ == "hermite_fe":
        method = package.HermiteFE(mesh=MESH, contact=contacts.NodeContact(hold_until=0.02))
    else:
        method = package.ExudynModel(mesh=MESH, contact=contacts.Penalty(hold=8))
    return method.for_whole_beam(WHOLE).simulate(WHOLE, end_time=END, save=60)


def forgotten(path: str) -> dict[str, Any]:
    """The modules of a path, which are imported anew from now on."""
    return {name: sys.modules.pop(name) for name in list(sys.modules) if name.partition(".")[0] == path}


@pytest.fixture
def own_modules(path: str, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """What a test imports of its path is forgotten after it. Nothing is compiled: that takes longer than the runs."""
    monkeypatch.setattr(numba.config, "DISABLE_JIT", True)
    before = forgotten(path)
    yield
    forgotten(path)
    sys.modules.update(before)


def checked(path: str, folder: Path) -> tuple[set[str], list[str]]:
    """Checks that a small run of a path, its package taken from a folder, does not keep to, and the run's warnings."""
    forgotten(path)
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(folder)
        package = import_module(path)
        history = simulated(package)
    assert Path(package.__file__).is_relative_to(folder)
    balance = balance_of(history)
    found = asdict(balance) | {"energy": history.energy_budget()["defect"]}
    return {name for name, most in SOUND.items() if abs(found[name] or 0.0) > most}, balance.warnings


@pytest.mark.parametrize("path", FAULTS)
def test_a_changed_line_shows_and_the_code_as_it_is_is_sound(path, tmp_path, own_modules):
    assert checked(path, ROOT) == (set(), [])
    for number, (fault, checks, file, code, other) in enumerate(FAULTS[path]):
        copy = tmp_path / str(number) / path
        shutil.copytree(ROOT / path, copy, ignore=shutil.ignore_patterns("__pycache__"))
        text = (copy / file).read_text()
        assert text.count(code) == 1
        (copy / file).write_text(text.replace(code, other.format(code)))
        wrong, warnings = checked(path, copy.parent)
        assert set(checks.split()) <= wrong, fault
        assert checks == "energy" or warnings, fault  # whoever runs it is told
