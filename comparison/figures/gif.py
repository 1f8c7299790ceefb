"""Figures in a row as an animated GIF."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from comparison.store import write_atomically

__all__ = ["DPI", "Film", "write_gif"]

DPI = 110


class Film:
    """Pictures of a figure in which only some artists move: the rest is drawn once, which takes nearly all the time.

    moving : what changes from picture to picture, drawn over the rest in this order.
    """

    def __init__(self, fig: Figure, moving: Sequence[Artist]) -> None:
        self.fig, self.moving = fig, moving
        for artist in moving:
            artist.set_animated(True)
        fig.set_dpi(DPI)
        self.canvas = FigureCanvasAgg(fig)
        self.canvas.draw()
        self.still = self.canvas.copy_from_bbox(fig.bbox)

    def picture(self) -> Any:
        """The figure as it stands, as one picture of 64 colours."""
        from PIL import Image

        self.canvas.restore_region(self.still)
        for artist in self.moving:
            self.fig.draw_artist(artist)
        pixels = np.asarray(self.canvas.buffer_rgba())[..., :3]
        return Image.fromarray(pixels).convert("P", palette=Image.Palette.ADAPTIVE, colors=64)


def write_gif(frames: Sequence[Any], file: Path, per_second: int) -> None:
    """Write ``frames`` to ``file``, atomically, to be shown over and over."""
    stream = BytesIO()
    frames[0].save(
        stream,
        format="GIF",
        save_all=True,
        append_images=frames[1:],
        duration=1000 // per_second,
        loop=0,
        optimize=True,
    )
    write_atomically(file, stream.getvalue())
