"""What may go wrong, by whose fault: bad input (exit code 2), a solver that cannot finish (3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bent_beam.history import ImpactHistory

__all__ = ["ANY_FAILURE", "InputError", "SimulationError", "TimeLimitError"]

ANY_FAILURE = (Exception, SystemExit)
"""What a row of a sweep may end with, whoever wrote its method: only an interrupt ends the sweep."""


class InputError(ValueError):
    """Bad input from a user: one line that names the field and the value."""


class TimeLimitError(Exception):
    """A row cannot be finished within its limit."""


class SimulationError(RuntimeError):
    """A solver could not finish. ``history`` holds what was reached (or ``None``); time : s, ``None`` where a method
    failed without saying when."""

    def __init__(
        self,
        message: str,
        *,
        time: float | None = None,
        step: int = 0,
        advice: str = "",
        history: ImpactHistory | None = None,
    ) -> None:
        super().__init__(message if time is None else f"{message} at t = {time:.6g} s (step {step}); try: {advice}")
        self.time, self.step, self.advice, self.history = time, step, advice, history
