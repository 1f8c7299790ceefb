"""Results as plain JSON data: numbers finite, missing values null, everything else as text, lists and dictionaries."""

from __future__ import annotations

from typing import Any

from pydantic_core import to_json

__all__ = ["json_text", "plain"]


def json_text(value: Any, indent: int | None = None) -> str:
    """``value`` as JSON; NaN and infinities become null."""
    return to_json(value, inf_nan_mode="null", fallback=_numpy, indent=indent).decode()


def plain(value: Any) -> Any:
    """``value`` as lists, dictionaries, text and finite numbers; NaN and infinities become ``None``."""
    import json

    return json.loads(to_json(value, inf_nan_mode="null", fallback=_numpy))


def _numpy(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else str(value)
