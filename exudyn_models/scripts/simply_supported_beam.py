"""A simply supported beam under a load in its middle, statics: w = PL³/(48EI), moment PL/4, slope PL²/(16EI) at the
ends.

Both ends turn freely (the thesis's Figs 3.2–3.3, which call it fixed at both ends, show this beam).
python exudyn_models/scripts/simply_supported_beam.py [--elements 8] [--load 1e-3] [--view]
"""

import argparse

import exudyn as exu
import exudyn.itemInterface as items
import matplotlib.pyplot as plt
import numpy as np

from exudyn_models.solvers import silence
from exudyn_models.viewer import open_viewer, wait_until_closed

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--elements", type=int, default=8, help="an even number")
parser.add_argument("--load", type=float, default=1e-3, help="N (small: the exact answer is linear)")
parser.add_argument("--figure", default="simply_supported_beam.png")
parser.add_argument("--view", action="store_true", help="show it in Exudyn's viewer, true to scale: try --load 0.3")
chosen = parser.parse_args()
L, EI, EA, mu, P, n = 2.0, 1.0, 1e4, 1.0, chosen.load, chosen.elements
if n < 2 or n % 2:
    parser.error(f"--elements must be even, so that a node is under the load (got {n})")

SC = exu.SystemContainer()
mbs = SC.AddSystem()
nodes = [mbs.AddNode(items.NodePoint2DSlope1(referenceCoordinates=[L * i / n, 0.0, 1.0, 0.0])) for i in range(n + 1)]
cables = [
    mbs.AddObject(
        items.ObjectANCFCable2D(
            length=L / n, massPerLength=mu, bendingStiffness=EI, axialStiffness=EA, nodeNumbers=[nodes[i], nodes[i + 1]]
        )
    )
    for i in range(n)
]
ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
for node, coordinate in ((0, 0), (0, 1), (n, 1)):  # a hinge and a roller
    support = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=nodes[node], coordinate=coordinate))
    mbs.AddObject(items.CoordinateConstraint(markerNumbers=[ground, support]))
mbs.AddLoad(
    items.Force(
        markerNumber=mbs.AddMarker(items.MarkerNodePosition(nodeNumber=nodes[n // 2])), loadVector=[0.0, P, 0.0]
    )
)
mbs.Assemble()

settings = exu.SimulationSettings()
settings.solution.file.write = False
settings.staticSolver.verboseMode = 0
settings.staticSolver.newton.relativeTolerance = 1e-12
with silence():
    mbs.SolveStatic(settings)
q = np.array([mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates) for node in nodes])
moment = mbs.GetObjectOutputBody(cables[n // 2], exu.OutputVariableType.TorqueLocal, [0.0, 0.0, 0.0])
rows = (
    ("deflection in the middle", q[n // 2, 1], P * L**3 / (48 * EI)),
    ("slope at the end", q[0, 3], P * L**2 / (16 * EI)),
    ("moment in the middle", abs(float(np.ravel(moment)[-1])), P * L / 4),
)
for name, found, exact in rows:
    print(f"{name} = {found:.10g}, exact {exact:.10g}, off by {found / exact - 1:+.2e}")

x = np.linspace(0, L, n + 1)
folded = np.minimum(x, L - x)
plt.plot(x, P * folded * (3 * L**2 - 4 * folded**2) / (48 * EI), "-", label="exact")
plt.plot(x, q[:, 1], "o", label="Exudyn")
plt.gca().set(xlabel="x, m", ylabel="deflection, m", title="simply supported beam")
plt.legend()
plt.savefig(chosen.figure, dpi=150)
print("figure:", chosen.figure)
if chosen.view and open_viewer(SC):
    wait_until_closed(SC)
    SC.renderer.Stop()
