"""Panels of one run in the units of its case: m along the beam, ms, kN, MPa. The wall is below in all of them; heights
are drawn to a scale that is said; a largest value is marked where and when it is, and where the material yields;
nothing is cut off."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.collections import PolyCollection

from bent_beam import Impact, ImpactHistory
from bent_beam.free_flight import acting
from bent_beam.history import Array
from bent_beam.measure.reduction import wall_peaks
from bent_beam.measure.whole_impact import WINDOW
from comparison.figures import style
from comparison.readable import milliseconds, unit_for

Panel = Callable[[Any, ImpactHistory, float], None]  # draws a run on an axis, until a time, s
WINDOWS, FEWEST = 160, 40  # of the force: on a wall that gives way; on a rigid one, else they are ten times shorter
SHAPES = 7
NICE = (1.0, 2.0, 3.0, 5.0)
WALL = "#D8D8D8"
FRONT, BACK = style.COLOURS["vermilion"], style.COLOURS["purple"]  # which wall pushes


def sheet(
    history: ImpactHistory, title: str, end: float, *, force: str = "", stress: str = "",
    yield_stress: float | None = None, reach: float | None = None, below: Sequence[Panel] = (),
) -> Any:  # fmt: skip
    """Force, largest stress and place of the pushes over time, and the beam above its wall, as a Matplotlib figure.

    end : s, of the axes. force, stress : words at the largest ones. reach : see :func:`draw_shapes`.
    below : two panels more, one under each column.
    """
    rows = 4 if below else 3
    with style.figure(rows, 2, width=style.PAGE, height=0.1 + 1.75 * rows, width_ratios=[1.25, 1.0]) as (fig, axes):
        push, largest, zone, *last = axes[:, 0]
        for axis in axes[:3, 1]:
            axis.remove()
        shapes = fig.add_subplot(push.get_gridspec()[:3, 1])
        draw_force(push, history, end, force)
        draw_stress(largest, history, end, stress, yield_stress)
        draw_zone(zone, history, end)
        more = [*last, axes[3, 1]] if below else []
        for axis, draw in zip(more, below, strict=True):
            draw(axis, history, end)
        for axis in axes[:-1, 0]:
            axis.set_xlabel("")
            axis.tick_params(labelbottom=False)
        style.label_panels(push, largest, zone, shapes, *more)
        fig.suptitle(f"{title}, path {history.path}", fontsize=9.0)
        draw_shapes(shapes, history, end, reach)
        return fig


def _force(history: ImpactHistory, end: float) -> tuple[Array, Array]:
    """Edges of windows in time, s, and the walls' mean force in each, N; a second wall's is negative. On a
    rigid wall the windows are those of the largest push, whatever the end."""
    window = WINDOW * history.impact.slow_time_scale
    while end < FEWEST * window:
        window /= 10.0
    if "peak_force" in history:
        window = end / WINDOWS
    edges: Array = window * np.arange(round(end / window) + 1, dtype=np.float64)
    return edges, np.diff(history.impulse_at(edges)) / np.diff(edges)


def draw_force(axis: Any, history: ImpactHistory, end: float, words: str = "") -> None:
    """Mean force of the wall in windows of time; of a wall that gives way the largest is marked by ``words``."""
    edges, force = _force(history, end)
    peaks = wall_peaks(history, end)
    largest = 0.0 if peaks is None else peaks.force if peaks.wall == "front" else -peaks.force
    low, top = min(float(force.min()), largest), max(float(force.max()), largest)
    scale, unit = unit_for("N", [low, top])
    axis.stairs(scale * force, 1e3 * edges, fill=True, color=style.COLOURS["sky"], lw=0.0)
    axis.stairs(scale * force, 1e3 * edges, color=style.COLOURS["blue"], lw=0.8)
    axis.set(ylabel=f"force of the wall  ({unit})", xlim=(0.0, 1e3 * end))
    axis.set_ylim(scale * min(0.0, 1.15 * low), scale * 1.3 * top)
    second = "; second wall negative" if history.impact.opposite_wall is not None else ""
    rigid = "" if peaks else "; rigid: no peak force" if second else "; a rigid wall has no peak force"
    window = f"mean over {milliseconds(edges[1])}{second}{rigid}"
    axis.text(1.0, 1.03, window, transform=axis.transAxes, ha="right", va="bottom", fontsize=6.5)
    if peaks is not None and largest:
        last = int(np.searchsorted(history.time, end, side="right")) - 1
        rising = peaks.time > history.time[max(last - 1, 0)]  # since the instant before; its time is amid a step
        _mark(axis, peaks.time, scale * largest, words or f"largest {scale * peaks.force:.4g} {unit}", rising)


def draw_stress(axis: Any, history: ImpactHistory, end: float, words: str, yield_stress: float | None) -> None:
    """Largest stress along the beam, without a section the moment, over time; the largest is marked by ``words``."""
    stress, inside = history.stress, history.time <= end
    values, what, si = (history.moment, "moment", "N m") if stress is None else (stress, "stress", "Pa")
    time, values = history.time[inside], values[inside]
    scale, unit = unit_for(si, values)
    axis.plot(1e3 * time[1:], scale * values[1:], drawstyle="steps-pre", color=style.COLOURS["blue"], lw=0.8)
    top = scale * float(values.max())
    axis.set(ylabel=f"largest {what}  ({unit})", xlim=(0.0, 1e3 * end), ylim=(0.0, 1.3 * top))
    if yield_stress is not None and stress is not None:
        style.yield_line(axis, scale * yield_stress, top)
    k = int(np.argmax(values))
    words = words or f"largest {scale * values[k]:.4g} {unit}"
    _mark(axis, float(time[k]), scale * float(values[k]), words, k == values.size - 1 > 0)


def _mark(axis: Any, time: float, value: float, words: str, rising: bool) -> None:
    """A point and what it says, on the side where there is room. rising : it is the largest only because the drawing
    ends, which is said."""
    left = time < 0.5e-3 * axis.get_xlim()[1]
    words += ", still rising" if rising else ""
    axis.plot([1e3 * time], [value], marker="o", ms=4.0, mfc="white", color="black", ls="", zorder=5, clip_on=False)
    axis.annotate(words, (1e3 * time, value), (5 if left else -5, 4), textcoords="offset points", fontsize=7.0,
                  ha="left" if left else "right", va="bottom")  # fmt: skip


def contacts(history: ImpactHistory, name: str = "impulse") -> tuple[Array, Array]:
    """Times, s, and places, m, at which a wall pushed, on both halves."""
    k, j = np.nonzero(acting(history.array(name)))
    time = 0.5 * (history.time[:-1] + history.time[1:])[k]
    places = np.array([history.contact_positions(int(i))[m] for i, m in zip(k, j)]) if k.size else np.zeros(0)
    if history.sides == 1:
        time, places = np.concatenate([time, time]), np.concatenate([places, -places])
    return time, places


def _shares(places: Array, nodes: Array) -> tuple[Array, Array]:
    """Lower and upper ends, m, of the shares of the beam that contact points at ``places`` stand for: as far as halfway
    to the neighbours, of those outside half a distance out."""
    apart = np.diff(places)
    if apart.size:
        nearest = np.minimum(np.append(apart, np.inf), np.insert(apart, 0, np.inf))
    else:
        nearest = np.diff(nodes).min(keepdims=True)  # a point without neighbours
    halfway = 0.5 * (places[:-1] + places[1:])
    # No farther than the nearest neighbour is, so that a gap between two walls stays one; of a mesh that becomes
    # coarser, where one distance is at most twice the one before, the shares still meet.
    low = np.append(places[0] - 0.5 * nearest[0], np.maximum(halfway, places[1:] - nearest[1:]))
    high = np.append(np.minimum(halfway, places[:-1] + nearest[:-1]), places[-1] + 0.5 * nearest[-1])
    return low.clip(nodes[0], nodes[-1]), high.clip(nodes[0], nodes[-1])


def _pushed(history: ImpactHistory, name: str, end: float) -> Array:
    """Rectangles of time, ms, and place, m, in which a wall pushed until ``end``, s: each pushing contact point with
    its share of the beam. Shape (rectangles, 4 corners, 2)."""
    time, found = 1e3 * history.time, []
    pushing = acting(history.array(name))
    for k in np.flatnonzero(pushing.any(axis=1) & (history.time[:-1] <= end)):
        low, high = _shares(history.contact_positions(int(k)), history.positions(int(k)))
        low, high = low[pushing[k]], high[pushing[k]]
        for bottom, top in zip(np.setdiff1d(low, high), np.setdiff1d(high, low)):  # neighbours are one
            found.append((time[k], time[k + 1], bottom, top))
            if history.sides == 1:
                found.append((time[k], time[k + 1], -top, -bottom))
    return np.array([[(t, y), (u, y), (u, z), (t, z)] for t, u, y, z in found]).reshape(-1, 4, 2)


def draw_zone(axis: Any, history: ImpactHistory, end: float) -> None:
    """Where the wall pushes, over time; as far out as it does. Where the middle alone pushes, the axis is that of
    the whole beam."""
    reach = 0.0
    for name, colour, label in (("impulse", FRONT, "wall"), ("opposite_impulse", BACK, "second wall")):
        if name not in history:
            continue
        time, place = contacts(history, name)
        parts = _pushed(history, name, end)
        zone = PolyCollection(list(parts), color=colour, lw=1.0, label=label, rasterized=True)  # lw: thin ones are seen
        axis.add_collection(zone)
        if place[time <= end].any():
            reach = max(reach, float(np.abs(parts[..., 1]).max()))
    edge = 1.15 * reach or 0.5 * history.impact.length
    axis.set(xlim=(0.0, 1e3 * end), ylim=(-edge, edge), xlabel="time  (ms)", ylabel="pushes at $x$  (m)")
    if "opposite_impulse" in history:
        axis.legend(loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2, borderpad=0.0)


def _far_wall(impact: Impact) -> float:
    """Height of a second wall above the first, m; 0 without one."""
    return 0.0 if impact.opposite_wall is None else impact.opposite_wall + impact.wall_clearance


def heights(history: ImpactHistory, k: int) -> tuple[Array, Array]:
    """x and the height above the wall, m, of the whole beam at a saved instant."""
    x, gap = history.positions(k), history.array("gap", k)
    if history.sides == 1:
        x, gap = np.concatenate([-x[:0:-1], x]), np.concatenate([gap[:0:-1], gap])
    return x, gap


def draw_wall(
    axis: Any, history: ImpactHistory, base: float, depth: float, scale: float = 1.0, reach: float | None = None
) -> None:
    """The wall, or both, with a stripe of ``depth`` behind, under a beam drawn from ``base`` on; m times ``scale``."""
    impact, grey, away = history.impact, style.COLOURS["grey"], _far_wall(history.impact)
    half = min(reach or np.inf, 0.5 * impact.length)
    edges = (impact.wall_from, -half), (impact.wall_to, half)
    span = [edge if given is None else min(max(given, -half), half) for given, edge in edges]
    if span[0] == span[1]:
        axis.plot(span[:1], [scale * base], marker="^", color=grey, ms=5.0, ls="")
        return
    for face, behind in ((0.0, -depth), *([(away, away + depth)] if away else [])):
        axis.fill_between(span, scale * (base + face), scale * (base + behind), color=WALL, lw=0.0)
        axis.plot(span, [scale * (base + face)] * 2, color=grey, lw=0.7)


def impulse_given(history: ImpactHistory) -> Array:
    """By all walls so far, N s, none taken off another's."""
    names = [name for name in ("impulse", "opposite_impulse") if name in history]
    return np.asarray(sum(history.array(name).sum(axis=1) for name in names))


