"""Problems of the open benchmark: ids, their physics, and the TOML file that an adapter reads (schema beam-impact/2).

docs/benchmark.md lists the ids. All problems but those with a table of their own are posed in units that make the
stiffness, the mass and the velocity one, in which every reference is known. A file holds no reference value and nothing
numerical.
"""

import json
import math
import re
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from bent_beam.checks import between, finite, non_negative, positive, shortened
from bent_beam.errors import InputError

__all__ = ["LADDER", "SCHEMA", "Problem", "document", "first_order_problem", "problem", "problem_text", "shipped_ids"]

PROBLEMS = Path(__file__).with_name("problems.json")
SCHEMA = "beam-impact/2"
END = 0.1  # τ; the leading order is self-similar, any end will do (the thesis ends here)
LOAD = 0.2  # ε times the sum of the loads' sizes: εr₁τ/r₀ ends at about 5 %, so its square is small and it is not
EQUIVALENTS = ("half beam", "small amplitude", "straight beam on a curved wall")
NUMBER = r"(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)"
COUNTS = {"leading": 1, "point": 1, "first": 4, "bounce": 2, "elastic-wall": 2, "elastic-stop": 1}  # of numbers in ids
IDS = {kind: re.compile("-".join([kind, *[NUMBER] * count])) for kind, count in COUNTS.items()}
IDS["first"] = re.compile(f"{IDS['first'].pattern}(?:-{NUMBER})?")


class Rung(NamedTuple):
    """A problem of the ladder without bending: in words, the given numbers and the end of the record in its units."""

    words: str
    given: dict[str, Any]
    end_time: float


BALL = {"mass": 1.0, "gravity": 1.0, "height": 0.5, "velocity": 0.0}
BAR = {"axial_stiffness": 1.0, "mass_per_length": 1.0, "length": 1.0, "velocity": 0.0, "gap": 0.0, "gravity": 0.0}
FREE = {"shape": "0", "far_end": "free"}
LADDER = {
    # lands at t = 1, and again every 2: ten impacts by the end
    "ball": Rung("bouncing ball, ten elastic impacts", BALL | {"restitution": 1.0}, 20.0),
    # rests at t = 3
    "chattering-ball": Rung("ball that comes to rest after infinitely many impacts", BALL | {"restitution": 0.5}, 4.0),
    # in contact from 0.5 to 2.5
    "bar": Rung("elastic bar that meets the wall end on and leaves", BAR | {"velocity": 1.0, "gap": 0.5} | FREE, 3.0),
    # held at its far end, let go compressed: in contact from 1 to 2, 4 to 5, 7 to 8
    "released-bar": Rung(
        "compressed bar that is let go in front of the wall, its far end held",
        BAR | {"shape": "(length - x)/(2 length)", "far_end": "held"},
        8.5,
    ),
    # the bouncing bar of Doyen, Ern and Piperno (2011): two periods of 16/3
    "bouncing-bar": Rung(
        "elastic bar that falls on the floor, twice",
        BAR | {"axial_stiffness": 900.0, "length": 10.0, "gap": 5.0, "gravity": 10.0} | FREE,
        11.0,
    ),
    # lands on the obstacle through its ends at 0.5, 1.5, 2.5 and 3.5
    "string": Rung(
        "string that lands on an obstacle all at once, four times",
        {"tension": 1.0, "mass_per_length": 1.0, "length": 1.0, "height": 1.0}
        | {"shape": "4 height x (length - x)/length^2", "velocity": 0.0, "ends": "fixed", "obstacle": 0.0}
        | {"restitution": 1.0},
        4.0,
    ),
}
EQUATION = (  # stands in the file, as comments
    "# u(x, t): deflection into the wall from the beam's shape at the first touch, which is at x = 0, t = 0.",
    "#   mass_per_length u_tt + bending_stiffness (u + damping u_t)_xxxx - axial_force u_xx",
    "#       = mass_per_length acceleration - push,   push >= 0, gap >= 0, push gap = 0",
    "#   gap = curvature x^2/2 - fourth_derivative x^4/24 - u;  at t = 0: u = 0, u_t = velocity + curvature_rate x^2/2",
    "# The axial force acts along x and on u alone: what it does to the bow is in the acceleration.",
)
# Code_Aster's test SDNL32 (V5.02.032), without damping: a square bar of 14 mm, E = 67 GPa, in SI units
SWUNG = {"bending_stiffness": 6.7e10 * 0.014**4 / 12.0, "mass_per_length": 2400.0 * 0.014**2, "length": 0.783}
SWUNG |= {"angular_velocity": 3.8}
SWUNG_END = 0.012  # s
STOPS = (3e3, 1e7)  # N/m: a softer one pushes most after that, stiffer ones need more modes than the exact answer has
WALLS, RATIOS = (1e-6, 1e6), (0.0, 5.0)  # κ/ν and ζ for which the largest force on an elastic wall is known
STOPPED_DAMPING, STOPPED_END = 0.01, 0.1  # the wall first lets go at 0.1516


