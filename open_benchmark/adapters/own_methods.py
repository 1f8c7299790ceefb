"""This project's own methods (hermite, exudyn), through the same two files as anybody's."""

import dataclasses
import sys
import time
import tomllib

from bent_beam import Impact, SimulationError
from bent_beam.method import chosen_for, for_whole_beam, method_type, refined
from open_benchmark.histories import result_from_history
from open_benchmark.problem import problem as problem_of
from open_benchmark.result import Result, save_result

REFINEMENT = {  # of the method's own choice for the problem
    "exudyn": {"coarse": 0.25, "medium": 0.5, "fine": 1.0},
}
OTHERS = {"coarse": 0.5, "medium": 1.0, "fine": 2.0}
HALF_LENGTH = 4.0  # l*: a beam with a fourth derivative must not be bent into the wall further out


def main(problem_file, result_file, resolution="medium", path="hermite"):
    with open(problem_file, "rb") as stream:
        given = tomllib.load(stream)
    asked, beam, load, end = problem_of(given["id"]), given["beam"], given["impact"], given["record"]["end_time"]
    bare = Impact(
        bending_stiffness=beam["bending_stiffness"],
        mass_per_length=beam["mass_per_length"],
        length=2 * HALF_LENGTH if beam["length"] == "infinite" else beam["length"],
        curvature=beam["curvature"],
        velocity=load["velocity"],
        damping=beam["damping"],
    )
    changes = {name: load[name] for name in ("acceleration", "curvature_rate", "fourth_derivative") if load[name]}
    if beam["axial_force"]:
        changes["axial_force"] = beam["axial_force"]
    # mesh and steps are those of the problem without loads, so that both can be subtracted
    method = method_type(path)()
    if beam["length"] != "infinite":
        method = for_whole_beam(method, bare)  # nothing held, nothing absorbed
    elif path == "hermite":  # cut where the beam goes on: its ends follow the free motion
        method = dataclasses.replace(method, domain=HALF_LENGTH)
    method = chosen_for(method, bare, end)
    method = refined(method, REFINEMENT.get(path, OTHERS)[resolution]) or method
    began = time.perf_counter()
    try:
        impact = bare.replace(**changes)
        refusal = method.refuses(impact)
    except (TypeError, ValueError) as error:
        refusal = str(error)
    if refusal:
        save_result(result_file, Result("unsupported", refusal, asked, {}))
        return
    try:
        history = method.simulate(impact, end_time=end, save=600)
    except SimulationError as error:
        save_result(result_file, Result("not_converged", " ".join(str(error).split()), asked, {}))
        return
    found = result_from_history(history, asked)
    about = {
        **found.metadata,
        "resolution": resolution,
        "set_up_seconds": time.perf_counter() - began - history.seconds,
    }
    about["lines"] = len(open(__file__).readlines())
    save_result(result_file, dataclasses.replace(found, metadata=about))


main(*sys.argv[1:])
