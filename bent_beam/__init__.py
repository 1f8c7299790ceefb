"""The impact problem, case files, meshes, the record of a run and the protocol of a method, shared by all paths.

Read `impact` first, on `scales` (its fields and units) and `loads`; then `cases`, from files by `tables`, `description`
and `section`; `free_flight`, whether a beam that is off the wall comes back; `history`, the record of a run, by
`files`; `method`, what a path must offer, and `fields`, how its parts are spelled.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bent_beam.cases import Case, load_case
    from bent_beam.errors import InputError, SimulationError
    from bent_beam.history import ImpactHistory
    from bent_beam.impact import Impact
    from bent_beam.method import Method

__all__ = ["Case", "Impact", "ImpactHistory", "InputError", "Method", "SimulationError", "load_case"]

# The theory needs Impact and no more, an error message nothing: each is imported when it is asked for.
_LATER = {
    "Case": "bent_beam.cases",
    "load_case": "bent_beam.cases",
    "ImpactHistory": "bent_beam.history",
    "SimulationError": "bent_beam.errors",
    "Impact": "bent_beam.impact",
    "Method": "bent_beam.method",
    "InputError": "bent_beam.errors",
}


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module 'bent_beam' has no attribute {name!r}")
    return getattr(importlib.import_module(_LATER[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
