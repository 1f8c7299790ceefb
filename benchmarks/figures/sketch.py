"""The beam at the first touch, with the names of the case file: length, sagitta, velocity, gap.

``python -m benchmarks.figures.sketch`` writes ``sketch.png`` in ``docs/figures``.
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from comparison.figures import style

HEIGHT = 0.42  # of the bow over half of its length: drawn larger than it is
BOTH: dict[str, object] = {"arrowstyle": "<->", "lw": 0.8, "shrinkA": 0.0, "shrinkB": 0.0}
ONE: dict[str, object] = {"arrowstyle": "-|>", "lw": 1.2, "color": style.COLOURS["vermilion"]}


def _measure(
    axis: Axes, begin: tuple[float, float], end: tuple[float, float], text: str, at: tuple[float, float]
) -> None:
    axis.annotate("", end, begin, arrowprops=BOTH)
    axis.text(*at, text, va="center", ha="center")


def draw_sketch(out: Path) -> list[Path]:
    """``sketch``: a bow over a wall, and what its case file calls its sizes."""
    x, beside = np.linspace(-1.0, 1.0, 201), 0.6
    with style.figure(1, 1, width=0.75 * style.PAGE, height=1.9) as (fig, axis):
        axis.fill_between([-1.25, 1.45], -0.07, 0.0, color="0.85", lw=0.0)
        axis.plot([-1.25, 1.45], [0.0, 0.0], color=style.COLOURS["grey"], lw=1.0)
        axis.plot(x, HEIGHT * x**2, color=style.COLOURS["blue"], lw=2.0)
        axis.plot([-1.0, 1.12], [HEIGHT, HEIGHT], color=style.COLOURS["grey"], lw=0.6, ls=":")
        _measure(axis, (-1.0, HEIGHT + 0.09), (1.0, HEIGHT + 0.09), "length $L$", (0.0, HEIGHT + 0.15))
        _measure(axis, (1.07, 0.0), (1.07, HEIGHT), "sagitta\n$KL^2/8$", (1.27, 0.5 * HEIGHT))
        _measure(axis, (-beside, 0.0), (-beside, HEIGHT * beside**2), "gap $g$", (-beside - 0.15, 0.05))
        axis.annotate("", (0.0, 0.05), (0.0, 0.33), arrowprops=ONE)
        axis.text(0.04, 0.27, "velocity $V_0$", va="center")
        axis.text(0.52, 0.04, "curvature $K$", va="center", color=style.COLOURS["blue"])
        axis.text(-1.2, -0.035, "wall", va="center", color="0.3")
        axis.text(0.0, -0.12, "first touch, $x=0$, $t=0$", va="center", ha="center")
        axis.set(xlim=(-1.25, 1.45), ylim=(-0.17, HEIGHT + 0.2))
        axis.set_axis_off()
        return style.save(fig, out, "sketch")


if __name__ == "__main__":
    print(*draw_sketch(Path("docs/figures")))
