"""Exudyn's own viewer, where there is a display to show it on."""

from __future__ import annotations

import os
import sys
from typing import Any

import exudyn.graphics as graphics
import exudyn.itemInterface as items
import numpy as np

__all__ = ["draw_wall", "missing_display", "open_viewer", "wait_until_closed"]

BLUE, GREY = [0.12, 0.35, 0.67, 1.0], [0.35, 0.35, 0.35, 1.0]


def missing_display() -> str | None:
    """Why no window can be opened here (None: one can)."""
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        return "no display: DISPLAY is not set, so Exudyn's viewer cannot open a window here"
    return None


def draw_wall(mbs: Any, left: float, right: float, curvature: float = 0.0) -> None:
    """The line y = ``curvature`` x²/2 of a wall (before ``mbs.Assemble``)."""
    x = np.linspace(left, right, 200)
    line = np.stack([x, curvature * x**2 / 2, np.zeros_like(x)], axis=1)
    wall = graphics.Lines(line.tolist(), color=GREY)
    mbs.AddObject(items.ObjectGround(visualization=items.VObjectGround(graphicsData=[wall])))


def open_viewer(container: Any) -> bool:
    """Open the viewer on an assembled system; without a display, say so on standard error and return False."""
    reason = missing_display()
    if reason is None:
        settings = container.visualizationSettings
        settings.general.graphicsUpdateInterval = 0.05
        settings.bodies.defaultColor = BLUE
        settings.openGL.lineWidth = 3.0
        for group in (settings.nodes, settings.markers, settings.connectors, settings.loads):
            group.show = False
        if container.renderer.Start():
            container.renderer.ZoomAll()
            return True
        reason = "Exudyn's viewer could not be started"
    print(reason, file=sys.stderr)
    return False


def wait_until_closed(container: Any) -> None:
    """Leave the last picture on the screen until its user has seen enough."""
    print("the viewer shows the end of the run: Q or Escape in its window to go on", file=sys.stderr)
    container.renderer.DoIdleTasks(printPauseMessage=False)
