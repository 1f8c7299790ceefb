"""The bent beam as a :class:`hermite_fe.system.System`.

Unknown is u = y + Kx²/2, the displacement from the bow at the first touch, so that u = 0 is free of stress whatever the
curvature. Seen from the wall y_w = −K_w x²/2 the bow is the shape −(K − K_w)x²/2: the gap is g = (K − K_w)x²/2 − u. The
motion before contact,

    y₀ = V₀t − Kx²/2 + a₀t²/2 + c₀x²t/2 + q₀x⁴/24,                                             (2.2.30)

starts the run (u = q₀x⁴/24, u̇ = V₀ + c₀x²/2) and fixes the load. With an axial force N and the material's damping η

    μü + EI(u_xxxx + ηu̇_xxxx) − Nu_xx = p − NK − r,      p − NK = μa₀ + EI q₀

so neither K nor K_w is left but in the gap. With shear a node turns by its section's angle, which follows the slope of
the bow and of V₀ + c₀x²/2; under q₀ it runs ahead, φ = u_x + l_s²u_xxx (:mod:`bent_beam.scales`). Where an end is held
the start is V₀ times the lowest mode of these ends (:func:`bent_beam.modes.lowest_mode`). A beam that
rocks starts with V₀ + ωx in place of V₀; where the bow's apex is off the middle, x counts from it in y₀ and from the
middle in ωx; both need the full beam.

**The ends** carry N as a dead load. Along the axis, EI(u_xxx + ηu̇_xxx) − Ny_x = 0: against u that is a transverse
force NKL/2 at either end, which starts a wave at once. Along the tangent of the bow at the first touch,
EI(u_xxx + ηu̇_xxx) − Nu_x = 0: its transverse part −NKL/2 balances the pull −NK per length of the bow, no wave starts,
and a₀ is the acceleration of the whole beam. A force that turned with the end would have no potential.

**Walls** stand along a part of the beam, as constraints or as springs. With a second wall behind the beam every node
has a constraint for either:

    g = y_w + c − y ≥ 0 in front,  g = y + D − (y_w at x = 0) ≥ 0 behind: a flat wall at the distance D of the apex

Without a clearance c the run starts with the first touch. A beam with held ends may start at rest in a hole, c from the
wall: it is then bent by c, and slower, when it touches.
"""

from dataclasses import dataclass

import numpy as np

from bent_beam.errors import InputError
from bent_beam.hysteresis import branches_of
from bent_beam.impact import Impact
from bent_beam.meshes import checked_nodes, mirrored, node_at
from bent_beam.modes import lowest_mode
from hermite_fe.banded import product, stiff_product
from hermite_fe.beam import HermiteBeam
from hermite_fe.compiled import Array, Flags
from hermite_fe.contacts import Contact
from hermite_fe.elastic_wall import NO_SPRINGS, Springs
from hermite_fe.far_fields import Dampings, FarField
from hermite_fe.masses import ConsistentMass, Mass
from hermite_fe.maxwell import branches_at_rest
from hermite_fe.stepping import end_moments
from hermite_fe.system import NO_BRANCHES, Bending, ContactRows, System

CONSISTENT = ConsistentMass()
HELD = {"free": 0, "hinged": 1, "clamped": 2}  # dofs of the end node
MODELLED = ("acceleration", "curvature_rate", "fourth_derivative", "axial_force", "rotation", "hysteretic_loss",
            "shear_stiffness", "wall_stiffness", "wall_damping", "wall_clearance", "wall_from", "wall_to", "left_end",
            "right_end")  # fmt: skip
"""The loads and other features that are modelled here."""


