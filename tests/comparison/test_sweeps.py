"""A sweep of hours goes on, whatever a method of somebody else's does, and at whatever moment it does it."""

from dataclasses import dataclass
from typing import ClassVar

import pytest

from comparison.match import match
from comparison.rows import Question


@dataclass(frozen=True)
class Careless:
    """Fails when it is asked about an impact, before any run."""

    path: ClassVar[str] = "careless"
    error: type[BaseException]
    label: str = "careless"

    def refuses(self, impact):
        raise self.error("nobody looked")


@pytest.mark.parametrize("error", [KeyError, MemoryError, SystemExit])
def test_what_fails_outside_its_run_costs_its_row_too(error):
    (row,) = match([Question(Careless(error), 0.5)])
    assert row.reason.startswith(error.__name__) and "nobody looked" in row.reason and not row.refused
