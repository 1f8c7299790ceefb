"""A cantilever of ANCF cables under a tip load, statics: w = PL³/(3EI), slope PL²/(2EI) for small deflections.

python exudyn_models/scripts/cantilever.py [--elements 8] [--load 1e-3] [--out FILE] [--view]
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from exudyn_models.scripts.static_cable import EI, LENGTH, draw, parser, print_rows, solved


def main(arguments: Sequence[str] | None = None) -> None:
    options = parser(__doc__, "cantilever.png")
    chosen = options.parse_args(arguments)
    n, load = chosen.elements, chosen.load
    if n < 1 or not np.isfinite(load) or load == 0.0:
        options.error(f"--elements must be at least 1 and --load a number other than 0 (got {n} and {load:g})")
    clamp = [(0, 0), (0, 1), (0, 3)]  # x, y and the slope; the fourth coordinate, the stretch, stays free
    q, _ = solved(n, clamp, n, load, chosen.view)
    print_rows(
        [
            ("tip deflection", q[-1, 1], load * LENGTH**3 / (3 * EI)),
            ("tip slope", q[-1, 3], load * LENGTH**2 / (2 * EI)),
        ]
    )
    x = np.linspace(0, LENGTH, 200)
    exact = load * x**2 * (3 * LENGTH - x) / (6 * EI)
    draw(q, exact, f"cantilever, tip load {load:g} N", chosen.out)


if __name__ == "__main__":
    main()
