"""What may go wrong, by whose fault: bad input (exit code 2), a solver that cannot finish (3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bent_beam.history import ImpactHistory

__all__ = ["InputError", "SimulationError"]


class InputError(ValueError):
    """Bad input from a user: one line that names the field and the value."""


class SimulationError(RuntimeError):
    """A solver could not finish. ``history`` holds what was reached (or ``None``)."""

    def __init__(
        self, message: str, *, time: float, step: int, advice: str, history: ImpactHistory | None = None
    ) -> None:
        super().__init__(f"{message} at t = {time:.6g} s (step {step}); try: {advice}")
        self.time, self.step, self.advice, self.history = time, step, advice, history

    def __reduce__(self) -> tuple[object, ...]:  # survives the way back from a worker process
        return _restored, (self.args, self.time, self.step, self.advice, self.history)


def _restored(
    args: tuple[str, ...], time: float, step: int, advice: str, history: ImpactHistory | None
) -> SimulationError:
    error = SimulationError("", time=time, step=step, advice=advice, history=history)
    error.args = args
    return error
