"""The predictor page's functions evaluated in Node.js, and its names of the problem's fields."""

import json
import shutil
import subprocess
from typing import Any

import pytest

from bent_beam.impact import Impact
from bent_beam_programs.predictor.page import MODEL, SIMULATION, script


def evaluated(expression: str, argument: Any) -> Any:
    """What the page's scripts make of ``expression`` with ``given``, JSON in and out."""
    if shutil.which("node") is None:
        pytest.skip("Node.js is not installed")
    parts = [script((*MODEL, *SIMULATION[:-1], "draw.js", "form.js", "words.js"))]
    parts += [f"const given = {json.dumps(argument)};", f"console.log(JSON.stringify({expression}));"]
    done = subprocess.run(["node", "-"], input="\n".join(parts), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


NAMES = {"stiffness": "bending_stiffness", "mass": "mass_per_length", "length": "length", "curvature": "curvature",
         "velocity": "velocity", "acceleration": "acceleration", "tension": "axial_force", "damping": "damping",
         "wallCurvature": "wall_curvature", "naturalCurvature": "natural_curvature", "shear": "shear_stiffness",
         "turning": "rotary_inertia", "wallStiffness": "wall_stiffness", "wallDamping": "wall_damping"}  # fmt: skip


def in_si(impact: Impact, name: str) -> float:
    """A field as the page has it: 0 for none, the whole bow where no stress-free one is stated."""
    value = getattr(impact, name)
    return float(impact.curvature if value is None and name == "natural_curvature" else value or 0.0)
