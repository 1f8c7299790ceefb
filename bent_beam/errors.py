"""What may go wrong, by whose fault: bad input (exit code 2), a solver that cannot finish (3)."""

import difflib
from collections.abc import Iterable
from typing import Any

ANY_FAILURE = (Exception, SystemExit)
"""What a row of a sweep may end with, whoever wrote its method: only an interrupt ends the sweep."""


class InputError(ValueError):
    """Bad input from a user: one line that names the field and the value."""


class TimeLimitError(Exception):
    """A row cannot be finished within its limit."""


class SimulationError(RuntimeError):
    """A solver could not finish. history : a :class:`bent_beam.ImpactHistory` of what was reached, or ``None``; time in
    s, ``None`` where a method failed without saying when."""

    def __init__(
        self, message: str, *, time: float | None = None, step: int = 0, advice: str = "", history: Any = None
    ) -> None:
        where = "" if time is None else f" at t = {time:.6g} s (step {step})"
        super().__init__(message + where + (f"; try: {advice}" if where and advice else ""))
        self.time, self.step, self.advice, self.history = time, step, advice, history


def nearest(word: str, known: Iterable[str]) -> str:
    """`` (did you mean …?)`` for a misspelt word, or the list of what is known."""
    known = sorted(set(known))
    close = difflib.get_close_matches(word, known, n=1, cutoff=0.5)
    return f" (did you mean {close[0]}?)" if close else f" (known: {', '.join(known)})"


def unknown_key(where: str, key: str, known: Iterable[str]) -> InputError:
    return InputError(f"{where + '.' if where else ''}{key} is not a known setting{nearest(key, known)}")
