"""Converged coefficients of restitution of the whole impacts that are shipped as problems.

    python -m bent_beam_programs.open_benchmark.bounce_reference [--problem ID …]   three minutes
    python -m bent_beam_programs.open_benchmark.bounce_reference --confirm          measure coarsely, compare, keep

The mesh is three times finer than that of ``bentbeam bounce``. The error bar is the sum of three changes: half as many
elements, steps twice as long, and Moreau and Jean's contact law (docs/whole_impact.md).
"""

from __future__ import annotations

import argparse
from typing import Any

from bent_beam.meshes import UniformMesh
from bent_beam_programs.open_benchmark.problem import Problem, problem, shipped_ids
from bent_beam_programs.open_benchmark.references import BOUNCES, stored
from comparison.bouncing import bounce
from comparison.bouncing import problem as beam
from comparison.stored import confirm, write
from hermite_fe import HermiteFE

__all__ = ["agrees", "measure"]

ELEMENTS = 600  # of a half beam
SAMPLE = 100  # the same of a confirmation
NUMBERS = ("restitution", "last_contact", "midspan_moment")
PACKAGES = ("hermite_fe", "bent_beam")


def measure(asked: Problem, elements: int = ELEMENTS) -> dict[str, Any]:
    """One whole impact: number → [value, error bar], the parts of the bar of e, and its settings and cost."""
    method = HermiteFE(mesh=UniformMesh(element_length=1.0 / elements))
    found = bounce(beam(asked.kappa_over_nu, asked.damping), method)
    return {
        "kappa_over_nu": asked.kappa_over_nu,
        "damping": asked.damping,
        **{name: [found.numbers[name].value, found.numbers[name].bar] for name in NUMBERS},
        "error_parts": dict(getattr(found.numbers["restitution"], "parts", {})),
        "settings": found.settings,
        "steps": found.runs.run.steps,
        "seconds": found.seconds,
    }


def agrees(name: str, elements: int = SAMPLE) -> bool:
    """Whether a coarser mesh gives the stored restitution within both error bars, its own the larger one."""
    value, error = stored(BOUNCES)["problems"][name]["restitution"]
    coarse, bar = measure(problem(name), elements)["restitution"]
    print(f"{name}: {coarse:.7g} ± {bar:.1g} with {elements} elements, stored {value:.7g} ± {error:.1g}", flush=True)
    return bool(abs(coarse - value) <= bar + error and bar > error)


def _main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--problem", action="append", default=[], help="measure this one and keep the others")
    parser.add_argument("--confirm", action="store_true", help="keep all numbers if coarse runs agree with them")
    asked = parser.parse_args()
    names = asked.problem or [name for name in shipped_ids() if name.startswith("bounce-")]
    if asked.confirm:
        if not all([agrees(name) for name in names]):
            parser.exit(1, "the stored references are stale: measure them anew\n")
        confirm(BOUNCES)
        return
    kept = dict(stored(BOUNCES)["problems"]) if BOUNCES.exists() else {}
    for name in names:
        kept[name] = measure(problem(name))
        print(name, kept[name]["restitution"], flush=True)
    write(
        BOUNCES,
        "whole impacts of a free-free bent beam, units L/2 = EI = mu = V0 = 1: number -> [value, error bar]",
        "python -m bent_beam_programs.open_benchmark.bounce_reference",
        PACKAGES,
        {"path": HermiteFE.path, "elements": ELEMENTS},
        {"problems": dict(sorted(kept.items()))},
    )


if __name__ == "__main__":
    _main()
