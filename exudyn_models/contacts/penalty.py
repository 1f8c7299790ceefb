"""Penalty at the nodes (Exudyn's ``ObjectContactCoordinate``), spring and dashpot that push and never pull.

    R_i = b_i max(0, k y_i + d ẏ_i),   b_i the length of beam that node i stands for
    k = C μ/τ²,   d = D μ/τ,   τ = √(μ/EI) Δx² √(1 + Φ), Φ = 0 without shear: k = C EI/Δx⁴, d = D √(EIμ)/Δx²

So a node is pushed a little before it touches: as soon as the gap that it would have a time d/k later is closed,
0 ≤ R ⊥ −(y + (d/k) ẏ − R/(bk)) ≥ 0. With C = 10 and D = 3, d/k = 0.3 τ. The states of a step are those of a linear
complementarity problem with a P-matrix, hence unique. Exudyn's own law, spring and dashpot on while y > 0, pulls a beam
that leaves; :mod:`exudyn_models.settling` writes these states over its.

Other C and D (measured: docs/exudyn.md):

- where the front passes an element faster than it bends. With λ = √(2ν/κ), the front's bound, it passes Δx at x in
  t = 2xΔx/λ² √(μ/EI), and C = (λ²Δx/x)² makes √(k/μ) t = 2, with the damping ratio of 10 and 3;
- with shear d Δx = 2√(κ_sGA μ), D = 4√3, takes up shear waves without reflection. Not where η is several τ (κ/ν = 0.1,
  η/T* = 3e-3: e = 0.13 for 0.23);
- behind a thin front D = 40 makes hits plastic. What is left adds to r₀ like 1/D². The coarser run of an error bar
  shows it: D is 40 times ``plastic``, the factor of refinement, 1 at most. Not with a ``hold``: its springs pull nodes
  stopped ahead of the wall.

The springs and dashpots of a wall that gives way, at the nodes, are the wall's own and do not change with the mesh:

    R_i = max(0, k b_i y_i + c w_i ẏ_i) where y_i > 0, 0 elsewhere,   b_i the length of wall that node i stands for.

With w_i = b_i each node would add c b_i V₀ at once as it lands. So w_i is the length that is covered. Of an element
with both nodes in the wall each has Δx/2, node i alone sΔx, s = y_i/(y_i − y_{i+1}), where velocities carry the beam by
the end of the step.
"""

import math
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar

import exudyn.itemInterface as items
import numpy as np

from bent_beam import Impact
from bent_beam.errors import InputError
from bent_beam.fields import Quantity
from bent_beam.impact import AT_ONCE
from exudyn_models.contacts.base import START, TINY, Contact, ContactRun, HeldStrip, Hold, Wall
from exudyn_models.elements import Beam, Element
from exudyn_models.geometry import Array, Flags, element_times
from exudyn_models.integrators import Integrator, Trapezoidal
from exudyn_models.solvers import USUAL, NewtonSolver

STIFFNESS, DAMPING = 10.0, 3.0  # C and D
PLASTIC = 40.0  # D behind a thin front
MATCHED = 4.0 * math.sqrt(3.0)  # D with shear, elements shorter than l_s: d Δx = 2√(κ_sGA μ) …
DAMPED = 4.0  # … unless the material's own damping takes as many element times: hits are then plastic by themselves
CHOSEN_STIFFNESS = f"{STIFFNESS:g} or more (whole beam, κ/ν < 1: 1.25)"
CHOSEN_DAMPING = f"{DAMPING:g}√(C/10) (thin front {PLASTIC:g}, with shear {MATCHED:.3g} times that root)"


def matched(element: float, shear_length: float, damping: float) -> bool:
    """Whether D is :data:`MATCHED` with the shortest ``element``; ``damping`` of the material, over √(μ/EI)."""
    return element < shear_length and damping < DAMPED * float(element_times(np.array(element), shear_length))


def chosen_stiffness(beam: Beam, wall: Wall) -> float:
    """C of the module's text: 10, or what the front asks for at the end of the run."""
    s, front = beam.shape.s, beam.scaling.front
    k = min(max(int(np.searchsorted(s, front)), 1), s.size - 1)
    length = s[k] - s[k - 1]
    asked = front**2 * element_times(length, beam.scaling.shear_length) / length / s[k]
    late = beam.shears and wall.waves_return < 1.0  # steps follow shear waves, and not the front
    return STIFFNESS if late else max(STIFFNESS, float(asked) ** 2)


