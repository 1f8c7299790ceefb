"""Faults, drawn at random, put into a code that is not ours (``foreign.py``) or into the books that it keeps.

Each has the symptoms of which one should come first, and the causes that may be named.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from tests.open_benchmark.foreign import solve

Fields = dict[str, Any]
Rng = np.random.Generator
ERRORS = {"error_lambda0", "error_r0", "bar_lambda0", "bar_r0"}
PUSHED, PLACED = {"push_at_a_gap", "energy"}, {"push_at_a_gap", "distribution"}
LATE = {"energy", "motion", "momentum"}
ROUGH = {"noise_in_time", "noise_in_space", "distribution", "lift"}


class Fault(NamedTuple):
    make: Callable[[Rng], Fields]
    first: set[str]
    causes: str = ""


def about(rng: Rng, least: float = 0.04) -> float:
    return float(1.0 + rng.choice([-1.0, 1.0]) * rng.uniform(least, 0.2))


def run(rng: Rng, **fault: Any) -> Fields:
    return solve(float(f"{rng.uniform(0.2, 0.7):.4g}"), **fault)


def springs(rng: Rng, **fault: Any) -> Fields:
    return run(rng, spring=10.0 ** rng.uniform(2.7, 3.5), **fault)


def booked(change: Callable[[Rng, Fields], Fields]) -> Callable[[Rng], Fields]:
    """Of a sound run, with the fields that ``change`` makes of it."""

    def make(rng: Rng) -> Fields:
        fields = run(rng)
        return fields | change(rng, fields)

    return make


def pushed(change: Callable[[Rng, Any], Any]) -> Callable[[Rng], Fields]:
    """With other impulses at the nodes, which ``change`` may alter in place."""
    return booked(lambda rng, fields: {"node_impulse": change(rng, fields["node_impulse"])})


def lost_point(rng: Rng, push: Any) -> Any:
    push[:, rng.integers(1, 0.8 * np.count_nonzero(push[-1] > 0.0))] = 0.0
    return push


def lost_time(rng: Rng, push: Any) -> Any:
    steps, start = np.diff(push, axis=0, prepend=0.0), rng.integers(11, 151)
    steps[start : start + rng.integers(60, 120)] = 0.0
    return np.cumsum(steps, axis=0)


def middle_twice(rng: Rng, push: Any) -> Any:
    push[:, 0] *= rng.uniform(2.0, 4.0)
    return push


def jitter(rng: Rng, push: Any) -> Any:
    return push * (1.0 + rng.uniform(0.01, 0.05) * rng.standard_normal((len(push), 1)))


def other_order(rng: Rng, push: Any) -> Any:
    reached = np.flatnonzero(push[-1] > 0.0)
    push[:, reached] = push[:, reached[::-1]]
    return push


def other_problem(rng: Rng, fields: Fields) -> Fields:
    kappa = float(fields["problem"].removeprefix("leading-"))
    return {"problem": f"leading-{kappa * about(rng, 0.08):.6g}"}


def other_clock(rng: Rng, fields: Fields) -> Fields:
    slow = rng.uniform(1.05, 1.3)
    return {name: slow * fields[name] for name in ("tau", "snap_tau")}


STEP = 0.1 / 400  # of a sound run
FACTORS = [0.5, 2.0, 1e3, 1e-3, 1.0 / 9.81]
FAULTS = {
    "stiffness": Fault(lambda rng: run(rng, stiffness=about(rng)), ERRORS),
    "mass": Fault(lambda rng: run(rng, mass=about(rng)), {"momentum"}, "momentum"),
    "speed": Fault(lambda rng: run(rng, speed=about(rng)), {"motion"}),
    "wall_curved_away": Fault(lambda rng: run(rng, shape=rng.uniform(1.1, 1.3)), {"penetration"}),
    "wall_curved_nearer": Fault(lambda rng: run(rng, shape=rng.uniform(0.75, 0.9)), {"push_at_a_gap", "lift"}),
    "wall_too_far": Fault(lambda rng: run(rng, shift=rng.uniform(0.5, 2.0) * 1e-3), {"penetration"}),
    "wall_too_near": Fault(lambda rng: run(rng, shift=-rng.uniform(0.5, 2.0) * 1e-3), PUSHED, "energy_gained"),
    "gravity": Fault(lambda rng: run(rng, gravity=rng.uniform(0.3, 1.0)), LATE, "energy_gained momentum"),
    "every_other_point": Fault(lambda rng: run(rng, every=int(rng.integers(2, 4))), ROUGH | {"penetration"}),
    "contact_ends": Fault(lambda rng: run(rng, reach=rng.uniform(0.08, 0.2)), {"penetration"}),
    "rebounds": Fault(lambda rng: solve(0.1, bounce=rng.uniform(0.4, 0.8)), {"lift"}),
    "short_beam": Fault(lambda rng: run(rng, half=rng.uniform(0.7, 1.0)), {"far_end"} | ROUGH),
    "clamped_end": Fault(lambda rng: run(rng, half=rng.uniform(0.8, 1.3), clamped=True), {"far_end", *LATE, *ROUGH}),
    "soft_springs": Fault(springs, {"penetration"}, "soft_penalty"),
    "damped_springs": Fault(lambda rng: springs(rng, dashpot=0.02), {"penetration", "pull"}, "soft_penalty"),
    "pulling_springs": Fault(lambda rng: run(rng, spring=3e5, dashpot=rng.uniform(0.005, 0.02)), {"pull"}, "adhesion"),
    "no_damping": Fault(lambda rng: run(rng, theta=0.5, grid=0.0), ROUGH),
    "overdamped": Fault(lambda rng: run(rng, grid=rng.uniform(20.0, 50.0)), ROUGH),
    "middle_too_stiff": Fault(lambda rng: run(rng, middle=rng.uniform(0.5, 1.2)), ROUGH),
    "coarse": Fault(lambda rng: run(rng, size=rng.uniform(0.1, 0.15)), ROUGH | ERRORS),
    "unstable": Fault(lambda rng: run(rng, theta=rng.uniform(0.485, 0.495), grid=0.0), {"energy"}, "energy_gained"),
    "lost_point": Fault(pushed(lost_point), {"momentum", "noise_in_space"}, "momentum"),
    "lost_time": Fault(pushed(lost_time), {"momentum"}, "momentum"),
    "forces": Fault(pushed(lambda rng, push: np.gradient(push, STEP, axis=0)), {"impulse_falls"}),
    "factor": Fault(pushed(lambda rng, push: push * rng.choice(FACTORS)), {"momentum"}, "momentum"),
    "sign": Fault(pushed(lambda rng, push: -push), {"impulse_falls"}),
    "middle_twice": Fault(pushed(middle_twice), {"momentum"}, "momentum"),
    "jitter": Fault(pushed(jitter), {"noise_in_time", "impulse_falls", "pull"}),
    "stale_gaps": Fault(booked(lambda rng, f: {"snap_gap": f["snap_gap"][[0, *range(9)]]}), {"motion"}),
    "stretched_places": Fault(booked(lambda rng, f: {"node_x": f["node_x"] * about(rng, 0.08)}), PLACED | ERRORS),
    "other_order": Fault(pushed(other_order), PLACED),
    "other_problem": Fault(booked(other_problem), {"motion", "momentum", "push_at_a_gap", "penetration", *ERRORS}),
    "other_clock": Fault(booked(other_clock), {"motion", "momentum"}),
}  # fmt: skip


def drawn(name: str, *seed: int) -> Fields:
    """The fields of a result with the fault, one that the solver could finish."""
    return FAULTS[name].make(np.random.default_rng([*seed, list(FAULTS).index(name)]))
