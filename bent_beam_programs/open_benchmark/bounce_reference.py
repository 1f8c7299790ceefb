"""Converged coefficients of restitution of the whole impacts that are shipped as problems.

    python -m bent_beam_programs.open_benchmark.bounce_reference             five minutes
    python -m bent_beam_programs.open_benchmark.bounce_reference --confirm   measure coarsely, compare, keep

The mesh is three times finer than that of ``bentbeam bounce``, whose error bar it has (docs/whole_impact.md).
"""

import argparse

from bent_beam.stored import confirm, write
from bent_beam_programs.open_benchmark.exact import SAMPLE, whole_impact
from bent_beam_programs.open_benchmark.problem import problem, shipped_ids
from bent_beam_programs.open_benchmark.references import BOUNCES, stored
from hermite_fe import HermiteFE

ELEMENTS = 600  # of a half beam
PACKAGES = (
    *("bent_beam", "hermite_fe", "comparison.bouncing", "comparison.questions", "comparison.runs"),
    "bent_beam_programs.open_benchmark.exact",
)


def agrees(name: str, elements: int = SAMPLE) -> bool:
    """Whether a coarser mesh gives the stored restitution within both error bars, its own the larger one."""
    value, error = stored(BOUNCES)["problems"][name]["restitution"]
    coarse, bar = whole_impact(problem(name), elements)["restitution"]
    print(f"{name}: {coarse:.7g} ± {bar:.1g} with {elements} elements, stored {value:.7g} ± {error:.1g}", flush=True)
    return bool(abs(coarse - value) <= bar + error and bar > error)


def _main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--confirm", action="store_true", help="keep all numbers if coarse runs agree with them")
    names = sorted(name for name in shipped_ids() if name.startswith("bounce-"))
    if parser.parse_args().confirm:
        if not all([agrees(name) for name in names]):
            parser.exit(1, "the stored references are stale: measure them anew\n")
        confirm(BOUNCES, PACKAGES)
        return
    found = {}
    for name in names:
        found[name] = whole_impact(problem(name), ELEMENTS)
        print(name, found[name]["restitution"], flush=True)
    what = "whole impacts of a free-free bent beam, units L/2 = EI = mu = V0 = 1: number -> [value, error bar]"
    made_by = "python -m bent_beam_programs.open_benchmark.bounce_reference"
    write(BOUNCES, what, made_by, PACKAGES, {"path": HermiteFE.path, "elements": ELEMENTS}, {"problems": found})


if __name__ == "__main__":
    _main()