@dataclass(frozen=True)
class Problem:
    """One problem of the benchmark, in units EI = μ = V₀ = 1 (so l* = t* = 1).

    id : its name. kind : "leading", "point", "first", "bounce", "stopped-beam", "elastic-wall", "elastic-stop", or one
    of the ladder's balls, bars and strings.
    kappa_over_nu : κ/ν. loads : (α, ψ, χ, n) with ν = 1, scaled by ``epsilon``; zeros at leading order.
    length : of the whole beam, ``None`` for an infinite one. damping : Kelvin–Voigt time η over T*.
    end_time, fit_window : in t* (the ladder: in the problem's own unit of time). given : the numbers of a problem that
    has a table of its own: the ladder's lower rungs, elastic walls and stops.
    """

    id: str
    kind: str
    kappa_over_nu: float = 0.0
    loads: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    epsilon: float = 0.0
    length: float | None = None
    damping: float = 0.0
    end_time: float = END
    snapshots: tuple[float, ...] = (0.02, 0.05, 0.1)
    given: dict[str, Any] = field(default_factory=dict, hash=False)

    @property
    def fit_window(self) -> tuple[float, float]:
        """The last decade of time."""
        return self.end_time / 10.0, self.end_time

    @property
    def is_front(self) -> bool:
        """The infinite beam: λ₀ and r₀ mean something."""
        return self.kind in ("leading", "point", "first")

    @property
    def is_symmetric(self) -> bool:
        """Whether one half of the beam, x ≥ 0, may stand for both."""
        return not self.given or self.kind == "elastic-wall"

    @property
    def largest_half_length(self) -> float:
        """The half length up to which the free motion leaves the gap open until the end of the record, infinite where
        every one does: the outer root of K x²/2 − q₀x⁴/24 − (V₀ + c₀x²/2)T − a₀T²/2 = 0. Beyond, the beam would be bent
        into the wall."""
        alpha, psi, chi, _ = (self.epsilon * load for load in self.loads)
        if psi <= 0.0:
            return math.inf
        T, curved = self.end_time, (self.kappa_over_nu - chi * self.end_time) / 2.0
        square = curved**2 - psi / 6.0 * (T + alpha * T**2 / 2.0)
        return math.sqrt((curved + math.sqrt(max(square, 0.0))) / (psi / 12.0))

    @property
    def base_id(self) -> str | None:
        """The problem without loads that a first-order problem is compared with."""
        return _front_id(self.kappa_over_nu) if self.kind == "first" else None

    @property
    def uniform_load(self) -> float:
        """The load that presses the resting zone on the wall, in μV₀/t*: ε(α + ψ + nκ), 0 when it lifts off (statics).

        In the zone the beam lies on the wall and does not move, so the wall carries the load p of the free motion,
        p = μa₀ + EI q₀ + N K.
        """
        alpha, psi, _, axial = self.loads
        load = alpha + psi + axial * self.kappa_over_nu
        largest = max(abs(alpha), abs(psi), abs(axial * self.kappa_over_nu), 1e-300)
        return self.epsilon * load if load > 1e-12 * largest else 0.0


def _front_id(kappa_over_nu: float) -> str:
    return f"{'leading' if kappa_over_nu < 1.0 else 'point'}-{kappa_over_nu:.12g}"


def first_order_problem(
    kappa_over_nu: float, loads: tuple[float, float, float, float], epsilon: float, end_time: float = END
) -> Problem:
    """The infinite beam with loads (α, ψ, χ, n) scaled by ``epsilon``; without loads the leading order."""
    positive("kappa_over_nu", kappa_over_nu)
    snapshots = (0.2 * end_time, 0.5 * end_time, end_time)
    if not any(loads):
        name = _front_id(kappa_over_nu)
        return Problem(name, name.partition("-")[0], kappa_over_nu, end_time=end_time, snapshots=snapshots)
    shown = loads if loads[3] else loads[:3]
    name = "-".join(["first", f"{kappa_over_nu:.12g}", *(f"{value:.12g}" for value in shown)])
    return Problem(name, "first", kappa_over_nu, loads, epsilon, end_time=end_time, snapshots=snapshots)


