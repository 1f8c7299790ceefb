"""Waiting for what other processes do."""

import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path


def until(holds: Callable[[], bool], seconds: float = 10.0, pause: float = 0.02) -> None:
    """Wait for it, but no longer than that: a machine may have other work."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end
        time.sleep(pause)


def ended(number: int) -> bool:
    """Whether no process of this number or of its group is alive (Linux); what nobody has waited for is over, too."""
    for place in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            state, _, group = (place / "stat").read_text().rpartition(")")[2].split()[:3]
            if number in (int(place.name), int(group)) and state != "Z":
                return False
    return True
