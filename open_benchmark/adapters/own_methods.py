"""This project's own methods (hermite, exudyn), through the same two files as anybody's.

Mesh and steps are what the method chooses from the problem's κ/ν and end time: a host's privilege. "strict" has none: a
uniform mesh and constant steps, the same for every problem, and contact that may never pull.
"""

import dataclasses
import json
import sys
import time
import tomllib

import numpy as np

from bent_beam import Impact, SimulationError
from bent_beam.meshes import UniformMesh
from bent_beam.method import chosen_for, for_whole_beam, method_type, refined

REFINEMENT = {"exudyn": {"coarse": 0.25, "medium": 0.5, "fine": 1.0}}  # of the method's own choice for the problem
OTHERS = {"coarse": 0.5, "medium": 1.0, "fine": 2.0}
STRICT = {"coarse": 0.02, "medium": 0.01, "fine": 0.005}  # element length over l*
HALF_LENGTH = 4.0  # l*: a beam with a fourth derivative must not be bent into the wall further out


def chosen(path, choice, bare, end, infinite, resolution):
    """The method: mesh and steps are those of the problem without loads, so that both can be subtracted."""
    method = method_type(path)()
    if not infinite:
        method = for_whole_beam(method, bare)  # nothing held, nothing absorbed
    elif path == "hermite":  # cut where the beam goes on: its ends follow the free motion
        method = dataclasses.replace(method, domain=HALF_LENGTH)
    if choice == "chosen":
        method = chosen_for(method, bare, end)
        return refined(method, REFINEMENT.get(path, OTHERS)[resolution]) or method
    from hermite_fe.contacts import NodeContact
    from hermite_fe.integrators import SignoriniPosition

    size = STRICT[resolution]
    steps = SignoriniPosition(theta=1.0, time_step=end / round(80 * end / size), growth=0.0)
    contact = NodeContact(hold=0, hold_until=0.0)
    method = dataclasses.replace(method, mesh=UniformMesh(element_length=size), integrator=steps, contact=contact)
    return chosen_for(method, bare, end)


def main(problem_file, result_file, resolution="medium", path="hermite", choice="chosen"):
    began = time.perf_counter()
    with open(problem_file, "rb") as stream:
        given = tomllib.load(stream)
    beam, load, end = given["beam"], given["impact"], given["record"]["end_time"]
    infinite = beam["length"] == "infinite"
    bare = Impact(
        bending_stiffness=beam["bending_stiffness"],
        mass_per_length=beam["mass_per_length"],
        length=2 * HALF_LENGTH if infinite else beam["length"],
        curvature=beam["curvature"],
        velocity=load["velocity"],
        damping=beam["damping"],
    )
    changes = {name: load[name] for name in ("acceleration", "curvature_rate", "fourth_derivative") if load[name]}
    changes |= {"axial_force": beam["axial_force"]} if beam["axial_force"] else {}
    method = chosen(path, choice, bare, end, infinite, resolution)
    try:
        impact = bare.replace(**changes)
        if refusal := method.refuses(impact):
            raise ValueError(refusal)
        history = method.simulate(impact, end_time=end, save=600)
    except (SimulationError, TypeError, ValueError) as error:
        outcome = "not_converged" if isinstance(error, SimulationError) else "unsupported"
        why = " ".join(str(error).split())
        np.savez(result_file, outcome=f"{outcome}({why})", problem=given["id"], metadata="{}")
        return
    x, last = history.positions(0), np.diff(history.time)[-1]
    about = {"tool": f"bent-beam-impact, {history.path}", "version": history.versions.get("bent-beam-impact", ""),
             "resolution": resolution, "steps": history.steps, "seconds": history.seconds,
             "set_up_seconds": time.perf_counter() - began - history.seconds, "lines": len(open(__file__).readlines()),
             "settings": {"mesh and steps": choice, **history.settings},
             "model": {"theory": "Euler-Bernoulli", "half_length": float(np.abs(x).max()),
                       "smallest_element": float(np.diff(np.sort(x)).min()), "time_step": float(last),
                       "amplitude": 1.0, "deviations": []}}  # fmt: skip
    keep = np.unique(np.searchsorted(history.time, np.geomspace(0.1 * end, 0.999 * end, 60)))
    fields = {"tau": history.time, "node_x": history.contact_positions(0), "node_impulse": history.array("impulse"),
              "x": x, "snap_tau": history.time[keep], "snap_gap": history.array("gap", keep),
              "snap_v": history.array("velocity", keep)}  # fmt: skip
    if "held_impulse" in history:  # within steps, too
        fields["J_minus"] = np.maximum.accumulate(np.abs(history.array("held_impulse")))
    for name, source in (("E_kin", "kinetic_energy"), ("E_el", "strain_energy")):
        fields[name] = history.array(source)
    np.savez(result_file, outcome="completed", problem=given["id"], metadata=json.dumps(about), **fields)


main(*sys.argv[1:])
