"""The one style of all figures: theory is always the black line, Hermite always blue circles, Self-similar green
diamonds, Exudyn vermilion squares; any other path has a mark of its own (:func:`mark`). The wall is below: y, positive
into the wall, points downwards (:func:`wall_below`).

Colours are those of Okabe and Ito (2008), told apart by the colour-blind; sizes are those of a journal column.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

from bent_beam.files import write_atomically

COLUMN = 3.4  # width of one column, inches
PAGE = 7.0  # width of both
DPI = 110  # of an animation
FORMATS: dict[str, Any] = {"png": {"Software": None}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}  # no time

COLOURS = {
    "black": "#000000",
    "orange": "#E69F00",
    "sky": "#56B4E9",
    "green": "#009E73",
    "yellow": "#F0E442",
    "blue": "#0072B2",
    "vermilion": "#D55E00",
    "purple": "#CC79A7",
    "grey": "#777777",
}
SEQUENCE = [COLOURS[c] for c in ("blue", "vermilion", "green", "purple", "sky", "orange", "grey")]

THEORY: dict[str, Any] = {"color": COLOURS["black"], "lw": 1.2, "ls": "-", "marker": "", "label": "theory"}
OPEN: dict[str, Any] = {"ls": "", "ms": 4.0, "mfc": "none", "mew": 1.0}
HERMITE: dict[str, Any] = {**OPEN, "color": COLOURS["blue"], "marker": "o", "ms": 4.5, "label": "Hermite"}
SELF_SIMILAR: dict[str, Any] = {**OPEN, "color": COLOURS["green"], "marker": "D", "ms": 3.8, "label": "Self-similar"}
EXUDYN: dict[str, Any] = {**OPEN, "color": COLOURS["vermilion"], "marker": "s", "ms": 3.5, "label": "Exudyn"}
MARKERS = {"hermite": HERMITE, "self_similar": SELF_SIMILAR, "exudyn": EXUDYN}
MARKS = "^vP<>Xhd*p"


def marks(labels: Iterable[str]) -> dict[str, dict[str, Any]]:
    """Marker and colour of each method, by its label in order of first appearance: the same label, the same mark within
    one figure. The three that nearly every figure shows always look alike."""
    known = {mark["label"]: mark for mark in MARKERS.values()}
    free = [c for c in SEQUENCE if c not in {mark["color"] for mark in known.values()}]
    names = list(dict.fromkeys(labels))
    own = {
        label: {**OPEN, "color": free[i % len(free)], "marker": MARKS[i % len(MARKS)], "label": label}
        for i, label in enumerate(name for name in names if name not in known)
    }
    return {label: (known | own)[label] for label in names}


RC: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 8.0,
    "mathtext.fontset": "dejavusans",
    "axes.labelsize": 8.5,
    "axes.titlesize": 8.5,
    "legend.fontsize": 7.5,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "lines.linewidth": 1.1,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "figure.dpi": 150,
    "savefig.dpi": 200,
    "axes.prop_cycle": matplotlib.rcsetup.cycler(color=SEQUENCE),
    "figure.constrained_layout.use": True,
    "svg.hashsalt": "bent-beam-impact",
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
}


@contextmanager
def figure(
    rows: int = 1, columns: int = 1, *, width: float = COLUMN, height: float | None = None, **kwargs: Any
) -> Iterator[tuple[Figure, Any]]:
    """A figure in the project's style: ``with figure() as (fig, ax): …``. Sizes in inches. Nothing of the caller's
    Matplotlib is changed: neither its backend nor the figures that it knows."""
    with matplotlib.rc_context(RC):
        fig = Figure(figsize=(width, height or 0.75 * width / columns * rows))
        yield fig, fig.subplots(rows, columns, **kwargs)


def save(fig: Figure, out: Path, name: str, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Write ``name.png`` (and pdf, svg) in ``out``, atomically and without time stamps; returns the files."""
    fig.draw_without_rendering()  # a layout makes room for the ticks of the one before
    files = []
    for kind in formats:
        if kind not in FORMATS:
            raise ValueError(f"format must be one of {', '.join(FORMATS)} (got {kind!r})")
        stream = BytesIO()
        with matplotlib.rc_context({name: RC[name] for name in ("svg.hashsalt", "svg.fonttype", "pdf.fonttype")}):
            fig.savefig(stream, format=kind, metadata=FORMATS[kind])
        files.append(out / f"{name}.{kind}")
        write_atomically(files[-1], stream.getvalue())
    return files


