"""Drake: a chain of rigid links, springs and dampers in its hinges, discrete contact by the SAP solver.

From its documentation: a discrete plant; rigid contact is "approximated with very stiff compliance" (Contact Modeling
in Drake), which SAP bounds by itself: sap_near_rigid_threshold = 1 is "a conservative choice", and where it softens
too much 0 is advised (MultibodyPlantConfig): errors here are the same to 0.002 %. DiscreteContactApproximation prefers
kSimilar for strong transients because of friction, which is absent here; the approximations then differ in damping
alone. Tried on the coarse chain: kSimilar with Hunt and Crossley's d = 10 to 1000/V0 is as good without loads (r0 +0.05
to +0.09 % at 0.5, +1.6 to +1.9 % at 0.1) and worse with them (lambda1 8 to 30 % off against 2 to 6 %); relaxation times
of 0, 1, 10, 100 steps: 5.4, 2.1, 1.6, 1.5 % at 0.1, and from 10 on worse with loads. One step is used.
"""

import json
import sys
import time
import tomllib
from importlib.metadata import version

import numpy as np
from pydrake.geometry import AddContactMaterial, HalfSpace, ProximityProperties, Sphere
from pydrake.math import RigidTransform
from pydrake.multibody.plant import AddMultibodyPlant, CoulombFriction, MultibodyPlantConfig
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    PrismaticJoint,
    RevoluteJoint,
    RevoluteSpring,
    SpatialInertia,
    UnitInertia,
)
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

SIZES = {"coarse": 0.04, "medium": 0.03, "fine": 0.02, "given": 0.02}  # link length over l*
HALF_LENGTH, AMPLITUDE, VISCOSITY = 4.0, 1e-3, 0.3  # viscosity of a hinge over sqrt(EI mu) size


def reactions(found, node):
    """Force of the wall on each node; node: index of a body -> number of its node."""
    forces = np.zeros(len(node))
    for j in range(found.num_point_pair_contacts()):
        pair = found.point_pair_contact_info(j)
        i = node.get(int(pair.bodyA_index()), node.get(int(pair.bodyB_index())))
        forces[i] += abs(pair.contact_force()[2])
    return forces


def metadata(resolution, steps, dt, size, seconds):
    about = {"tool": "Drake", "version": version("drake"), "resolution": resolution, "steps": steps,
             "seconds": seconds,
             "settings": {"contact": "point, SAP", "relaxation_time": dt},
             "model": {"theory": "chain of rigid links", "half_length": HALF_LENGTH, "smallest_element": size,
                       "time_step": dt, "amplitude": AMPLITUDE, "deviations": []}}  # fmt: skip
    return json.dumps(about)


def main(problem_file, result_file, resolution="medium"):
    with open(problem_file, "rb") as stream:
        problem = tomllib.load(stream)
    beam, impact, end = problem["beam"], problem["impact"], problem["record"]["end_time"]
    if beam["axial_force"] != 0.0:
        np.savez(result_file, outcome="not_attempted(axial force)", problem=problem["id"], metadata="{}")
        return
    size = SIZES[resolution]
    n = round(HALF_LENGTH / size)
    steps = max(round(end / (0.2 * size**2)), 300)  # the springs are explicit: 2/omega = size^2/2
    dt, x = end / steps, size * np.arange(n + 1)
    curvature = AMPLITUDE * (beam["curvature"] - impact["fourth_derivative"] * x**2 / 2)
    builder = DiagramBuilder()
    config = MultibodyPlantConfig(time_step=dt, contact_model="point", discrete_contact_approximation="sap")
    plant, _ = AddMultibodyPlant(config, builder)
    plant.mutable_gravity_field().set_gravity_vector([0, 0, -AMPLITUDE * impact["acceleration"]])
    touch = ProximityProperties()
    AddContactMaterial(point_stiffness=1e12, friction=CoulombFriction(0, 0), properties=touch)
    touch.AddProperty("material", "relaxation_time", dt)
    plant.RegisterCollisionGeometry(plant.world_body(), RigidTransform(), HalfSpace(), "wall", touch)
    radius, line, bodies, hinges = size / 10, beam["mass_per_length"] * size, [], []
    viscosity = VISCOSITY * np.sqrt(beam["bending_stiffness"] * beam["mass_per_length"]) * size
    for i in range(n + 1):
        arm = np.zeros(3) if i == 0 else np.array([size, 0.0, 0.0])  # the node at the far end of its link
        mass = line / 2 if i in (0, n) else line
        unit = UnitInertia.SolidSphere(radius) if i == 0 else UnitInertia.PointMass(arm)
        bodies.append(plant.AddRigidBody(f"link{i}", SpatialInertia(mass, arm, unit)))
        plant.RegisterCollisionGeometry(bodies[i], RigidTransform(arm), Sphere(radius), f"node{i}", touch)
        if i == 0:
            slider = plant.AddJoint(PrismaticJoint("slider", plant.world_frame(), bodies[0].body_frame(), [0, 0, 1]))
            continue
        place = RigidTransform(np.zeros(3) if i == 1 else arm)
        hinge = RevoluteJoint(
            f"hinge{i}",
            plant.AddFrame(FixedOffsetFrame(f"end{i - 1}", bodies[i - 1].body_frame(), place)),
            bodies[i].body_frame(), [0, -1, 0], viscosity,
        )  # fmt: skip
        hinges.append(plant.AddJoint(hinge))
        share = 2.0 if i == 1 else 1.0  # symmetry: the first hinge is half a cell of the beam
        stiffness = share * beam["bending_stiffness"] / size
        plant.AddForceElement(RevoluteSpring(hinges[-1], curvature[i - 1] * size / share, stiffness))
    plant.Finalize()
    simulator = Simulator(builder.Build())
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    slider.set_translation(context, radius)
    slider.set_translation_rate(context, -AMPLITUDE * impact["velocity"])
    for i, hinge in enumerate(hinges):
        share = 2.0 if i == 0 else 1.0
        hinge.set_angle(context, curvature[i] * size / share)
        hinge.set_angular_rate(context, -AMPLITUDE * impact["curvature_rate"] * size / share)
    node = {int(body.index()): i for i, body in enumerate(bodies)}
    tau, pushed = dt * np.arange(steps + 1), np.zeros((steps + 1, n + 1))
    snapshots, snaps, speeds = {round(s / dt): s for s in problem["record"]["snapshots"]}, [], []
    began = time.perf_counter()
    for k in range(1, steps + 1):
        simulator.AdvanceTo(k * dt)
        forces = reactions(plant.get_contact_results_output_port().Eval(context), node)
        pushed[k] = pushed[k - 1] + dt / AMPLITUDE * forces
        if k in snapshots:
            angle = np.cumsum([hinge.get_angle(context) for hinge in hinges])
            heights = slider.get_translation(context) - radius + size * np.concatenate([[0], np.cumsum(np.sin(angle))])
            snaps.append(heights / AMPLITUDE)
            rates = np.cumsum([hinge.get_angular_rate(context) for hinge in hinges])
            turning = size * np.concatenate([[0], np.cumsum(rates * np.cos(angle))])
            speeds.append(-(slider.get_translation_rate(context) + turning) / AMPLITUDE)
    about = metadata(resolution, steps, dt, size, time.perf_counter() - began)
    np.savez(result_file, outcome="completed", problem=problem["id"], metadata=about, tau=tau, node_x=x,
             node_impulse=pushed, J_minus=0 * tau, x=x, snap_tau=list(snapshots.values()), snap_gap=snaps,
             snap_v=speeds)  # fmt: skip


main(*sys.argv[1:])
