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


def history_of(run: Any, mesh: ExpandingMesh, seconds: float, completed: bool) -> ImpactHistory:
    """The record of a :class:`self_similar_fe.run.Run` in SI units."""
    p = run.impact
    column = {k: np.array([r[k] for r in run.records]) for k in run.records[0]}
    force_time = p.mass_per_length * p.length_scale * p.velocity  # μ l* V₀, N s
    energy = force_time * p.velocity
    deflection = p.deflection_scale
    units: dict[str, tuple[tuple[str, ...], float]] = {
        "position": (("time", "x"), p.length_scale),
        "gap": (("time", "x"), deflection),
        "velocity": (("time", "x"), p.velocity),
        "slope": (("time", "x"), deflection / p.length_scale),
        "impulse": (("time", "contact"), force_time),
        "total_impulse": (("time",), force_time),
        "held_impulse": (("time",), force_time),
        "impulse_moment": (("time",), force_time * p.length_scale),
        "smallest_gap": (("time",), deflection),
        "smallest_reaction": (("time",), force_time / p.time_scale),
        "complementarity_product": (("time",), force_time / p.time_scale * deflection),
        "lift": (("time",), deflection),
        **{
            k: (("time",), energy)
            for k in ("kinetic_energy", "strain_energy", "work_of_loads", "loss_absorbed", "loss_algorithmic")
        },
    }
    fields: dict[str, tuple[Sequence[str], NDArray[Any]]] = {
        name: (dims, column[name] * unit) for name, (dims, unit) in units.items()
    }
    fields["contact_position"] = (("time", "contact"), fields["position"][1])
    fields["in_contact"] = (("time", "contact"), column["in_contact"])
    final = fields["position"][1][-1]
    return ImpactHistory.build(
        impact=p,
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
            "gap_tolerance": run.state.gap_tolerance,
            "energies": "of the fast part z = y0 - y",
        },
        time=column["time"] * p.time_scale,
        x=final,
        contact_x=final,
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
    if reach > run.impact.half_length and run.impact.length < 999.0 * run.impact.length_scale:
        found.append(
            f"an infinite beam was simulated: the waves followed here reach {reach:.3g} m, beyond the half length "
            f"{run.impact.half_length:.3g} m"
        )
    if moved > 0.3:
        found.append(
            f"the front moved by {moved:.0%} of the contact length, out of the mesh's finest part"
        )
    return found
