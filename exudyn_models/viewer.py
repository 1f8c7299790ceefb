"""Exudyn's own viewer, where there is a display to show it on."""

from __future__ import annotations

import os
import sys
from typing import Any

__all__ = ["open_viewer", "wait_until_closed"]

BLUE = [0.12, 0.35, 0.67, 1.0]


def open_viewer(container: Any) -> bool:
    """Open the viewer on an assembled system; without a display, say so on standard error and return False."""
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        print("no display: DISPLAY is not set, so Exudyn's viewer cannot open a window here", file=sys.stderr)
        return False
    settings = container.visualizationSettings
    settings.general.graphicsUpdateInterval = 0.05
    settings.bodies.defaultColor = BLUE
    settings.openGL.lineWidth = 3.0
    for group in (settings.nodes, settings.markers, settings.connectors, settings.loads):
        group.show = False
    if not container.renderer.Start():
        print("Exudyn's viewer could not be started", file=sys.stderr)
        return False
    container.renderer.ZoomAll()
    return True


def wait_until_closed(container: Any) -> None:
    """Leave the last picture on the screen until its user has seen enough."""
    print("the viewer shows the end of the run: Q or Escape in its window to go on", file=sys.stderr)
    container.renderer.DoIdleTasks(printPauseMessage=False)
