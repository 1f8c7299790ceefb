"""A straight beam of ANCF cables under one force P, statics, beside linear theory.

A cantilever with P at its tip: w = PL³/(3EI), slope PL²/(2EI). Or, `--simply-supported`, P in the middle of one whose
ends turn freely: w = PL³/(48EI), slope PL²/(16EI) at the ends, moment PL/4 (the thesis's Figs 3.2–3.3, which call it
fixed at both ends, show this beam).
"""

import argparse
from typing import Any

import exudyn as exu
import exudyn.itemInterface as items
import matplotlib.pyplot as plt
import numpy as np
from exudyn.beams import GenerateBeamElementsAlongLine

from exudyn_models.solvers import open_viewer, quiet, wait_until_closed

LENGTH, EI, EA = 2.0, 1.0, 1e4  # m, N m², N
CLAMPED, HINGED, ROLLER = [1, 1, 0, 1], [1, 1, 0, 0], [0, 1, 0, 0]  # which of x, y, x′, y′ are held


def main(arguments: list[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--simply-supported", action="store_true")
    options.add_argument("--elements", type=int, default=8)
    options.add_argument("--load", type=float, default=1e-3, help="N (small: linear theory is exact)")
    options.add_argument("--out", default="static_beam.png", help="file to save the figure in (default %(default)s)")
    options.add_argument("--view", action="store_true", help="show it, true to scale: try --load 0.3")
    chosen = options.parse_args(arguments)
    n, load, two = chosen.elements, chosen.load, chosen.simply_supported
    if n < 1 or (two and n % 2):
        options.error(f"--elements must be at least 1, and even where a node in the middle bears the load (got {n})")
    if not 0.0 < abs(load) < 1e6:
        options.error(f"--load must be a number other than 0, below a million (got {load:g})")

    container = exu.SystemContainer()
    mbs: Any = container.AddSystem()
    cable = items.ObjectANCFCable2D(massPerLength=1.0, bendingStiffness=EI, axialStiffness=EA)
    ends = {"groundConstraintsStart": HINGED if two else CLAMPED, "groundConstraintsEnd": ROLLER if two else None}
    beam = GenerateBeamElementsAlongLine(mbs, [0, 0, 0], [LENGTH, 0, 0], n, cable, **ends)
    loaded = n // 2 if two else n
    point = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=beam["nodes"][loaded]))
    mbs.AddLoad(items.Force(markerNumber=point, loadVector=[0, load, 0]))
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.staticSolver.verboseMode = 0
    settings.staticSolver.newton.relativeTolerance = 1e-12
    settings.staticSolver.numberOfLoadSteps = 1 + int(20 * abs(load))
    with quiet():
        try:
            mbs.SolveStatic(settings)
        except Exception:
            raise SystemExit(f"Exudyn found no equilibrium under --load {load:g}: take a smaller one") from None
    if chosen.view and open_viewer(container):
        wait_until_closed(container)
        container.renderer.Stop()

    q = mbs.systemData.GetODE2Coordinates().reshape(n + 1, 4)  # x, y, x′, y′, less those of the straight beam
    rows = [("deflection under the load", q[loaded, 1], load * LENGTH**3 / ((48 if two else 3) * EI))]
    rows += [("slope", q[0 if two else n, 3], load * LENGTH**2 / ((16 if two else 2) * EI))]
    if two:
        moment = mbs.GetObjectOutputBody(beam["elements"][loaded], exu.OutputVariableType.TorqueLocal, [0.0, 0.0, 0.0])
        rows += [("moment under the load", abs(np.ravel(moment)[-1]), abs(load) * LENGTH / 4)]
    for name, found, theory in rows:
        print(f"{name} = {found:.10g}, linear theory {theory:.10g}, off by {found / theory - 1:+.2e}")
    x = np.linspace(0, LENGTH, 200)
    near = np.minimum(x, LENGTH - x)
    shape = near * (3 * LENGTH**2 - 4 * near**2) / 48 if two else x**2 * (3 * LENGTH - x) / 6
    figure, axes = plt.subplots(layout="constrained")
    axes.plot(x, 1e3 * load / EI * shape, "-", color="black", label="linear theory")
    axes.plot(np.linspace(0, LENGTH, n + 1) + q[:, 0], 1e3 * q[:, 1], "s", color="#D55E00", label="Exudyn, nodes")
    axes.set(xlabel="x, m", ylabel="deflection, mm", title=f"{'two supports' if two else 'cantilever'}, {load:g} N")
    axes.legend()
    figure.savefig(chosen.out, dpi=150)


if __name__ == "__main__":
    main()
