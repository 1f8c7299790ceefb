"""The method of a whole impact, and what it is held against for error bars (docs/exudyn.md, "The whole impact").

Nothing is held, nothing damped but by the beam itself, and every part of the beam matters alike. So

    a uniform mesh,   constant steps at the wall,   the trapezoidal rule,   no viscosity at grid scale.

- A beam that touches in a point takes h = ½Δx²√(μ/EI) and the penalty as it is. So does one with a mesh, an integrator
  or a contact that is given, and one so flat (κ/ν < 1/150) that its penalty becomes stiffer with its front.
- Where a zone spreads, elements lose energy as they land, and e is off by it, about in proportion to Δx. So there
  elements are shorter, and to make up for it steps are 2√2 times ½Δx²√(μ/EI), and the penalty is an eighth as stiff,
  with the same damping ratio: kh² and dh stay what they are.
- Off the wall there are only waves of ω ~ 1/√(ηT*): the steps of a damped beam grow there with its gap.
- A rigid plate, whose hits are plastic, takes steps four times as long.
- Elements that are shorter than l_s follow shear waves, and so do steps: h = ½Δx/c_s, or twice as long.
"""

import dataclasses
import math
from typing import Any, TypeVar

import numpy as np

from bent_beam import Impact
from bent_beam.loads import wall_scales
from bent_beam.meshes import UniformMesh
from exudyn_models.contacts import Penalty, penalty
from exudyn_models.elements import chosen_element
from exudyn_models.geometry import supports_or_plate
from exudyn_models.integrators import Implicit, Trapezoidal
from exudyn_models.resolution import STEP, near_buckling, resolving_step, shortest_element
from exudyn_models.solvers import NewtonSolver, filled

M = TypeVar("M", bound=Any)  # :class:`exudyn_models.method.ExudynModel`, which has these functions as methods

UNHELD = Penalty(hold_start=0.0)
ON_PLATE = Penalty(relative_stiffness=penalty.STIFFNESS, relative_damping=penalty.PLASTIC, hold_start=0.0)
POINT_ELEMENTS = 100  # of a half beam that touches in a point; half as many: e moves by 4e-5
ZONE_ELEMENTS = 240  # where a zone spreads, κ/ν < 1; 220 to 300: e within 1.5e-4 at κ/ν = 0.4, η/T* = 1e-2, the worst
SLOWER = 2.0 * math.sqrt(2.0)  # its steps; the penalty is softer by the square. Twice as long: e is 5e-4 off there
SLOWER_ON_PLATE = 4.0  # steps where hits are plastic: the impulse moves by 1e-4, the moment by 3e-4
LARGEST_OF_WALL = 0.25  # ℓ_k: elements before a wall that gives way
SHEARED_ELEMENTS = 160  # of a half beam that shears
SLOWER_SHEARED, THICK = 2.0, 0.35  # times longer steps, from κ/ν = THICK on: at 0.2 they move e by 2e-4, at 0.1 by 0.01
FLIGHT, DAMPED_FLIGHT = 5e-4, 0.04  # steps off the wall, over T* and √(ηT*)
ABSOLUTE = 1e-5  # of the amplitude: Newton stalls at 1e-8 on 240 elements, geometrically exact ones at 1e-6
RELATIVE = 1e-8  # of what a step begins with: 1e-5 of a long step's is up to 3e-5 of the energy
FLATTEST_FRONT = 1.0 / 150.0  # κ/ν down to which the front does not ask for a stiffer penalty


