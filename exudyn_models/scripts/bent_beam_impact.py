"""A naturally bent beam hits the plane y = 0, in Exudyn's own items. EI = μ = V₀ = 1: its curvature is κ/ν.

Half of it is modelled. Exact for an infinite beam: contact up to x = λ₀√t, impulse on the whole beam 4√(2t/π) r₀.
"""

import argparse
import itertools
from collections.abc import Sequence
from typing import Any

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np

# κ/ν: λ₀, r₀
EXACT = {0.1: (4.25760, 2.74499), 0.2: (2.70353, 1.88523), 0.5: (1.01887, 1.17721), 0.8: (0.29685, 1.01915)}
COUNT, LENGTH, END, STEPS = 400, 0.0125, 0.1, 1500  # elements, the length of each, end time, time steps
# a node's spring is as stiff as its elements are in bending; its dashpot keeps it from rebounding
DASHPOT = {"contactStiffness": 10 / LENGTH**3, "contactDamping": 40 / LENGTH}
RIGID_IN_SHEAR = {"shearStiffness": 100 / LENGTH**2, "crossSectionInertia": 0.01 * LENGTH**2}
KINDS: dict[str, dict[str, Any]] = {
    "element": {  # node, body, its own section, coordinates between y and the last: x′, 1 at first
        "ancf_cable": (items.NodePoint2DSlope1, items.ObjectANCFCable2D, {}, [1]),
        "geometrically_exact": (items.NodeRigidBody2D, items.ObjectBeamGeometricallyExact2D, RIGID_IN_SHEAR, []),
    },
    "contact": {"dashpot": {}, "gonthier": {"contactDamping": 0, "impactModel": 2, "restitutionCoefficient": 0.5}},
    "integrator": {
        "generalized_alpha": {"spectralRadius": 0.5},
        "newmark": {"useNewmark": True, "newmarkGamma": 0.6, "newmarkBeta": 0.3025},
        "trapezoidal": {"useNewmark": True, "newmarkGamma": 0.5, "newmarkBeta": 0.25},
    },
}


def main(arguments: Sequence[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--kappa-over-nu", dest="kappa", type=float, choices=EXACT, default=0.5)
    for part, kinds in KINDS.items():
        options.add_argument(f"--{part}", choices=kinds, default=next(iter(kinds)))
    options.add_argument("--view", action="store_true", help="watch it, with larger deflections")
    chosen = options.parse_args(arguments)
    small = 0.1 if chosen.view else 1e-4  # times all deflections and forces: slopes must be small
    container = exu.SystemContainer()
    mbs: Any = container.AddSystem()

    # the beam: a bow free of stress that moves towards y > 0; its middle neither moves along x nor turns
    node_kind, body_kind, own, between = KINDS["element"][chosen.element]
    x, none = LENGTH * np.arange(COUNT + 1), [0] * len(between)
    y, slope = -small * chosen.kappa * x**2 / 2, -small * chosen.kappa * x
    nodes = []
    for s, *bow in zip(x, y, slope):
        first = {"initialCoordinates": [0, bow[0], *none, bow[1]], "initialVelocities": [0, small, *none, 0]}
        nodes.append(mbs.AddNode(node_kind(referenceCoordinates=[s, 0, *between, 0], **first)))
    section = own | {"length": LENGTH, "massPerLength": 1, "bendingStiffness": 1, "axialStiffness": 1}
    # its damping is for waves as short as the elements
    section |= {"referenceCurvature": -small * chosen.kappa, "bendingDamping": 0.15 * LENGTH**2}
    for pair in itertools.pairwise(nodes):
        mbs.AddObject(body_kind(nodeNumbers=list(pair), **section))
    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
    for coordinate in (0, 2 + len(between)):
        middle = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=coordinate))
        mbs.AddObject(items.CoordinateConstraint(markerNumbers=[ground, middle]))

    # the plane, at every node
    law = DASHPOT | {"minimumImpactVelocity": 0.5 * small} | KINDS["contact"][chosen.contact]
    share = np.where((x > 0) & (x < x[-1]), 1, 0.5)  # of LENGTH, that a node stands for
    for node, gap, part in zip(nodes, -y, share):
        state = [max(1e-14, gap), 0][: 1 + ("impactModel" in law)]  # open
        data = mbs.AddNode(items.NodeGenericData(numberOfDataCoordinates=len(state), initialCoordinates=state))
        markers = [mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=1)), ground]
        its = law | {name: part * law[name] for name in DASHPOT}
        mbs.AddObject(items.ObjectContactCoordinate(markerNumbers=markers, nodeNumber=data, **its))

    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    stepping = settings.timeIntegration
    stepping.endTime, stepping.numberOfSteps, stepping.adaptiveStep = END, STEPS, False
    stepping.newton.relativeTolerance, stepping.newton.absoluteTolerance = 1e-5, 1e-7 * small
    stepping.discontinuous.iterationTolerance = 1e-4 * small  # a force: Exudyn's 1 is above all here
    stepping.discontinuous.useRecommendedStepSize = False  # contact changes in most steps
    for name, value in KINDS["integrator"][chosen.integrator].items():
        setattr(stepping.generalizedAlpha, name, value)
    watched = chosen.view and container.renderer.Start()
    mbs.SolveDynamic(settings)
    if watched:
        container.renderer.DoIdleTasks()
        container.renderer.Stop()

    # the momentum P that the beam has lost acts at x = λ₀√t: ∫x lost dx = κt + ½λ₀√t P
    lost = LENGTH * share * (1 - mbs.systemData.GetODE2Coordinates_t().reshape(x.size, -1)[:, 1] / small)
    found = 2 * (x @ lost - chosen.kappa * END) / lost.sum() / END**0.5, lost.sum() / (8 * END / np.pi) ** 0.5
    for name, value, exact in zip(("lambda0", "r0"), found, EXACT[chosen.kappa]):
        print(f"{name} = {value:.4f}, exact {exact}, off by {value / exact - 1:+.2%}")


if __name__ == "__main__":
    main()
