"""A simply supported beam under a load in its middle, statics: w = PL³/(48EI), moment PL/4, slope PL²/(16EI) at the
ends.

Both ends turn freely (the thesis's Figs 3.2–3.3, which call it fixed at both ends, show this beam).
python exudyn_models/scripts/simply_supported_beam.py [--elements 8] [--load 1e-3] [--out FILE] [--view]
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from exudyn_models.scripts.static_cable import EI, LENGTH, draw, parser, print_rows, solved


def main(arguments: Sequence[str] | None = None) -> None:
    options = parser(__doc__, "simply_supported_beam.png")
    chosen = options.parse_args(arguments)
    n, load = chosen.elements, chosen.load
    if n < 2 or n % 2:
        options.error(f"--elements must be even, so that a node is under the load (got {n})")
    if not np.isfinite(load) or load == 0.0:
        options.error(f"--load must be a number other than 0 (got {load:g})")
    hinge_and_roller = [(0, 0), (0, 1), (n, 1)]
    q, moment = solved(n, hinge_and_roller, n // 2, load, chosen.view)
    print_rows(
        [
            ("deflection in the middle", q[n // 2, 1], load * LENGTH**3 / (48 * EI)),
            ("slope at the end", q[0, 3], load * LENGTH**2 / (16 * EI)),
            ("moment in the middle", moment, abs(load) * LENGTH / 4),
        ]
    )
    x = np.linspace(0, LENGTH, 200)
    folded = np.minimum(x, LENGTH - x)
    exact = load * folded * (3 * LENGTH**2 - 4 * folded**2) / (48 * EI)
    draw(q, exact, f"simply supported beam, {load:g} N in its middle", chosen.out)


if __name__ == "__main__":
    main()