def for_whole_beam(method: M, impact: Impact) -> M:
    """A copy of ``method`` whose open parts are those of the module's head; its ``refine`` is worked in."""
    wall = wall_scales(impact)
    elements = ZONE_ELEMENTS if impact.kappa_over_nu < 1.0 and wall is None else POINT_ELEMENTS
    if impact.shear_stiffness is not None:
        elements = SHEARED_ELEMENTS
    if wall is not None:
        elements = max(elements, round(impact.half_length / (LARGEST_OF_WALL * wall.length)))
    mesh = method.mesh or UniformMesh(impact.half_length / round(elements * near_buckling(impact)))
    mesh = mesh.refined(method.refine)
    chosen = wall is None and method.mesh is None and method.contact is None and method.integrator is None
    plate = supports_or_plate(impact)  # whose flat beams meet all of it at once, without a front
    spreads = FLATTEST_FRONT <= impact.kappa_over_nu < 1.0
    slower = 1.0 if not chosen else SLOWER_ON_PLATE if plate else SLOWER if spreads else 1.0
    if shears := shortest_element(mesh, impact) < impact.shear_length:
        plate, slower = False, SLOWER_SHEARED if chosen and impact.kappa_over_nu >= THICK else 1.0
    integrator = Trapezoidal() if method.integrator is None else method.integrator.refined(method.refine)
    if isinstance(integrator, Implicit) and integrator.is_open:
        step, slow = slower * resolving_step(mesh, impact), impact.slow_time_scale
        flight = min(FLIGHT * slow, DAMPED_FLIGHT * math.sqrt(impact.damping * slow))
        free = wall is None and impact.shear_stiffness is None and not supports_or_plate(impact)
        flight_step = flight if free and flight > 2.0 * step else None  # None: steps off the wall are like those at it
        integrator = dataclasses.replace(integrator, time_step=step, flight_step=flight_step)
    element = method.element or chosen_element(impact)
    contact = method.contact
    if contact is None and wall is None:
        softer = slower != 1.0 and not shears
        contact = ON_PLATE if plate else _softer(UNHELD, slower**-2) if softer else UNHELD
    solver = method.solver
    if not integrator.explicit:
        solver = filled(solver, NewtonSolver(relative_tolerance=RELATIVE))
    if contact is not None and getattr(integrator, "flight_step", None):
        solver = filled(solver, NewtonSolver(absolute_tolerance=ABSOLUTE))
    return dataclasses.replace(
        method,
        mesh=mesh,
        element=element if element.viscosity is not None else dataclasses.replace(element, viscosity=0.0),
        integrator=integrator,
        contact=contact,
        solver=solver,
        full_beam=method.full_beam or impact.off_centre,
        refine=1.0,
    )


def cross_checks(method: M, impact: Impact) -> dict[str, M]:
    """What stands beside ``method`` for error bars, by cause: of a penalty, a quarter of the stiffness, whose own time
    is twice as long, with such steps; where elements resolve shear waves, the other of the two dashpots."""
    chosen = for_whole_beam(method, impact)
    integrator, contact, shortest = chosen.integrator, chosen.contact, shortest_element(chosen.mesh, impact)
    if not isinstance(contact, Penalty):
        return {}
    if shortest < impact.shear_length and contact.relative_damping is contact.damping is None:
        own = penalty.matched(shortest, impact.shear_length, impact.damping * impact.wave_constant)
        other = dataclasses.replace(contact, relative_damping=penalty.DAMPING if own else penalty.MATCHED)
        return {"contact_law": dataclasses.replace(chosen, contact=other)}
    softer = _softer(contact, 0.25)
    return {"contact_law": dataclasses.replace(chosen, integrator=integrator.refined(0.5), contact=softer)}


def _softer(contact: Penalty, factor: float) -> Penalty:
    """A penalty of ``factor`` times the stiffness with the same damping ratio; damping left open follows by itself."""
    if contact.stiffness is None and contact.relative_stiffness is None:
        contact = dataclasses.replace(contact, relative_stiffness=penalty.STIFFNESS)
    by = dict.fromkeys(("stiffness", "relative_stiffness"), factor)
    by |= dict.fromkeys(("damping", "relative_damping"), math.sqrt(factor))
    given = {name: getattr(contact, name) for name in by}
    return dataclasses.replace(contact, **{name: one * by[name] for name, one in given.items() if one is not None})


def varied(method: M, impact: Impact, random: np.random.Generator) -> M:
    """A method for an ensemble: elements, steps and stiffness of the penalty drawn at random."""
    elements = int(random.integers(2 * POINT_ELEMENTS // 5, 4 * POINT_ELEMENTS // 5))
    length = impact.half_length / elements
    step = STEP * 2.0 ** random.uniform(-0.5, 0.5) * length**2 / impact.wave_constant
    contact = _softer(UNHELD, 2.0 ** random.uniform(-2.0, 0.0)) if impact.wall_stiffness is None else None
    return dataclasses.replace(
        method, mesh=UniformMesh(length), integrator=Trapezoidal(time_step=step), contact=contact
    )