class PenaltyRun(ContactRun):
    """Springs and dashpots at the nodes; ``stiffness`` and ``damping`` of each contact point, shape (contacts,)."""

    imposes = True

    def __init__(self, beam: Beam, wall: Wall, stiffness: Array, damping: Array, strip: HeldStrip) -> None:
        nodes, wall_y, signs = wall.nodes, beam.shape.wall_y[wall.nodes], np.ones(wall.nodes.size)
        if wall.opposite is not None:
            nodes = np.tile(nodes, 2)
            stiffness, damping = np.tile(stiffness, 2), np.tile(damping, 2)
            wall_y = np.concatenate([wall_y, np.full(wall.nodes.size, wall.opposite)])
            signs = np.concatenate([signs, -signs])
        super().__init__(beam, nodes, wall_y, signs)
        self.strip: HeldStrip = strip
        self.stiffness, self.damping, self.explicit = stiffness, damping, wall.explicit
        self.held = np.zeros(nodes.size, bool)
        markers = [beam.marker(int(node), beam.vertical_coordinate) for node in nodes]
        self.connectors = [beam.mbs.AddObject(self._connector(k, marker)) for k, marker in enumerate(markers)]
        if strip.until:
            self.holders = [beam.mbs.AddObject(self._holder(k, marker)) for k, marker in enumerate(markers)]

    def _connector(self, k: int, marker: Any) -> Any:
        beam, sign, units = self.beam, self.signs[k], self.beam.units
        # open at t = 0: a closed one would put its damping into the initial accelerations
        gap = max(1e-14, float(sign * (self.wall_y[k] - beam.shape.y[self.nodes[k]])))
        state = items.NodeGenericData(numberOfDataCoordinates=1, initialCoordinates=[gap * units.length])
        return items.ObjectContactCoordinate(
            markerNumbers=[marker, beam.ground_marker][:: int(sign)],
            nodeNumber=beam.mbs.AddNode(state),
            contactStiffness=self.stiffness[k] * units.stiffness,
            contactDamping=self.damping[k] * units.damping,
            offset=-sign * self.wall_y[k] * units.length,
        )

    def _holder(self, k: int, marker: Any) -> Any:
        units = self.beam.units
        return items.ObjectConnectorCoordinateSpringDamper(
            markerNumbers=[self.beam.ground_marker, marker],
            stiffness=self.stiffness[k] * units.stiffness,
            damping=self.damping[k] * units.damping,
            offset=self.wall_y[k] * units.length,
            activeConnector=False,
        )

    def _law(self, q: Array, v: Array) -> tuple[Array, Flags]:
        """Force of spring and dashpot off the wall, and where they act."""
        force = self.stiffness * self.depth(q) + self.damping * (self.signs * v[self.coordinates])
        return force, force > 0.0

    def closed_by(self, q: Array, v: Array) -> Flags:
        return self._law(q, v)[1]

    def forces(self, q: Array, v: Array) -> tuple[Array, Flags]:
        force, closed = self._law(q, v)
        active = closed | self.held
        self.strip.captured |= active[: self.strip.captured.size]
        return np.where(active, self.signs * force, 0.0), active

    def plain_forces(self, q: Array, v: Array) -> Array:
        return np.where(self.depth(q) > 0.0, self.signs * self._law(q, v)[0], 0.0)

    def stored_energy(self, q: Array) -> float:
        depth = self.depth(q)
        return float((self.stiffness * np.where(self.held, depth, np.maximum(depth, 0.0)) ** 2).sum() / 2)

    def contradictions(self, q: Array, v: Array, closed: Flags) -> Array:
        force, shown = self._law(q, v)
        return np.where((shown != closed) & ~self.held, np.abs(force), 0.0)

    def between(self, time: float, step: float, q: Array, v: Array) -> bool:
        wanted = np.zeros_like(self.held)
        wanted[: self.strip.captured.size] = self.strip.wanted(time)
        changed = np.flatnonzero(wanted != self.held)
        for k in changed:
            self.beam.mbs.SetObjectParameter(self.holders[k], "activeConnector", bool(wanted[k]))
            # the one-sided connector stays active without force: deactivated, Exudyn repeats steps for it in vain
            for name, value in (("contactStiffness", self.stiffness[k]), ("contactDamping", self.damping[k])):
                self.beam.mbs.SetObjectParameter(self.connectors[k], name, 0.0 if wanted[k] else float(value))
        self.held = wanted
        if self.explicit:  # nothing is repeated: the state at the start of a step serves all of it
            data, closed = self.beam.mbs.systemData, self.closed_by(q, v)
            if not np.array_equal(closed, data.GetDataCoordinates() <= 0.0):
                data.SetDataCoordinates(np.where(closed, -TINY, TINY))
        return bool(changed.size)

    def stiffness_and_damping(self) -> tuple[Array, Array]:
        k, d = np.zeros((2, self.beam.shape.s.size))
        k[self.nodes], d[self.nodes] = self.stiffness, self.damping  # a node touches one wall at a time
        return k, d


