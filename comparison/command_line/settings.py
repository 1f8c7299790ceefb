"""``bentbeam settings``."""

from __future__ import annotations

from typing import Annotated

import typer

from comparison.command_line.options import Json, emit

__all__ = ["settings"]


def settings(
    markdown: Annotated[bool, typer.Option("--markdown", help="As the page of the documentation.")] = False,
    as_json: Json = False,
) -> None:
    """List every setting with unit, default and range.

    Example: bentbeam settings
    """
    from comparison.settings import settings as every
    from comparison.settings import settings_markdown, settings_text

    emit(every(), as_json, settings_markdown if markdown else settings_text)
