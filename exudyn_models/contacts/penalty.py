"""Penalty at the nodes (Exudyn's ``ObjectContactCoordinate``), spring and dashpot that push and never pull.

    R_i = b_i max(0, k y_i + d ẏ_i),   b_i the length of beam that node i stands for
    k = C EI/Δx⁴,   d = D √(EIμ)/Δx²

It is the complementarity 0 ≤ R ⊥ −(y + (d/k) ẏ − R/(bk)) ≥ 0 of the gap a time d/k ahead, 0.3 Δx² for
C = 10 and D = 3, so that the dashpot takes hold just before the wall and lets go just before it would pull. The states
of a step are those of a linear complementarity problem with a P-matrix, hence unique. Exudyn's own law, dashpot on
while y > 0, pulls a beam that leaves; :mod:`exudyn_models.settling` writes these states over its.

With k and d tied to the element length the contact is as stiff as the elements themselves, on every scale of the
mesh. Where κ/ν is so small that the front passes an element faster than the element bends, the contact must be as fast
as the front: it passes Δx at x in t = 2xΔx/λ² √(μ/EI), and C = (λ²Δx/x)² makes √(k/μ) t = 2. The damping ratio stays
that of 10 and 3. Explicit solvers keep Exudyn's law; there d = 0 unless given.
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
from exudyn_models.contacts.holding import START, HeldStrip
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
        self.wall_y = beam.shape.wall_curvature * self.contact_s**2 / 2
        self.strip = strip
        self.imposes = not wall.explicit
        self.held = np.zeros(wall.nodes.size, bool)
        self.contacts: list[Any] = []
        self.holders: list[Any] = []
        mbs = beam.mbs
        for k, node in enumerate(wall.nodes):
            marker = beam.marker(int(node), beam.vertical_coordinate)
            # open at t = 0: a closed one would put its damping into the initial accelerations
            state = mbs.AddNode(
                items.NodeGenericData(
                    numberOfDataCoordinates=1,
                    initialCoordinates=[max(1e-14, float(self.wall_y[k] - beam.shape.y[node]))],
                )
            )
            self.contacts.append(
                mbs.AddObject(
                    items.ObjectContactCoordinate(
                        markerNumbers=[marker, beam.ground_marker],
                        nodeNumber=state,
                        contactStiffness=stiffness[k],
                        contactDamping=damping[k],
                        offset=-self.wall_y[k],
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
                            offset=self.wall_y[k],
                            activeConnector=False,
                        )
                    )
                )

    def depth(self, q: Array) -> Array:
        return np.asarray(q[self.beam.vertical[self.nodes]] - self.wall_y)

    def _spring_and_dashpot(self, q: Array, v: Array) -> Array:
        return np.asarray(self.stiffness * self.depth(q) + self.damping * self.velocity(q, v))

    def closed_by(self, q: Array, v: Array) -> Flags:
        return self._spring_and_dashpot(q, v) > 0.0

    def forces(self, q: Array, v: Array) -> tuple[Array, Flags]:
        force = self._spring_and_dashpot(q, v)
        active = (force > 0.0 if self.imposes else self.depth(q) > 0.0) | self.held
        self.strip.captured |= active
        return np.where(active, force, 0.0), active

    def stored_energy(self, q: Array) -> float:
        depth = self.depth(q)
        return float((self.stiffness * np.where(self.held, depth, np.maximum(depth, 0.0)) ** 2).sum() / 2)

    def contradictions(self, q: Array, v: Array, closed: Flags) -> Array:
        force = self._spring_and_dashpot(q, v)
        return np.where(((force > 0.0) != closed) & ~self.held, np.abs(force), 0.0)

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

    @property
    def held_until(self) -> float:
        return self.strip.until

    def settings(self) -> dict[str, Any]:
        return {"hold_elements": self.strip.hold} | self.chosen


@dataclass(frozen=True)
class Penalty(Contact):
    """Nodal penalty: the default.

    stiffness, damping : k in N/m² and d in N s/m² per length of beam; None: from the element length and the next two.
    relative_stiffness, relative_damping : C and D of the module's text; None: chosen, 10 and 3 for κ/ν ≥ 1/150.
    hold : elements behind the front whose captured nodes are held, until waves may be back from the ends; none unless
        asked for.
    hold_start : first share of the run in which all captured nodes are held, for the start is never resolved; None:
        0.01, but none where the load draws the beam off the wall, none in runs longer than the first spread and none
        under explicit integrators.
    """

    stiffness: float | None = None
    damping: float | None = None
    relative_stiffness: float | None = None
    relative_damping: float | None = None
    hold: int = 0
    hold_start: float | None = None

    def __post_init__(self) -> None:
        if self.stiffness is not None:
            positive("exudyn.contact.stiffness", self.stiffness)
        if self.damping is not None:
            non_negative("exudyn.contact.damping", self.damping)
        if self.relative_stiffness is not None:
            positive("exudyn.contact.relative_stiffness", self.relative_stiffness)
        if self.relative_damping is not None:
            non_negative("exudyn.contact.relative_damping", self.relative_damping)
        whole("exudyn.contact.hold", self.hold, 0)
        if self.hold_start is not None:
            between("exudyn.contact.hold_start", self.hold_start, 0.0, START)

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        length = beam.tributary[wall.nodes]
        local = length.copy()
        if wall.half:
            local[0] *= 2.0  # the node of symmetry stands for half of its neighbourhood
        stiffness, damping = self.relative_stiffness, self.relative_damping
        if stiffness is None:
            stiffness = chosen_stiffness(beam.shape.s, wall)
        if damping is None:
            damping = 0.0 if wall.explicit else DAMPING * math.sqrt(stiffness / STIFFNESS)
        k, d = penalty_per_length(local, stiffness, damping)
        if self.stiffness is not None:
            k = np.full_like(local, self.stiffness / wall.stiffness_unit)
        if self.damping is not None:
            d = np.full_like(local, self.damping / wall.damping_unit)
        strip = HeldStrip(wall, self.hold, self.hold_start)
        chosen = {"relative_stiffness": stiffness, "relative_damping": damping}
        return _Run(beam, wall, k * length, d * length, strip, chosen)
