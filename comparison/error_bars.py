"""Do the error bars cover the truth? Methods drawn at random, matched at leading order, error over error bar.

The distribution (:func:`draw`): κ/ν log-uniform from 0.05 to 0.95. Eight of ten on the Hermite path, one each on the
self-similar and the Exudyn path. Hermite: mesh chosen, uniform, graded or scale-free alike, with elements log-uniform
from 1/50 to 2/5 of the front's thickness 2√(κτ/2) at the end and growth log-uniform from 0.5 to 10 % an element; the
four integrators, Signorini at the new position twice as often, θ = 1, 0.8 or 0.6 and ρ∞ = 0.8 or 0.5; contact at nodes
(twice as often), middles or means. Self-similar: resolution of the front log-uniform from 0.5 to 10 %, growth 1 to 6 %,
steps 1 to 6 % of the time, two to five decades. Exudyn: three implicit integrators, everything up to three times
coarser than chosen.

    python -m comparison.error_bars --runs 200 --seed 1 --out docs/figures
"""

from __future__ import annotations

import argparse
import dataclasses
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam.method import method_from_tables
from bent_beam.versions import stamp
from comparison.match import DURATION, MatchRow, Question, match
from comparison.plain import json_text
from comparison.store import RunStore, write_atomically

__all__ = ["Coverage", "coverage", "draw", "draw_coverage"]

def draw(random: np.random.Generator) -> Question:
    """One question of the distribution above."""
    kappa = _log_uniform(random, 0.05, 0.95)
    path = str(random.choice(["hermite"] * 8 + ["self_similar", "exudyn"]))
    tables, refine = {"hermite": _hermite, "self_similar": _self_similar, "exudyn": _exudyn}[path](random, kappa)
    label = f"{path} {sorted((k, v.get('kind')) for k, v in tables.items())}"
    return Question(method_from_tables(path, tables, label=label[:80]), kappa, None, refine)


def _log_uniform(random: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(random.uniform(math.log(low), math.log(high))))


def _hermite(random: np.random.Generator, kappa: float) -> tuple[dict[str, Any], float]:
    thickness = 2.0 * math.sqrt(DURATION * kappa / 2.0)
    element = thickness * _log_uniform(random, 0.02, 0.4)
    growth = 1.0 + _log_uniform(random, 0.005, 0.1)
    tables: dict[str, Any] = {}
    mesh = str(random.choice(["auto", "uniform", "graded", "scale_free"]))
    if mesh == "uniform":
        tables["mesh"] = {"kind": mesh, "element_length": max(element, 0.05)}  # 10,000 elements of 500 l*
    elif mesh == "graded":
        zone = float(random.uniform(1.0, 4.0)) * math.sqrt(2.0 * DURATION / kappa)
        tables["mesh"] = {"kind": mesh, "element_length": element, "growth": growth, "zone": zone}
    elif mesh == "scale_free":
        tables["mesh"] = {"kind": mesh, "element_length": 0.1 * element, "growth": min(growth, 1.04)}
    kind = str(
        random.choice(
            [
                "signorini_position",
                "signorini_position",
                "moreau_jean",
                "nonsmooth_generalized_alpha",
                "generalized_alpha_penalty",
            ]
        )
    )
    tables["integrator"] = {"kind": kind}
    if kind == "moreau_jean":
        tables["integrator"]["theta"] = float(random.choice([1.0, 0.8, 0.6]))
    if kind == "nonsmooth_generalized_alpha":
        tables["integrator"]["spectral_radius"] = float(random.choice([0.8, 0.5]))
    contact = str(random.choice(["node", "node", "middle", "mean"]))
    tables["contact"] = {"kind": "node" if kind == "generalized_alpha_penalty" else contact}
    return tables, 1.0


def _self_similar(random: np.random.Generator, kappa: float) -> tuple[dict[str, Any], float]:
    return {
        "mesh": {
            "kind": "expanding",
            "front_resolution": _log_uniform(random, 0.005, 0.1),
            "growth": float(random.uniform(0.01, 0.06)),
            "step_ratio": float(random.uniform(0.01, 0.06)),
            "decades": float(random.uniform(2.0, 5.0)),
        }
    }, 1.0


