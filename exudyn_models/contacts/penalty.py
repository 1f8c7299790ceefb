"""Penalty at the nodes (Exudyn's ``ObjectContactCoordinate``).

    R_i = b_i (k y_i + d ẏ_i)  while y_i > 0,   b_i the length of beam that node i stands for
    k = C EI/Δx⁴,   d = D √(EIμ)/Δx²

With k and d tied to the element length the contact is as stiff as the elements themselves, on every scale of the
mesh; C = 10 and D = 3 keep both the penetration and the rattling below the mesh's own error. Where κ/ν is so small that
the front passes an element faster than the element bends, the contact must be as fast as the front: it passes Δx at x
in t = 2xΔx/λ² √(μ/EI), and C = (λ²Δx/x)² makes √(k/μ) t = 2. The damping ratio stays that of 10 and 3.

Behind the front the exact reaction vanishes; a one-sided force turns the numerical noise there into pushes that lift
the beam. So a captured node is held (its penalty acts in both directions) until the front is ``hold`` elements
further on: the held strip shrinks with the mesh, so that the scheme stays consistent. What it pulls is reported as
``held_impulse``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import exudyn.itemInterface as items
import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import between, non_negative, positive, whole
from exudyn_models.contacts.base import Contact, ContactRun, Flags, Wall
from exudyn_models.contacts.holding import START, HeldStrip, chosen_hold
from exudyn_models.elements import Beam

__all__ = ["Penalty", "penalty_per_length"]

Array = NDArray[np.float64]

STIFFNESS, DAMPING = 10.0, 3.0  # C and D


def chosen_stiffness(s: Array, wall: Wall) -> float:
    """C of the module's text: 10, or what the front asks for at the end of the run."""
    k = min(max(int(np.searchsorted(s, wall.front)), 1), s.size - 1)
    return max(STIFFNESS, float(wall.front**2 * (s[k] - s[k - 1]) / s[k]) ** 2)


def penalty_per_length(lengths: Array, relative_stiffness: float, relative_damping: float) -> tuple[Array, Array]:
    """k and d of the module's text for given element lengths (EI = μ = 1)."""
    return relative_stiffness / lengths**4, relative_damping / lengths**2


class _Run(ContactRun):
    def __init__(
        self, beam: Beam, wall: Wall, stiffness: Array, damping: Array, strip: HeldStrip, chosen: dict[str, float]
    ) -> None:
        self.chosen = chosen
        self.beam, self.nodes = beam, wall.nodes
        self.stiffness, self.damping = stiffness, damping
        self.contact_s = beam.shape.s[wall.nodes]
        self.strip = strip
        self.held = np.zeros(wall.nodes.size, bool)
        self.contacts: list[Any] = []
        self.holders: list[Any] = []
        mbs = beam.mbs
        for k, node in enumerate(wall.nodes):
            marker = beam.marker(int(node), beam.vertical_coordinate)
            # open at t = 0: a closed one would put its damping into the initial accelerations
            state = mbs.AddNode(
                items.NodeGenericData(
                    numberOfDataCoordinates=1, initialCoordinates=[max(1e-14, -float(beam.shape.y[node]))]
                )
            )
            self.contacts.append(
                mbs.AddObject(
                    items.ObjectContactCoordinate(
                        markerNumbers=[marker, beam.ground_marker],
                        nodeNumber=state,
                        contactStiffness=stiffness[k],
                        contactDamping=damping[k],
                    )
                )
            )
            if self.strip.used:
                self.holders.append(
                    mbs.AddObject(
                        items.ObjectConnectorCoordinateSpringDamper(
                            markerNumbers=[beam.ground_marker, marker],
                            stiffness=stiffness[k],
                            damping=damping[k],
                            activeConnector=False,
                        )
                    )
                )

    def depth(self, q: Array) -> Array:
        return np.asarray(q[self.beam.vertical[self.nodes]])

    def forces(self, q: Array, v: Array) -> tuple[Array, Flags]:
        place = self.beam.vertical[self.nodes]
        touching = q[place] > 0.0
        active = touching | self.held
        force = np.where(active, self.stiffness * q[place] + self.damping * v[place], 0.0)
        self.strip.captured |= touching
        return force, active

    def contradictions(self, q: Array, v: Array, closed: Flags) -> Array:
        depth = self.depth(q)
        spring = self.stiffness * depth
        pushing = spring + self.damping * self.velocity(q, v) > 0.0
        wrong = np.where(depth >= 0.0, ~closed, closed & ~pushing) & ~self.held
        return np.where(wrong, np.abs(spring), 0.0)

    def between(self, time: float, step: float, q: Array, v: Array) -> bool:
        wanted = self.strip.wanted(time)
        changed = np.flatnonzero(wanted != self.held)
        for k in changed:
            self.beam.mbs.SetObjectParameter(self.holders[k], "activeConnector", bool(wanted[k]))
            # the one-sided connector stays active without force: deactivated, Exudyn repeats steps for it in vain
            for name, value in (("contactStiffness", self.stiffness[k]), ("contactDamping", self.damping[k])):
                self.beam.mbs.SetObjectParameter(self.contacts[k], name, 0.0 if wanted[k] else float(value))
        self.held = wanted
        return bool(changed.size)

    def stiffness_and_damping(self) -> tuple[Array, Array]:
        k, d = np.zeros((2, self.beam.shape.s.size))
        k[self.nodes], d[self.nodes] = self.stiffness, self.damping
        return k, d

    def settings(self) -> dict[str, Any]:
        return {"hold_elements": self.strip.hold} | self.chosen


