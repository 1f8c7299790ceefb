"""Siconos: Hermite beam elements, Moreau and Jean's time stepping, an LCP over the nodes' contacts, as in its own
example (siconos-tutorials, ImpactingEulerBernouilliBeam). theta = 1 damps the short waves of the mesh; what else was
tried: docs/benchmark.md. Matrices are dense."""

import json
import sys
import time
import tomllib

import numpy as np
import siconos.kernel as sk

SIZES = {"coarse": 0.04, "medium": 0.02, "fine": 0.0125, "given": 0.02}  # element length over l*
HALF_LENGTH, THETA = 3.0, 1.0


def matrices(n, size, beam):
    """Mass and stiffness of n Hermite elements, deflection and slope a node."""
    a = size
    mass = beam["mass_per_length"] * a / 420 * np.array(
        [[156, 22 * a, 54, -13 * a], [22 * a, 4 * a * a, 13 * a, -3 * a * a],
         [54, 13 * a, 156, -22 * a], [-13 * a, -3 * a * a, -22 * a, 4 * a * a]])  # fmt: skip
    bending = beam["bending_stiffness"] / a**3 * np.array(
        [[12, 6 * a, -12, 6 * a], [6 * a, 4 * a * a, -6 * a, 2 * a * a],
         [-12, -6 * a, 12, -6 * a], [6 * a, 2 * a * a, -6 * a, 4 * a * a]])  # fmt: skip
    string = beam["axial_force"] / (30 * a) * np.array(
        [[36, 3 * a, -36, 3 * a], [3 * a, 4 * a * a, -3 * a, -a * a],
         [-36, -3 * a, 36, -3 * a], [3 * a, -a * a, -3 * a, 4 * a * a]])  # fmt: skip
    M, K = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
    for e in range(n):
        at = slice(2 * e, 2 * e + 4)
        M[at, at] += mass
        K[at, at] += bending + string
    return M, K


def main(problem_file, result_file, resolution="medium"):
    with open(problem_file, "rb") as stream:
        problem = tomllib.load(stream)
    beam, impact, end = problem["beam"], problem["impact"], problem["record"]["end_time"]
    size = SIZES[resolution]
    n = round(HALF_LENGTH / size)
    # the velocity law lets a node sink in the step that closes it
    steps = round(160 * end / size) if resolution != "given" else 400
    h, x = end / steps, size * np.arange(n + 1)
    M, K = matrices(n, size, beam)
    gap = beam["curvature"] * x**2 / 2 - impact["fourth_derivative"] * x**4 / 24
    q, v = np.zeros(2 * n + 2), np.zeros(2 * n + 2)
    v[0::2] = impact["velocity"] + impact["curvature_rate"] * x**2 / 2
    v[1::2] = impact["curvature_rate"] * x
    keep = np.delete(np.arange(2 * n + 2), 1)  # the middle does not turn
    system = sk.LagrangianLinearTIDS(q[keep], v[keep], M[np.ix_(keep, keep)])
    system.setKPtr(K[np.ix_(keep, keep)])
    load = M @ np.where(np.arange(2 * n + 2) % 2 == 0, impact["acceleration"], 0.0)  # a rigid motion: no slopes
    system.setFExtPtr(load[keep])
    model = sk.NonSmoothDynamicalSystem(0.0, end + h)
    model.insertDynamicalSystem(system)
    law, contacts = sk.NewtonImpactNSL(0.0), []
    for i in range(n + 1):
        if gap[i] > 1.5 * impact["velocity"] * end:
            break  # out of reach
        row = np.zeros((1, 2 * n + 1))
        row[0, list(keep).index(2 * i)] = -1.0
        contacts.append(sk.Interaction(law, sk.LagrangianLinearTIR(row, [gap[i]])))
        model.link(contacts[-1], system)
    stepping = sk.TimeStepping(model, sk.TimeDiscretisation(0.0, h), sk.MoreauJeanOSI(THETA), sk.LCP())
    tau, pushed = h * np.arange(steps + 1), np.zeros((steps + 1, len(contacts)))
    snapshots, snaps, speeds = {round(s / h): s for s in problem["record"]["snapshots"]}, [], []
    began = time.perf_counter()
    for k in range(1, steps + 1):
        stepping.computeOneStep()
        pushed[k] = pushed[k - 1] + [contact.lambda_(1)[0] for contact in contacts]
        stepping.nextStep()
        if k in snapshots:
            full = np.insert(system.q(), 1, 0.0)
            snaps.append(gap - full[0::2])
            speeds.append(np.insert(system.velocity(), 1, 0.0)[0::2])
    about = {"tool": "Siconos", "version": "4.4", "resolution": resolution, "steps": steps,
             "seconds": time.perf_counter() - began,
             "settings": {"integrator": f"Moreau-Jean, theta = {THETA:g}", "contact": "LCP, restitution 0"},
             "model": {"theory": "Euler-Bernoulli, half beam", "half_length": HALF_LENGTH, "smallest_element": size,
                       "time_step": h, "amplitude": 1.0, "deviations": []}}  # fmt: skip
    np.savez(result_file, outcome="completed", problem=problem["id"], metadata=json.dumps(about), tau=tau,
             node_x=x[: len(contacts)], node_impulse=pushed, J_minus=0 * tau, x=x, snap_tau=list(snapshots.values()),
             snap_gap=snaps, snap_v=speeds)  # fmt: skip


main(*sys.argv[1:])
