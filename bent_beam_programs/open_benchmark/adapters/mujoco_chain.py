"""MuJoCo: a chain of rigid links with springs and dampers in its hinges, soft contact made stiff.

Settings as its documentation recommends them (pages: adapters.toml): discrete, implicit in the stiffness of springs;
speculative contacts for geoms that are fast for their size, a tenth of a step's way; the stiffest time constant and
impedance that it lets one have; condim 1 on both geoms, because the larger counts; Newton's solver without early stop.
"""

import json
import sys
import time
import tomllib

import mujoco
import numpy as np

SIZES = {"coarse": 0.04, "medium": 0.03, "fine": 0.02, "given": 0.02}  # link length over l*
HALF_LENGTH, AMPLITUDE, VISCOSITY = 4.0, 1e-3, 0.3  # viscosity of a hinge over sqrt(EI mu) size
XML = """<mujoco><compiler angle="radian" inertiafromgeom="false" boundmass="0" boundinertia="0"/>
<option timestep="{dt}" integrator="discrete" solver="Newton" iterations="100" tolerance="0" gravity="0 0 {load}">
<flag speculative="enable"/></option>
<default><geom condim="1" solref="{time} 1" solimp="0.9999 0.9999 0.001 0.5 2" friction="0 0 0" margin="0"/></default>
<worldbody><geom type="plane" size="0 0 1" contype="1" conaffinity="0"/>{chain}</worldbody></mujoco>"""


def main(problem_file, result_file, resolution="medium"):
    with open(problem_file, "rb") as stream:
        problem = tomllib.load(stream)
    beam, impact, end = problem["beam"], problem["impact"], problem["record"]["end_time"]
    if beam["axial_force"] != 0.0:
        np.savez(result_file, outcome="not_attempted(axial force)", problem=problem["id"], metadata="{}")
        return
    size = SIZES[resolution]
    n = round(HALF_LENGTH / size)
    # steps for accuracy: the springs are implicit
    steps = max(round(end / (0.2 * size**2)), 300) if resolution != "given" else 400
    dt, x = end / steps, size * np.arange(n + 1)
    radius = 0.1 * AMPLITUDE * impact["velocity"] * dt
    curvature = AMPLITUDE * (beam["curvature"] - impact["fourth_derivative"] * x**2 / 2)
    line, bend = beam["mass_per_length"] * size, beam["bending_stiffness"] / size
    damping = VISCOSITY * np.sqrt(beam["bending_stiffness"] * beam["mass_per_length"]) * size
    ball = f'<geom type="sphere" size="{radius}" pos="{{}} 0 0" contype="0" conaffinity="1"/>'
    heavy = '<inertial pos="{} 0 0" mass="{}" diaginertia="{r} {r} {r}"/>'
    tiny = 1e-4 * line * size**2
    chain = ""
    for i in range(n, 0, -1):  # from the tip inwards; the first hinge is half a cell of the beam: symmetry
        share = 2.0 if i == 1 else 1.0
        mass = line / 2 if i == n else line
        chain = (
            f'<body pos="{0 if i == 1 else size} 0 0"><joint type="hinge" axis="0 -1 0" stiffness="{share * bend}" '
            f'springref="{curvature[i - 1] * size / share}" damping="{damping}"/>'
            + heavy.format(size, mass, r=tiny) + ball.format(size) + chain + "</body>"
        )  # fmt: skip
    root = f'<body pos="0 0 {radius}"><joint type="slide" axis="0 0 1"/>' + heavy.format(0, line / 2, r=tiny)
    chain = root + ball.format(0) + chain + "</body>"
    load = -AMPLITUDE * impact["acceleration"]
    model = mujoco.MjModel.from_xml_string(XML.format(dt=dt, load=load, time=2 * dt, chain=chain))
    data = mujoco.MjData(model)
    share = np.where(np.arange(n) == 0, 2.0, 1.0)
    data.qpos[1:] = curvature[:n] * size / share
    data.qvel[0] = -AMPLITUDE * impact["velocity"]
    data.qvel[1:] = -AMPLITUDE * impact["curvature_rate"] * size / share
    tau, pushed = dt * np.arange(steps + 1), np.zeros((steps + 1, n + 1))
    snapshots, snaps, speeds = {round(s / dt): s for s in problem["record"]["snapshots"]}, [], []
    force = np.zeros(6)
    began = time.perf_counter()
    for k in range(1, steps + 1):
        mujoco.mj_step(model, data)
        push = np.zeros(n + 1)
        for j in range(data.ncon):
            mujoco.mj_contactForce(model, data, j, force)
            push[max(data.contact[j].geom) - 1] += force[0] * dt / AMPLITUDE
        pushed[k] = pushed[k - 1] + push
        if k in snapshots:
            angle, rate = np.cumsum(data.qpos[1:]), np.cumsum(data.qvel[1:])
            heights = data.qpos[0] + size * np.concatenate([[0], np.cumsum(np.sin(angle))])
            snaps.append(heights / AMPLITUDE)
            turning = size * np.concatenate([[0], np.cumsum(rate * np.cos(angle))])
            speeds.append(-(data.qvel[0] + turning) / AMPLITUDE)
    about = {"tool": "MuJoCo", "version": mujoco.__version__, "resolution": resolution, "steps": steps,
             "seconds": time.perf_counter() - began,
             "settings": {"integrator": "discrete", "speculative": True, "solref": [2 * dt, 1.0], "impedance": 0.9999},
             "model": {"theory": "chain of rigid links", "half_length": HALF_LENGTH, "smallest_element": size,
                       "time_step": dt, "amplitude": AMPLITUDE, "deviations": ["soft contact"]}}  # fmt: skip
    np.savez(result_file, outcome="completed", problem=problem["id"], metadata=json.dumps(about), tau=tau, node_x=x,
             node_impulse=pushed, J_minus=0 * tau, x=x, snap_tau=list(snapshots.values()), snap_gap=snaps,
             snap_v=speeds)  # fmt: skip


main(*sys.argv[1:])
