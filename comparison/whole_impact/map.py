"""The map of the whole impact: every number over κ/ν and η/T*, with error bars, stored with where it comes from.

``python -m comparison.whole_impact.map`` measures it (on two cores, in under ten minutes) and writes ``map.json``
beside this module, with the time that it took; interrupted, it goes on where it was when asked again, and says so.
:mod:`.stored_map` interpolates. A free–free beam has no other groups as long as it flies without loads: ε drops
out, because the problem is homogeneous of degree one in the deflection.

Every point is what :func:`comparison.bounce.bounce` says with the Hermite path's elements and law for the whole beam
and steps h = Δx²√(μ/EI), with its error bars from elements, steps and contact law; below κ/ν = :data:`FLAT`, where a
flat bow lands element by element, elements are half as long. The last column is that of ∞: the midspan moment stays
below κ, so the beam touches in one point throughout, whatever κ is from there on. Without damping the map holds bands
of :data:`comparison.bounce.RUNS` runs. :data:`OTHERS` are measured by another path, with its own bars.
"""

from __future__ import annotations

import argparse
import dataclasses
import random
import sys
import time as clock
from collections.abc import Sequence
from itertools import chain, islice
from pathlib import Path
from typing import Any, NamedTuple

from bent_beam.measure.measured import Band, Measured
from bent_beam.measure.whole_impact import SHORTEST_SEPARATION
from bent_beam.method import for_whole_beam, method_from_tables
from comparison import stored
from comparison.bounce import RUNS, SEED, bounce, problem
from comparison.store import RunStore, default_store
from comparison.whole_impact.stored_map import DATA, POINT
from comparison.workers import run_all

__all__ = ["DAMPINGS", "KAPPAS", "Point", "grid", "measure_point"]

KAPPAS = (
    *(0.05, 0.07, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5),
    *(0.6, 0.7, 0.75, 0.8, 0.9, 1.0, 1.1, 1.2, 1.35, 1.5, 1.75, 2.0, POINT),
)
DAMPINGS = (1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1)
BANDS = (0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5)
PATH, OTHER = "hermite", "exudyn"
PACKAGES = ("bent_beam", "hermite_fe", "exudyn_models")
OTHERS = tuple((kappa, damping) for damping in (1e-3, 1e-2) for kappa in (0.4, 0.7, 1.5, POINT))
FLAT, FINER = 0.35, 2.0  # below this κ/ν elements so many times shorter
LONGER = 2.0  # steps than a single bounce takes: half of the work, and e moves by less than by half of the elements
COARSER = 0.5  # of the other path
ELEMENT = 0.01  # of the half length: the longest of the map
SAVED = 2000


class Point(NamedTuple):
    """One point to measure. refine : elements so many times shorter than the path's own choice for the whole beam;
    longer : steps so many times longer than those that go with these elements."""

    path: str
    kappa_over_nu: float
    damping: float
    refine: float = 1.0
    longer: float = 1.0

    def method(self) -> Any:
        """What measures it."""
        impact = problem(self.kappa_over_nu, self.damping)
        made = method_from_tables(self.path, {"refine": self.refine})
        if self.longer == 1.0:
            return made
        chosen = for_whole_beam(made, impact)
        return dataclasses.replace(chosen, integrator=chosen.integrator.refined(1.0 / self.longer))


def grid(kappas: Sequence[float] = KAPPAS, dampings: Sequence[float] = DAMPINGS) -> list[Point]:
    """The map's points, in the order of ``dampings``, ``kappas``."""
    return [Point(PATH, kappa, eta, FINER if kappa < FLAT else 1.0, LONGER) for eta in dampings for kappa in kappas]


def measure_point(point: Point) -> dict[str, Any]:
    """One point of the map: number → [value, error bar], and what it took."""
    found = bounce(problem(point.kappa_over_nu, point.damping), point.method(), save=SAVED)
    asked = {**point._asdict(), "left": found.left, "seconds": found.seconds}
    if point.damping == 0.0:
        bands = {name: [number.mean, number.std] for name, number in found.numbers.items() if isinstance(number, Band)}
        return {**asked, "runs": RUNS, "seed": SEED, "band": bands}
    numbers = {name: [n.value, n.error] for name, n in found.numbers.items() if isinstance(n, Measured)}
    return {
        **asked,
        "numbers": numbers,
        "energy_defect": found.outcome.energy_defect,
        "energy_gain": found.outcome.energy_gain,
        "steps": found.history.steps,
        "settings": found.settings,
    }


