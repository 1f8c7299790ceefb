"""Do the error bars of a whole beam hold? Beams drawn at random, simulated by Hermite elements and by Exudyn.

    make coverage                                    (python -m benchmarks.beams [--rows 20] [--seed N])

Compared at the end of the run: half contact length, impulse and largest moment. A number is covered when the two codes
differ by no more than the root of the sum of squares of their bars. Every run draws anew and prints its seed. It fails
when fewer than 94 % are covered, or when one is more than two bars off. Misses stay as case files in ``out/beams``.

The distribution (:func:`draw`), in units of the beam, L/2 = EI = μ = V₀ = 1: κ/ν log-uniform from 0.05 to 3, the end
from 0.002 to 0.3 T*; three of four with a damping ratio of the first mode from 0.2 to 5 %; every other with gravity,
gT*/V₀ from 0.03 to 30, to the wall or away from it; every third with an axial force, a tension of 0.1 to 30 π²EI/L² or
half of that which buckles, along the axis or the ends' tangents; every fourth before a wall that is curved, by up to
half the bow.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.coverage import Coverage, Point, log_uniform, options
from bent_beam.cases import load_case
from bent_beam.errors import SimulationError
from bent_beam.files import write_atomically
from bent_beam.measure.numbers import Number
from comparison.simulating import simulate_case
from comparison.workers import run_all

__all__ = ["beams", "draw", "numbers"]

PATHS = ("hermite", "exudyn")
NAMES = ("half_contact_length", "impulse", "peak_moment")
BUCKLING = math.pi**2 / 4.0  # π²EI/L²


def draw(random: np.random.Generator) -> str:
    """A case file of the distribution above."""
    size = partial(log_uniform, random)
    kappa = size(0.05, 3.0)
    beam = {"bending_stiffness": 1.0, "mass_per_length": 1.0, "length": 2.0, "curvature": kappa}
    beam["damping_ratio"] = size(2e-3, 5e-2) if random.random() < 0.75 else 0.0
    impact, wall, direction = {"velocity": 1.0}, {}, str(random.choice(["axis", "tangent"]))
    if random.random() < 1.0 / 2.0:
        impact["acceleration"] = size(0.03, 30.0) * float(random.choice([-1.0, 1.0]))
    if random.random() < 1.0 / 3.0:
        beam["axial_force"] = BUCKLING * (size(0.1, 30.0) if random.random() < 0.7 else -0.5)
    if random.random() < 1.0 / 4.0:
        wall["curvature"] = kappa * float(random.uniform(-0.5, 0.5))
    tables = {"beam": beam, "impact": impact, "wall": wall, "run": {"end_time": size(2e-3, 0.3)}}
    lines = []
    for name, table in tables.items():
        lines += [f"[{name}]", *(f"{key} = {value!r}" for key, value in table.items())]
        lines += [f'tension_direction = "{direction}"'] if name == "beam" and "axial_force" in beam else []
    return "\n".join(lines) + "\n"


def numbers(file: Path, path: str) -> dict[str, Number]:
    """What a path says at the end of the run of a case, with its error bars; nothing where it cannot finish."""
    case = load_case(file)
    try:
        found = simulate_case(case, path, until=case.end_time).numbers
    except SimulationError:
        return {}
    return {name: found[name] for name in NAMES}


def beams(files: Sequence[Path], jobs: int = 1) -> Coverage:
    """Coverage of the beams of case files, errors and bars over the larger number of the two codes."""
    found = run_all(numbers, [(file, path) for file in files for path in PATHS], jobs=jobs)
    points = []
    for k, (file, one, other) in enumerate(zip(files, found[::2], found[1::2])):
        for name in NAMES if one and other else ():
            a, b = one[name], other[name]
            unit = max(abs(a.known), abs(b.known)) or 1.0
            error, bar = abs(a.known - b.known) / unit, math.hypot(a.spread, b.spread) / unit
            points.append(Point(k, load_case(file).impact.kappa_over_nu, file.name, name, error, bar))
    return Coverage.of(points, len(files), 1.0 - len(points) / (len(NAMES) * len(files)))


def main(words: Sequence[str] | None = None) -> int:
    """Draw, simulate, count; 1 when the error bars do not hold."""
    asked = options(__doc__, 20, Path("out/beams"), "of the misses").parse_args(words)
    print(f"seed {asked.seed}", flush=True)
    random = np.random.default_rng(asked.seed)
    files = [asked.out / f"beam-{k}.toml" for k in range(asked.rows)]
    for file in files:
        write_atomically(file, draw(random))
    found = beams(files, asked.jobs)
    print(found)
    for p in found.misses:
        print(f"missed: {files[p.row]}: {p.name}, {p.error / p.bar:.2g} bars off, the bar is {p.bar:.2g}")
    for k in set(range(asked.rows)) - {p.row for p in found.misses}:
        files[k].unlink()
    return 0 if found.holds else 1


if __name__ == "__main__":
    sys.exit(main())