def _exudyn(random: np.random.Generator, kappa: float) -> tuple[dict[str, Any], float]:
    kind = str(random.choice(["generalized_alpha", "newmark", "trapezoidal"]))
    return {"integrator": {"kind": kind}}, 1.0 / _log_uniform(random, 1.0, 3.0)


@dataclass(frozen=True)
class Coverage:
    """What a sample showed. ``share`` of numbers covered; ``ratio`` : median of error bar over error; ``lost`` : share
    of runs without a number; ``points`` : (κ/ν, label, what, error, bar), relative to theory."""

    runs: int
    share: float
    ratio: float
    lost: float
    points: list[tuple[float, str, str, float, float]]

    @property
    def worst(self) -> list[tuple[float, str, str, float, float]]:
        """The numbers whose bars miss, furthest first."""
        missed = [p for p in self.points if p[3] > p[4]]
        return sorted(missed, key=lambda p: p[4] / p[3])


def coverage(rows: Sequence[MatchRow]) -> Coverage:
    """Coverage of λ₀ and r₀ among matched rows."""
    points = []
    for row in rows:
        for what, number in row.compared().items():
            off, bar = number.relative(), number.relative_error()
            if off is not None and bar is not None:
                points.append((row.kappa_over_nu, row.label, what, abs(off), bar))
    held = [error <= bar for *_, error, bar in points]
    ratios = [bar / max(error, 1e-12) for *_, error, bar in points]
    return Coverage(
        runs=len(rows),
        share=float(np.mean(held)),
        ratio=float(np.median(ratios)),
        lost=float(np.mean([not row.r0.measured for row in rows])),
        points=points,
    )


def measure(
    runs: int,
    seed: int,
    *,
    jobs: int = 1,
    store: RunStore | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Coverage:
    """Draw, match, count."""
    random = np.random.default_rng(seed)
    asked = [draw(random) for _ in range(runs)]
    return coverage(match(asked, jobs=jobs, store=store, progress=progress))


def draw_coverage(found: Coverage, out: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """``error-bars.png``: the error of every number over its error bar."""
    from comparison.figures import style

    with style.figure(1, 1, width=style.COLUMN, height=3.2) as (fig, axis):
        for what, symbol, mark in (("lambda0", r"$\lambda_0$", style.HERMITE), ("r0", "$r_0$", style.EXUDYN)):
            mine = [(bar, max(error, 1e-7)) for *_, name, error, bar in found.points if name == what]
            axis.plot(*zip(*mine), **{**mark, "label": symbol, "ms": 3})
        bars = [bar for *_, bar in found.points if bar > 0.0]
        ends = np.array([0.5 * min(bars, default=1e-4), 2.0 * max(bars, default=1e-1)])
        axis.plot(ends, ends, color="black", lw=1.0, label="error = bar")
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel("error bar / theory  (1)")
        axis.set_ylabel("|error| / theory  (1)")
        axis.legend()
        return style.save(fig, out, "error-bars", formats)


def _main() -> None:
    parser = argparse.ArgumentParser(description="Coverage of the error bars on a random sample.")
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, default=Path("docs/figures"))
    chosen = parser.parse_args()
    found = measure(chosen.runs, chosen.seed, jobs=chosen.jobs)
    about = stamp(f"python -m comparison.error_bars --runs {chosen.runs} --seed {chosen.seed}")
    write_atomically(chosen.out / "error-bars.json", json_text(about | dataclasses.asdict(found), indent=1))
    draw_coverage(found, chosen.out)
    print(f"covered {found.share:.1%}, median bar over error {found.ratio:.2g}, without a number {found.lost:.1%}")
    for kappa, label, what, error, bar in found.worst:
        print(f"missed: {label}, kappa/nu = {kappa:.4g}: {what} off by {error:.2e}, bar {bar:.2e}")


if __name__ == "__main__":
    _main()
