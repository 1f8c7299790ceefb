"""A ball on a stiff damped spring: each bounce keeps e = exp(−πζ/√(1−ζ²)) of the velocity, ζ = d/(2√(km)).

python exudyn_models/scripts/bouncing_ball.py [--restitution 0.8] [--out FILE]
"""

import argparse

import exudyn as exu
import exudyn.itemInterface as items
import matplotlib.pyplot as plt
import numpy as np

from exudyn_models.solvers import quiet

LOWEST = 0.01  # of the height: below, the spring's own sag under the weight shows
MASS, GRAVITY, HEIGHT, STIFFNESS, END = 1.0, 9.81, 1.0, 1e7, 2.5


def main(arguments: list[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--restitution", type=float, default=0.8)
    options.add_argument("--out", default="bouncing_ball.png", help="file to save the figure in")
    chosen = options.parse_args(arguments)
    if not LOWEST**0.5 < (e := chosen.restitution) <= 1.0:
        options.error(f"--restitution must lie above {LOWEST**0.5:g}, and at most at 1 (got {e})")
    damping = -2 * np.log(e) / np.hypot(np.pi, np.log(e)) * np.sqrt(STIFFNESS * MASS)
    mbs = exu.SystemContainer().AddSystem()
    ball = mbs.AddNode(items.NodePoint2D(referenceCoordinates=[0.0, 0.0], initialCoordinates=[0.0, HEIGHT]))
    mbs.AddObject(items.ObjectMassPoint2D(mass=MASS, nodeNumber=ball))
    centre = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=ball))
    mbs.AddLoad(items.Force(markerNumber=centre, loadVector=[0.0, -MASS * GRAVITY, 0.0]))
    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
    vertical = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ball, coordinate=1))
    law = {"nodeNumber": mbs.AddNode(items.NodeGenericData(numberOfDataCoordinates=1, initialCoordinates=[HEIGHT]))}
    law |= {"contactStiffness": STIFFNESS, "contactDamping": damping}
    mbs.AddObject(items.ObjectContactCoordinate(markerNumbers=[ground, vertical], **law))
    position = exu.OutputVariableType.Position
    sensor = mbs.AddSensor(items.SensorNode(nodeNumber=ball, storeInternal=True, outputVariableType=position))
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 1e-4
    time = settings.timeIntegration
    time.endTime, time.numberOfSteps = END, round(END / 1.5e-5)  # sixty steps to the contact's half period
    time.solverType = exu.DynamicSolverType.RK44
    with quiet():
        mbs.SolveDynamic(settings)
    t, y = np.array(mbs.GetSensorStoredData(sensor))[:, [0, 2]].T
    top = np.flatnonzero((y[1:-1] > y[:-2]) & (y[1:-1] >= y[2:])) + 1
    for k, apex in enumerate(y[top][:3] / HEIGHT, start=1):
        exact = e ** (2 * k)
        if exact > LOWEST:
            print(f"apex {k} = {apex:.5f} of the height, exact {exact:.5f}, off by {apex / exact - 1:+.2%}")
    figure, axes = plt.subplots(layout="constrained")
    axes.plot(t, y)
    axes.set(xlabel="t, s", ylabel="height, m", title=f"bouncing ball, e = {e:g}")
    figure.savefig(chosen.out, dpi=150)


if __name__ == "__main__":
    main()
