"""Exudyn's own viewer, where there is a display to show it on."""

from __future__ import annotations

import os
import sys
from typing import Any

__all__ = ["missing_display", "open_viewer"]


def missing_display() -> str | None:
    """Why no window can be opened here (None: one can)."""
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        return "no display: DISPLAY is not set, so Exudyn's viewer cannot open a window here"
    return None


def open_viewer(container: Any, system: Any) -> bool:
    """Open the viewer on an assembled system; without a display, say so on standard error and return False."""
    reason = missing_display()
    if reason is None:
        container.visualizationSettings.general.graphicsUpdateInterval = 0.05
        if container.renderer.Start():
            container.renderer.ZoomAll()
            return True
        reason = "Exudyn's viewer could not be started"
    print(reason, file=sys.stderr)
    return False
