"""A naturally bent beam hits the plane y = 0, in Exudyn's own items. EI = μ = V₀ = 1: its curvature is κ/ν.

Half of it is modelled. Exact for an infinite beam: contact up to x = λ₀√t, impulse on the whole beam 4√(2t/π) r₀.
"""

import argparse
import os
import sys
from typing import Any

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
from exudyn.beams import GenerateBeamElementsAlongLine

# κ/ν: λ₀, r₀
EXACT = {0.1: (4.25760, 2.74499), 0.2: (2.70353, 1.88523), 0.5: (1.01887, 1.17721), 0.8: (0.29685, 1.01915)}
COUNT, LENGTH, END, STEPS = 400, 0.0125, 0.1, 1500  # elements, the length of each, end time, time steps
STIFF_BEAM = items.ObjectBeamGeometricallyExact2D(shearStiffness=100 / LENGTH**2, crossSectionInertia=0.01 * LENGTH**2)
KINDS: dict[str, dict[str, Any]] = {
    "element": {"ancf_cable": items.ObjectANCFCable2D(), "geometrically_exact": STIFF_BEAM},
    "contact": {"dashpot": {}, "gonthier": {"contactDamping": 0, "impactModel": 2, "restitutionCoefficient": 0.5}},
    "integrator": {
        "generalized_alpha": {"spectralRadius": 0.5},
        "newmark": {"useNewmark": True, "newmarkGamma": 0.6, "newmarkBeta": 0.3025},
        "trapezoidal": {"useNewmark": True, "newmarkGamma": 0.5, "newmarkBeta": 0.25},
    },
}


def main(arguments: list[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--kappa-over-nu", dest="kappa", type=float, choices=EXACT, default=0.5)
    for part, kinds in KINDS.items():
        options.add_argument(f"--{part}", choices=kinds, default=next(iter(kinds)))
    options.add_argument("--view", action="store_true", help="watch it, with larger deflections")
    chosen = options.parse_args(arguments)
    if chosen.kappa == 0.1 and chosen.contact == "gonthier":
        options.error("--contact gonthier lets nodes rebound, which no thin front bears: take dashpot at 0.1")
    small = 0.1 if chosen.view else 1e-4  # times all deflections and forces: slopes must be small
    container = exu.SystemContainer()
    mbs: Any = container.AddSystem()

    # half of the beam: its middle neither moves along x nor turns
    element = KINDS["element"][chosen.element]
    element.massPerLength = element.bendingStiffness = element.axialStiffness = 1
    element.referenceCurvature, element.bendingDamping = -small * chosen.kappa, 0.15 * LENGTH**2  # of short waves
    stretch = [0] if chosen.element == "ancf_cable" else []  # coordinates of a node: x, y, of cables x′, slope
    line, middle = ([0, 0, 0], [COUNT * LENGTH, 0, 0], COUNT), [1, 0, *stretch, 1]
    nodes = GenerateBeamElementsAlongLine(mbs, *line, element, groundConstraintsStart=middle)["nodes"]

    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))
    x = LENGTH * np.arange(COUNT + 1)
    share = np.where((x > 0) & (x < x[-1]), 1, 0.5)  # of LENGTH, that a node stands for
    for node, s, part in zip(nodes, x, share):
        # a bow free of stress that moves towards y > 0 …
        gap, slope = small * chosen.kappa * s**2 / 2, -small * chosen.kappa * s
        mbs.SetNodeParameter(node, "initialCoordinates", [0, -gap, *stretch, slope])
        mbs.SetNodeParameter(node, "initialVelocities", [0, small, *stretch, 0])
        # … and the plane: a spring as stiff as the elements are in bending, a dashpot that keeps nodes from rebounding
        law = {"contactStiffness": 10 * part / LENGTH**3, "contactDamping": 40 * part / LENGTH}
        law |= {"minimumImpactVelocity": 0.5 * small} | KINDS["contact"][chosen.contact]
        state = [max(1e-14, gap), 0][: 1 + ("impactModel" in law)]  # the gap: open
        data = mbs.AddNode(items.NodeGenericData(numberOfDataCoordinates=len(state), initialCoordinates=state))
        markers = [mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=1)), ground]
        mbs.AddObject(items.ObjectContactCoordinate(markerNumbers=markers, nodeNumber=data, **law))

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
    shown = not sys.platform.startswith("linux") or os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    watched = chosen.view and shown and container.renderer.Start()
    if chosen.view and not watched:
        print("no display: Exudyn's viewer cannot open a window here", file=sys.stderr)
    mbs.SolveDynamic(settings)
    if watched:
        container.renderer.DoIdleTasks()

    # the momentum P that the beam has lost acts at x = λ₀√t: ∫x lost dx = κt + ½λ₀√t P
    lost = LENGTH * share * (1 - mbs.systemData.GetODE2Coordinates_t().reshape(x.size, -1)[:, 1] / small)
    found = 2 * (x @ lost - chosen.kappa * END) / lost.sum() / END**0.5, lost.sum() / (8 * END / np.pi) ** 0.5
    for name, value, exact in zip(("lambda0", "r0"), found, EXACT[chosen.kappa]):
        print(f"{name} = {value:.4f}, exact {exact}, off by {value / exact - 1:+.2%}")


if __name__ == "__main__":
    main()
