"""Sideways motion of a beam that slides on its wall with Coulomb friction, in three dimensions: z = μ_f η.

A straight beam of three-dimensional cables arrives at a bulging wall; its surface slides along z, faster than it is
deflected, so that each contact carries μ_f R sideways. η = y₀ − y is what the contact has taken from the free motion.
"""

import itertools

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
import pytest

from exudyn_models.integrators import GeneralizedAlpha
from exudyn_models.solvers import NewtonSolver, quiet

FRICTION, KAPPA, AMPLITUDE = 0.3, 0.5, 1e-3
ELEMENTS, LENGTH, END = 60, 3.0, 0.1


def taken_and_sideways(steps):
    """η and z at the nodes at the end, of half the beam."""
    h = LENGTH / ELEMENTS
    mbs = exu.SystemContainer().AddSystem()
    places = np.linspace(0.0, LENGTH, ELEMENTS + 1)
    start = [0.0, AMPLITUDE, 0.0, 0.0, 0.0, 0.0]
    at = [[x, 0.0, 0.0, 1.0, 0.0, 0.0] for x in places]
    nodes = [mbs.AddNode(items.NodePointSlope1(referenceCoordinates=q, initialVelocities=start)) for q in at]
    beam = {"length": h, "massPerLength": 1.0, "bendingStiffness": 1.0, "axialStiffness": 1.0}
    for pair in itertools.pairwise(nodes):
        mbs.AddObject(items.ObjectANCFCable(nodeNumbers=list(pair), **beam))
    ground = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=mbs.AddNode(items.NodePointGround()), coordinate=0))

    def marker(node, coordinate):
        return mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))

    for coordinate in (0, 4, 5):  # symmetry: x and both slopes
        mbs.AddObject(items.CoordinateConstraint(markerNumbers=[ground, marker(nodes[0], coordinate)]))
    wall = AMPLITUDE * KAPPA * places**2 / 2
    share = np.full(places.size, h)
    share[[0, -1]] /= 2
    stiffness, damping = 10.0 * share / h**4, 3.0 * share / h**2
    loads = []
    for k, node in enumerate(nodes):
        open_by = [max(1e-14, float(wall[k]))]
        state = mbs.AddNode(items.NodeGenericData(numberOfDataCoordinates=1, initialCoordinates=open_by))
        law = {"contactStiffness": stiffness[k], "contactDamping": damping[k], "offset": -wall[k]}
        markers = [marker(node, 1), ground]
        mbs.AddObject(items.ObjectContactCoordinate(markerNumbers=markers, nodeNumber=state, **law))
        loads.append(mbs.AddLoad(items.LoadCoordinate(markerNumber=marker(node, 2), load=0.0)))
    mbs.Assemble()

    def slide(mbs, time):
        """The friction of each contact, from the reaction that it has at the start of a step."""
        q, v = mbs.systemData.GetODE2Coordinates(), mbs.systemData.GetODE2Coordinates_t()
        depth = q[1::6] - wall
        force = np.where(depth > 0.0, stiffness * depth + damping * v[1::6], 0.0)  # Exudyn's own law
        for load, value in zip(loads, force):
            mbs.SetLoadParameter(load, "load", FRICTION * float(value))
        return True

    mbs.SetPreStepUserFunction(slide)
    settings = NewtonSolver(contact_iterations=5).settings(AMPLITUDE, round_off=1e-11, along=0.0)
    GeneralizedAlpha(spectral_radius=0.5).configure(settings)
    settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = END, steps
    with quiet():
        mbs.SolveDynamic(settings)
    q = mbs.systemData.GetODE2Coordinates()
    return AMPLITUDE * END - q[1::6], q[2::6]


@pytest.mark.verify
def test_a_sliding_beam_is_pushed_sideways_by_the_friction_coefficient_times_its_deflection():
    """The friction lags by a step: first order in it, extrapolated to none (9 % off at 400 steps, 4 % at 800)."""
    (coarse, coarse_z), (fine, fine_z) = (taken_and_sideways(steps) for steps in (400, 800))
    taken, sideways = 2 * fine - coarse, 2 * fine_z - coarse_z
    assert taken.max() > 0.5 * AMPLITUDE * END
    assert np.abs(sideways - FRICTION * taken).max() < 0.02 * FRICTION * taken.max()
