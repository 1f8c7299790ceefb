"""A straight beam of ANCF cables on supports under one force, statics: what the static scripts share."""

from __future__ import annotations

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

__all__ = ["EI", "LENGTH", "draw", "parser", "print_rows", "solved"]

LENGTH, EI, EA = 2.0, 1.0, 1e4  # m, N m², N


def parser(description: str | None, figure: str) -> argparse.ArgumentParser:
    """The options of a static script."""
    made = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("--elements", type=int, default=8)
    made.add_argument("--load", type=float, default=1e-3, help="N (small: the exact answer is that of linear theory)")
    made.add_argument("--out", default=figure, help="file to save the figure in (default %(default)s)")
    made.add_argument("--view", action="store_true", help="show it in Exudyn's viewer, true to scale: try --load 0.3")
    return made


def solved(
    elements: int, supports: Sequence[tuple[int, int]], loaded: int, load: float, view: bool
) -> tuple[NDArray[np.float64], float]:
    """Displacements and slopes (x, y, x′, y′) of the nodes, shape (elements + 1, 4), and the moment at ``loaded``.

    supports : (node, coordinate) pairs held fixed. Raises ``SystemExit`` with one line where Newton's method fails.
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
    mbs.AddLoad(
        items.Force(
            markerNumber=mbs.AddMarker(items.MarkerNodePosition(nodeNumber=nodes[loaded])), loadVector=[0, load, 0]
        )
    )
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


def draw(q: NDArray[np.float64], exact: NDArray[np.float64], title: str, out: str) -> None:
    """Save a figure of the deflections in ``q`` (m) beside ``exact`` ones, which stand at even distances."""
    figure, axes = plt.subplots(layout="constrained")
    axes.plot(np.linspace(0, LENGTH, exact.size), 1e3 * exact, "-", color="black", label="linear theory")
    places = np.linspace(0, LENGTH, len(q)) + q[:, 0]
    axes.plot(places, 1e3 * q[:, 1], "s", color="#D55E00", label="Exudyn, nodes")
    axes.set(xlabel="x, m", ylabel="deflection, mm", title=title)
    axes.legend()
    figure.savefig(out, dpi=150)


def print_rows(rows: Sequence[tuple[str, float, float]]) -> None:
    """Print what was found beside what is exact."""
    for name, found, exact in rows:
        print(f"{name} = {found:.10g}, linear theory {exact:.10g}, off by {found / exact - 1:+.2e}")
