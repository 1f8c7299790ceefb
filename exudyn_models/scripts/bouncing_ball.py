"""A ball on a stiff damped spring at the ground: each bounce keeps e = exp(−πζ/√(1−ζ²)) of the velocity, ζ =
d/(2√(km)).

Between bounces the flight is exact, so the k-th apex is e^{2k} of the first height (for a contact short against the
flight).
python exudyn_models/scripts/bouncing_ball.py [--restitution 0.8] [--view]
"""

import argparse

import exudyn as exu
import exudyn.itemInterface as items
import matplotlib.pyplot as plt
import numpy as np

from exudyn_models.solvers import silence
from exudyn_models.viewer import draw_wall, open_viewer, wait_until_closed

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--restitution", type=float, default=0.8)
parser.add_argument("--figure", default="bouncing_ball.png")
parser.add_argument("--view", action="store_true", help="watch in Exudyn's viewer")
chosen = parser.parse_args()
e = chosen.restitution
if not 0.0 < e <= 1.0:
    parser.error(f"--restitution must lie in (0, 1] (got {e})")
mass, g, height, stiffness, end = 1.0, 9.81, 1.0, 1e7, 2.5
zeta = -np.log(e) / np.hypot(np.pi, np.log(e))

SC = exu.SystemContainer()
mbs = SC.AddSystem()
ball = mbs.AddNode(items.NodePoint2D(referenceCoordinates=[0.0, 0.0], initialCoordinates=[0.0, height]))
mbs.AddObject(items.ObjectMassPoint2D(mass=mass, nodeNumber=ball))
mbs.AddLoad(
    items.Force(markerNumber=mbs.AddMarker(items.MarkerNodePosition(nodeNumber=ball)), loadVector=[0.0, -mass * g, 0.0])
)
ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
vertical = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ball, coordinate=1))
state = mbs.AddNode(items.NodeGenericData(numberOfDataCoordinates=1, initialCoordinates=[height]))
mbs.AddObject(
    items.ObjectContactCoordinate(
        markerNumbers=[ground, vertical],
        nodeNumber=state,
        contactStiffness=stiffness,
        contactDamping=2 * zeta * np.sqrt(stiffness * mass),
    )
)
sensor = mbs.AddSensor(
    items.SensorNode(nodeNumber=ball, storeInternal=True, outputVariableType=exu.OutputVariableType.Position)
)
draw_wall(mbs, -1.0, 1.0)
mbs.Assemble()

settings = exu.SimulationSettings()
settings.solution.file.write = False
settings.solution.sensors.writePeriod = 1e-4
settings.timeIntegration.solverType = exu.DynamicSolverType.RK44  # a step of 1/60 of the contact's half period
settings.timeIntegration.numberOfSteps = round(end / 1.5e-5)
settings.timeIntegration.endTime = end
settings.timeIntegration.verboseMode = 0
viewing = chosen.view and open_viewer(SC, nodes=True)
with silence():
    mbs.SolveDynamic(settings)
if viewing:
    wait_until_closed(SC)
    SC.renderer.Stop()

t, y = np.array(mbs.GetSensorStoredData(sensor))[:, [0, 2]].T
top = np.flatnonzero((y[1:-1] > y[:-2]) & (y[1:-1] >= y[2:])) + 1
for k, apex in enumerate(y[top][:3], start=1):
    exact = height * e ** (2 * k)
    print(f"apex {k} = {apex:.5f} m, exact {exact:.5f} m, off by {apex / exact - 1:+.2%}")
plt.plot(t, y)
plt.gca().set(xlabel="t, s", ylabel="height, m", title=f"bouncing ball, e = {e:g}")
plt.savefig(chosen.figure, dpi=150)
print("figure:", chosen.figure)
