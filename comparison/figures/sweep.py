"""A sweep as a picture: over one key curves with error bars, over two a map with contours and a line where the material
yields. Both in units that a reader writes."""

from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator
from scipy.interpolate import PchipInterpolator

from bent_beam.measure.numbers import MISSING
from comparison.figures import style
from comparison.readable import readable, unit_for, with_bar
from comparison.sweeping import SweepTable, numeric
from comparison.whole_numbers import WHOLE

SHOWN = ("peak_stress", "peak_moment", "peak_force", "restitution", "impulse")
"""Numbers that are drawn where there are any, in this order; the moment only without a stress."""
CURVES, MAPS = 3, 2  # panels
OF_A_MAP = 3  # values of a key of a map
FEWEST, LEVELS = 2, 8  # parts of a map between contours
FINE = 60  # places a key between which a map's lines are straight
LOUD = 0.1  # of the value: larger bars are marked on a map


def sweep_figure(found: SweepTable) -> Any:
    """Largest stress (or moment), largest force and restitution over the keys, as a Matplotlib figure. Raises
    ``ValueError`` for more than two keys, and where no row has a number."""
    if len(found.vary) > 2:
        raise ValueError(f"vary: one or two keys can be drawn (got {len(found.vary)}); take .table or .to_dataset()")
    shown = [name for name in SHOWN if any(_values(found, name))]
    shown = [name for name in shown if name != "peak_moment" or "peak_stress" not in shown]
    if not shown:
        raise ValueError("no row has a number to be drawn")
    mapped = len(found.vary) == 2 and all(numeric(v) and len(v) >= OF_A_MAP for v in found.vary.values())
    shown = shown[: MAPS if mapped else CURVES]
    size = {"width": style.PAGE, "height": 3.4 if mapped else 2.8, "sharex": mapped, "sharey": mapped}
    with style.figure(1, len(shown), squeeze=False, **size) as (fig, axes):
        for axis, name in zip(axes[0], shown):
            (_map if mapped else _curves)(axis, found, name)
        style.label_panels(*axes[0])
        fig.suptitle(found.title or "Sweep", fontsize=9.0)
        handles, names = axes[0, 0].get_legend_handles_labels()
        note, sizes = _note(found, shown if mapped else []), {"fontsize": 7.0, "title_fontsize": 7.0}
        fig.legend(handles, names, loc="outside lower center", ncols=4, title=note, **sizes)
        return fig


def _values(found: SweepTable, name: str) -> list[tuple[float, float] | None]:
    """Value and bar of each row, or mean and standard deviation; ``None`` where it has none."""
    pairs = (with_bar(row.numbers.get(name, MISSING)) for row in found.rows)
    return [None if value is None else (value, bar) for value, bar in pairs]


def _grid(found: SweepTable, name: str) -> tuple[Any, Any, str]:
    """Values and bars over the keys, NaN where there is none, and the title of their axis with its unit."""
    pairs = _values(found, name)
    scale, unit = unit_for(WHOLE[name].unit, [pair[0] for pair in pairs if pair])
    shape = [len(values) for values in found.vary.values()]
    array = scale * np.array([pair or (np.nan, np.nan) for pair in pairs]).reshape(*shape, 2)
    return array[..., 0], array[..., 1], _with_unit(WHOLE[name].heading, unit)


def _with_unit(words: str, unit: str) -> str:
    return f"{words}  ({unit})" if unit else words


def _axis_of(found: SweepTable, key: str) -> tuple[Any, str]:
    """Places of the values of a key on an axis, and its title."""
    values, name = found.vary[key], key.rpartition(".")[2].replace("_", " ")
    if not numeric(values):
        return np.arange(len(values)), name
    return np.array(values, float), _with_unit(name, found.units[key])


def _curves(axis: Any, found: SweepTable, name: str) -> None:
    """Over the key with more values, a curve for each value of the other."""
    keys = sorted(found.vary, key=lambda key: (not numeric(found.vary[key]), -len(found.vary[key])))
    values, bars, title = _grid(found, name)
    if len(keys) == 2 and keys[0] != next(iter(found.vary)):
        values, bars = values.T, bars.T
    values, bars = values.reshape(values.shape[0], -1), bars.reshape(bars.shape[0], -1)
    x, label = _axis_of(found, keys[0])
    joined = numeric(found.vary[keys[0]])
    order = np.argsort(x)
    for i in range(values.shape[1]):
        colour = style.SEQUENCE[i % len(style.SEQUENCE)]
        look = {"color": colour, "marker": "o", "ms": 3.0, "mfc": "white", "ls": "-" if joined else ""}
        if len(keys) == 2:
            unit = found.units[keys[1]]
            look["label"] = f"{keys[1].rpartition('.')[2]} = {readable(found.vary[keys[1]][i])} {unit}".rstrip()
        style.bars(axis, x[order], values[order, i], bars[order, i], look)
    highest = float(np.nanmax(values + bars))
    axis.set(xlabel=label, ylabel=title, ylim=(min(0.0, 1.08 * float(np.nanmin(values - bars))), 1.08 * highest))
    if (limit := _yield_stress(found, name)) is not None:
        style.yield_line(axis, 1e-6 * limit, highest)
    if not joined:
        axis.set_xticks(x, [str(value) for value in found.vary[keys[0]]])