@dataclass(frozen=True)
class BeamModel:
    """A system, its start, and how to read it: y = u + ``natural``, and the gap is −(u + ``facing``).

    natural, facing : (dofs,), the bow at the first touch, from the axis and from the wall.
    behind : (rows,), which constraints guard a second wall behind the beam. axial_force : N, tension positive.
    """

    beam: HermiteBeam
    system: System
    displacement: Array
    velocity: Array
    natural: Array
    facing: Array
    behind: Flags
    full: bool
    axial_force: float

    @property
    def copies(self) -> int:
        """How often the model stands in the whole beam: 2 for the half, 1 for the full beam."""
        return 1 if self.full else 2

    def work_of_tension(self, q: Array) -> Array:
        """−½N∫u′² dx, the work of an axial force on the shortening of the axis, J, of each of ``q`` (states, dofs)."""
        if not self.axial_force:
            return np.zeros(len(q))
        bands = self.beam.geometric_stiffness()
        return np.array([-0.5 * self.axial_force * float(u @ product(bands, u)) for u in q])

    def bending_moments(self, q: Array) -> Array:
        """At the nodes, N m, (states, nodes), of each of ``q``, (states, dofs): the mean of both elements there, which
        the load within them does not change."""
        bending = self.system.bending
        rise = np.diff(q[:, 0::2]) / bending.lengths
        strains = q[:, 1:-2:2] - rise, q[:, 3::2] - rise
        left, right = end_moments(bending.stiffness / bending.lengths, bending.phi, *strains)
        inside = 0.5 * (left[:, 1:] + right[:, :-1])
        return np.asarray(bending.free + np.concatenate([left[:, :1], inside, right[:, -1:]], axis=1))

    def gap(self, q: Array) -> Array:
        """Distance of the nodes to the wall, m, (…, nodes), of q, (…, dofs)."""
        return np.asarray(-(q[..., 0::2] + self.facing[0::2]))


def beam_model(
    impact: Impact, nodes: Array, contact: Contact, far_field: FarField, *, full: bool, mass: Mass = CONSISTENT
) -> BeamModel:
    """Assemble the half beam on ``nodes`` (0 … L/2), or the full beam on them and their mirror image.

    The load is laid on in proportion to the mass matrix, as (3.1.9) does, so that a free beam accelerates as a
    rigid body whatever that matrix is; for the consistent one this is the consistent load.
    """
    half = checked_nodes(nodes)
    x = mirrored(half) if full else half
    s = x - impact.first_touch
    branches = branches_of(impact)
    relaxed = impact.bending_stiffness * (1.0 if branches is None else branches.relaxed)
    beam = HermiteBeam(x, relaxed, impact.mass_per_length, impact.shear_stiffness, impact.rotary_inertia)
    bow = beam.interpolate(-0.5 * s**2, -s)
    natural, facing = impact.curvature * bow, impact.relative_curvature * bow
    facing[0::2] -= impact.wall_clearance
    from_behind = -natural
    from_behind[0::2] -= impact.opposite_wall or 0.0
    motion = impact.free_motion(0.0)
    displacement = beam.interpolate(motion(s), motion(s, by_x=1) + impact.shear_length**2 * motion(s, by_x=3))
    velocity = beam.interpolate(motion(s, by_t=1), motion(s, by_x=1, by_t=1))
    if impact.supported:
        velocity = impact.velocity * beam.interpolate(*lowest_mode(impact, x))
    bending_stiffness, inertia = beam.stiffness(), mass.matrix(beam)
    stiffness = bending_stiffness + impact.axial_force * beam.geometric_stiffness()
    dampings = far_field.dampings(beam, impact)
    if impact.damping > 0.0:  # Kelvin–Voigt: C = ηK
        dampings += (("material", impact.damping * bending_stiffness),)
    bent = impact.unbent_curvature - impact.curvature  # what of the bow is elastic
    bending = Bending(beam.lengths, beam.phi, relaxed, impact.bending_stiffness * bent, half.size - 1 if full else 0)
    left = tuple(range(HELD[impact.left_end])) if full else (1,)  # of a half beam the slope in its middle
    supports = left + tuple(range(beam.dofs - 2, beam.dofs - 2 + HELD[impact.right_end]))
    rows = rows_at_walls(contact.rows(beam, facing, full=full), impact, natural, supports)
    system = System(
        mass=inertia,
        stiffness=stiffness,
        dampings=dampings,
        contacts=rows,
        supports=supports,
        bending=bending,
        load=nodal_loads(impact, beam, s, inertia, stiffness, dampings, follows=far_field.end == "following"),
        springs=springs_of(impact, beam, facing, full=full),
        second=NO_SPRINGS if impact.opposite_wall is None else springs_of(impact, beam, from_behind, -1.0, full=full),
        branches=NO_BRANCHES if branches is None else branches_at_rest(bending_stiffness, branches),
    )
    behind = (np.arange(len(rows)) % 2 == 1) & (impact.opposite_wall is not None)
    return BeamModel(beam, system, displacement, velocity, natural, facing, behind, full, impact.axial_force)


