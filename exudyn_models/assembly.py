"""The Exudyn system of one impact: beam, loads, symmetry and contact; and how long a step it bears.

The ends carry the moment EI(q₀x²/2 + c₀t) and the shear EI q₀x of y₀ (nothing when ψ = χ = 0: a free end), so that
without contact y₀ of :class:`bent_beam.Impact` is the motion.
"""

from __future__ import annotations

import math

import exudyn as exu
import numpy as np

from bent_beam.impact import BEFORE_WAVES_RETURN
from exudyn_models.contacts import Contact, ContactRun, Wall
from exudyn_models.elements import Beam, Element
from exudyn_models.elements.beam import VISCOSITY, VISCOSITY_EXPLICIT, Section
from exudyn_models.geometry import Shape
from exudyn_models.integrators import Integrator
from exudyn_models.resolution import lasts_until_waves_return, reachable, thin_front
from exudyn_models.scaling import Scaling, front_bound
from exudyn_models.supports import before_the_wall, hold_ends, supports_or_plate
from exudyn_models.viewer import draw_wall

__all__ = ["assemble", "stable_step"]

STRETCH = 1e-4  # largest strain under the axial force in the linear limit: lengths are then right to as much
TAUT = 1e4  # EAΛ²/EI under it: a strain of N/EA moves the front, too, by 7e-4 of what the force does (λ_N at κ/ν = 0.5)
STRETCH_LATER = 1e-7  # likewise once waves are back: else waves along the beam take up to 1e-2 of the energy


def assemble(
    shape: Shape,
    scaling: Scaling,
    element: Element,
    contact: Contact,
    integrator: Integrator,
    half: bool,
    plastic: float = 1.0,
) -> tuple[Beam, ContactRun]:
    """The Exudyn system: beam, loads, symmetry, contact; ``plastic`` is that of :class:`Wall` at a thin front."""
    container = exu.SystemContainer()
    system = container.AddSystem()
    system.variables["container"] = container  # the system must not outlive it
    factor = element.viscosity
    if factor is None:
        factor = VISCOSITY_EXPLICIT if integrator.explicit else VISCOSITY
    section = Section(
        axial_stiffness=_axial_stiffness(element.axial_stiffness, shape.slender, scaling),
        axial_force=scaling.axial_force,
        damping=scaling.impact.damping / scaling.end_time,
    )
    beam = element.build(system, shape, section, factor * shape.lengths**2)
    last, centre = shape.s.size - 1, int(np.argmin(np.abs(shape.s)))
    if half:
        hold = beam.hold_by_inertia if integrator.explicit else beam.fix
        hold(0, beam.horizontal_coordinate, beam.rotation_coordinate)
    hold_ends(beam, scaling.impact, half=half, by_inertia=integrator.explicit)
    if scaling.load:
        beam.load_uniformly(scaling.load * scaling.amplitude)
    ends = [(last, 1.0)] if half else [(last, 1.0), (0, -1.0)]
    for node, sign in ends:
        _load_end(beam, node, sign, scaling)
    run = contact.attach(beam, _wall(shape, scaling, centre, half, integrator.explicit, plastic))
    draw_wall(system, min(0.0, float(shape.x[0])), float(shape.x[-1]), shape.wall_curvature)
    system.Assemble()
    beam.locate()
    return beam, run


def _axial_stiffness(asked: float | None, true: bool, scaling: Scaling) -> float:
    """EA in EI/Λ². In the linear limit it matters under an axial force only."""
    if asked is not None:
        return asked * scaling.length**2 / scaling.impact.bending_stiffness
    if true:
        return 12.0 * (scaling.length / scaling.impact.section_height) ** 2
    if not scaling.axial_force:
        return 1.0
    later = lasts_until_waves_return(scaling.impact, scaling.end_time)
    return max(TAUT, abs(scaling.axial_force) / (STRETCH_LATER if later else STRETCH))


def _wall(shape: Shape, scaling: Scaling, centre: int, half: bool, explicit: bool, plastic: float) -> Wall:
    impact = scaling.impact
    opposite, stiffness = impact.opposite_wall, impact.wall_stiffness
    first_spread = BEFORE_WAVES_RETURN * impact.slow_time_scale / scaling.end_time
    before, lengths = before_the_wall(shape.s, scaling)
    thin = thin_front(scaling.kappa) and not supports_or_plate(impact)
    unit = impact.bending_stiffness / scaling.length ** (4 if lengths.any() else 3)
    return Wall(
        nodes=np.intersect1d(reachable(shape.s, scaling, centre), np.flatnonzero(before)),
        lengths=lengths,
        centre=centre,
        half=half,
        front=front_bound(scaling.kappa),
        first_spread=first_spread,
        plastic=plastic if thin and first_spread >= 1.0 and not explicit else 0.0,
        lifts=impact.zone_pressure < 0.0 or impact.damping > 0.0 or impact.kappa_over_nu >= 1.0,
        explicit=explicit,
        opposite=None if opposite is None else -opposite / scaling.deflection,
        stiffness=None if stiffness is None else stiffness / unit,
        damping=impact.wall_damping / (unit * scaling.end_time),
    )


def _load_end(beam: Beam, node: int, sign: float, scaling: Scaling) -> None:
    """The moment and shear that the free motion y₀ has at an end of the modelled beam, and the axial force: along x at
    the end of the beam itself unless it follows the bow, along the bow where the model cuts the beam."""
    loads, a, x, force = scaling.loads, scaling.amplitude, float(beam.shape.s[node]), beam.section.axial_force
    impact, angle = scaling.impact, float(beam.shape.angle[node])  # of the beam's own end
    along_x = impact.tension_direction == "axis" and abs(x) * scaling.length >= impact.half_length * (1.0 - 1e-9)
    bending_rate = a * float(loads(x, by_x=2, by_t=1))
    # bending at a rate also takes the moment of the viscosity
    moment = a * float(loads(x, by_x=2)) + beam.viscosity[node if node == 0 else -1] * bending_rate
    beam.load_node(node, beam.rotation_coordinate, sign * moment, sign * bending_rate)
    shear, turning = a * float(loads(x, by_x=3)), a * float(loads(x, by_x=1, by_t=1))
    if along_x:
        angle = turning = 0.0
    beam.load_node(node, beam.horizontal_coordinate, sign * force * math.cos(angle))
    beam.load_node(node, beam.vertical_coordinate, sign * (force * math.sin(angle) - shear), sign * force * turning)


def stable_step(beam: Beam, contact: ContactRun, integrator: Integrator) -> float:
    """limit/ω, ω the largest eigenvalue of any element with its contact closed: a bound for the whole mesh."""
    mass, stiffness, damping = beam.element_matrices()
    k, d = contact.stiffness_and_damping()
    share = beam.lengths / 2
    for end in (0, 1):
        node = slice(end, beam.lengths.size + end)
        part = share / beam.tributary[node]
        stiffness[:, 2 * end, 2 * end] += k[node] * part
        damping[:, 2 * end, 2 * end] += d[node] * part
    solved_k, solved_d = np.linalg.solve(mass, stiffness), np.linalg.solve(mass, damping)
    count = mass.shape[0]
    state = np.zeros((count, 8, 8))
    state[:, :4, 4:] = np.eye(4)
    state[:, 4:, :4], state[:, 4:, 4:] = -solved_k, -solved_d
    largest = float(np.abs(np.linalg.eigvals(state)).max())
    return float(integrator.limit / max(largest, beam.axial_frequency()))
