"""scikit-fem: Hermite beam elements (its Example 34), implicit Euler, contact at the nodes' new positions.

scikit-fem assembles and leaves time and contact to its user; its contact examples are static (ex04.py: Nitsche's and a
mortar method; ex51.py: a penalty). So the contact is the primal-dual active set of Hintermueller, Ito and Kunisch (SIAM
J. Optim. 13, 2003), solved exactly in each step.
"""

import json
import sys
import time
import tomllib

import numpy as np
import skfem
from scipy.linalg import solveh_banded
from skfem.helpers import dd, ddot

SIZES = {"coarse": 0.02, "medium": 0.01, "fine": 0.005, "given": 0.02}  # element length over l*
HALF_LENGTH = 5.0  # l*, of an infinite beam: implicit Euler damps the short waves, the only ones that are back in time


def main(problem_file, result_file, resolution="medium"):
    with open(problem_file, "rb") as stream:
        problem = tomllib.load(stream)
    beam, impact, end = problem["beam"], problem["impact"], problem["record"]["end_time"]
    size = SIZES[resolution]
    steps = round(80.0 * end / size)  # in one step the front passes a fraction of an element
    h, half = end / steps, HALF_LENGTH if beam["length"] == "infinite" else beam["length"] / 2
    x = np.linspace(0.0, half, round(half / size) + 1)
    basis = skfem.Basis(skfem.MeshLine(x), skfem.ElementLineHermite(), intorder=6)
    stiffness = skfem.BilinearForm(
        lambda u, v, w: beam["bending_stiffness"] * ddot(dd(u), dd(v)) + beam["axial_force"] * u.grad[0] * v.grad[0]
    ).assemble(basis)
    mass = skfem.BilinearForm(lambda u, v, w: beam["mass_per_length"] * u * v).assemble(basis)
    load = skfem.LinearForm(lambda v, w: beam["mass_per_length"] * impact["acceleration"] * v).assemble(basis)
    order = basis.nodal_dofs.T.ravel()  # deflection and slope node by node: a narrow band
    mass, stiffness, load = mass[order][:, order].tocsr(), stiffness[order][:, order].tocsr(), load[order]
    system = (mass + h * (h + beam["damping"]) * stiffness).tolil()
    system[1, :] = system[:, 1] = 0.0  # the middle does not turn
    system[1, 1] = 1.0
    system = system.tocsr()
    band = np.array([np.concatenate([system.diagonal(-k), np.zeros(k)]) for k in range(4)])
    shape = beam["curvature"] * x**2 / 2 - impact["fourth_derivative"] * x**4 / 24  # gap at the first touch
    u = np.zeros(2 * x.size)
    v = np.zeros(2 * x.size)
    v[0::2] = impact["velocity"] + impact["curvature_rate"] * x**2 / 2
    v[1::2] = impact["curvature_rate"] * x
    active, reaction = np.zeros(x.size, bool), np.zeros(x.size)
    tau, pushed = h * np.arange(steps + 1), np.zeros((steps + 1, x.size))
    kinetic, elastic, snaps, speeds = np.zeros(steps + 1), np.zeros(steps + 1), [], []
    times = np.round(np.array(problem["record"]["snapshots"]) / h).astype(int)
    kinetic[0] = v @ mass @ v
    began = time.perf_counter()
    for k in range(1, steps + 1):
        right = mass @ v - h * (stiffness @ u) + h * load
        right[1] = 0.0
        wanted = (shape - u[0::2]) / h  # the velocity that closes the gap in this step
        for rounds in range(300):
            held = 2 * np.flatnonzero(active)
            known = np.zeros(u.size)
            known[held] = wanted[active]
            part, matrix = right - system @ known, band.copy()
            for offset in range(4):
                matrix[offset, held] = matrix[offset, held[held >= offset] - offset] = 0.0
            matrix[0, held] = 1.0
            part[held] = wanted[active]
            v = solveh_banded(matrix, part, lower=True, check_finite=False)
            reaction = np.where(active, (right - system @ v)[0::2], 0.0)  # impulse of the wall on the beam
            new = np.where(active, reaction > 0.0, v[0::2] > wanted)
            if np.array_equal(new, active):
                break
            if rounds < 15:
                active = new
            else:  # all at once run in a circle: one at a time (Murty's rule)
                active[np.flatnonzero(new != active)[-1]] ^= True
        u = u + h * v
        pushed[k] = pushed[k - 1] + reaction
        kinetic[k], elastic[k] = v @ mass @ v, u @ stiffness @ u  # of both halves
        if k in times:
            snaps.append(shape - u[0::2])
            speeds.append(v[0::2])
    about = {"tool": "scikit-fem", "version": skfem.__version__, "resolution": resolution, "steps": steps,
             "seconds": time.perf_counter() - began,
             "settings": {"integrator": "implicit Euler", "contact": "primal-dual active set, new positions"},
             "model": {"theory": "Euler-Bernoulli, half beam", "half_length": half, "smallest_element": size,
                       "time_step": h, "amplitude": 1.0, "deviations": []}}  # fmt: skip
    np.savez(result_file, outcome="completed", problem=problem["id"], metadata=json.dumps(about), tau=tau, node_x=x,
             node_impulse=pushed, J_minus=0 * tau, E_kin=kinetic, E_el=elastic, x=x, snap_tau=times * h, snap_gap=snaps,
             snap_v=speeds)  # fmt: skip


main(*sys.argv[1:])