def mark(path: str) -> dict[str, Any]:
    """Marker and colour of a path, without a label."""
    found = MARKERS[path] if path in MARKERS else marks([path])[path]
    return {k: v for k, v in found.items() if k != "label"}


def wall_below(axis: Axes, low: float, high: float) -> None:
    """Limits of an axis of deflections y, from ``low`` (off the wall) to ``high`` (inside it), and the wall below."""
    axis.axhspan(0.0, max(high, 0.0) * 2.0 + 1e-30, color="#E8E8E8", lw=0, zorder=0)
    axis.axhline(0.0, color=COLOURS["grey"], lw=0.7, zorder=0.5)
    axis.set_ylim(high, low)


def panel_label(axis: Axes, text: str) -> None:
    """(a), (b) … in the upper left corner, outside the data."""
    axis.text(0.0, 1.02, text, transform=axis.transAxes, ha="left", va="bottom", fontweight="bold", fontsize=8.5)


def decades(axis: Axis, values: Iterable[float]) -> None:
    """Plain numbers on a logarithmic axis of ``values``: of decades, and where these are few of what is between."""
    known = [*values]
    few = max(known) < 100.0 * min(known)
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
    axis.set_major_formatter(FormatStrFormatter("%g"))
    axis.set_minor_formatter(NullFormatter())


def linear_within(axis: Axes, limit: float, unit: str = "") -> None:
    """An axis of values of both signs, logarithmic from ``limit`` on; says so."""
    axis.set_yscale("symlog", linthresh=limit)
    axis.set_title(f"linear within ±{limit:g}{unit}, beyond logarithmic", loc="right", fontsize=6.5, pad=3.0)


def yield_line(axis: Axes, limit: float, highest: float) -> None:
    """Where the material yields, if the stresses, at most ``highest``, come near it; on the axis."""
    if limit > 2.0 * highest:
        return
    axis.axhline(limit, color=COLOURS["black"], lw=0.9, ls="--")
    axis.set_ylim(top=max(axis.get_ylim()[1], 1.15 * limit))
    axis.annotate(f"yields at {limit:.4g}", (0.02, limit), xycoords=("axes fraction", "data"), va="bottom", fontsize=7)


def write_gif(fig: Figure, moving: Sequence[Artist], frames: Iterable[object], file: Path, per_second: int) -> None:
    """Write pictures of 64 colours of a figure to ``file``, atomically, to be shown over and over.

    moving : the artists that change from picture to picture, drawn over the rest in this order. The rest is drawn once,
    which takes nearly all the time. frames : moves them, a picture a step.
    """
    from PIL import Image

    for artist in moving:
        artist.set_animated(True)
    fig.set_dpi(DPI)
    canvas, pictures = FigureCanvasAgg(fig), []
    canvas.draw()
    still = canvas.copy_from_bbox(fig.bbox)
    for _ in frames:
        canvas.restore_region(still)
        for artist in moving:
            fig.draw_artist(artist)
        pixels = np.asarray(canvas.buffer_rgba())[..., :3]
        pictures.append(Image.fromarray(pixels).convert("P", palette=Image.Palette.ADAPTIVE, colors=64))
    stream = BytesIO()
    film: Any = {"save_all": True, "append_images": pictures[1:], "duration": 1000 // per_second, "loop": 0}
    pictures[0].save(stream, format="GIF", optimize=True, **film)
    write_atomically(file, stream.getvalue())


def label_panels(*axes: Axes) -> None:
    for axis, letter in zip(axes, "abcdef"):
        panel_label(axis, f"({letter})")


def bars(axis: Axes, x: Any, values: Any, errors: Any, mark: dict[str, Any]) -> None:
    axis.errorbar(x, values, yerr=errors, elinewidth=0.8, capsize=2, **mark)