def _question(point: Point) -> dict[str, Any]:
    return {"whole impact": point._asdict(), "saved": SAVED}


def _kept_point(store: RunStore, point: Point) -> dict[str, Any]:
    return store.answer(_question(point), lambda: measure_point(point))


def write_map(
    rows: Sequence[dict[str, Any]],
    bands: Sequence[dict[str, Any]],
    others: Sequence[dict[str, Any]],
    run: dict[str, Any],
) -> Path:
    """Write ``map.json``. bands : of the undamped beam; others : points of another path, to draw on the map; run : what
    the command took, see :func:`_main`."""
    return stored.write(
        DATA,
        "the whole impact of a free-free bent beam, units L/2 = EI = mu = V0 = 1: number -> [value, error bar]",
        "python -m comparison.whole_impact.map",
        PACKAGES,
        {
            **rows[-1]["settings"],
            "finer": {"kappa_over_nu_below": FLAT, "refine": FINER},
            "shortest_separation": SHORTEST_SEPARATION,
        },
        {
            "kappa_over_nu": sorted({row["kappa_over_nu"] for row in rows}),
            "damping": sorted({row["damping"] for row in rows}),
            "seconds": sum(row["seconds"] for row in (*rows, *bands, *others)),
            "run": run,
            "points": [_without_settings(row) for row in rows],
            "bands": list(bands),
            "others": [_without_settings(row) for row in others],
        },
    )


def _without_settings(row: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in row.items() if key != "settings"}


def _rounding(name: str, value: float) -> float:
    """What rounding may move a number by: a place by an element, for a largest moment is flat there."""
    return ELEMENT if name.endswith("_place") else 1e-9 * abs(value)


def outside_their_bars(count: int, seed: int) -> list[str]:
    """Numbers of ``count`` points drawn at random that, measured again, are outside the bars of both."""
    found = []
    points = {(p["kappa_over_nu"], p["damping"]): p["numbers"] for p in stored.read(DATA)["points"]}
    for point in random.Random(seed).sample(grid(), count):
        before, again = points[point.kappa_over_nu, point.damping], measure_point(point)["numbers"]
        found += [
            f"{name} at kappa/nu = {point.kappa_over_nu:g}, eta/T* = {point.damping:g}: {again[name]}, stored {number}"
            for name, number in before.items()
            if abs(again[name][0] - number[0]) > again[name][1] + number[1] + _rounding(name, number[0])
        ]
    return found


def _main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--scheduler", default=None)
    parser.add_argument("--confirm", type=int, metavar="N", help="measure N points again; if they agree, keep the map")
    asked = parser.parse_args()
    if asked.confirm:
        wrong = outside_their_bars(asked.confirm, seed=int(clock.time()))
        if not wrong:
            stored.confirm(DATA)
        print("\n".join(wrong) or f"{DATA.name}: {asked.confirm} points agree")
        return 1 if wrong else 0
    store = RunStore(default_store())
    parts = grid(), [Point(PATH, kappa, 0.0) for kappa in BANDS], [Point(OTHER, *at, COARSER) for at in OTHERS]
    points = list(chain(*parts))
    before = sum(file is not None and file.exists() for file in (store.file(_question(point)) for point in points))
    if before:
        print(f"{before} of {len(points)} points are kept from an earlier run of the same code")
    began = clock.perf_counter()

    def count(done: int, total: int) -> None:
        print(f"\r{done}/{total}, {clock.perf_counter() - began:.0f} s", end="", flush=True)

    calls = [(store, point) for point in points]
    try:
        found = iter(run_all(_kept_point, calls, jobs=asked.jobs, scheduler=asked.scheduler, progress=count))
    except KeyboardInterrupt:
        print("\ninterrupted: the same command again goes on from there")
        return 130
    run = {"jobs": asked.jobs, "wall_seconds": clock.perf_counter() - began, "points_of_earlier_runs": before}
    rows, bands, others = (list(islice(found, len(part))) for part in parts)
    print(f"\n{write_map(rows, bands, others, run)}")
    return 0


if __name__ == "__main__":
    sys.exit(_main())