def _yield_stress(found: SweepTable, name: str) -> float | None:
    """Of the material, where stresses are drawn and it is one for all rows."""
    limits = {row.yield_stress for row in found.rows if row.numbers}
    return limits.pop() if name == "peak_stress" and len(limits) == 1 else None


def _map(axis: Any, found: SweepTable, name: str) -> None:
    """Colours and contours over two keys; a dot a row, a cross where it has no number, a ring where its bar is wide."""
    across, up = found.vary
    (x, label), (y, other) = _axis_of(found, across), _axis_of(found, up)
    order_x, order_y = np.argsort(x), np.argsort(y)
    values, bars, title = _grid(found, name)
    x, y, z, bars = x[order_x], y[order_y], values[order_x][:, order_y].T, bars[order_x][:, order_y].T
    shown = np.ma.masked_invalid(z)
    if shown.count() and shown.max() > shown.min():
        smooth = _between(x, y, shown)
        low, high = float(shown.min()), float(shown.max())
        # No finer than the bars are in general: the few rows whose bars are wider have a ring.
        bar = float(np.median(bars[bars > 0.0])) if (bars > 0.0).any() else 1e-300
        parts = np.clip((high - low) / bar, FEWEST, LEVELS)
        levels = MaxNLocator(int(parts), min_n_ticks=1).tick_values(low, high)
        field = axis.contourf(*smooth, levels, cmap="YlGnBu", alpha=0.8)
        lines = axis.contour(*smooth, levels, colors="black", linewidths=0.4)
        for text in axis.clabel(lines, fontsize=6.5, fmt="%g"):
            text.set_clip_on(False)  # one at the edge is whole
        axis.figure.colorbar(field, ax=axis)
        if (limit := _yield_stress(found, name)) is not None and shown.min() < 1e-6 * limit < shown.max():
            axis.contour(*smooth, [1e-6 * limit], colors=style.COLOURS["vermilion"], linewidths=1.8)
    every = np.stack(np.meshgrid(x, y), axis=-1)
    loud = bars > LOUD * np.abs(z)
    for which, look in ((~np.isnan(z), {"marker": ".", "ms": 2.0}), (np.isnan(z), {"marker": "x", "ms": 4.0}),
                        (loud, {"marker": "o", "ms": 6.0, "mfc": "none", "mew": 0.7})):  # fmt: skip
        if which.any():  # the layout takes a curve without points to be in the corner
            axis.plot(*every[which].T, ls="", color=style.COLOURS["black"], clip_on=False, **look)
    axis.set(xlabel=label, ylabel=other if axis.get_subplotspec().is_first_col() else "", title=title)
    axis.grid(False)


def _between(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    """The rows and what is between them, by cubics that nowhere overshoot; where some are missing, as they are."""
    known = ~z.mask & np.ones(z.shape, bool)
    x, y, z = x[known.any(axis=0)], y[known.any(axis=1)], z[known.any(axis=1)][:, known.any(axis=0)]
    if np.ma.is_masked(z) or min(z.shape) < 2:
        return x, y, z
    fine = [np.unique(np.concatenate([v, np.linspace(v[0], v[-1], FINE)])) for v in (x, y)]
    return *fine, PchipInterpolator(y, PchipInterpolator(x, z, axis=1)(fine[0]), axis=0)(fine[1])


def _note(found: SweepTable, mapped: list[str]) -> str:
    """What the marks mean; of maps, how wide the bars of the numbers ``mapped`` are, which they cannot show."""
    lost = sum(1 for row in found.rows if not row.numbers)
    missing = f" {lost} of {len(found.rows)} rows have no number." if lost else ""
    if not mapped:
        return f"Bars: error bars.{missing}"
    wide = "; ".join(_bars_of(found, name) for name in mapped)
    line = ""
    for limit in filter(None, (_yield_stress(found, name) for name in mapped)):
        highest = max(pair[0] for pair in _values(found, "peak_stress") if pair)
        where = "Red line: the material yields" if highest > limit else "Nowhere does the material yield"
        line = f" {where}, {1e-6 * limit:.4g} MPa."
    marks = f"Dots: rows, interpolated between; rings: bar above {100 * LOUD:g} % of the value."
    return f"Error bars: {wide}.\n{marks}{line}{missing}"


def _bars_of(found: SweepTable, name: str) -> str:
    """The bars of a number in a few words, in the unit of its map, of the rows that have one."""
    pairs = [pair for pair in _values(found, name) if pair]
    scale, unit = unit_for(WHOLE[name].unit, [value for value, _ in pairs])
    bars = [scale * bar for _, bar in pairs if bar]
    if not bars:
        return f"{WHOLE[name].heading}: no bar"
    middle, widest = (f"{readable(size(bars), 2)} {unit}".rstrip() for size in (np.median, np.max))
    return f"{WHOLE[name].heading} ± {middle} (median), at most ± {widest}"
