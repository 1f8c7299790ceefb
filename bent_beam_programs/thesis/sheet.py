"""A figure or table with its data: every curve drawn through a :class:`Sheet` is also in its CSV. An item of the
gallery is a number of the thesis and a function that draws it on a sheet (:func:`item`).

CSV columns: panel, series, x_quantity, x, y_quantity, y; the quantities are the axis labels, units included.
"""

import csv
import io
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import chain, repeat
from pathlib import Path
from string import ascii_lowercase
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from bent_beam.files import write_atomically
from comparison.figures import style
from comparison.readable import readable

NAMES = "lambda kappa nu tau xi beta eta alpha psi chi varphi varepsilon rho theta mu infty Delta partial tilde sqrt"
TEX = {f"\\{name}": letter for name, letter in zip(NAMES.split(), "λκντξβηαψχφερθμ∞Δ∂~√")}
TEX |= {r"\dot": "dot ", r"\,": " ", r"\mathrm": ""}


def without_tex(label: str) -> str:
    """A mathtext label as plain text, for a CSV header."""
    for tex, text in TEX.items():
        label = label.replace(tex, text)
    return re.sub(r"\s+", " ", re.sub(r"[${}\\]", "", label)).strip()


@dataclass
class Sheet:
    """One figure or table in the making, its data, and the numbers that go with it.

    curves : axis, series, x, y, and the quantity of y where it is not the axis's. numbers : name with unit → number.
    page : text of a Markdown page, if one is written beside it.
    """

    figure_: Figure | None = None
    curves: list[tuple[Axes, str, NDArray[np.float64], NDArray[np.float64], str]] = field(default_factory=list)
    panels: dict[int, str] = field(default_factory=dict)
    rows: list[list[Any]] = field(default_factory=list)
    numbers: dict[str, float | None] = field(default_factory=dict)
    page: str = ""

    @contextmanager
    def figure(
        self,
        rows: int = 1,
        columns: int = 1,
        *,
        texts: Sequence[str] = (),
        letters: bool = True,
        legend: int = 0,
        legend_size: float | None = None,
        **kwargs: Any,
    ) -> Iterator[tuple[Figure, Any]]:
        """``style.figure``, a page wide where it has columns, and kept for :meth:`save`.

        Several axes get ``letters``, row by row, also in the CSV, and ``texts`` beside them. legend : columns of one
        legend below (0: none).
        """
        width = style.PAGE if columns > 1 else style.COLUMN
        with style.figure(rows, columns, **{"width": width} | kwargs) as (self.figure_, axes):
            yield self.figure_, axes
            if letters and np.size(axes) > 1:
                for axis, letter, text in zip(np.ravel(axes), ascii_lowercase, chain(texts, repeat(""))):
                    self.panels[id(axis)] = letter
                    style.panel_label(axis, f"({letter})")
                    place = {"xycoords": "axes fraction", "xytext": (17, 0), "textcoords": "offset points"}
                    axis.annotate(text, (0.0, 1.02), **place, ha="left", va="bottom", fontsize=7.5)
            if legend:
                legend_below(self.figure_, axes, legend, fontsize=legend_size)

    def line(self, axis: Axes, x: ArrayLike, y: ArrayLike, *, series: str, legend: bool = True, **drawn: Any) -> None:
        """Plot one curve and remember it. ``drawn`` is a style of :mod:`comparison.figures.style` or matplotlib's."""
        places, values = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        axis.plot(places, values, **{**drawn, "label": series if legend else "_"})
        self.record(axis, places, values, series)

    def record(self, axis: Axes, x: ArrayLike, y: ArrayLike, series: str, quantity: str = "") -> None:
        """Remember data that was drawn by other means; ``quantity`` : of y, if not that of the axis."""
        places, values = np.ravel(np.asarray(x, float)), np.ravel(np.asarray(y, float))
        self.curves.append((axis, series, places, values, quantity))

    def data(self, columns: Sequence[str], rows: Sequence[Sequence[Any]]) -> None:
        """A table for the CSV."""
        self.rows = [[without_tex(c) for c in columns], *(list(row) for row in rows)]

    def table(self, columns: Sequence[str], rows: Sequence[Sequence[Any]], *, width: float = style.PAGE) -> None:
        """A table as picture and CSV. Cells are shown as given (strings) or with four digits (numbers)."""
        self.data(columns, rows)
        cells = [[readable(v) for v in row] for row in rows]
        lengths = [max(map(len, column)) + 2 for column in zip(self.rows[0], *cells)]
        with self.figure(width=width, height=0.21 * (len(rows) + 1) + 0.12) as (_, axis):
            axis.axis("off")
            drawn = axis.table(
                cells, colLabels=list(columns), cellLoc="right", colLoc="right", edges="", bbox=[0.0, 0.0, 1.0, 1.0],
                colWidths=[n / sum(lengths) for n in lengths],
            )  # fmt: skip
            drawn.auto_set_font_size(False)
            drawn.set_fontsize(7.5)
            for row in range(len(rows) + 1):
                drawn[row, 0].set_text_props(ha="left")
                drawn[row, 0]._loc = "left"
            for level, thick in ((1.0, 0.9), (1.0 - 1.0 / (len(rows) + 1), 0.5), (0.0, 0.9)):
                axis.plot([0, 1], [level, level], color="black", lw=thick, transform=axis.transAxes, clip_on=False)

    def csv(self) -> str:
        stream = io.StringIO()
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerows([["" if v is None else v for v in row] for row in self.rows])
        if not self.rows:
            writer.writerow(["panel", "series", "x_quantity", "x", "y_quantity", "y"])
        for axis, series, places, values, quantity in self.curves:
            about = (self.panels.get(id(axis), ""), without_tex(series), without_tex(axis.get_xlabel()))
            name = quantity or without_tex(axis.get_ylabel())
            for x, y in zip(places, values):
                if np.isfinite(x) and np.isfinite(y):
                    writer.writerow([*about, f"{x:.9g}", name, f"{y:.9g}"])
        return stream.getvalue()

    def save(self, out: Path, name: str, formats: Sequence[str] = ("png",)) -> list[Path]:
        """Write picture(s), page and ``name.csv``; returns the files, the CSV last.

        Raises ``ValueError`` where nothing was drawn.
        """
        with matplotlib.rc_context(style.RC):
            files = [] if self.figure_ is None else style.save(self.figure_, out, name, formats)
        if self.page:
            files.append(out / f"{name}.md")
            write_atomically(files[-1], self.page)
        if not files:
            raise ValueError(f"{name} draws nothing")
        files.append(out / f"{name}.csv")
        write_atomically(files[-1], self.csv())
        return files


