"""Do the error bars of a whole beam hold? Beams drawn at random, against runs four times finer by two contact laws.

    make coverage                                    (python -m benchmarks.beams [--rows 60] [--seed N])

A number is what ``bounce`` and ``simulate`` print, with their bars. Its references are the same question on elements
four times smaller, with the contact law that is chosen and with another one; its error is the larger distance from
the two. Every run draws anew and prints its seed. It fails when fewer than 94 % of the numbers lie within their bars,
or 90 % of a stratum, or when one is more than two bars off. Misses stay as case files in ``out/beams``.

The distribution (:func:`draw`), in units of the beam, L/2 = EI = μ = V₀ = 1: κ/ν log-uniform from 0.05 to 3; every
other beam with shear, its length √(EI/κ_sGA) log-uniform from 0.005 to 0.1; the end of the runs from 0.01 to 0.3 T*. In
turn of five strata: a rigid wall; an elastic one, k from 10² to 10⁶ EI/ℓ⁴, every other damped; hinged or clamped ends,
or stops; gravity, gT*/V₀ from 0.03 to 30 to the wall or away from it, or an axial force, a tension of 0.1 to
30 π²EI/L² or half of that which buckles, or a curved wall; light damping. Damping ratios of the first mode from 0.3 to
5 %, of light damping from 0.02 to 0.3 %.
"""

import math
import sys
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.coverage import Coverage, Point, log_uniform, options
from bent_beam.cases import load_case
from bent_beam.errors import SimulationError
from bent_beam.files import write_atomically
from bent_beam.measure.numbers import Number
from bent_beam.method import for_whole_beam, refined
from comparison.bouncing import bounce, whole_reading
from comparison.predicting import instants_reading
from comparison.questions import OF_UNIT, Question
from comparison.simulating import simulate_case
from comparison.whole_numbers import NUMBERS
from comparison.workers import run_all
from hermite_fe.integrators import MoreauJean

STRATA = ("rigid", "wall", "support", "loads", "light")
AT_A_TIME = ("half_contact_length", "impulse", "peak_moment")
OF_THE_WHOLE = ("restitution", "impulse", "last_contact", "peak_moment", "peak_force")
FINER = 4.0
BUCKLING = math.pi**2 / 4.0  # π²EI/L²
LEAST_OF_STRATUM = 0.9


def draw(random: np.random.Generator, stratum: str) -> str:
    """A case file of the distribution above."""
    size = partial(log_uniform, random)
    kappa, tables = size(0.05, 3.0), defaultdict[str, dict[str, Any]](dict)
    ratio = size(2e-4, 3e-3) if stratum == "light" else size(3e-3, 5e-2)
    tables["beam"] |= {"bending_stiffness": 1.0, "mass_per_length": 1.0, "length": 2.0, "curvature": kappa}
    tables["beam"] |= {"damping_ratio": ratio}
    tables["impact"]["velocity"] = 1.0
    if random.random() < 0.5:
        tables["beam"]["shear_stiffness"] = size(0.005, 0.1) ** -2
    if stratum == "wall":
        tables["wall"]["stiffness"] = size(1e2, 1e6)
        tables["wall"] |= {"damping_ratio": size(0.05, 1.0)} if random.random() < 0.5 else {}
    if stratum == "support":
        stop = float(random.uniform(0.0, 0.8))
        tables["beam"] |= {"ends": str(random.choice(["hinged", "clamped"]))} if random.random() < 0.7 else {}
        tables["wall"] |= {} if "ends" in tables["beam"] else {"from": stop, "to": stop}
    if stratum == "loads":
        for name in random.permutation(["gravity", "axial", "curved"])[: random.integers(1, 3)]:
            if name == "gravity":
                tables["impact"]["acceleration"] = size(0.03, 30.0) * float(random.choice([-1.0, 1.0]))
            elif name == "axial":
                tables["beam"]["axial_force"] = BUCKLING * (size(0.1, 30.0) if random.random() < 0.7 else -0.5)
                tables["beam"]["tension_direction"] = str(random.choice(["axis", "tangent"]))
            else:
                tables["wall"]["curvature"] = kappa * float(random.uniform(-0.5, 0.5))
    tables["run"]["end_time"] = size(0.01, 0.3)
    quoted = {name: [f"{key} = {value!r}".replace("'", '"') for key, value in t.items()] for name, t in tables.items()}
    return "\n".join(line for name, lines in quoted.items() for line in (f"[{name}]", *lines)) + "\n"


