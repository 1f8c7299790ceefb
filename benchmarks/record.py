"""What a benchmark keeps: its rows, with date, processor and versions."""

from __future__ import annotations

import datetime
import importlib.metadata
import json
import platform
from pathlib import Path
from typing import Any

from bent_beam.files import write_atomically
from bent_beam.versions import processor

__all__ = ["RESULTS", "keep"]

VERSIONS = ("numpy", "scipy", "numba", "llvmlite", "typer")

RESULTS = Path(__file__).parent / "results"


def keep(file: Path, rows: list[dict[str, Any]]) -> None:
    """Write ``rows`` as JSON."""
    record = {
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "processor": processor(),
        "python": platform.python_version(),
        "versions": {name: importlib.metadata.version(name) for name in VERSIONS},
        "rows": rows,
    }
    write_atomically(file, json.dumps(record, indent=1, ensure_ascii=False) + "\n")
