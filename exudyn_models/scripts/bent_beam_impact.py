"""A naturally bent beam hits a rigid plane, in Exudyn's own items: half of it, whose middle touches y = 0 at t = 0.

EI = μ = V₀ = 1: κ/ν = K√(EI/μ)/V₀ is the curvature K of the bow. The contact spreads as x = λ₀√t, and the impulse of
the plane on the whole beam is 4√(2t/π) r₀.   python exudyn_models/scripts/bent_beam_impact.py [--contact ...] [--view]
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np

EXACT = {0.1: (4.25760, 2.74499), 0.2: (2.70353, 1.88523), 0.5: (1.01887, 1.17721), 0.8: (0.29685, 1.01915)}  # λ₀, r₀
SIZE, ELEMENTS, END, STEPS = 0.0125, 400, 0.1, 1500
DAMPING = 40  # in √(EIμ)/Δx²
X = SIZE * np.arange(ELEMENTS + 1)
SHARE = np.where((X > 0) & (X < X[-1]), SIZE, SIZE / 2)  # length of beam that each node stands for
KINDS = {
    "element": ("ancf_cable", "geometrically_exact"),
    "contact": ("penalty", "impact_model", "general_contact"),
    "integrator": ("generalized_alpha", "newmark", "trapezoidal"),
}


def add_beam(mbs: Any, element: str, curvature: float, velocity: float) -> list[Any]:
    """A bow free of stress, y > 0 into the plane; its nodes."""
    cable = element == "ancf_cable"  # coordinates x, y, x′, y′; else x, y, angle
    node_kind = items.NodePoint2DSlope1 if cable else items.NodeRigidBody2D
    body_kind = items.ObjectANCFCable2D if cable else items.ObjectBeamGeometricallyExact2D
    section: dict[str, Any] = {"length": SIZE, "massPerLength": 1, "bendingStiffness": 1, "axialStiffness": 1}
    section |= {"referenceCurvature": -curvature, "bendingDamping": 0.15 * SIZE**2}  # of waves as short as elements
    section |= {} if cable else {"shearStiffness": 100 / SIZE**2, "crossSectionInertia": 0.01 * SIZE**2}
    nodes, along = [], [0] * cable
    for x in X:
        start = {"initialCoordinates": [0, -curvature * x**2 / 2, *along, -curvature * x]}
        start |= {"initialVelocities": [0, velocity, *along, 0]}
        nodes.append(mbs.AddNode(node_kind(referenceCoordinates=[x, 0, *[1] * cable, 0], **start)))
    for pair in pairwise(nodes):
        mbs.AddObject(body_kind(nodeNumbers=list(pair), **section))
    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
    for coordinate in (0, 3 if cable else 2):  # symmetry: the middle neither moves along x nor turns
        middle = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=coordinate))
        mbs.AddObject(items.CoordinateConstraint(markerNumbers=[ground, middle]))
    return nodes


def add_contact(mbs: Any, kind: str, nodes: list[Any], gaps: Any, velocity: float) -> None:
    """The plane y = 0, at every node: as stiff as the elements themselves, and damped so that no node rebounds."""
    laws = [{"contactStiffness": 10 * b / SIZE**4, "contactDamping": DAMPING * b / SIZE**2} for b in SHARE]
    if kind == "general_contact":  # spheres around the nodes, a square of two triangles
        general, radius, far = mbs.AddGeneralContact(), SIZE / 2, 2 * X[-1]
        general.SetFrictionPairings(np.zeros((1, 1)))
        general.SetSearchTreeCellSize([ELEMENTS // 2, 1, 1])
        general.SetSearchTreeBox([-1, -far, -1], [far, 1, 1])
        square = [[-1, radius, -1], [far, radius, -1], [far, radius, 1], [-1, radius, 1]]
        body = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=mbs.AddObject(items.ObjectGround())))
        general.AddTrianglesRigidBodyBased(body, 1e12, 0, 0, square, [[0, 1, 2], [0, 2, 3]])
        for node, law in zip(nodes, laws):
            place = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=node))
            general.AddSphereWithMarker(place, radius, **law, frictionMaterialIndex=0)
        return
    if kind == "impact_model":  # Gonthier's, in place of the dashpot
        model = {"impactModel": 2, "restitutionCoefficient": 0.5, "minimumImpactVelocity": 0.5 * velocity}
        laws = [law | model | {"contactDamping": 0} for law in laws]
    plane = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
    for node, gap, law in zip(nodes, gaps, laws):
        data = [max(1e-14, gap), *[0] * (kind == "impact_model")]  # open at first
        state = mbs.AddNode(items.NodeGenericData(numberOfDataCoordinates=len(data), initialCoordinates=data))
        deflection = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=1))
        mbs.AddObject(items.ObjectContactCoordinate(markerNumbers=[deflection, plane], nodeNumber=state, **law))


def solver_settings(integrator: str, small: float) -> Any:
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    stepping = settings.timeIntegration
    stepping.endTime, stepping.numberOfSteps, stepping.adaptiveStep = END, STEPS, False
    stepping.newton.relativeTolerance, stepping.newton.absoluteTolerance = 1e-5, 1e-7 * small  # in place of 1e-10
    stepping.discontinuous.iterationTolerance = 1e-4 * small  # in place of 1, above every force here
    stepping.discontinuous.useRecommendedStepSize = False  # contact changes in most steps
    rule = stepping.generalizedAlpha
    if integrator == "newmark":
        rule.useNewmark, rule.newmarkGamma, rule.newmarkBeta = True, 0.6, 0.3025
    elif integrator == "trapezoidal":
        stepping.solverType = exu.DynamicSolverType.TrapezoidalIndex2
    else:
        rule.spectralRadius = 0.5
    return settings


def main(arguments: Sequence[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--kappa-over-nu", type=float, choices=EXACT, default=0.5)
    for part, kinds in KINDS.items():
        options.add_argument(f"--{part}", choices=kinds, default=kinds[0])
    options.add_argument("--view", action="store_true", help="watch it, with larger deflections")
    chosen = options.parse_args(arguments)
    small = 0.1 if chosen.view else 1e-4  # of deflections: slopes stay small, and so do the forces of the tolerances
    container = exu.SystemContainer()
    mbs: Any = container.AddSystem()
    curvature = small * chosen.kappa_over_nu
    nodes = add_beam(mbs, chosen.element, curvature, small)
    add_contact(mbs, chosen.contact, nodes, curvature * X**2 / 2, small)
    mbs.Assemble()
    watched = chosen.view and container.renderer.Start()
    mbs.SolveDynamic(solver_settings(chosen.integrator, small))
    if watched:
        container.renderer.DoIdleTasks()
        container.renderer.Stop()
    # the impulse is the momentum that is lost; its moment about the middle, that of the beam there being EI K while
    # the zone is flat, says where the contact has come: the plane pushes at its end only, which moves as √t
    speeds = mbs.systemData.GetODE2Coordinates_t()[[mbs.GetNodeODE2Index(node) + 1 for node in nodes]]
    lost = SHARE * (1 - speeds / small)
    lambda0 = 2 * (X @ lost - chosen.kappa_over_nu * END) / lost.sum() / np.sqrt(END)
    r0 = 2 * lost.sum() / (4 * np.sqrt(2 * END / np.pi))
    for name, found, exact in zip(("lambda0", "r0"), (lambda0, r0), EXACT[chosen.kappa_over_nu]):
        print(f"{name} = {found:.4f}, exact {exact}, off by {found / exact - 1:+.2%}")


if __name__ == "__main__":
    main()
