"""One small run of a path for each folder given, its package taken from there: the checks, a line of JSON each.

python faulty_runs.py hermite_fe FOLDER exudyn_models FOLDER …
"""

import json
import sys
from dataclasses import asdict
from importlib import import_module
from typing import Any

import numba
import numpy as np
from exudyn.solver import ComputeLinearizedSystem

from bent_beam import Impact, ImpactHistory
from bent_beam.meshes import UniformMesh
from bent_beam.method import made_of
from measure.balance import balance_of
from measure.reduction import pull_of

numba.config.DISABLE_JIT = True  # a changed source would be compiled anew, for longer than the run takes
WHOLE, END = Impact.whole_beam(0.5, relative_damping=1e-2), 0.1
MESH = UniformMesh(1.0 / 16)


def hermite_fe(package: Any) -> tuple[ImpactHistory, float]:
    """A whole beam, held for the first fifth of the run, so that some constraints pull; its mass matrix over μL."""
    contact = import_module("hermite_fe.contacts").NodeContact(hold_until=0.02)
    method = package.HermiteFE(mesh=MESH, contact=contact).for_whole_beam(WHOLE)
    beam = import_module("hermite_fe.beam").HermiteBeam(MESH.nodes(1.0), 1.0, 1.0)
    moved = import_module("hermite_fe.banded").product(
        import_module("hermite_fe.masses").ConsistentMass().matrix(beam), beam.interpolate(np.ones(17), np.zeros(17))
    )
    return method.simulate(WHOLE, end_time=END, save=60), float(moved[0::2].sum())


def exudyn_models(package: Any) -> tuple[ImpactHistory, float]:
    """The same, its mass matrix asked of Exudyn."""
    beams: list[Any] = []

    def until(run: Any, *_: Any) -> bool:
        beams.append(run.beam)
        return False

    contact = import_module("exudyn_models.contacts").Penalty(hold=8)
    method = package.ExudynModel(mesh=MESH, contact=contact).for_whole_beam(WHOLE)
    history = package.simulate(WHOLE, end_time=END, save=60, until=until, **made_of(method))
    mass, _, _ = ComputeLinearizedSystem(beams[0].mbs)
    across = np.ix_(beams[0].vertical, beams[0].vertical)
    return history, float(mass[across].sum() / beams[0].lengths.sum())


def self_similar_fe(package: Any) -> tuple[ImpactHistory, float]:
    """An infinite beam; its mass matrix over what is modelled."""
    mesh = package.ExpandingMesh(front_resolution=0.05, growth=0.05, step_ratio=0.05, decades=2.0)
    state = import_module("self_similar_fe.similarity").similarity(0.5, mesh)
    moved = state.operators.mass @ np.tile([1.0, 0.0], state.zeta.size)
    history = package.SelfSimilarFE(mesh=mesh).simulate(Impact.dimensionless(0.5), end_time=0.1, save=60)
    return history, float(moved[0::2].sum() / state.zeta[-1])


def main(*words: str) -> None:
    """Run each path from the folder after it."""
    for path, folder in zip(words[::2], words[1::2]):
        for name in [name for name in sys.modules if name.partition(".")[0] == path]:
            del sys.modules[name]
        sys.path.insert(0, folder)
        history, mass = globals()[path](import_module(path))
        sys.path.remove(folder)
        found = {"mass": mass - 1.0, "energy": history.energy_budget()["defect"], "pull": pull_of(history)}
        balance = balance_of(history)
        print(json.dumps(found | asdict(balance) | {"warnings": balance.warnings}), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
