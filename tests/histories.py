"""Histories made by hand, for what reads histories, and the rod that falls."""

from pathlib import Path
from typing import Any

import numpy as np

from bent_beam import Impact, ImpactHistory

# A steel rod, Ø 20 mm × 1 m with a sagitta of 10 mm, as a case file.
ROD = """title = "A rod"
[section]
kind = "round_bar"
diameter = 0.02
youngs_modulus = 2.1e11
density = 7850.0
yield_stress = 3.55e8
[beam]
length = 1.0
sagitta = 0.01
damping_ratio = 0.01
[impact]
velocity = 1.0
"""


def rod(folder: Path, *tables: str, element: float) -> Path:
    """The case file of the rod on even elements, with more tables."""
    file = folder / "rod.toml"
    file.write_text("\n".join([ROD, f'[mesh]\nkind = "uniform"\nelement_length = {element}', *tables]))
    return file


def history_of(time: Any, x: Any, *, impact: Any = None, symmetry: str = "half", **fields: Any) -> ImpactHistory:
    """A history with ``fields`` by name, of shape (times,), (times, nodes) or, for impulses, (times, contacts); what a
    history must have besides is zero. Contacts are the nodes."""
    time, x = np.asarray(time, float), np.asarray(x, float)
    still = np.zeros((time.size, x.size))
    energies = dict.fromkeys(("total_impulse", "kinetic_energy", "strain_energy"), 0.0 * time)
    values = {"gap": still, "impulse": still, **energies} | fields
    places = dict.fromkeys(("impulse", "opposite_impulse", "contact_position", "in_contact"), "contact")
    return ImpactHistory.build(
        impact=impact or Impact.dimensionless(0.5), path="bare", symmetry=symmetry, settings={}, time=time, x=x,
        contact_x=x, fields={n: (("time", places.get(n, "x"))[: np.ndim(v)], v) for n, v in values.items()},
    )  # fmt: skip


def recorded(time: Any, impulse: Any, *, gap: Any = 0.0, velocity: Any = 0.0, moment: Any = None, **other: Any) -> Any:
    """A beam that the wall gives these impulses, and that keeps its energy: half of it, unless told otherwise.
    moment : the largest, in the middle."""
    still, one = 0.0 * impulse, np.ones(time.size)
    known: dict[str, Any] = {"x": np.linspace(0.0, 1.0, 5), "impact": Impact.whole_beam(2.0), "gap": still + gap}
    known |= {"velocity": still + velocity, "impulse": impulse, "total_impulse": 2.0 * impulse.sum(axis=1)}
    if moment is not None:
        known |= {"largest_moment": moment, "largest_midspan_moment": moment, "largest_moment_place": 0.0 * time}
    return history_of(time, **(known | {"slope": still, "kinetic_energy": one, "strain_energy": 0.0 * one} | other))


def pushed_until(end: float, *, last: float = 2.0, again: float | None = None, **other: Any) -> ImpactHistory:
    """A rigid beam, pushed from first touch to ``end`` and as long from ``again`` on at 5.8 μℓV₀ a T*, saved 20 times a
    T*. Times in T*. other : of :func:`recorded`."""
    time = np.linspace(0.0, last, round(20 * last) + 1)
    push = 2.9 * np.minimum(time, end)
    if again is not None:
        push += 2.9 * np.clip(time - again, 0.0, end)
    gap, velocity = np.maximum(time - end, 0.0)[:, None], 1.0 - push[:, None]
    return recorded(time, np.outer(push, np.eye(5)[0]), gap=gap, velocity=velocity, **other)
