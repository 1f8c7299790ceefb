"""What sound default runs leave of momentum, energy and contact: :mod:`bent_beam.measure.limits`.

    make coverage                                (python -m benchmarks.balances [--runs 60] [--path NAME] [--seed N])

Sixty runs of each path with its defaults, drawn at random: κ/ν log-uniform from 0.05 to 3; half of them, by a coin,
whole damped beams until they have left, of which half shear, by another coin, with shear lengths log-uniform from 0.005
to 0.1 half lengths; the others infinite beams until 0.1 t*, with α and χ of -0.5, 0 or 0.5 each (the self-similar path:
infinite ones alone). A self-similar run that warns of itself, as of a front that left the fine part of the mesh, is not
sound and is left out. Prints the worst of each check and its limit; fails where a run exceeds it, and where fewer than
half of them are left.
"""

import argparse
import sys
import time
from functools import partial

import numpy as np

from benchmarks.coverage import log_uniform
from bent_beam import Impact
from bent_beam.errors import InputError, SimulationError
from bent_beam.measure.balance import Balance, balance_of
from bent_beam.measure.limits import ELSEWHERE, LIMITS, OF_ALL
from bent_beam.method import method_from_tables, simulate_to_separation

PATHS = ("hermite", "self_similar", "exudyn")
FEWEST = 0.5  # of the runs of a path


def judged(path: str, random: np.random.Generator) -> Balance | None:
    """The checks of one run drawn at random; ``None`` where the method refuses it or the front left the mesh."""
    ratio, method = log_uniform(random, 0.05, 3.0), method_from_tables(path, {})
    expands = not hasattr(method, "for_whole_beam")
    if not expands and random.random() < 0.5:
        shear = log_uniform(random, 0.005, 0.1) ** -2 if random.random() < 0.5 else None
        impact = Impact.whole_beam(ratio, relative_damping=log_uniform(random, 1e-3, 1e-2))
        impact = impact.replace(shear_stiffness=shear)
        run = partial(simulate_to_separation, method, impact)
    else:
        size = dict(zip(("alpha", "chi"), 0.5 * random.integers(-1, 2, 2)))
        impact = Impact.dimensionless(ratio, **{f"epsilon_{name}": value for name, value in size.items()})
        run = partial(method.simulate, impact, end_time=0.1, save=100)
    try:
        history = run()
    except (InputError, SimulationError) as error:
        print(f"{path}: {error}", file=sys.stderr)
        return None
    for line in history.warnings:
        print(f"{path}: {line}", file=sys.stderr)
    return None if expands and history.warnings else balance_of(history)


def main() -> int:
    """Draw, simulate, judge; 1 where a run exceeds a limit."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=60, help="of each path")
    parser.add_argument("--path", choices=PATHS, help="this one alone")
    parser.add_argument("--seed", type=int, default=time.time_ns() % 2**31, help="the clock's unless given")
    asked = parser.parse_args()
    print(f"seed {asked.seed}", flush=True)
    exceeded = False
    for path in [asked.path] if asked.path else PATHS:
        random = np.random.default_rng(asked.seed)
        found = [one for one in (judged(path, random) for _ in range(asked.runs)) if one is not None]
        print(f"{path}: {len(found)} sound runs of {asked.runs}", flush=True)
        exceeded |= len(found) < FEWEST * asked.runs
        for kind in sorted({one.path for one in found}):
            for name, limit in (OF_ALL | LIMITS.get(kind, ELSEWHERE)).items():
                values = [value for one in found if one.path == kind and (value := getattr(one, name)) is not None]
                worst = max(map(abs, values), default=0.0)
                exceeded |= worst > limit
                of = f"worst of {len(values):2} runs {worst:8.2g}   limit {limit:8.2g}"
                print(f"{kind:14} {name:13} {of}", flush=True)
    return int(exceeded)


if __name__ == "__main__":
    sys.exit(main())
