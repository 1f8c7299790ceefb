"""EasyFEA: Euler-Bernoulli elements (Hermite), its implicit Euler scheme, Dirichlet conditions where nodes touch.

Its penalty contact is for surfaces of solids (adapters.toml). So a node that passes the wall is held there, one whose
reaction pulls is let go, and the step is taken again until none is wrong. It has no command to take a step back: two
steps with every displacement prescribed put the state back.
"""

import contextlib
import io
import json
import sys
import time
import tomllib

import numpy as np
from EasyFEA import AlgoType, ElemType, Mesher, Models, Simulations, __version__
from EasyFEA.Geoms import Domain, Line, Point

SIZES = {"coarse": 0.02, "medium": 0.01, "fine": 0.005, "given": 0.02}  # element length over l*
HALF_LENGTH, SIDE = 5.0, 0.1


def main(problem_file, result_file, resolution="medium"):
    with open(problem_file, "rb") as stream:
        problem = tomllib.load(stream)
    beam, impact, end = problem["beam"], problem["impact"], problem["record"]["end_time"]
    if beam["axial_force"] != 0.0:
        np.savez(result_file, outcome="not_attempted(axial force)", problem=problem["id"], metadata="{}")
        return
    size = SIZES[resolution]
    steps = round(80.0 * end / size)
    h = end / steps
    with contextlib.redirect_stdout(io.StringIO()):
        section = Mesher().Mesh_2D(Domain(Point(-SIDE / 2, -SIDE / 2), Point(SIDE / 2, SIDE / 2), SIDE))
        line = Line(Point(), Point(HALF_LENGTH), size)
        young = beam["bending_stiffness"] / (SIDE**4 / 12)
        bar = Models.Beam.Isotropic(2, line, section, young, 0.0)
        mesh = Mesher().Mesh_Beams([bar], elemType=ElemType.SEG2)
        model = Simulations.Beam(mesh, Models.Beam.BeamStructure([bar]))
    model.rho = beam["mass_per_length"] / SIDE**2
    nodes = np.argsort(mesh.coord[:, 0])
    x = mesh.coord[nodes, 0]
    deflections, slopes = (model.Bc_dofs_nodes(nodes, [name]) for name in ("y", "rz"))
    gap = beam["curvature"] * x**2 / 2 - impact["fourth_derivative"] * x**4 / 24  # a straight beam, a curved wall
    model.Solver_Set_Hyperbolic_Algorithm(h, algo=AlgoType.euler_implicit)
    unknowns = [model.Bc_dofs_nodes(nodes, [name]) for name in ("x", "y", "rz")]

    def put(u, v):
        """Displacements and velocities, by steps in which all are prescribed."""
        for prescribed in (u - h * v, u):
            model.Bc_Init()
            for name, dofs in zip(("x", "y", "rz"), unknowns):
                model.add_dirichlet(nodes, [prescribed[dofs]], [name])
            model.Solve()

    def solve(held):
        """A step with these nodes held on the wall."""
        model.Bc_Init()
        model.add_dirichlet(nodes, [0.0], ["x"])
        model.add_dirichlet(nodes[:1], [0.0], ["rz"])
        if held.any():
            model.add_dirichlet(nodes[held], [gap[held]], ["y"])
        if load:
            model.add_lineLoad(nodes, [load], ["y"])
        u, push = model.Solve().copy(), np.zeros(x.size)
        if held.any():
            push[held] = shares[held] - model.Calc_Reaction(deflections[held])
        return u, push

    load = beam["mass_per_length"] * impact["acceleration"]
    shares = np.full(x.size, load * size)  # of the load, which a reaction does not count
    shares[[0, -1]] /= 2
    u, v, held = np.zeros(3 * x.size), np.zeros(3 * x.size), np.zeros(x.size, bool)
    v[deflections], v[slopes] = impact["velocity"] + impact["curvature_rate"] * x**2 / 2, impact["curvature_rate"] * x
    put(u, v)
    tau, pushed, snaps, speeds = h * np.arange(steps + 1), np.zeros((steps + 1, x.size)), [], []
    snapshots = {round(s / h): s for s in problem["record"]["snapshots"]}
    began = time.perf_counter()
    for k in range(1, steps + 1):
        for rounds in range(200):
            new, push = solve(held)
            wrong = np.where(held, push < 0.0, new[deflections] > gap + 1e-12)
            if not wrong.any():
                break
            put(u, v)
            if rounds < 15:
                held = held ^ wrong
            else:  # all at once run in a circle: one at a time
                held[np.flatnonzero(wrong)[-1]] ^= True
        u, v = new, (new - u) / h
        pushed[k] = pushed[k - 1] + h * push
        if k in snapshots:
            snaps.append(gap - u[deflections])
            speeds.append(v[deflections])
    about = {"tool": "EasyFEA", "version": __version__, "resolution": resolution, "steps": steps,
             "seconds": time.perf_counter() - began,
             "settings": {"integrator": "euler_implicit", "contact": "Dirichlet conditions, active set"},
             "model": {"theory": "Euler-Bernoulli, half beam", "half_length": HALF_LENGTH, "smallest_element": size,
                       "time_step": h, "amplitude": 1.0, "deviations": []}}  # fmt: skip
    np.savez(result_file, outcome="completed", problem=problem["id"], metadata=json.dumps(about), tau=tau, node_x=x,
             node_impulse=pushed, x=x, snap_tau=list(snapshots.values()), snap_gap=snaps, snap_v=speeds)  # fmt: skip


main(*sys.argv[1:])
