"""A figure that remembers what it shows: every curve drawn through a :class:`Sheet` is also a row block of its CSV.

CSV columns: panel, series, x_quantity, x, y_quantity, y; the quantities are the axis labels, units included.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from comparison.figures import style
from comparison.store import write_atomically

__all__ = ["Sheet", "without_tex"]

TEX = {
    r"\lambda": "λ",
    r"\kappa": "κ",
    r"\nu": "ν",
    r"\tau": "τ",
    r"\xi": "ξ",
    r"\beta": "β",
    r"\eta": "η",
    r"\alpha": "α",
    r"\psi": "ψ",
    r"\chi": "χ",
    r"\varphi": "φ",
    r"\varepsilon": "ε",
    r"\rho": "ρ",
    r"\infty": "∞",
    r"\Delta": "Δ",
    r"\tilde": "~",
    r"\sqrt": "√",
    r"\dot": "dot ",
    r"\,": " ",
    r"\mathrm": "",
    r"\partial": "∂",
    r"\theta": "θ",
    r"\mu": "μ",
}


def without_tex(label: str) -> str:
    """A mathtext label as plain text, for a CSV header."""
    for tex, text in TEX.items():
        label = label.replace(tex, text)
    return re.sub(r"\s+", " ", re.sub(r"[${}\\]", "", label)).strip()


@dataclass
class _Curve:
    axis: Axes
    series: str
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    quantity: str = ""


@dataclass
class _Table:
    columns: Sequence[str]
    rows: Sequence[Sequence[Any]]


@dataclass
class Sheet:
    """One figure (or table) in the making, and its data."""

    figure_: Figure | None = None
    curves: list[_Curve] = field(default_factory=list)
    panels: dict[int, str] = field(default_factory=dict)
    table_: _Table | None = None
    _context: Any = None

    @contextmanager
    def figure(self, rows: int = 1, columns: int = 1, **kwargs: Any) -> Iterator[tuple[Figure, Any]]:
        """``style.figure`` whose figure is kept open for :meth:`save`."""
        self._context = style.figure(rows, columns, **kwargs)
        self.figure_, axes = self._context.__enter__()
        yield self.figure_, axes

    def close(self) -> None:
        if self._context is not None:
            self._context.__exit__(None, None, None)
            self._context = None

    def panel(self, axis: Axes, letter: str, *, text: str = "") -> None:
        """Name an axis (a), (b) …, in the picture and in the CSV."""
        self.panels[id(axis)] = letter
        style.panel_label(axis, f"({letter})")
        if text:
            axis.annotate(
                text,
                (0.0, 1.02),
                xycoords="axes fraction",
                xytext=(17, 0),
                textcoords="offset points",
                ha="left",
                va="bottom",
                fontsize=7.5,
            )

    def line(self, axis: Axes, x: ArrayLike, y: ArrayLike, *, series: str, legend: bool = True, **drawn: Any) -> None:
        """Plot one curve and remember it. ``drawn`` is a style of :mod:`comparison.figures.style` or matplotlib's."""
        places, values = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        drawn = {**drawn, "label": series if legend else "_"}
        axis.plot(places, values, **drawn)
        self.record(axis, places, values, series)

    def record(self, axis: Axes, x: ArrayLike, y: ArrayLike, series: str, quantity: str = "") -> None:
        """Remember data that was drawn by other means; ``quantity`` is what y is, if not what the axis says."""
        places, values = np.ravel(np.asarray(x, float)), np.ravel(np.asarray(y, float))
        self.curves.append(_Curve(axis, series, places, values, quantity))

    def table(self, columns: Sequence[str], rows: Sequence[Sequence[Any]], *, width: float = style.PAGE) -> None:
        """A table as picture and CSV. Cells are shown as given (strings) or with four digits (numbers)."""
        self.table_ = _Table([without_tex(c) for c in columns], rows)
        cells = [[shown(v) for v in row] for row in rows]
        lengths = [max(len(without_tex(columns[i])), *(len(row[i]) for row in cells)) + 2 for i in range(len(columns))]
        height = 0.21 * (len(rows) + 1) + 0.12
        with self.figure(width=width, height=height) as (_, axis):
            axis.axis("off")
            drawn = axis.table(
                cells,
                colLabels=list(columns),
                cellLoc="right",
                colLoc="right",
                edges="",
                bbox=[0.0, 0.0, 1.0, 1.0],
                colWidths=[n / sum(lengths) for n in lengths],
            )
            drawn.auto_set_font_size(False)
            drawn.set_fontsize(7.5)
            for row in range(len(rows) + 1):
                drawn[row, 0].set_text_props(ha="left")
                drawn[row, 0]._loc = "left"
            for level, thick in ((1.0, 0.9), (1.0 - 1.0 / (len(rows) + 1), 0.5), (0.0, 0.9)):
                axis.plot([0, 1], [level, level], color="black", lw=thick, transform=axis.transAxes, clip_on=False)

    def csv(self) -> str:
        """The data as CSV text."""
        stream = io.StringIO()
        writer = csv.writer(stream, lineterminator="\n")
        if self.table_ is not None:
            writer.writerow(self.table_.columns)
            writer.writerows([["" if v is None else v for v in row] for row in self.table_.rows])
            return stream.getvalue()
        writer.writerow(["panel", "series", "x_quantity", "x", "y_quantity", "y"])
        for curve in self.curves:
            about = (self.panels.get(id(curve.axis), ""), without_tex(curve.series))
            names = without_tex(curve.axis.get_xlabel()), curve.quantity or without_tex(curve.axis.get_ylabel())
            for x, y in zip(curve.x, curve.y):
                if np.isfinite(x) and np.isfinite(y):
                    writer.writerow([*about, names[0], f"{x:.9g}", names[1], f"{y:.9g}"])
        return stream.getvalue()

    def save(self, out: Path, name: str, formats: Sequence[str] = ("png",)) -> list[Path]:
        """Write picture(s) and ``name.csv``; returns the files, the CSV last."""
        if self.figure_ is None:
            raise ValueError(f"{name} draws nothing")
        files = style.save(self.figure_, out, name, formats)
        self.close()
        data = out / f"{name}.csv"
        write_atomically(data, self.csv())
        return [*files, data]


def shown(value: Any) -> str:
    """A table cell for a reader."""
    if value is None:
        return "–"
    if isinstance(value, (float, np.floating)):
        text = f"{value:.4g}"
        return f"−{text[1:]}" if text.startswith("-") else text
    return str(value)