@dataclass(frozen=True)
class Penalty(Contact):
    """Nodal penalty: the default."""

    relative_stiffness: Annotated[
        float | None, Quantity("", "C in k = C EI/Δx⁴ per length of beam", above=0.0, absent=CHOSEN_STIFFNESS)
    ] = None
    relative_damping: Annotated[
        float | None, Quantity("", "D in d = D √(EIμ)/Δx²", least=0.0, absent=CHOSEN_DAMPING)
    ] = None
    stiffness: Annotated[
        float | None, Quantity("N/m²", "k itself: N/m per m of beam, of all nodes alike", above=0.0, absent="as C says")
    ] = None
    damping: Annotated[
        float | None, Quantity("N s/m²", "d itself: N s/m per m of beam", least=0.0, absent="as D says")
    ] = None
    hold: Hold = 0
    hold_start: Annotated[
        float | None,
        Quantity(
            "", "first share of the run in which all captured nodes are held", least=0.0, most=START,
            absent=f"{START:g}; 0: loads, damping or shear lift the zone, thin front, waves are back, explicit steps",
        ),
    ] = None  # fmt: skip

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("stiffness", "damping"):
            if getattr(self, name) is not None and getattr(self, f"relative_{name}") is not None:
                raise InputError(f"{self.where}.{name} and relative_{name} exclude each other: give one")

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        length, local = beam.tributary[wall.nodes], beam.tributary[wall.nodes]
        if wall.half:
            local[0] *= 2.0  # the node of symmetry stands for half of its neighbourhood
        plastic = 0.0 if self.hold else wall.plastic
        stiffness, damping = self.relative_stiffness or chosen_stiffness(beam, wall), self.relative_damping
        if damping is None:
            own = matched(float(beam.lengths.min()), beam.scaling.shear_length, beam.scaling.material_damping)
            damping = MATCHED if own else PLASTIC * plastic if plastic else DAMPING
            damping *= math.sqrt(stiffness / STIFFNESS)
        times = element_times(local, beam.scaling.shear_length)
        k = stiffness / times**2 if self.stiffness is None else self.stiffness / beam.scaling.stiffness
        d = damping / times if self.damping is None else self.damping / beam.scaling.damping
        strip = HeldStrip(wall, self.hold, 0.0 if plastic and self.hold_start is None else self.hold_start)
        chosen = {"stiffness": stiffness, "damping": damping}
        run = PenaltyRun(beam, wall, k * length, d * length, strip)
        run.chosen = {f"relative_{name}": one for name, one in chosen.items() if getattr(self, name) is None}
        return run


def covered(depth: Array, lengths: Array) -> Array:
    """w of all nodes, (nodes,), at such depths, elements of ``lengths``, (nodes − 1,), between them."""
    left, right, found = depth[:-1], depth[1:], np.zeros(depth.size)
    with np.errstate(divide="ignore", invalid="ignore"):
        for node, other, end in ((left, right, found[:-1]), (right, left, found[1:])):
            share = np.where(other > 0.0, 0.5, node / (node - other))
            end += np.where(node > 0.0, share, 0.0) * lengths
    return found


class SpringsRun(PenaltyRun):
    def __init__(self, beam: Beam, wall: Wall) -> None:
        assert wall.stiffness is not None
        strip = HeldStrip(wall, hold=0, start=0.0)
        super().__init__(beam, wall, wall.stiffness * wall.weights, wall.damping * wall.weights, strip)
        self.wall, self.wall_springs = wall, self.stiffness

    def between(self, time: float, step: float, q: Array, v: Array) -> bool:
        if self.wall.damping and not self.wall.stop:
            at, wall_y = self.beam.vertical, self.beam.shape.wall_y
            share = covered(q[at] + step * v[at] - wall_y, self.wall.lengths)
            # the pressure of what lands begins at the rim with a jump, that of what leaves ends there with none
            leaves = v[at][self.nodes] < 0.0
            damping = self.wall.damping * np.where(leaves, self.wall.weights, share[self.nodes])
            changed = np.flatnonzero(damping != self.damping)
            for k in changed:
                self.beam.mbs.SetObjectParameter(self.connectors[k], "contactDamping", float(damping[k]))
            self.damping = damping
            return bool(changed.size)
        return False

    def _law(self, q: Array, v: Array) -> tuple[Array, Flags]:
        force, closed = super()._law(q, v)
        return force, closed & (self.depth(q) > 0.0)

    def landing(self, depth: Array, speed: Array) -> Array:
        impact = self.beam.scaling.impact
        share = impact.damping_at_landing / (impact.wall_damping or 1.0)
        low, high, after = depth[:-1].min(axis=1), depth[:-1].max(axis=1), depth[1:].max(axis=1)
        at_once = (high <= 0.0) & (after > 0.0) & (high - low <= AT_ONCE * (after - high))
        return np.where(at_once[:, None], share * self.wall.damping * self.wall.weights * speed[:-1], 0.0)


@dataclass(frozen=True)
class Springs(Contact):
    """What stands in the place of a contact where the wall has a stiffness; it has no settings of its own."""

    integrator: ClassVar[Integrator] = Trapezoidal()  # conserves energy: an elastic wall gives back what it took
    # what elements much shorter than the zone leave as round-off is no residual; a contact that changes by less would
    # push on for a while as the beam leaves a soft wall
    solver: ClassVar[NewtonSolver] = replace(USUAL, absolute_tolerance=1e-6, contact_tolerance=1e-7)

    def refuses(self, impact: Impact, element: Element, integrator: Integrator) -> str | None:
        if impact.opposite_wall is not None:
            return f"wall_stiffness is modelled without opposite_wall only (got {impact.opposite_wall!r})"
        if integrator.explicit:
            return f"wall_stiffness needs an implicit exudyn.integrator (got {type(integrator).__name__})"
        return None

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        return SpringsRun(beam, wall)