def nodal_loads(
    impact: Impact, beam: HermiteBeam, s: Array, inertia: Array, stiffness: Array, dampings: Dampings, *, follows: bool
) -> Array:
    """F(t) = Σ_k load[k]·t^k, shape (powers, dofs), of all loads; s : the nodes from the first touch, m.

    follows : with the end forces of y₀, F = Mü + Cu̇ + Ku of its displacement u, in which K on Hermite interpolants is
        exact at nodes; else of free ends, where the uniform load acts, and what the bow makes of an axial force.
    """
    motion, load = impact.free_motion(0.0), np.zeros((2, beam.dofs))
    uniform = product(inertia, beam.interpolate(np.ones(s.size), np.zeros(s.size)))  # M·1
    load[0] = float(motion(0.0, by_t=2)) * uniform
    share = 1.0 if beam.nodes[0] < 0.0 else 0.5  # half a beam takes half of a force in the middle
    for place, force in impact.forces:
        load[0, 2 * node_at(beam.nodes, place)] += share * force
    if follows:
        bent = motion.bending()
        shape = beam.interpolate(bent(s), bent(s, by_x=1) + impact.shear_length**2 * bent(s, by_x=3))
        rate = beam.interpolate(bent(s, by_t=1), bent(s, by_x=1, by_t=1))
        load[0] += stiff_product(stiffness, shape)
        load[0] += sum((stiff_product(bands, rate) for _, bands in dampings), np.zeros(beam.dofs))
        load[1] = stiff_product(stiffness, rate)
    else:
        load[0] += impact.bending_stiffness * float(motion(0.0, by_x=4)) / impact.mass_per_length * uniform
        if impact.tension_direction == "axis":
            ends = [0, -1] if beam.nodes[0] < 0.0 else [-1]
            load[0, 0::2][ends] += impact.axial_force * impact.curvature * np.abs(s[ends])
    return load if np.any(load[1]) else load[:1]


def rows_at_walls(rows: ContactRows, impact: Impact, natural: Array, supports: tuple[int, ...]) -> ContactRows:
    """``rows`` that stand before the wall, and not at an end that is held; if there is a wall behind the beam, each is
    followed by the same node's there. natural : (dofs,), the bow at the first touch.

    Raises ``ValueError`` where none is left, as before a stop where contact is not at nodes, and before two walls
    where contact is not at nodes.
    """
    at_nodes, kept = rows.dofs.shape[1] == 1, impact.before_wall(rows.places)
    if at_nodes:
        kept &= ~np.isin(rows.dofs[:, 0], supports)
    if not kept.any():
        begin, end = impact.wall_span
        raise InputError(
            f"wall_from: no contact point stands before the wall from {begin!r} to {end!r} m; take "
            "hermite.contact.kind = node"
        )
    rows = rows.at(kept)
    if impact.opposite_wall is None:
        return rows
    if not at_nodes:
        raise InputError('opposite_wall takes hermite.contact.kind = "node" or "alternate"')
    both = rows.at(np.repeat(np.arange(len(rows)), 2))
    both.factors[1::2] *= -1.0
    both.gap[1::2] = natural[rows.dofs[:, 0]] + impact.opposite_wall
    return both


def springs_of(impact: Impact, beam: HermiteBeam, facing: Array, side: float = 1.0, *, full: bool) -> Springs:
    """The springs of a wall that gives way; of a stop in the middle of a half beam, half of them."""
    if impact.wall_stiffness is None:
        return NO_SPRINGS
    first, last = (int(at) for at in np.flatnonzero(impact.before_wall(beam.nodes))[[0, -1]])
    begin, end = impact.wall_span
    share = 0.5 if begin == end and not full else 1.0
    return Springs(
        stiffness=share * impact.wall_stiffness,
        damping=share * impact.wall_damping,
        facing=facing,
        lengths=beam.lengths,
        shares=beam.phi / (1.0 + beam.phi),
        first=first,
        last=last,
        stop=2 * first if begin == end else -1,
        side=side,
        at_landing=share * impact.damping_at_landing,
    )
