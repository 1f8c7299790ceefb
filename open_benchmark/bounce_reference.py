"""Converged coefficients of restitution of the whole impacts that are shipped as problems.

``python -m open_benchmark.bounce_reference`` measures them on the Hermite path and writes ``bounce_reference.json``.
The mesh is three times finer than what ``bentbeam bounce`` takes by itself; the error bar is the sum of what halving
the number of elements, doubling the steps and Moreau and Jean's contact law change (docs/whole_impact.md).
"""

from __future__ import annotations

import argparse
import json
from typing import Any

from bent_beam.meshes import UniformMesh
from bent_beam.versions import stamp
from comparison.bounce import bounce
from comparison.bounce import problem as beam
from comparison.plain import json_text
from comparison.store import write_atomically
from hermite_fe import HermiteFE
from open_benchmark.problem import Problem, problem, shipped_ids
from open_benchmark.references import BOUNCES

__all__ = ["measure"]

ELEMENTS = 600  # of a half beam
NUMBERS = ("restitution", "last_contact", "midspan_moment")


def measure(asked: Problem, elements: int = ELEMENTS) -> dict[str, Any]:
    """One whole impact: number → [value, error bar], the parts of the bar of e, and what it took."""
    method = HermiteFE(mesh=UniformMesh(element_length=1.0 / elements))
    found = bounce(beam(asked.kappa_over_nu, asked.damping), method)
    return {
        "kappa_over_nu": asked.kappa_over_nu,
        "damping": asked.damping,
        **{name: [found.numbers[name].value, found.numbers[name].error] for name in NUMBERS},
        "error_parts": dict(found.numbers["restitution"].parts),
        "settings": found.settings,
        "steps": found.history.steps,
        "seconds": found.seconds,
    }


def _main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problem", action="append", default=[], help="keep the others as they are stored")
    names = parser.parse_args().problem or [name for name in shipped_ids() if name.startswith("bounce-")]
    kept = json.loads(BOUNCES.read_text(encoding="utf-8"))["problems"] if BOUNCES.exists() else {}
    for name in names:
        kept[name] = measure(problem(name))
        print(name, kept[name]["restitution"], flush=True)
    document = {
        "what": "whole impacts of a free-free bent beam, units L/2 = EI = mu = V0 = 1: number -> [value, error bar]",
        **stamp("python -m open_benchmark.bounce_reference"),
        "settings": {"path": HermiteFE.path, "elements": ELEMENTS},
        "problems": dict(sorted(kept.items())),
    }
    write_atomically(BOUNCES, json_text(document, indent=1) + "\n")


if __name__ == "__main__":
    _main()
