"""OpenSeesPy: elastic beam-column elements, gap springs at the nodes, Newmark's method with strong damping.

gamma = 3/2 with beta = (gamma + 1/2)^2/4 damps the short waves most; the structural engineer's 1/2, 1/4 lets them
rattle in the gaps. Pages of the manual: adapters.toml; what else was tried: docs/benchmark.md.
"""

import json
import sys
import time
import tomllib

import numpy as np
import openseespy.opensees as ops

SIZES = {"coarse": 0.03, "medium": 0.015, "fine": 0.0075, "given": 0.02}  # element length over l*
HALF_LENGTH, GAMMA, BETA = 5.0, 1.5, 1.0
STIFFNESS = 1e3  # of a gap spring over that of an element's deflection, 12 EI/size^3


def main(problem_file, result_file, resolution="medium"):
    with open(problem_file, "rb") as stream:
        problem = tomllib.load(stream)
    beam, impact, end = problem["beam"], problem["impact"], problem["record"]["end_time"]
    if beam["axial_force"] != 0.0:
        np.savez(result_file, outcome="not_attempted(axial force)", problem=problem["id"], metadata="{}")
        return
    n, size = round(HALF_LENGTH / SIZES[resolution]), SIZES[resolution]
    steps = max(round(40.0 * end / size), 250) if resolution != "given" else 400
    h = end / steps
    x = np.linspace(0.0, HALF_LENGTH, n + 1)
    gap = beam["curvature"] * x**2 / 2 - impact["fourth_derivative"] * x**4 / 24  # a straight beam, a curved wall
    velocity = impact["velocity"] + impact["curvature_rate"] * x**2 / 2
    spring = STIFFNESS * 12 * beam["bending_stiffness"] / size**3
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    for i in range(n + 1):
        ops.node(i + 1, float(x[i]), 0.0)
        ops.node(n + 2 + i, float(x[i]), 0.0)  # the wall
        ops.fix(i + 1, 1, 0, 1 if i == 0 else 0)
        ops.fix(n + 2 + i, 1, 1, 1)
        ops.uniaxialMaterial("ElasticPPGap", i + 1, spring, 1e12, max(float(gap[i]), 1e-15))
        ops.element("zeroLength", n + 1 + i, n + 2 + i, i + 1, "-mat", i + 1, "-dir", 2)
    for i in range(n):
        ops.element("elasticBeamColumn", i + 1, i + 1, i + 2, 1.0, 1.0, beam["bending_stiffness"], 1,
                    "-mass", beam["mass_per_length"], "-cMass")  # fmt: skip
    if impact["acceleration"]:
        ops.timeSeries("Constant", 1)
        ops.pattern("Plain", 1, 1)
        load = beam["mass_per_length"] * impact["acceleration"]
        ops.eleLoad("-ele", *range(1, n + 1), "-type", "-beamUniform", load, 0.0)
    for i in range(n + 1):
        ops.setNodeVel(i + 1, 2, float(velocity[i]), "-commit")
        ops.setNodeVel(i + 1, 3, float(impact["curvature_rate"] * x[i]), "-commit")
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-9 * 12 * beam["bending_stiffness"] / size**2, 30)
    ops.integrator("Newmark", GAMMA, BETA)
    ops.analysis("Transient")
    tau, pushed, speeds = h * np.arange(steps + 1), np.zeros((steps + 1, n + 1)), []
    snapshots = {round(s / h): s for s in problem["record"]["snapshots"]}
    snaps, force, outcome = [], np.zeros(n + 1), "completed"
    began = time.perf_counter()
    for k in range(1, steps + 1):
        for algorithm in ("Newton", "NewtonLineSearch", "KrylovNewton"):  # the next only where one fails
            ops.algorithm(algorithm)
            failed = ops.analyze(1, h)
            if not failed:
                break
        if failed:
            outcome = f"not_converged({k * h:g})"
            break
        y = np.array([ops.nodeDisp(i, 2) for i in range(1, n + 2)])
        before, force = force, spring * np.maximum(y - np.maximum(gap, 1e-15), 0.0)
        pushed[k] = pushed[k - 1] + h * ((1 - GAMMA) * before + GAMMA * force)  # as Newmark's velocity update
        if k in snapshots:
            snaps.append(gap - y)
            speeds.append([ops.nodeVel(i, 2) for i in range(1, n + 2)])
    when = list(snapshots.values())
    about = {"tool": "OpenSeesPy", "version": ops.version(), "resolution": resolution, "steps": steps,
             "seconds": time.perf_counter() - began,
             "settings": {"integrator": f"Newmark {GAMMA}, {BETA}", "contact": f"ElasticPPGap, {STIFFNESS:g}"},
             "model": {"theory": "Euler-Bernoulli, half beam", "half_length": HALF_LENGTH, "smallest_element": size,
                       "time_step": h, "amplitude": 1.0, "deviations": ["stiff springs for the wall"]}}  # fmt: skip
    np.savez(result_file, outcome=outcome, problem=problem["id"], metadata=json.dumps(about), tau=tau, node_x=x,
             node_impulse=pushed, x=x, snap_tau=when[: len(snaps)], snap_gap=snaps, snap_v=speeds)  # fmt: skip


main(*sys.argv[1:])
