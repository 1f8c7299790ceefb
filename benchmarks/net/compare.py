"""How far an answer is from the recorded one, as a share of what its class allows."""

from __future__ import annotations

import math

from benchmarks.net.case import Case

__all__ = ["Numbers", "group", "sensitivity", "worst"]

Numbers = dict[str, float]

ROUND_OFF = 1e-9  # of the size of a quantity's group
FACTOR = 30.0  # times what a nudge changed
DEVIATIONS = 4.0  # standard deviations of a difference of two means
SHARES = {"lift", "pull", "hold", "noise", "penetration", "adhesion", "energy_defect", "energy_gain"}
TOGETHER = {"energy", "impulse", "impulse moment", "contacts", "gap", "velocity", "slope"}
WATCHED = {"total_impulse.value": 1.0, "peak_moment": 1.0, "energy.kinetic": 1.0, "half_contact_length.value": 10.0}
CHANGED = "r0.error"  # the bar of r₀ holds the lift since 22 November 2026
Deviation = tuple[float, str]


def group(key: str) -> str:
    """The name of the quantities that are judged by one size: energies by the largest energy, a bar by its value."""
    words = key.split(".")
    if words[0] == "error_parts":
        return words[1] if words[1] not in ("translation", "vibration", "dissipated") else "energy"
    if words[0] == "hits":
        return f"hits.{words[-1]}"
    if words[0] in TOGETHER | SHARES:
        return words[0]
    return ".".join(word for word in words if word not in ("value", "error", "theory", "band", "mean", "std"))


def sizes(numbers: Numbers) -> Numbers:
    """The size of each group: its largest number; a share is one of one."""
    found: Numbers = {}
    for key, value in numbers.items():
        name = group(key)
        found[name] = max(found.get(name, 0.0), abs(value))
    return {name: 1.0 if SHARES & set(name.split(".")) or size == 0.0 else size for name, size in found.items()}


def changes(recorded: Numbers, found: Numbers) -> Numbers:
    """Change of every recorded number over the size of its group; one that is missing is infinitely far."""
    size = sizes(recorded)
    return {key: abs(found.get(key, math.inf) - value) / size[group(key)] for key, value in recorded.items()}


def sensitivity(answer: Numbers, nudged: list[Numbers]) -> Numbers:
    """Group by group, the largest change under the nudges, where it is more than nothing."""
    found: Numbers = {}
    for other in nudged:
        for key, change in changes(answer, other).items():
            found[group(key)] = max(found.get(group(key), 0.0), min(change, 1.0))
    return {name: float(f"{change:.2g}") for name, change in found.items() if FACTOR * change > ROUND_OFF}


def worst(case: Case, recorded: Numbers, sensitive: Numbers, found: Numbers) -> Deviation:
    """The largest deviation over its tolerance, and of which quantity."""
    change, size = changes(recorded, found), sizes(recorded)
    allowed: Numbers = {}
    for key in recorded:
        name = group(key)
        if key.endswith(CHANGED):
            continue
        if case.kind == "same":
            allowed[key] = max(ROUND_OFF, FACTOR * sensitive.get(name, 0.0))
        elif case.kind == "band" and key.endswith("band.mean"):
            spread, runs = recorded[key[:-4] + "std"], recorded[key[:-4] + "runs"]
            allowed[key] = max(case.relative, DEVIATIONS * math.sqrt(2.0 / runs) * spread / size[name])
        elif case.kind == "bar" and (key in WATCHED or key.endswith(".value")):
            bar = recorded.get(key[:-5] + "error", 0.0) if key.endswith(".value") else 0.0
            allowed[key] = max(WATCHED.get(key, 1.0) * case.relative, bar / size[name])
    return max((change[key] / max(most, ROUND_OFF), key) for key, most in allowed.items())
