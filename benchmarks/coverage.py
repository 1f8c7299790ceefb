"""Do the error bars hold the truth? Methods drawn at random, matched at leading and first order, error over error bar.

    make coverage                                    (python -m benchmarks.coverage [--rows 200] [--seed N])

Every run draws anew and prints its seed. It fails when fewer than 94 % of the numbers lie within their bars, or when
one is more than two bars off. Each miss becomes a methods file in ``out/coverage`` that says how to run it.

The distribution (:func:`draw`): κ/ν log-uniform from 0.05 to 0.95, the end of the runs from 0.01 to 1 t*. Half of the
rows are about first order: loads log-uniform from 0.3 to 300, what gravity is, gT*/V₀, for slender beams that arrive at
metres to millimetres per second; α alone twice as often as (α, ψ, χ) or an axial force in free flight, of either sign.
Eight of ten on the Hermite path, one each on the self-similar and the Exudyn path. Hermite: mesh chosen, uniform,
graded or scale-free alike, with elements log-uniform from 1/50 to 2/5 of the front's thickness 2√(κτ/2) at the end and
growth log-uniform from 0.5 to 10 % an element; all integrators but the midpoint rule and the massless
boundary, Signorini at the new position twice as often, θ = 1, 0.8 or 0.6 and ρ∞ = 0.8 or 0.5; contact at nodes (twice
as often), middles or means. Self-similar: resolution of the front log-uniform from 0.5 to 10 %, growth 1 to 6 %, steps
1 to 6 % of the time, two to five decades. Exudyn: three implicit integrators, everything up to three times coarser than
chosen.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bent_beam.files import write_atomically
from bent_beam.method import method_from_tables
from bent_beam.stored import write
from comparison.matching import CODE, match
from comparison.rows import First, MatchQuestion, MatchRow

LEAST_SHARE = 0.94  # of the numbers within their bars; the bars are meant for 95 %
MOST_BARS = 2.0  # that a number may be off


@dataclass(frozen=True)
class Draw:
    """One row: the tables of a method, as in a methods file, κ/ν, the load (α, ψ, χ, N), the end of the runs, t*, and
    how much finer than the tables say it is run."""

    path: str
    tables: dict[str, dict[str, Any]]
    kappa_over_nu: float
    first: First | None = None
    duration: float = 0.1
    refine: float = 1.0

    @property
    def label(self) -> str:
        """The kinds of its parts."""
        return ", ".join([self.path, *(str(table["kind"]) for table in self.tables.values())])

    @property
    def question(self) -> MatchQuestion:
        """The row of ``match``."""
        method = method_from_tables(self.path, self.tables, label=self.label)
        return MatchQuestion(method, self.kappa_over_nu, self.first, self.refine, duration=self.duration)

    def text(self, file: Path, found: str) -> str:
        """A methods file of this method alone."""
        asked = f"bentbeam match --methods {file} --kappa-over-nu {self.kappa_over_nu!r} --refine {self.refine!r}"
        asked += f" --duration {self.duration!r}"
        asked += f" --first-order={','.join(map(repr, self.first))}" if self.first else ""
        lines = [f"# {found}", f"# {asked}", "[[method]]"]
        lines += [f"label = {json.dumps(self.label)}", f"path = {json.dumps(self.path)}"]
        for name, table in self.tables.items():
            lines.append(f"{name} = {{{', '.join(f'{key} = {json.dumps(value)}' for key, value in table.items())}}}")
        return "\n".join(lines) + "\n"


def draw(random: np.random.Generator) -> Draw:
    """One row of the distribution above."""
    kappa, duration = log_uniform(random, 0.05, 0.95), log_uniform(random, 0.01, 1.0)
    path = str(random.choice(["hermite"] * 8 + ["self_similar", "exudyn"]))
    parts = {"hermite": _hermite, "self_similar": _self_similar, "exudyn": _exudyn}[path]
    tables, refine = parts(random, kappa, duration)
    return Draw(path, tables, kappa, _load(random, kappa), duration, refine)


def _load(random: np.random.Generator, kappa: float) -> First | None:
    if random.random() < 0.5:
        return None
    size = log_uniform(random, 0.3, 300.0) * float(random.choice([-1.0, 1.0]))
    alpha, psi, chi = (float(size * part) for part in random.uniform(-1.0, 1.0, 3))
    options: list[First] = [(size, 0.0, 0.0, 0.0)] * 2 + [(alpha, psi, chi, 0.0), (-kappa * size, 0.0, 0.0, size)]
    return options[random.integers(len(options))]


def log_uniform(random: np.random.Generator, low: float, high: float) -> float:
    """Drawn evenly in the logarithm."""
    return float(np.exp(random.uniform(math.log(low), math.log(high))))


def _hermite(random: np.random.Generator, kappa: float, duration: float) -> tuple[dict[str, Any], float]:
    element = 2.0 * math.sqrt(duration * kappa / 2.0) * log_uniform(random, 0.02, 0.4)
    growth = 1.0 + log_uniform(random, 0.005, 0.1)
    zone = float(random.uniform(1.0, 4.0)) * math.sqrt(2.0 * duration / kappa)
    meshes: list[dict[str, Any]] = [
        {"kind": "auto"},
        {"kind": "uniform", "element_length": max(element, 0.05)},  # 10,000 elements of 500 l*
        {"kind": "graded", "element_length": element, "growth": growth, "zone": zone},
        {"kind": "scale_free", "element_length": 0.1 * element, "growth": min(growth, 1.04)},
    ]
    schemes: list[dict[str, Any]] = [
        *[{"kind": "signorini_position"}] * 2,
        {"kind": "moreau_jean", "theta": float(random.choice([1.0, 0.8, 0.6]))},
        {"kind": "nonsmooth_generalized_alpha", "spectral_radius": float(random.choice([0.8, 0.5]))},
        {"kind": "generalized_alpha_penalty"},
    ]
    mesh, scheme = (options[random.integers(len(options))] for options in (meshes, schemes))
    contact = str(random.choice(["node", "node", "middle", "mean"]))
    only_nodes = scheme["kind"] == "generalized_alpha_penalty"  # it takes no other
    return {"mesh": mesh, "integrator": scheme, "contact": {"kind": "node" if only_nodes else contact}}, 1.0


def _self_similar(random: np.random.Generator, kappa: float, duration: float) -> tuple[dict[str, Any], float]:
    mesh = {
        "kind": "expanding",
        "front_resolution": log_uniform(random, 0.005, 0.1),
        "growth": float(random.uniform(0.01, 0.06)),
        "step_ratio": float(random.uniform(0.01, 0.06)),
        "decades": float(random.uniform(2.0, 5.0)),
    }
    return {"mesh": mesh}, 1.0


def _exudyn(random: np.random.Generator, kappa: float, duration: float) -> tuple[dict[str, Any], float]:
    kind = str(random.choice(["generalized_alpha", "newmark", "trapezoidal"]))
    return {"integrator": {"kind": kind}}, 1.0 / log_uniform(random, 1.0, 3.0)


class Point(NamedTuple):
    """A number of a row: its error and its bar, over the theory's value."""

    row: int
    kappa_over_nu: float
    label: str
    name: str
    error: float
    bar: float