def legend_below(fig: Any, axes: Any, columns: int, **drawn: Any) -> None:
    """One legend under the whole figure, of the axis with the most entries, theory's first."""
    handles, labels = max((axis.get_legend_handles_labels() for axis in np.ravel(axes)), key=lambda pair: len(pair[1]))
    pairs = sorted(zip(handles, labels), key=lambda pair: not pair[1].startswith("theory"))
    place = {"loc": "outside lower center", "ncols": columns}
    fig.legend([p[0] for p in pairs], [p[1] for p in pairs], **place | drawn)


Draw = Callable[[Sheet], None]


@dataclass(frozen=True)
class Item:
    """id : "fig-2.7a", "table-3.1" …; caption : its content, and the difference from the thesis."""

    id: str
    title: str
    caption: str
    module: str
    draw: Draw


ITEMS: dict[str, Item] = {}
"""Every figure and table by its id; filled by the modules of :mod:`bent_beam_programs.thesis.gallery`."""


def item(name: str, *, beside: str = "", **parts: str) -> Callable[[Draw], Draw]:
    """Decorator that registers a drawing function under its number.

    beside : the module whose items the same process draws, for it shares their runs (default: its own).
    The first line of its docstring is the title, the rest the caption, in which {part} stands for a text of ``parts``.
    """

    def register(draw: Draw) -> Draw:
        title, _, caption = (draw.__doc__ or "").partition("\n\n")
        ITEMS[name] = Item(name, title, " ".join(caption.split()).format(**parts), beside or draw.__module__, draw)
        return draw

    return register


def items(module: str, draw: Callable[..., None], rows: Iterable[tuple[Any, ...]]) -> None:
    """Register figures that one function draws: a row is id, title, caption, and what ``draw`` gets after the sheet."""
    for name, title, caption, *given in rows:

        def drawn(sheet: Sheet, given: Sequence[Any] = given) -> None:
            draw(sheet, *given)

        ITEMS[name] = Item(name, title, caption, module, drawn)


def order(name: str) -> tuple[int, int, int, str]:
    """Place of an id in the thesis: chapters, then the appendix, tables after the figures of a chapter, others last."""
    found = re.fullmatch(r"(fig|table)-(\d+|A)\.(\d+)([a-z]?)", name)
    if found is None:
        return (99, 0, 0, name)
    chapter = 50 if found[2] == "A" else int(found[2])
    return (chapter, 1 if found[1] == "table" else 0, int(found[3]), found[4])
