"""Plain JSON data: numbers finite, missing values null, everything else as text, lists and dictionaries."""

import json
from typing import Any


def json_text(value: Any, indent: int | None = None) -> str:
    """``value`` as JSON; NaN and infinities become null."""
    from pydantic_core import to_json

    def of_numpy(value: Any) -> Any:
        return value.tolist() if hasattr(value, "tolist") else str(value)

    return to_json(value, inf_nan_mode="null", fallback=of_numpy, indent=indent).decode()


def plain(value: Any) -> Any:
    """``value`` as lists, dictionaries, text and finite numbers; NaN and infinities become ``None``."""
    return json.loads(json_text(value))