def _telling(history: ImpactHistory, end: float) -> Array:
    """Times, s, that share out both the time until ``end`` and the impulse given by then: more where more happens."""
    inside = history.time <= end
    time, given = history.time[inside], np.maximum.accumulate(impulse_given(history)[inside])
    told = time / time[-1] + given / (float(given[-1]) or 1.0)
    return np.interp(np.linspace(0.0, told[-1], SHAPES), told, time)


def draw_shapes(axis: Any, history: ImpactHistory, end: float, reach: float | None) -> None:
    """The beam above its wall at :func:`_telling` times until ``end``, s, the first on top: to scale along, heights by
    a factor that is said. reach : half width that is shown, m; ``None``: the whole beam.

    Lays the figure out, so that everything else must be on it.
    """
    edge = min(reach or np.inf, 0.5 * history.impact.length)
    shown = []
    for t in _telling(history, end):
        x, height = heights(history, int(np.argmin(np.abs(history.time - t))))
        shown.append((t, x[np.abs(x) <= 1.001 * edge], height[np.abs(x) <= 1.001 * edge]))
    tallest = max(*(float(height.max()) for _, _, height in shown), _far_wall(history.impact), 1e-12)
    lowest = min(*(float(height.min()) for _, _, height in shown), 0.0)
    axis.set(xlim=(-1.04 * edge, 1.4 * edge), xlabel="$x$  (m)", yticks=[])
    axis.set_xticks([tick for tick in axis.get_xticks() if abs(tick) <= 1.001 * edge])
    axis.grid(False)
    axis.spines["left"].set_visible(False)
    axis.spines["bottom"].set_bounds(-edge, edge)
    axis.set_title("heights × 1", loc="right", fontsize=7.5)
    axis.figure.draw_without_rendering()
    box = axis.get_window_extent()
    high = box.height / box.width * 2.44 * edge  # of the axis, m, if heights were to scale
    most = high / (1.4 * len(shown) * (tallest - lowest))
    power = 10.0 ** np.floor(np.log10(most))
    factor = power * max(nice for nice in NICE if nice * power <= most * (1.0 + 1e-9))
    room = high / factor / len(shown)
    for number, (t, x, height) in enumerate(shown):
        base = (len(shown) - 1 - number) * room + 0.18 * room
        draw_wall(axis, history, base, 0.07 * room, reach=edge)
        axis.plot(x, base + height, color=style.COLOURS["blue"], lw=1.3)
        axis.text(1.04 * edge, base, milliseconds(t), va="center", fontsize=7.0)
    axis.set_ylim(0.0, high / factor)
    axis.set_title(f"heights × {factor:,.6g}", loc="right", fontsize=7.5)
