"""A group of commands of which only the one that is asked for is imported and its options made."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import typer
from typer.core import TyperGroup

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["COMMANDS", "CommandGroup", "command_function"]

COMMANDS = {
    "theory": "The numbers of the semi-analytic theory.",
    "new": "A commented case to start from, for a beam of your own.",
    "settings": "Every table and field of a case file.",
    "predict": "What the theory says of a case, and until when it holds.",
    "predictor": "The theory as one web page.",
    "simulate": "One case on one path.",
    "bounce": "The whole impact: does the beam bounce, for how long?",
    "match": "Simulations by any methods, held against the theory.",
    "study": "What a numerical parameter does.",
    "gallery": "Every figure and table of the thesis.",
    "report": "The main job: both paths against the theory, one page.",
    "rerun": "A stored run again, and whether it came out the same.",
    "plot": "Pictures of stored runs.",
    "compare": "How far two stored runs are apart.",
    "problem": "A problem of the open benchmark.",
    "score": "Results of any code against the exact solution.",
    "benchmark": "Codes on the open benchmark, and its page.",
}
"""Name → its line in ``bentbeam --help``. Each is the function of that name in the module of that name beside this one,
which the list does not need."""


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
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))