@dataclass(frozen=True)
class Coverage:
    """A sample: share of numbers covered; ratio, the median of error bar over error; lost, the share of rows without a
    number; and its points."""

    runs: int
    share: float
    ratio: float
    lost: float
    points: list[Point]

    @classmethod
    def of(cls, points: list[Point], runs: int, lost: float) -> Coverage:
        """What the points say."""
        share = float(np.mean([p.error <= p.bar for p in points]))
        return cls(runs, share, float(np.nanmedian([p.bar / max(p.error, 1e-12) for p in points])), lost, points)

    @property
    def misses(self) -> list[Point]:
        """The numbers whose bars do not reach the theory, furthest first."""
        return sorted((p for p in self.points if p.error > p.bar), key=lambda p: p.bar / p.error)

    def __str__(self) -> str:
        return f"covered {self.share:.1%}, median bar over error {self.ratio:.2g}, without a number {self.lost:.1%}"

    @property
    def holds(self) -> bool:
        """Whether enough numbers are covered and none is far off."""
        return self.share >= LEAST_SHARE and all(p.error <= MOST_BARS * p.bar for p in self.points)


def coverage(rows: Sequence[MatchRow]) -> Coverage:
    """Coverage of λ₀ and r₀, or λ₁ and r₁, among matched rows."""
    points = []
    for k, row in enumerate(rows):
        for name, number in row.compared().items():
            off, bar = number.relative(), number.relative_bar()
            if off is not None and bar is not None:
                points.append(Point(k, row.kappa_over_nu, row.label, name, abs(off), bar))
    lost = [not all(number.measured for number in row.compared().values()) for row in rows]
    return Coverage.of(points, len(rows), float(np.mean(lost)))


