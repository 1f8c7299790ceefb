"""The massless-boundary scheme on a beam of finite differences, in NumPy and SciPy alone.

Monjaraz-Tec, Gross and Krack (arXiv 2111.07693): contact points carry no mass, so nothing impacts there. At the end of
each step they are in static equilibrium with the wall, K_bb q_b + K_bi q_i = λ, 0 ≤ λ ⊥ g ≥ 0, and between steps the
points with mass move explicitly (Verlet's method). It neither damps nor has a parameter. Here every other point touches
and the points between carry the mass; the reactions are a non-negative least-squares problem (Lawson and Hanson).
"""

import json
import sys
import time
import tomllib

import numpy as np
import scipy
from scipy.linalg import cholesky, eigvalsh, solve_triangular
from scipy.optimize import nnls

SIZES = {"coarse": 0.02, "medium": 0.01, "fine": 0.005, "given": 0.02}  # distance of points over l*
HALF_LENGTH = 4.0


def stiffness(n, size, beam):
    """Of a half beam, symmetric about its first point, free at its last; tension acts along the axis."""
    unit = np.eye(n + 1)
    bend = np.vstack([2.0 * (unit[1] - unit[0]), np.diff(unit, 2, axis=0)]) / size**2
    turn = np.diff(unit, axis=0) / size
    weight = np.where(np.arange(n) == 0, 0.5, 1.0) * size * beam["bending_stiffness"]
    return bend.T @ (weight[:, None] * bend) + beam["axial_force"] * size * turn.T @ turn


def main(problem_file, result_file, resolution="medium"):
    with open(problem_file, "rb") as stream:
        problem = tomllib.load(stream)
    beam, impact, end = problem["beam"], problem["impact"], problem["record"]["end_time"]
    size = SIZES[resolution]
    n = 2 * round(min(HALF_LENGTH, beam.get("largest_half_length", HALF_LENGTH)) / size / 2)
    x, K = size * np.arange(n + 1), stiffness(n, size, beam)
    b, i = np.arange(0, n + 1, 2), np.arange(1, n + 1, 2)
    mass = 2.0 * size * beam["mass_per_length"]  # of each point between two that touch
    highest = np.sqrt(eigvalsh(K[np.ix_(i, i)], subset_by_index=[i.size - 1, i.size - 1])[0] / mass)
    steps = max(int(np.ceil(end * highest / 0.8)), 400)  # Verlet's limit is 2
    h = end / steps
    flexible = np.linalg.inv(K[np.ix_(b, b)])
    gap = beam["curvature"] * x**2 / 2 - impact["fourth_derivative"] * x**4 / 24
    u, v = np.zeros(n + 1), impact["velocity"] + impact["curvature_rate"] * x**2 / 2
    inner, push = v[i].copy(), np.zeros(b.size)
    inner += h / 2 * impact["acceleration"]  # velocities stand between two instants
    tau, pushed = h * np.arange(steps + 1), np.zeros((steps + 1, b.size))
    kinetic, elastic, snaps, speeds = np.full(steps + 1, mass * v[i] @ v[i]), np.zeros(steps + 1), [], []
    when = np.unique(np.round(np.array(problem["record"]["snapshots"]) / h).astype(int))
    began = time.perf_counter()
    for k in range(1, steps + 1):
        old = u.copy()
        u[i] += h * inner
        load = -K[np.ix_(b, i)] @ u[i]
        free = flexible @ load
        near = np.flatnonzero((free > gap[b] - 0.05 * end) | (push > 0.0))
        push = np.zeros(b.size)
        if near.size:  # λ ≥ 0 ⊥ gap − free + flexible λ ≥ 0
            lower = cholesky(flexible[np.ix_(near, near)], lower=True)
            push[near] = nnls(lower.T, solve_triangular(lower, (free - gap[b])[near], lower=True), maxiter=9999)[0]
        u[b] = free - flexible @ push
        change = h / mass * (mass * impact["acceleration"] - K[i] @ u)
        v[i], v[b] = inner + change / 2, (u - old)[b] / h
        inner += change
        pushed[k] = pushed[k - 1] + h * push
        kinetic[k], elastic[k] = mass * v[i] @ v[i], u @ K @ u  # of both halves
        if k in when:
            snaps.append(gap - u), speeds.append(v.copy())
    about = {"tool": "massless boundary", "version": f"scipy {scipy.__version__}", "resolution": resolution,
             "seconds": time.perf_counter() - began, "steps": steps,
             "settings": {"integrator": "Verlet", "contact": "massless points, LCP by NNLS"},
             "model": {"theory": "Euler-Bernoulli, half beam", "half_length": x[-1], "smallest_element": size,
                       "time_step": h, "amplitude": 1.0, "deviations": ["mass at every other point"]}}  # fmt: skip
    np.savez(result_file, outcome="completed", problem=problem["id"], metadata=json.dumps(about), tau=tau, node_x=x[b],
             node_impulse=pushed, J_minus=0 * tau, E_kin=kinetic, E_el=elastic, x=x, snap_tau=h * when, snap_gap=snaps,
             snap_v=speeds)  # fmt: skip


main(*sys.argv[1:])
