"""Figures in a row as an animated GIF."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from comparison.store import write_atomically

__all__ = ["frame_of", "write_gif"]


def frame_of(fig: Figure) -> Any:
    """The figure as it stands, as one picture of 64 colours."""
    from PIL import Image

    stream = BytesIO()
    fig.savefig(stream, format="png", dpi=110)
    stream.seek(0)
    return Image.open(stream).convert("P", palette=Image.Palette.ADAPTIVE, colors=64)


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