def write_misses(found: Coverage, drawn: Sequence[Draw], out: Path) -> list[Path]:
    """A methods file of each number outside its bar, in place of older ones."""
    for old in out.glob("miss-*.toml"):
        old.unlink()
    files = []
    for p in found.misses:
        files.append(out / f"miss-{p.row}-{p.name}.toml")
        about = f"{p.name} is off by {p.error:.2e}, its bar is {p.bar:.2e}"
        write_atomically(files[-1], drawn[p.row].text(files[-1], about))
    return files


def draw_figure(found: Coverage, out: Path) -> None:
    """``error-bars.png``: the error of every number over its error bar."""
    from comparison.figures import style

    with style.figure(1, 1, width=style.COLUMN, height=3.2) as (fig, axis):
        for order, mark in (("0", style.HERMITE), ("1", style.EXUDYN)):
            mine = [(p.bar, max(p.error, 1e-7)) for p in found.points if p.name in (f"lambda{order}", f"r{order}")]
            label = rf"$\lambda_{order}$, $r_{order}$"
            axis.plot(*np.array(mine).reshape(-1, 2).T, **{**mark, "label": label, "ms": 3})
        bars = [p.bar for p in found.points if p.bar > 0.0]
        ends = np.array([0.5 * min(bars, default=1e-4), 2.0 * max(bars, default=1e-1)])
        axis.plot(ends, ends, color="black", lw=1.0, label="error = bar")
        axis.set(xscale="log", yscale="log", xlabel="error bar / theory  (1)", ylabel="|error| / theory  (1)")
        axis.legend()
        style.save(fig, out, "error-bars", ("png",))


def options(about: str | None, rows: int, out: Path, of: str) -> argparse.ArgumentParser:
    """The options of a study that draws."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rows", type=int, default=rows)
    parser.add_argument("--seed", type=int, default=time.time_ns() % 2**31, help="the clock's unless given")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, default=out, help=of)
    return parser


def main() -> int:
    """Draw, match, count; 1 when the error bars do not hold."""
    parser = options(__doc__, 200, Path("out/coverage"), "of misses and of the figure")
    parser.add_argument("--figure", type=Path, help="another folder for the figure")
    asked = parser.parse_args()
    print(f"seed {asked.seed}", flush=True)
    random = np.random.default_rng(asked.seed)
    drawn = [draw(random) for _ in range(asked.rows)]
    found = coverage(match([one.question for one in drawn], jobs=asked.jobs))
    figures, settings = asked.figure or asked.out, {"rows": asked.rows, "seed": asked.seed}
    command = f"python -m benchmarks.coverage --rows {asked.rows} --seed {asked.seed} --figure docs/figures"
    about = "errors of λ₀, r₀, λ₁, r₁ and their error bars, of methods drawn at random"
    write(figures / "error-bars.json", about, command, CODE, settings, dataclasses.asdict(found))
    draw_figure(found, figures)
    print(found)
    for p, file in zip(found.misses, write_misses(found, drawn, asked.out)):
        print(f"missed: {p.label}, kappa/nu = {p.kappa_over_nu:.4g}: {p.name}, {p.error / p.bar:.2g} bars off; {file}")
    return 0 if found.holds else 1


if __name__ == "__main__":
    sys.exit(main())
