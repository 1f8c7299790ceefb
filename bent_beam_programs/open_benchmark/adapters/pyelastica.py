"""PyElastica: a Cosserat rod, position Verlet, its plane contact as shipped or with the wall's pull clipped.

LaplaceDissipationFilter of the order that filters most (adapters.toml). The plane contact takes all that is less than
an absolute 1e-4 above the plane for touching (surface_tol), so lengths are scaled until that is nothing. Its damping
acts on separation too: the wall pulls ("shipped"); "clipped" keeps the part of each element's force that pushes.
"""

import json
import sys
import time
import tomllib

import elastica as ea
import numpy as np

SIZES = {"coarse": 0.04, "medium": 0.02, "fine": 0.01, "given": 0.02}  # element length over l*
HALF_LENGTH, SCALE, AMPLITUDE, RADIUS = 6.0, 1e5, 1e-3, 0.01  # scale: units a length l*; radius over l*


class Recording(ea.RodPlaneContact):
    """The plane contact that sums its impulses, node by node; it is called once a step."""

    impulse, pulled, dt, clip = None, 0.0, 0.0, False

    def apply_contact(self, system_one, system_two, time=0.0):
        before = system_one.external_forces.copy()
        super().apply_contact(system_one, system_two, time)
        push = (system_one.external_forces - before)[2]
        if Recording.clip:
            push = np.maximum(push, 0.0)
            system_one.external_forces[:] = before
            system_one.external_forces[2] += push
        Recording.impulse += push * Recording.dt
        Recording.pulled += -np.minimum(push, 0.0).sum() * Recording.dt


class Simulator(ea.BaseSystemCollection, ea.Contact, ea.Damping, ea.Forcing):
    """What of PyElastica takes part."""


def main(problem_file, result_file, resolution="medium", variant="shipped"):
    with open(problem_file, "rb") as stream:
        problem = tomllib.load(stream)
    beam, impact, end = problem["beam"], problem["impact"], problem["record"]["end_time"]
    if beam["axial_force"] != 0.0:
        np.savez(result_file, outcome="not_attempted(axial force)", problem=problem["id"], metadata="{}")
        return
    assert beam["bending_stiffness"] == beam["mass_per_length"] == impact["velocity"] == 1.0
    n = 2 * round(HALF_LENGTH / SIZES[resolution]) + 1  # odd: the middle of an element touches first
    x = np.linspace(-HALF_LENGTH, HALF_LENGTH, n + 1)
    height = AMPLITUDE * (beam["curvature"] * x**2 / 2 - impact["fourth_derivative"] * x**4 / 24)
    area = np.pi * (RADIUS * SCALE) ** 2  # mass per length is one
    modulus = 4 * np.pi * SCALE**4 / area**2  # E I = SCALE^4: times stay in t*
    position = SCALE * np.stack([x, 0 * x, height]) + np.array([[0.0], [0.0], [RADIUS * SCALE]])
    rod = ea.CosseratRod.straight_rod(
        n, position[:, 0], np.array([1.0, 0, 0]), np.array([0, 1.0, 0]), 2 * HALF_LENGTH * SCALE, RADIUS * SCALE,
        1.0 / area, youngs_modulus=modulus, shear_modulus=modulus / 3.0, position=position,
    )  # fmt: skip
    rod.velocity_collection[2] = -AMPLITUDE * SCALE * (1.0 + impact["curvature_rate"] * x**2 / 2)
    rod.rest_kappa[:], rod.rest_sigma[:] = rod.kappa, rod.sigma
    size = 2 * HALF_LENGTH / n
    # fractions of an axial wave's way through an element, and of an element's fastest turning against its shear
    steps = int(np.ceil(end / min(0.2 * size * RADIUS, 0.4 * RADIUS**2)))
    dt = end / steps
    simulator = Simulator()
    simulator.append(rod)
    plane = ea.Plane(plane_origin=np.zeros(3), plane_normal=np.array([0, 0, 1.0]))
    simulator.append(plane)
    mass = size * SCALE
    rate = 2.0 / size**2  # of the contact: about the fastest bending wave of the mesh; damped critically
    simulator.detect_contact_between(rod, plane).using(Recording, k=mass * rate**2, nu=2 * mass * rate)
    simulator.dampen(rod).using(ea.LaplaceDissipationFilter, filter_order=3)
    if impact["acceleration"]:
        down = np.array([0.0, 0.0, -AMPLITUDE * SCALE * impact["acceleration"]])
        simulator.add_forcing_to(rod).using(ea.GravityForces, acc_gravity=down)
    Recording.impulse, Recording.dt, Recording.clip = np.zeros(n + 1), dt, variant == "clipped"
    simulator.finalize()
    stepper, now = ea.PositionVerlet(), np.float64(0.0)
    stepper.step(simulator, now, np.float64(1e-300))  # compiles
    Recording.impulse[:], Recording.pulled = 0.0, 0.0
    every, unit = max(steps // 1000, 1), AMPLITUDE * SCALE * SCALE
    snaps_at = {round(s / dt): s for s in problem["record"]["snapshots"]}
    start = rod.compute_translational_energy() / (AMPLITUDE * SCALE) ** 2 / SCALE
    rows, pushed, snaps, speeds = [[0.0, 0.0, start, 0.0]], [np.zeros(n + 1)], [], []
    began = time.perf_counter()
    for k in range(1, steps + 1):
        now = stepper.step(simulator, now, np.float64(dt))
        if k % every == 0 or k == steps:
            energy = rod.compute_bending_energy() + rod.compute_shear_energy()
            pushed.append(Recording.impulse / unit)
            rows.append([k * dt, Recording.pulled / unit,
                         rod.compute_translational_energy() / unit**2 * SCALE, energy / unit**2 * SCALE])  # fmt: skip
        if k in snaps_at:
            snaps.append(rod.position_collection[2] / (SCALE * AMPLITUDE) - RADIUS / AMPLITUDE)
            speeds.append(-rod.velocity_collection[2] / (SCALE * AMPLITUDE))
    ok = np.isfinite(np.array(rows)).all()
    tau, pulled, kinetic, elastic = np.array(rows).T
    about = {"tool": f"PyElastica, {variant}", "version": ea.version.VERSION if hasattr(ea, "version") else "1.0.0",
             "resolution": resolution, "steps": steps, "seconds": time.perf_counter() - began,
             "settings": {"integrator": "position Verlet", "filter_order": 3, "contact": f"RodPlaneContact, {variant}"},
             "model": {"theory": "Cosserat rod", "half_length": HALF_LENGTH, "smallest_element": size, "time_step": dt,
                       "amplitude": AMPLITUDE, "deviations": ["shear and rotary inertia"]}}  # fmt: skip
    np.savez(result_file, outcome="completed" if ok else "diverged", problem=problem["id"], metadata=json.dumps(about),
             tau=tau, node_x=x, node_impulse=pushed, J_minus=pulled, E_kin=kinetic, E_el=elastic, x=x,
             snap_tau=list(snaps_at.values()), snap_gap=snaps, snap_v=speeds)  # fmt: skip


main(*sys.argv[1:])
