"""A straight beam of ANCF cables under one force P, statics, beside linear theory.

A cantilever with P at its tip: w = PL³/(3EI), slope PL²/(2EI). Or, `--simply-supported`, P in the middle of one whose
ends turn freely: w = PL³/(48EI), slope PL²/(16EI) at the ends, moment PL/4 (the thesis's Figs 3.2–3.3, which call it
fixed at both ends, show this beam).
"""

import argparse
import itertools
from collections.abc import Sequence
from typing import Any

import exudyn as exu
import exudyn.itemInterface as items
import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

from exudyn_models.solvers import open_viewer, quiet, wait_until_closed

LENGTH, EI, EA = 2.0, 1.0, 1e4  # m, N m², N


def main(arguments: Sequence[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--simply-supported", action="store_true")
    options.add_argument("--elements", type=int, default=8)
    options.add_argument(
        "--load", type=float, default=1e-3, help="N (small: the exact answer is that of linear theory)"
    )
    options.add_argument("--out", default="static_beam.png", help="file to save the figure in (default %(default)s)")
    options.add_argument(
        "--view", action="store_true", help="show it in Exudyn's viewer, true to scale: try --load 0.3"
    )
    chosen = options.parse_args(arguments)
    n, load, two = chosen.elements, chosen.load, chosen.simply_supported
    if n < 1 or (two and n % 2):
        options.error(f"--elements must be at least 1, and even where a node in the middle bears the load (got {n})")
    if not np.isfinite(load) or load == 0.0:
        options.error(f"--load must be a number other than 0 (got {load:g})")
    loaded = n // 2 if two else n
    # (node, coordinate): x, y, x′, y′; the stretch x′ stays free
    held = [(0, 0), (0, 1), (n, 1) if two else (0, 3)]
    q, moment = solved(n, held, loaded, load, chosen.view)
    x = np.linspace(0, LENGTH, 200)
    if two:
        folded = np.minimum(x, LENGTH - x)
        exact = load * folded * (3 * LENGTH**2 - 4 * folded**2) / (48 * EI)
        slope = q[0, 3], load * LENGTH**2 / (16 * EI)
    else:
        exact = load * x**2 * (3 * LENGTH - x) / (6 * EI)
        slope = q[n, 3], load * LENGTH**2 / (2 * EI)
    rows = [
        ("deflection under the load", q[loaded, 1], load * LENGTH**3 / ((48 if two else 3) * EI)),
        ("slope", *slope),
    ]
    for name, found, theory in [*rows, ("moment under the load", moment, abs(load) * LENGTH / 4)][: 3 if two else 2]:
        print(f"{name} = {found:.10g}, linear theory {theory:.10g}, off by {found / theory - 1:+.2e}")
    figure, axes = plt.subplots(layout="constrained")
    axes.plot(x, 1e3 * exact, "-", color="black", label="linear theory")
    axes.plot(np.linspace(0, LENGTH, n + 1) + q[:, 0], 1e3 * q[:, 1], "s", color="#D55E00", label="Exudyn, nodes")
    axes.set(
        xlabel="x, m", ylabel="deflection, mm", title=f"{'two supports' if two else 'cantilever'}, load {load:g} N"
    )
    axes.legend()
    figure.savefig(chosen.out, dpi=150)


def solved(
    elements: int, supports: Sequence[tuple[int, int]], loaded: int, load: float, view: bool
) -> tuple[NDArray[np.float64], float]:
    """Displacements and slopes (x, y, x′, y′) of the nodes, shape (elements + 1, 4), and the moment at ``loaded``.

    Raises ``SystemExit`` with one line where Newton's method fails.
    """
    container = exu.SystemContainer()
    mbs: Any = container.AddSystem()
    h = LENGTH / elements
    nodes = [
        mbs.AddNode(items.NodePoint2DSlope1(referenceCoordinates=[h * i, 0.0, 1.0, 0.0])) for i in range(elements + 1)
    ]
    beam: dict[str, Any] = {"length": h, "massPerLength": 1.0, "bendingStiffness": EI, "axialStiffness": EA}
    pairs = itertools.pairwise(nodes)
    cables = [mbs.AddObject(items.ObjectANCFCable2D(nodeNumbers=list(pair), **beam)) for pair in pairs]
    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
    for node, coordinate in supports:
        held = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=nodes[node], coordinate=coordinate))
        mbs.AddObject(items.CoordinateConstraint(markerNumbers=[ground, held]))
    point = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=nodes[loaded]))
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
    if view and open_viewer(container):
        wait_until_closed(container)
        container.renderer.Stop()
    q = np.array([mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates) for node in nodes])
    near = cables[min(loaded, elements - 1)]
    moment = mbs.GetObjectOutputBody(near, exu.OutputVariableType.TorqueLocal, [0.0, 0.0, 0.0])
    return q, abs(float(np.ravel(moment)[-1]))


if __name__ == "__main__":
    main()
