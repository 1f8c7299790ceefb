"""The thesis's first-order impacts in Exudyn's own items: the beam of `bent_beam_impact.py` accelerated by
a₀ = ±700 m/s². EI = μ = 1, V₀ = 3.5 m/s, K = 0.35 1/m (κ/ν = 0.1).

Contact ends at x = √t (λ₀ + ελ₁V₀² t) and pushes there with F = √(2/(πt)) V₀ (r₀ + εr₁V₀² t); a load that presses adds
a₀ along it. Both are found from what a₀ changes; half of a₀ shows what is of second order, which goes.
"""

import argparse
from typing import Any

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
from exudyn.beams import GenerateBeamElementsAlongLine

EXACT = {700: (300.0, 85.90), -700: (-280.6, -88.97)}  # a₀: ελ₁V₀², εr₁ (thesis 2.7.40, 2.7.71)
# nodes' dashpot, √(EIμ)/Δx: must not let them rebound where they are pressed, nor hold them where the zone lifts off
DASHPOT = {700: 40, -700: 10}
LAMBDA0, R0 = 4.25760, 2.74499  # exact
SPEED, CURVATURE, END, HALF, SMALL = 3.5, 0.35, 6.53e-4, 0.4, 1e-3  # SMALL times all deflections and forces


def impact(acceleration: float, dashpot: float, count: int) -> tuple[float, float]:
    """Impulse on one half of the beam until END, N s, and its moment about the middle, N s m."""
    mbs: Any = exu.SystemContainer().AddSystem()
    length, x = HALF / count, np.linspace(0, HALF, count + 1)
    cable = items.ObjectANCFCable2D(massPerLength=1, bendingStiffness=1, axialStiffness=1)
    cable.referenceCurvature, cable.bendingDamping = -SMALL * CURVATURE, 0.15 * length**2
    load, middle = [0, SMALL * acceleration, 0], [1, 0, 0, 1]  # the middle neither moves along x nor turns
    nodes = GenerateBeamElementsAlongLine(mbs, [0, 0, 0], [HALF, 0, 0], count, cable, load, middle)["nodes"]
    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
    share = np.where((x > 0) & (x < HALF), length, length / 2)
    for node, s, part in zip(nodes, x, share):  # it arrives as a bow; the plane
        gap, slope = SMALL * CURVATURE * s**2 / 2, -SMALL * CURVATURE * s
        mbs.SetNodeParameter(node, "initialCoordinates", [0, -gap, 0, slope])
        mbs.SetNodeParameter(node, "initialVelocities", [0, SMALL * SPEED, 0, 0])
        data = mbs.AddNode(items.NodeGenericData(numberOfDataCoordinates=1, initialCoordinates=[max(1e-14, gap)]))
        markers = [mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=1)), ground]
        law = {"contactStiffness": 10 * part / length**4, "contactDamping": dashpot * part / length**2}
        mbs.AddObject(items.ObjectContactCoordinate(markerNumbers=markers, nodeNumber=data, **law))
    bending = items.SensorBody(bodyNumber=0, outputVariableType=exu.OutputVariableType.TorqueLocal, storeInternal=True)
    sensor = mbs.AddSensor(bending)  # in the middle
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 0
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    stepping = settings.timeIntegration
    stepping.endTime, stepping.numberOfSteps, stepping.adaptiveStep = END, round(3.75 * count), False
    stepping.newton.relativeTolerance, stepping.newton.absoluteTolerance = 1e-5, 1e-7 * SMALL
    stepping.discontinuous.iterationTolerance = 1e-4 * SMALL
    stepping.discontinuous.useRecommendedStepSize = False
    stepping.generalizedAlpha.spectralRadius = 0.5
    mbs.SolveDynamic(settings)

    time, moment = np.array(mbs.GetSensorStoredData(sensor))[:, [0, -1]].T
    lost = share * (SPEED + acceleration * END - mbs.systemData.GetODE2Coordinates_t()[1::4] / SMALL)
    return lost.sum(), x @ lost - np.trapezoid(moment, time) / SMALL


def main(arguments: list[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--elements", type=int, default=400)
    count = options.parse_args(arguments).elements
    if count < 200:
        options.error(f"--elements must be at least 200, with which lambda1 is 8 % off (got {count})")
    for load, exact in EXACT.items():
        # of the uniform reaction
        pressed = max(load, 0) * np.array([LAMBDA0 * END**1.5 / 1.5, LAMBDA0**2 * END**2 / 4])
        none, half, whole = (np.array(impact(part * load, DASHPOT[load], count)) for part in (0, 0.5, 1))
        push, turn = (4 * half - whole - 3 * none - pressed) / (SPEED * np.sqrt(2 / np.pi))
        r1 = 1.5 * push / END**1.5
        lambda1 = (2 * turn / END**2 - r1 * LAMBDA0) / R0
        for name, value, theory in zip(("lambda1 V0^2", "r1"), (lambda1, r1 / SPEED**2), exact):
            print(f"a0 = {load:+}: eps {name} = {value:.4g}, exact {theory}, off by {value / theory - 1:+.1%}")


if __name__ == "__main__":
    main()
