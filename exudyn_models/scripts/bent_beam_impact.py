"""A naturally bent beam hits a rigid plane, in Exudyn's own items. Its middle touches y = 0 at t = 0.

    python bent_beam_impact.py [--kappa-over-nu ...] [--element ...] [--contact ...] [--integrator ...] [--view]

Bending stiffness, mass per length and velocity are EI = μ = V₀ = 1, so that the curvature κ of the bow is κ/ν,
ν = V₀√(μ/EI). Half of the beam is modelled. The contact spreads as x = λ₀√t, and the impulse on the whole beam is
4√(2t/π) r₀, r₀ = 1 being that of a single point (two-scale theory of an infinite undamped beam).
"""

import argparse
from collections.abc import Sequence
from typing import Any

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np

# κ/ν: exact λ₀, r₀
EXACT = {0.1: (4.25760, 2.74499), 0.2: (2.70353, 1.88523), 0.5: (1.01887, 1.17721), 0.8: (0.29685, 1.01915)}
COUNT, LENGTH, END, STEPS = 400, 0.0125, 0.1, 1500  # elements and the length of each; the run
X = LENGTH * np.arange(COUNT + 1)
SHARE = np.where((X > 0) & (X < X[-1]), LENGTH, LENGTH / 2)  # length of beam that each node stands for
# a penalty as stiff as the elements are in bending; its dashpot keeps nodes from rebounding
DASHPOT = {"contactStiffness": 10 / LENGTH**3, "contactDamping": 40 / LENGTH}
GONTHIER = DASHPOT | {"contactDamping": 0, "impactModel": 2, "restitutionCoefficient": 0.5}  # 2: Gonthier's law
KINDS: dict[str, dict[str, Any]] = {
    "element": {"ancf_cable": items.ObjectANCFCable2D, "geometrically_exact": items.ObjectBeamGeometricallyExact2D},
    "contact": {"dashpot": DASHPOT, "gonthier": GONTHIER},
    "integrator": {
        "generalized_alpha": {"spectralRadius": 0.5},
        "newmark": {"useNewmark": True, "newmarkGamma": 0.6, "newmarkBeta": 0.3025},
        "trapezoidal": {"useNewmark": True, "newmarkGamma": 0.5, "newmarkBeta": 0.25},
    },
}


def main(arguments: Sequence[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--kappa-over-nu", dest="kappa", type=float, choices=EXACT, default=0.5)
    for part, kinds in KINDS.items():
        options.add_argument(f"--{part}", choices=kinds, default=next(iter(kinds)))
    options.add_argument("--view", action="store_true", help="watch it, with larger deflections")
    chosen = options.parse_args(arguments)
    small = 0.1 if chosen.view else 1e-4  # times all deflections, and so all forces: slopes must be small
    container = exu.SystemContainer()
    mbs: Any = container.AddSystem()

    # the beam: a bow free of stress that moves towards y > 0; symmetry holds x and the slope of its middle
    section: dict[str, Any] = {"length": LENGTH, "massPerLength": 1, "bendingStiffness": 1, "axialStiffness": 1}
    section |= {"referenceCurvature": -small * chosen.kappa}
    section |= {"bendingDamping": 0.15 * LENGTH**2}  # of waves as short as elements, which no mesh carries
    node_kind: Any
    if cable := chosen.element == "ancf_cable":
        node_kind, straight, own = items.NodePoint2DSlope1, [1, 0], [0, 1, 3]  # x, y, x′, y′
    else:  # x, y, angle; so stiff in shear that the beam only bends
        node_kind, straight, own = items.NodeRigidBody2D, [0], [0, 1, 2]
        section |= {"shearStiffness": 100 / LENGTH**2, "crossSectionInertia": 0.01 * LENGTH**2}
    bow, speed = np.zeros((2, X.size, 4 if cable else 3))
    bow[:, own[1]], bow[:, own[2]], speed[:, own[1]] = -chosen.kappa * X**2 / 2, -chosen.kappa * X, 1
    nodes = [
        mbs.AddNode(node_kind(referenceCoordinates=[x, 0, *straight], initialCoordinates=u, initialVelocities=v))
        for x, u, v in zip(X, small * bow, small * speed)
    ]
    for i in range(COUNT):
        mbs.AddObject(KINDS["element"][chosen.element](nodeNumbers=nodes[i : i + 2], **section))
    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
    for coordinate in (own[0], own[2]):
        middle = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=coordinate))
        mbs.AddObject(items.CoordinateConstraint(markerNumbers=[ground, middle]))

    # the plane y = 0, at every node
    law = KINDS["contact"][chosen.contact]
    for node, gap, share in zip(nodes, -small * bow[:, 1], SHARE / LENGTH):
        state = [max(1e-14, gap)] + [0] * ("impactModel" in law)  # open at first
        data = mbs.AddNode(items.NodeGenericData(numberOfDataCoordinates=len(state), initialCoordinates=state))
        markers = [mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=own[1])), ground]
        its = law | {name: share * law[name] for name in ("contactStiffness", "contactDamping")}
        its |= {"minimumImpactVelocity": 0.5 * small, "markerNumbers": markers, "nodeNumber": data}
        mbs.AddObject(items.ObjectContactCoordinate(**its))

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

    # the impulse is the momentum P that is lost, ∫lost dx; it acts at the zone's end, which moves as λ₀√t, against
    # the moment EI κ of the flat zone: ∫x lost dx = κt + ½λ₀√t P
    lost = SHARE * (1 - mbs.systemData.GetODE2Coordinates_t().reshape(X.size, -1)[:, own[1]] / small)
    lambda0 = 2 * (X @ lost - chosen.kappa * END) / lost.sum() / np.sqrt(END)
    r0 = 2 * lost.sum() / (4 * np.sqrt(2 * END / np.pi))
    for name, found, exact in zip(("lambda0", "r0"), (lambda0, r0), EXACT[chosen.kappa]):
        print(f"{name} = {found:.4f}, exact {exact}, off by {found / exact - 1:+.2%}")


if __name__ == "__main__":
    main()
