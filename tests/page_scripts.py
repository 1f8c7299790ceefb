"""What the scripts of the page compute, in Node.js."""

import json
import shutil
import subprocess
from typing import Any

import pytest

from bent_beam_programs.predictor.page import MODEL, SIMULATION, script


def evaluated(expression: str, argument: Any) -> Any:
    """What the page's scripts make of ``expression`` with ``given``, JSON in and out."""
    if shutil.which("node") is None:
        pytest.skip("Node.js is not installed")
    parts = [script((*MODEL, *SIMULATION[:-1], "draw.js", "form.js", "words.js"))]
    parts += [f"const given = {json.dumps(argument)};", f"console.log(JSON.stringify({expression}));"]
    done = subprocess.run(["node", "-"], input="\n".join(parts), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)