def problem(name: str) -> Problem:
    """The problem of an id. Raises :class:`InputError` for an id that none has."""
    if not isinstance(name, str) or len(name) > 200:
        raise InputError(f"problem: {shortened(name)} is not the id of a problem")
    if name in LADDER:
        return Problem(name, name, end_time=LADDER[name].end_time, snapshots=(), given=LADDER[name].given)
    if name == "stopped-beam":
        end, half = STOPPED_END, (0.5 * STOPPED_END,)
        return Problem(name, name, 2.0, length=2.0, damping=STOPPED_DAMPING, end_time=end, snapshots=half)
    for kind, pattern in IDS.items():
        if match := pattern.fullmatch(name):
            try:
                return _of_numbers(name, kind, [float(word or 0.0) for word in match.groups()])
            except ValueError as error:
                raise InputError(f"problem: {name}: {error}") from None
    raise InputError(
        f"problem: {shortened(name)} is not the id of a problem (leading-K, point-K, first-K-A-P-C[-N], bounce-K-D, "
        f"elastic-wall-K-Z, elastic-stop-S, {', '.join(LADDER)}, stopped-beam; shipped: {', '.join(shipped_ids())})"
    )


def _of_numbers(name: str, kind: str, numbers: list[float]) -> Problem:
    """The problem of an id with the numbers in it. Raises ``ValueError``."""
    if kind == "elastic-stop":
        given = {**SWUNG, "stop_stiffness": between("S", numbers[0], *STOPS)}
        return Problem(name, kind, end_time=SWUNG_END, snapshots=(), given=given)
    kappa = positive("K", numbers[0])
    if kind == "elastic-wall":
        ratio = between("Z", numbers[1], *RATIOS)
        between("K", kappa, *WALLS)
        units = {name: 1.0 for name in ("bending_stiffness", "mass_per_length", "velocity", "wall_stiffness")}
        given = {**units, "curvature": kappa, "wall_damping": 2.0 * ratio}
        # as long as a force may last: that of a straight beam is over at π, a sharp one's grows with κ^¼
        return Problem(name, kind, kappa, end_time=4.0 * max(1.0, kappa**0.25), snapshots=(), given=given)
    if kind == "bounce":
        damping = non_negative("D", numbers[1])
        # the last contact is before T* for every κ/ν that was tried (whole-impact study); half as much again is free
        return Problem(name, kind, kappa, length=2.0, damping=damping, end_time=1.5, snapshots=(0.5, 1.0, 1.5))
    if kind == "first":
        alpha, psi, chi, axial = (finite("load", value) for value in numbers[1:])
        total = abs(alpha) + abs(psi) + abs(chi) + abs(axial)
        if total == 0.0:
            raise ValueError("at least one load must not be zero (without loads it is leading-K)")
        return Problem(name, kind, kappa, (alpha, psi, chi, axial), LOAD / total)
    if (kappa < 1.0) != (kind == "leading"):
        raise ValueError(f"K must be {'below' if kind == 'leading' else 'at least'} 1 (got {kappa:g})")
    return Problem(name, kind, kappa)


def problem_text(asked: Problem) -> str:
    """The TOML file of a problem, for an adapter: the same as :func:`document`."""
    tables = document(asked)
    # a number, a text and a list of either are written alike in TOML and JSON
    lines = list(EQUATION if "beam" in tables else ())
    lines += [*(f"{key} = {json.dumps(tables.pop(key))}" for key in ("schema", "id")), ""]
    for table, values in tables.items():
        lines += [f"[{table}]", *(f"{key} = {json.dumps(value)}" for key, value in values.items()), ""]
    return "\n".join(lines)


def document(asked: Problem) -> dict[str, Any]:
    """A problem as JSON: schema, id, and the tables of its file."""
    names = {"schema": SCHEMA, "id": asked.id}
    record = {"end_time": asked.end_time, "fit_window": [*asked.fit_window], "snapshots": [*asked.snapshots]}
    if asked.given:
        table = asked.kind.rpartition("-")[2] if asked.kind in LADDER else asked.kind.replace("-", "_")
        return {**names, table: asked.given, "record": record}
    alpha, psi, chi, axial = (asked.epsilon * value for value in asked.loads)
    reach = asked.largest_half_length
    beam: dict[str, Any] = {"bending_stiffness": 1.0, "mass_per_length": 1.0, "curvature": asked.kappa_over_nu}
    beam |= {"length": asked.length or "infinite"} | ({"largest_half_length": reach} if math.isfinite(reach) else {})
    return {
        **names,
        "beam": beam | {"axial_force": axial, "damping": asked.damping},  # T* = √(μℓ⁴/EI) is one for ℓ = 1
        "impact": {"velocity": 1.0, "acceleration": alpha, "curvature_rate": chi, "fourth_derivative": psi},
        "wall": {"curvature": 0.0, "side": "one-sided", "friction": 0.0, "adhesion": 0.0},
        "record": record,
        "allowed": {"equivalents": list(EQUIVALENTS)},
    }


@cache
def shipped_ids() -> tuple[str, ...]:
    """Ids of the problems that are shipped (``problems.json``), in the benchmark's order."""
    return tuple(json.loads(PROBLEMS.read_text(encoding="utf-8"))["problems"])
