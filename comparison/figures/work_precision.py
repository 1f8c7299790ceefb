"""Work and precision: the errors of r₀, λ₀ (r₁, λ₁) and the lift over the seconds that they took, a line a method.

It answers which integrator and which contact law, at what cost. A point lies at its error against the theory; below the
error bar of the estimate an error means nothing, so the bar is drawn upwards from the point; what is off by more than
all of the number leaves the frame. Where there are many methods the paths have panels of their own, on common axes: a
colour an integrator, a marker a contact.
"""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from comparison.figures import style
from comparison.rows import HELD_AGAINST, MatchRow

SMALLEST = 1e-7  # errors below are drawn here
LARGEST = 1.0  # errors above leave the frame: there is no number
MANY = 7  # methods that one panel can tell apart
MARKERS = "osD^vP*X"


def draw_work_precision(rows: Sequence[MatchRow], out: Path) -> list[Path]:
    """``work-precision.png`` (leading order) and ``work-precision-first-order.png`` of the impacts that at least one
    method was run on at several refinements; returns the files."""
    files = []
    for name, first in (("work-precision", False), ("work-precision-first-order", True)):
        mine = [r for r in rows if r.of_first_order == first and r.reason is None and r.seconds]
        runs = Counter((case, label) for case, label, _ in {(_case(r), r.label, r.refine) for r in mine})
        several = {case for (case, _), count in runs.items() if count > 1}
        mine = [r for r in sorted(mine, key=lambda r: r.refine) if _case(r) in several]
        if mine:
            lost = {r.label for r in rows if r.of_first_order == first} - {r.label for r in mine}
            files += _draw(mine, out, name, first, missing=len(lost))
    return files


def _read(row: MatchRow, what: str) -> tuple[float | None, float | None]:
    """What a panel shows of a row, the lift or the error of a number, and its error bar."""
    if what == "lift":
        return row.lift, None
    number = getattr(row, what)
    off = number.relative(HELD_AGAINST[what])
    return None if off is None else abs(off), number.relative_bar(HELD_AGAINST[what])


def _draw(rows: Sequence[MatchRow], out: Path, name: str, first: bool, missing: int) -> list[Path]:
    order = 1 if first else 0
    panels = {
        f"r{order}": f"error of $r_{order}$",
        f"lambda{order}": rf"error of $\lambda_{order}$",
        "lift": r"lift $/(V_0t)$" + (", no load" if first else ""),
    }
    groups = _groups(rows)
    marks = {label: mark for group in groups for label, mark in _marks(group).items()}
    cases = sorted({_case(r) for r in rows})
    lines = [(case, group) for case in cases for group in groups if any(_case(r) == case for r in group)]
    columns = _columns(groups)
    below = 0.16 * len(columns[0]) + 0.2
    size = {"width": style.PAGE, "height": 1.9 * len(lines) + 0.5 + below}
    with style.figure(len(lines), len(panels), **size, squeeze=False, sharex=True, sharey="col") as (fig, axes):
        for line, (case, group) in enumerate(lines):
            for axis, (what, title) in zip(axes[line], panels.items()):
                for label, mark in marks.items():
                    _line(axis, [r for r in group if r.label == label and _case(r) == case], what, mark)
                axis.set(yscale="log", ylabel=title, xlabel="seconds  (s)" if line == len(lines) - 1 else "")
                axis.set_xscale("log")
                style.decades(axis.xaxis, [r.seconds for r in rows if r.seconds])
            paths = ", ".join(dict.fromkeys(r.path for r in group)) if len(groups) > 1 else ""
            axes[line][0].set_title(_title(case, paths, first), loc="left")
        for axis in axes[0]:
            axis.set_ylim(top=min(axis.get_ylim()[1], LARGEST))
        names = [label for column in columns for label in column]
        looks = [{**marks[label], "ls": "-", "lw": 0.7} if label else {"ls": ""} for label in names]
        handles = [axes[0][0].plot([], [], **look)[0] for look in looks]
        words = f"left out, no number: {missing} method{'s' if missing > 1 else ''} of the table" if missing else None
        sizes = {"fontsize": 6.5, "title_fontsize": 6.5}
        fig.legend(handles, names, loc="outside lower center", ncols=len(columns), title=words, **sizes)
        return style.save(fig, out, name)


def _groups(rows: Sequence[MatchRow]) -> list[list[MatchRow]]:
    """The rows path by path, as many paths together as one panel can tell apart."""
    found: list[list[MatchRow]] = []
    for path in dict.fromkeys(r.path for r in rows):
        mine = [r for r in rows if r.path == path]
        if found and len({r.label for r in (*found[-1], *mine)}) <= MANY:
            found[-1] += mine
        else:
            found.append(mine)
    return found


def _columns(groups: Sequence[Sequence[MatchRow]]) -> list[list[str]]:
    """Labels as columns of a legend, all as long as the first: one for each group, or two of a single one."""
    found = [list(dict.fromkeys(r.label for r in group)) for group in groups]
    if len(found) == 1:
        half = -(-len(found[0]) // 2)
        found = [found[0][:half], found[0][half:]]
    longest = max(map(len, found))
    return [column + [""] * (longest - len(column)) for column in found]


def _case(row: MatchRow) -> tuple[float, tuple[float, ...]]:
    return row.kappa_over_nu, row.first


def _title(case: tuple[float, tuple[float, ...]], path: str, first: bool) -> str:
    kappa, load = case
    words = rf"$\kappa/\nu$ = {kappa:g}"
    if first:
        symbols = r"$\alpha, \psi, \chi$" + (", $N$" if load[3] else "")
        words += rf", ({symbols}) = ({', '.join(f'{v:g}'.replace('-', '−') for v in load[: 4 if load[3] else 3])})"
    return f"{words}, path {path}" if path else words


def _line(axis: Any, rows: Sequence[MatchRow], what: str, mark: dict[str, Any]) -> None:
    """One method over its refinements, in their order, with the error bars upwards."""
    read = [(row.seconds, *_read(row, what)) for row in rows]
    points = [(s, max(v, SMALLEST), max(v + (bar or 0.0), SMALLEST)) for s, v, bar in read if v is not None]
    if not points:
        return
    seconds, values, tops = zip(*points)
    axis.vlines(seconds, values, tops, color=mark["color"], lw=0.5, alpha=0.4)
    axis.plot(seconds, values, **{**mark, "ls": "-", "lw": 0.7})


def _marks(rows: Sequence[MatchRow]) -> dict[str, dict[str, Any]]:
    """Marker and colour by label: few as everywhere; many by contact and integrator, where that tells them apart."""
    labels = list(dict.fromkeys(r.label for r in rows))
    chosen = {r.label: [r.settings.get(name) for name in ("integrator", "contact")] for r in rows}
    parts = {
        label: tuple(str(part.get("kind")) if isinstance(part, dict) else "" for part in both)
        for label, both in chosen.items()
    }
    if len(labels) <= 4 or len(set(parts.values())) < len(labels):
        return style.marks(labels)
    integrators, contacts = (list(dict.fromkeys(p[i] for p in parts.values())) for i in (0, 1))
    return {
        label: {
            **style.OPEN,
            "color": style.SEQUENCE[integrators.index(parts[label][0]) % len(style.SEQUENCE)],
            "marker": MARKERS[contacts.index(parts[label][1]) % len(MARKERS)],
            "label": label,
        }
        for label in labels
    }