@dataclass(frozen=True)
class Penalty(Contact):
    """Nodal penalty: the default.

    stiffness, damping : k in N/m² and d in N s/m² per length of beam; None: from the element length and the next two.
    relative_stiffness, relative_damping : C and D of the module's text; None: chosen, 10 and 3 for κ/ν ≥ 1/150.
    hold : elements behind the front whose captured nodes are held; None: 16, but none where the load draws the beam
        off the wall (α + ψ < 0, where a hold would pull on what rightly lifts) and none under explicit integrators.
    hold_start : first share of the run in which all captured nodes are held, for the start is never resolved.
    """

    stiffness: float | None = None
    damping: float | None = None
    relative_stiffness: float | None = None
    relative_damping: float | None = None
    hold: int | None = None
    hold_start: float = START

    def __post_init__(self) -> None:
        if self.stiffness is not None:
            positive("exudyn.contact.stiffness", self.stiffness)
        if self.damping is not None:
            non_negative("exudyn.contact.damping", self.damping)
        if self.relative_stiffness is not None:
            positive("exudyn.contact.relative_stiffness", self.relative_stiffness)
        if self.relative_damping is not None:
            non_negative("exudyn.contact.relative_damping", self.relative_damping)
        if self.hold is not None:
            whole("exudyn.contact.hold", self.hold, 0)
        between("exudyn.contact.hold_start", self.hold_start, 0.0, 1.0)

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        length = beam.tributary[wall.nodes]
        local = length.copy()
        if wall.half:
            local[0] *= 2.0  # the node of symmetry stands for half of its neighbourhood
        stiffness, damping = self.relative_stiffness, self.relative_damping
        if stiffness is None:
            stiffness = chosen_stiffness(beam.shape.s, wall)
        if damping is None:
            damping = DAMPING * math.sqrt(stiffness / STIFFNESS)
        k, d = penalty_per_length(local, stiffness, damping)
        if self.stiffness is not None:
            k = np.full_like(local, self.stiffness / wall.stiffness_unit)
        if self.damping is not None:
            d = np.full_like(local, self.damping / wall.damping_unit)
        strip = HeldStrip(wall, chosen_hold(wall, self.hold), self.hold_start)
        chosen = {"relative_stiffness": stiffness, "relative_damping": damping}
        return _Run(beam, wall, k * length, d * length, strip, chosen)
