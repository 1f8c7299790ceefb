"""A cantilever of ANCF cables under a tip load, statics: w = PL³/(3EI), slope PL²/(2EI) for small deflections.

python exudyn_models/scripts/cantilever.py [--elements 8] [--load 1e-3] [--view]
"""

import argparse

import exudyn as exu
import exudyn.itemInterface as items
import matplotlib.pyplot as plt
import numpy as np

from exudyn_models.solvers import silence
from exudyn_models.viewer import open_viewer, wait_until_closed

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--elements", type=int, default=8)
parser.add_argument("--load", type=float, default=1e-3, help="tip load, N (small: the exact answer is linear)")
parser.add_argument("--figure", default="cantilever.png")
parser.add_argument("--view", action="store_true", help="show it in Exudyn's viewer, true to scale: try --load 0.3")
chosen = parser.parse_args()
L, EI, EA, mu, P, n = 2.0, 1.0, 1e4, 1.0, chosen.load, chosen.elements

SC = exu.SystemContainer()
mbs = SC.AddSystem()
nodes = [mbs.AddNode(items.NodePoint2DSlope1(referenceCoordinates=[L * i / n, 0.0, 1.0, 0.0])) for i in range(n + 1)]
for i in range(n):
    mbs.AddObject(
        items.ObjectANCFCable2D(
            length=L / n, massPerLength=mu, bendingStiffness=EI, axialStiffness=EA, nodeNumbers=[nodes[i], nodes[i + 1]]
        )
    )
ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
for coordinate in (0, 1, 3):  # clamp: x, y and the slope; the fourth, the stretch, stays free
    clamped = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=coordinate))
    mbs.AddObject(items.CoordinateConstraint(markerNumbers=[ground, clamped]))
mbs.AddLoad(
    items.Force(markerNumber=mbs.AddMarker(items.MarkerNodePosition(nodeNumber=nodes[-1])), loadVector=[0.0, P, 0.0])
)
mbs.Assemble()

settings = exu.SimulationSettings()
settings.solution.file.write = False
settings.staticSolver.verboseMode = 0
settings.staticSolver.newton.relativeTolerance = 1e-12
with silence():
    mbs.SolveStatic(settings)
q = np.array([mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates) for node in nodes])
w, slope = q[-1, 1], q[-1, 3]
for name, found, exact in (("tip deflection", w, P * L**3 / (3 * EI)), ("tip slope", slope, P * L**2 / (2 * EI))):
    print(f"{name} = {found:.10g}, exact {exact:.10g}, off by {found / exact - 1:+.2e}")

x = np.linspace(0, L, n + 1)
plt.plot(x, P * x**2 * (3 * L - x) / (6 * EI), "-", label="exact")
plt.plot(x, q[:, 1], "o", label="Exudyn")
plt.gca().set(xlabel="x, m", ylabel="deflection, m", title="cantilever under a tip load")
plt.legend()
plt.savefig(chosen.figure, dpi=150)
print("figure:", chosen.figure)
if chosen.view and open_viewer(SC):
    wait_until_closed(SC)
    SC.renderer.Stop()
