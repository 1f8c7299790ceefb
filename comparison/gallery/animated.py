"""An impact in motion."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from comparison.figures.animation import Frame, animate
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.runs import reference_history
from comparison.store import write_atomically
from self_similar_fe import SelfSimilarFE

CURVATURE, DURATION = 5.0, 0.1


def write(out: Path, sheet: Sheet) -> tuple[list[Path], str]:
    """The GIF and its frames as CSV."""
    files = [out / "animation.gif", out / "animation.csv"]
    frames = animate(reference_history(CURVATURE, DURATION, SelfSimilarFE.path), files[0])
    write_atomically(files[1], table(frames))
    final = frames[-1]
    return files, f"At t = {final.time:.2e} s the contact points are at ±{1e3 * final.front:.1f} mm."


def table(frames: list[Frame]) -> str:
    """time, half contact length, reaction and the beam of each frame: one row a point."""
    lines = ["time (s),half contact length (m),reaction of one side (N),x (m),y (m)"]
    for f in frames:
        near = np.abs(f.x) <= 2.0 * max(f.front, 1e-9) + f.x[-1] / 8
        head = f"{f.time:.9g},{f.front:.9g},{f.reaction:.9g}"
        lines += [f"{head},{x:.9g},{y:.9g}" for x, y in zip(f.x[near], f.y[near])]
    return "\n".join(lines) + "\n"


@item(
    "animation",
    "An impact in motion",
    group="theory",
    write=write,
    caption=(
        "K = 5 1/m (κ/ν = 0.25), V₀ = 20 m/s, Self-similar: beam, wall and contact points; below, the reaction "
        "against theory."
    ),
)
def animation(sheet: Sheet) -> None:
    """Drawn by :func:`write`."""
