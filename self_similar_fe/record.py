"""The record of a run in similarity coordinates, in SI units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.fields import describe
from bent_beam.history import ImpactHistory
from self_similar_fe.mesh import ExpandingMesh

__all__ = ["history_of"]

LARGEST_PULL = 0.1  # in any step, over the largest push: sound runs under loads reach 0.03 by round-off
MOST_WIDENED = 100.0  # likewise
OF_CONTACTS = ("impulse", "in_contact")  # all else along the beam is at its nodes


def history_of(run: Any, mesh: ExpandingMesh, seconds: float, completed: bool) -> ImpactHistory:
    """The record of a :class:`self_similar_fe.run.Run` in SI units."""
    column = {name: np.array([record[name] for record in run.records]) for name in run.records[0]}
    time, nodes = column.pop("time"), column["position"][-1]
    fields: dict[str, tuple[Sequence[str], NDArray[Any]]] = {
        name: (("time", "contact" if name in OF_CONTACTS else "x")[: values.ndim], values)
        for name, values in column.items()
    }
    fields["contact_position"] = (("time", "contact"), column["position"])
    return ImpactHistory.build(
        impact=run.impact,
        path="self_similar",
        symmetry="half",
        settings={
            "mesh": describe(mesh),
            "end_time": run.end_time,
            "save": run.saves,
            "integrator": "implicit Euler, steps ∝ time",
            "contact": "node, Signorini at position level",
            "nodes": int(run.state.zeta.size),
            "iterations": run.state.iterations,
            "widened": run.state.widened,
            "largest_pull": run.state.pull / run.state.push,
            "energies": "of the fast part z = y0 - y",
        },
        time=time,
        x=nodes,
        contact_x=nodes,
        fields=fields,
        warnings=warnings_of(run),
        steps=run.steps,
        seconds=seconds,
        completed=completed,
    )


def warnings_of(run: Any) -> list[str]:
    """What a reader of the result should know."""
    found = []
    reach = run.state.zeta[-1] * math.sqrt(run.end) * run.impact.length_scale
    thickness = 2.0 / math.sqrt(1.0 + run.front**2)
    moved = abs(run.state.front - run.front) / max(run.front, thickness)
    if reach > run.impact.half_length:
        found.append(
            f"an infinite beam was simulated: the waves followed here reach {reach:.3g} m, beyond the half length "
            f"{run.impact.half_length:.3g} m"
        )
    if moved > 0.3:
        found.append(f"the front moved by {moved:.0%} of the contact length, out of the mesh's finest part")
    if (pull := run.state.pull / run.state.push) > LARGEST_PULL or run.state.widened > MOST_WIDENED:
        found.append(
            f"the wall pulls by up to {pull:.2g} of its largest push in a step, contacts being judged with "
            f"{run.state.widened:.2g} times the tolerance of round-off: a larger mesh.front_resolution or a smaller "
            "mesh.step_ratio settles them"
        )
    return found
