"""Progress on standard error, with the time that is left, on a terminal only and only when it takes a while."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress

__all__ = ["Bar", "Console"]


class Bar:
    """What a long job reports to: a fraction, or a count of things done."""

    def __init__(self, progress: Progress | None, title: str) -> None:
        self._progress = progress
        self._task = progress.add_task(title, total=1.0) if progress is not None else None

    def fraction(self, done: float) -> None:
        if self._progress is not None and self._task is not None:
            self._progress.update(self._task, completed=done)

    def count(self, done: int, total: int) -> None:
        self.fraction(done / max(total, 1))


class Console:
    """Standard error as a place for progress; silent when it is not a terminal, or ``quiet``."""

    def __init__(self, quiet: bool = False) -> None:
        self.quiet = quiet
        self.shown = not quiet and sys.stderr.isatty()

    @contextmanager
    def progress(self, title: str) -> Iterator[Bar]:
        if self.quiet:
            yield Bar(None, title)
            return
        if not self.shown:
            with notices(partial(print, file=sys.stderr)):
                yield Bar(None, title)
            return
        from rich.console import Console as RichConsole
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

        columns = (
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.percentage:>3.0f} %"),
            TimeElapsedColumn(),
            TextColumn("left"),
            TimeRemainingColumn(),
        )
        with Progress(*columns, console=RichConsole(stderr=True), transient=True) as bar, notices(bar.console.print):
            yield Bar(bar, title)


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