def printed(file: Path) -> dict[str, Number]:
    """What ``simulate`` and ``bounce`` print of a case, with their bars; of a beam that stays, the first alone."""
    case = load_case(file)
    found = simulate_case(case, "hermite", until=case.end_time).numbers
    numbers = {f"{name} at {case.end_time:.2g}": found[name] for name in AT_A_TIME}
    if not (case.impact.supported or case.impact.wall_in_part):
        whole = bounce(case.impact, case.method("hermite")).numbers
        numbers |= {name: whole[name] for name in OF_THE_WHOLE if name in whole}  # type: ignore[misc]
    return {name: number for name, number in numbers.items() if number.measured}


def references(file: Path) -> list[dict[str, float | None]]:
    """The same numbers from runs :data:`FINER`, by the contact law that is chosen and by another.

    At velocity level a node stays as deep in the wall as the step in which it arrived left it. Where one point touches,
    neighbours on elements so small then push, too: the moment of one point is that of the law at the position alone.
    """
    case = load_case(file)
    impact, end, found = case.impact, float(case.end_time), list[dict[str, float | None]]()
    whole = Question(impact, case.method("hermite"))
    timed, whole = replace(whole, until=end), replace(whole, save=2 * OF_UNIT)  # surer of times than what is judged
    chosen = [for_whole_beam(refined(one.run_by, FINER), impact) for one in (timed, whole)]
    for law in (None, "contact_law"):
        methods = [one if law is None else one.cross_checks(impact).get(law) for one in chosen]
        if None in methods:
            continue
        if law is not None:  # as a companion it takes long steps, which rattle on elements so small
            methods = [replace(one, integrator=one.integrator.refined(4.0)) for one in methods]
        reading = instants_reading((end,), False, timed.run(methods[0]))
        values = {f"{name} at {end:.2g}": reading[name] for name in AT_A_TIME}
        if not (impact.supported or impact.wall_in_part):
            reading = whole_reading(whole.run(methods[1]))
            values |= {name: reading[name] for name in {*OF_THE_WHOLE} & {*NUMBERS, "peak_force"}}
        deep = impact.kappa_over_nu >= 1.0 and isinstance(methods[0].integrator, MoreauJean)
        found.append(values | {name: None for name in values if deep and name.startswith("peak_moment")})
    return found


def points_of(row: int, stratum: str, file: Path) -> list[Point]:
    """The numbers of a case, error and bar over the number itself; none where a run cannot finish."""
    try:
        numbers, values = printed(file), references(file)
    except SimulationError:
        return []
    found = []
    for name, number in numbers.items():
        others = [one[name] for one in values if one[name] is not None]
        unit = max(abs(number.known), 1e-3)
        error = max((abs(number.known - other) for other in others), default=math.inf)
        kappa = load_case(file).impact.kappa_over_nu
        found.append(Point(row, kappa, stratum, name, error / unit, number.spread / unit))
    return found


def main(words: Sequence[str] | None = None) -> int:
    """Draw, simulate, count; 1 when the error bars do not hold."""
    asked = options(__doc__, 60, Path("out/beams"), "of the misses").parse_args(words)
    print(f"seed {asked.seed}", flush=True)
    random = np.random.default_rng(asked.seed)
    rows = [(k, STRATA[k % len(STRATA)], asked.out / f"beam-{k}.toml") for k in range(asked.rows)]
    for _, stratum, file in rows:
        write_atomically(file, draw(random, stratum))
    shown = partial(print, end="\r", file=sys.stderr, flush=True)
    found = run_all(points_of, rows, jobs=asked.jobs, progress=lambda done, _: shown(f"{done} of {len(rows)} beams"))
    lost = sum(not one for one in found) / len(rows)
    every = Coverage.of([p for one in found for p in one], len(rows), lost)
    print(f"all: {every}")
    holds = every.holds
    for stratum in STRATA:
        mine = [p for p in every.points if p.label == stratum]
        share = sum(p.error <= p.bar for p in mine) / max(1, len(mine))
        holds &= share >= LEAST_OF_STRATUM
        print(f"{stratum:8} {share:.1%} of {len(mine)}")
    for p in every.misses:
        print(f"missed: {rows[p.row][2]}: {p.name}, {p.error / p.bar:.2g} bars off, the bar is {p.bar:.2g}")
    for k in {k for k, *_ in rows} - {p.row for p in every.misses}:
        rows[k][2].unlink()
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
