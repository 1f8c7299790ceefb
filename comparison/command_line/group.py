"""A group of commands of which only the one that is asked for is imported and its options made."""

from __future__ import annotations

import importlib
import inspect
from typing import TYPE_CHECKING, Any

import typer
from typer.core import TyperGroup

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["COMMANDS", "CommandGroup", "command_function"]

COMMANDS = (
    "theory",
    "new",
    "settings",
    "predict",
    "predictor",
    "simulate",
    "bounce",
    "match",
    "study",
    "gallery",
    "report",
    "rerun",
    "plot",
    "compare",
    "problem",
    "score",
    "benchmark",
)
"""Each is the function of that name in the module of that name beside this one."""


def command_function(name: str) -> Callable[..., Any]:
    """The function behind one of :data:`COMMANDS`."""
    found: Callable[..., Any] = getattr(importlib.import_module(f"comparison.command_line.{name}"), name)
    return found


class CommandGroup(TyperGroup):
    """:data:`COMMANDS` as a group; making the options of all of them would take half of the time of a start."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**{**settings, "commands": dict.fromkeys(COMMANDS)})

    def list_commands(self, ctx: Any) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in COMMANDS:
            return None
        if self.commands[cmd_name] is None:
            alone = typer.Typer(rich_markup_mode=None, pretty_exceptions_enable=False, add_completion=False)
            alone.command()(command_function(cmd_name))
            self.commands[cmd_name] = typer.main.get_command(alone)
        return self.commands[cmd_name]

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """The list in ``--help``: of each command the first paragraph of what its function says."""
        rows = []
        for name in COMMANDS:
            said = inspect.getdoc(command_function(name)) or ""
            rows.append((name, " ".join(said.partition("\n\n")[0].split())))
        with formatter.section("Commands"):
            formatter.write_dl(rows)
