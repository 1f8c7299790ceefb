"""Progress on standard error, with the time that is left, on a terminal only and only when it takes a while."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial

__all__ = ["Bar", "Console"]


@dataclass(frozen=True)
class Bar:
    """What a long job reports to: a fraction, or a count of things done."""

    fraction: Callable[[float], None]

    def count(self, done: int, total: int) -> None:
        self.fraction(done / max(total, 1))


@dataclass(frozen=True)
class Console:
    """Standard error as a place for progress; silent when it is not a terminal, or ``quiet``."""

    quiet: bool = False

    @contextmanager
    def progress(self, title: str) -> Iterator[Bar]:
        if self.quiet:
            yield Bar(lambda done: None)
            return
        if not sys.stderr.isatty():
            with notices(partial(print, file=sys.stderr)):
                yield Bar(lambda done: None)
            return
        from rich import progress
        from rich.console import Console as RichConsole

        columns = (
            "{task.description}",
            progress.BarColumn(),
            "{task.percentage:>3.0f} %",
            progress.TimeElapsedColumn(),
            "left",
            progress.TimeRemainingColumn(),
        )
        terminal = RichConsole(stderr=True)
        with progress.Progress(*columns, console=terminal, transient=True) as bar, notices(terminal.print):
            task = bar.add_task(title, total=1.0)
            yield Bar(lambda done: bar.update(task, completed=done))


@contextmanager
def notices(show: Callable[[str], None]) -> Iterator[None]:
    """What any path logs for the user (the logger ``bent_beam``) goes to ``show`` while in here."""

    class Shown(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            show(record.getMessage())

    handler, log = Shown(logging.INFO), logging.getLogger("bent_beam")
    level = log.level
    log.addHandler(handler)
    log.setLevel(logging.INFO)
    try:
        yield
    finally:
        log.removeHandler(handler)
        log.setLevel(level)
