"""This project's own methods (hermite, exudyn), through the same two files as anybody's.

Mesh and steps are what the method chooses from the problem's κ/ν and end time: a host's privilege. "strict" has none: a
uniform mesh and constant steps, the same for every problem, and contact that may never pull; "massless" is the scheme
of contact points without mass on this mesh.
"""

import dataclasses
import json
import sys
import tomllib

import numpy as np

from bent_beam import Impact, SimulationError
from bent_beam.meshes import UniformMesh
from bent_beam.method import chosen_for, for_whole_beam, method_type, refined

REFINEMENT = {"exudyn": {"coarse": 0.6, "medium": 1.0, "fine": 1.6}}  # of the method's own choice for the problem
STEPS = {"exudyn": 2.0}  # as many as it chooses: the window of a score needs more instants than its long steps give
OTHERS = {"coarse": 0.5, "medium": 1.0, "fine": 2.0}
ON_SPRINGS = {"coarse": 1.0, "medium": 2.0, "fine": 4.0}
STRICT = {"coarse": 0.02, "medium": 0.01, "fine": 0.005, "given": 0.02}  # element length over l*
LONG = 120.0  # ℓ_k: length of a beam on an elastic wall, whose force is over before a wave is back
GIVEN = 0.02, 400  # the mesh for all codes: element length over l*, and equal steps of the record
HALF_LENGTH = 4.0  # l*: a beam with a fourth derivative must not be bent into the wall further out


def chosen(path, choice, bare, end, infinite, resolution):
    """The method: mesh and steps are those of the problem without loads, so that both can be subtracted."""
    method = method_type(path)()
    if bare.wall_stiffness is not None:  # nothing is subtracted: what is left open is chosen when it runs
        return refined(method, ON_SPRINGS[resolution])
    if not infinite:
        method = for_whole_beam(method, bare)  # nothing held, nothing absorbed
    elif path == "hermite":  # cut where the beam goes on: its ends follow the free motion
        method = dataclasses.replace(method, domain=HALF_LENGTH)
    if resolution == "given" and choice == "chosen":
        method = chosen_for(dataclasses.replace(method, mesh=UniformMesh(element_length=GIVEN[0])), bare, end)
        even = {"growth": 0.0} if path == "hermite" else {}
        steps = dataclasses.replace(method.integrator, time_step=end / GIVEN[1], **even)
        return dataclasses.replace(method, integrator=steps)
    if choice == "chosen":
        method = chosen_for(method, bare, end)
        if path in STEPS:
            method = dataclasses.replace(method, integrator=method.integrator.refined(STEPS[path]))
        return refined(method, REFINEMENT.get(path, OTHERS)[resolution]) or method
    from hermite_fe.contacts import AlternateContact, NodeContact
    from hermite_fe.far_fields import GridViscosity
    from hermite_fe.integrators import MasslessBoundary, SignoriniPosition

    size = STRICT[resolution]
    steps = {"time_step": end / round(80 * end / size), "growth": 0.0}
    parts = {"integrator": SignoriniPosition(theta=1.0, **steps), "contact": NodeContact(hold=0, hold_until=0.0)}
    if choice == "massless":  # which knows no damping
        still = GridViscosity(viscosity=0.0, end="following")
        parts = {"integrator": MasslessBoundary(**steps), "contact": AlternateContact(), "far_field": still}
    method = dataclasses.replace(method, mesh=UniformMesh(element_length=size), **parts)
    return chosen_for(method, bare, end)


def posed(given):
    """The impact of a problem's file without its loads, and whether the beam goes on beyond the ends of the model."""
    if stop := given.get("elastic_stop"):
        half = stop["length"] / 2
        at_end = {"left_end": "hinged", "wall_from": half, "wall_to": half, "wall_stiffness": stop["stop_stiffness"]}
        speed = stop["angular_velocity"] * half
        stiffness, mass = stop["bending_stiffness"], stop["mass_per_length"]
        return Impact(stiffness, mass, stop["length"], 0.0, speed, **at_end), False
    if wall := given.get("elastic_wall"):
        return Impact(length=LONG, **wall), False
    beam = given["beam"]
    infinite = beam["length"] == "infinite"
    names = ("bending_stiffness", "mass_per_length", "curvature", "damping")
    length = 2 * HALF_LENGTH if infinite else beam["length"]
    return Impact(length=length, velocity=given["impact"]["velocity"], **{name: beam[name] for name in names}), infinite


def main(problem_file, result_file, resolution="medium", path="hermite", choice="chosen"):
    with open(problem_file, "rb") as stream:
        given = tomllib.load(stream)
    load, end = {**given.get("impact", {}), **given.get("beam", {})}, given["record"]["end_time"]
    bare, infinite = posed(given)
    if resolution == "given" and bare.wall_stiffness is not None:  # it is one of the length l*, which such a wall lacks
        np.savez(result_file, outcome="not_attempted(no mesh is given)", problem=given["id"], metadata="{}")
        return
    names = ("acceleration", "curvature_rate", "fourth_derivative", "axial_force")
    changes = {name: load[name] for name in names if load.get(name)}
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
