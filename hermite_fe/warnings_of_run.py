"""What a reader of a result should know: what the mesh, the steps and the ends of the beam may have done to it."""

import math

import numpy as np

from bent_beam.history import REFLECTED, ImpactHistory
from bent_beam.impact import WAVES_FELT, Impact
from hermite_fe.compiled import Array
from hermite_fe.far_fields import FarField
from hermite_fe.integrators import Integrator
from hermite_fe.model import BeamModel
from hermite_fe.resolution import front

ELEMENTS_PER_FRONT = 2.0  # fewer in ℓ deserve a warning
MOST_ROUNDS = 100  # of the active set in one step; sound runs take ten or so
ABSORBED = "; {} damps it, of which HermiteFE().for_whole_beam(impact) has none"
LARGEST_LIFT = 1e-2  # of V₀t; r₀ may be too large by as much (docs/numerics.md)
EMITTED = 10.0 ** np.arange(-9.0, 1.0, 0.02)  # T*: times at which waves are looked at, the same for all runs
DAMPED = 4.0  # elements within √(cη), or l_s: from then on a lift is the beam's own, in all schemes within a fifth


def rounds_warnings(most: int) -> list[str]:
    """A warning where the contacts of a step hardly settled, after ``most`` rounds."""
    if most <= MOST_ROUNDS:
        return []
    return [
        f"the active set of the contact took {most} rounds in a step: shorter steps or finer elements settle sooner"
    ]


def resolution_warnings(impact: Impact, end_time: float, nodes: Array, integrator: Integrator) -> list[str]:
    """What the mesh and the steps cannot resolve of the front at the end of the run, and by how much."""
    out: list[str] = []
    if impact.kappa_over_nu >= 1.0 or impact.kappa_over_nu == 0.0:  # a point, or all of the beam at once: no front
        return out
    place, thickness = front(impact, end_time)
    element = float(np.diff(nodes)[min(int(np.searchsorted(nodes, min(place, nodes[-1]))), nodes.size - 1) - 1])
    if thickness < ELEMENTS_PER_FRONT * element:
        short = ELEMENTS_PER_FRONT * element / thickness
        out.append(
            "the mesh cannot resolve the contact front: about "
            f"{thickness:.3g} m thick at the end of the run, it spans {thickness / element:.2g} elements "
            f"({element:.3g} m there); {ELEMENTS_PER_FRONT:g} are the least, "
            f"elements {short:.2g} times shorter"
        )
    step = min(max(integrator.time_step or 0.0, (integrator.growth or 0.0) * end_time), end_time)
    travel, room = place * 0.5 * step / end_time, 0.5 * max(thickness, element)
    if travel > room:
        out.append(
            f"the time steps cannot resolve the contact front: it runs about {travel:.3g} m in the last one; "
            f"{room:.3g} m (half its thickness or half an element) is the most, "
            f"steps {travel / room:.2g} times shorter"
        )
    return out


def end_warnings(impact: Impact, end_time: float, nodes: Array, far_field: FarField) -> list[str]:
    """What the ends of the beam may do to the contact within the run.

    A wave of number k travels at 2k√(EI/μ). The front radiates waves of its own number 1/ℓ(t), the shorter
    the earlier, with an energy in proportion to √t: those of the first hundredth of the time until they are
    back carry a tenth. The rest is looked at here, as far as the elements at the end carry it (k Δx < 1; shorter
    waves are absorbed at grid scale).
    """
    out = []
    place, _ = front(impact, end_time)
    half, last = float(nodes[-1]), float(nodes[-1] - nodes[-2])
    if place > half and (0.0 < impact.kappa_over_nu < 1.0 or impact.zone_pressure > 0.0):
        out.append(
            f"the contact may reach the end of the beam: it may spread to {place:.3g} m, the end is at {half:.3g} m"
        )
    emitted = impact.slow_time_scale * EMITTED
    reached, thickness = np.array([front(impact, t) for t in emitted]).T
    arrival = emitted + np.maximum(2.0 * half - reached, 0.0) * thickness / (2.0 * impact.wave_constant)
    returning = arrival[(last < thickness) & (arrival < end_time) & (emitted > 0.01 * arrival)]
    if returning.size and impact.kappa_over_nu > 0.0:  # of a straight beam no front radiates
        out.append(
            f"{REFLECTED} (x = {half:.3g} m) and be back at the contact from about "
            f"t = {float(returning.min()):.2g} s on: from then on it is the impact of this beam, which no theory of an "
            f"endless one covers{ABSORBED.format(far_field.damper) if far_field.damper else ''}"
        )
    far = nodes > 1.5 * place
    free = impact.free_motion(impact.relative_curvature)(nodes, end_time)
    if far_field.end == "following" and np.any(free[far] >= 0.0):
        out.append(
            "the free motion itself meets the wall away from the contact, at x = "
            f"{float(nodes[far][free[far] >= 0.0][0]):.3g} m, before the run ends: shorten the beam"
        )
    return out


def lift_warnings(impact: Impact, model: BeamModel, history: ImpactHistory) -> list[str]:
    """A warning where the zone leaves the wall though nothing lifts it: no load, no waves from the ends (0.005 T*).

    Material damping η does. It stops sections as they land until t ≈ η; the bow's middle then swings back. Elements
    that resolve how far bending runs until then, √(cη), show the beam's own lift. So do those that resolve the shear
    length: the sections' own turning lifts flat zones (docs/shear.md).
    """
    time = history.time
    end = time[-1]
    bounces = impact.wall_stiffness is not None  # it gives back what it took
    if bounces or impact.lifts or end > WAVES_FELT * impact.slow_time_scale:
        return []
    places = model.system.contacts.places[~model.behind] - impact.first_touch
    nodes, worst, widest = model.beam.nodes - impact.first_touch, 0.0, np.zeros(model.beam.nodes.size, bool)
    for k in np.flatnonzero(time > 0.1 * end)[1:]:
        before = history.array("impulse", int(np.searchsorted(time, 0.9 * time[k]) - 1))
        pushed = places[history.array("impulse", k) > before]
        inside = (nodes >= 0.8 * pushed.min(initial=0.0)) & (nodes < 0.8 * pushed.max(initial=0.0))
        lift = np.max(history.array("gap", k)[inside], initial=0.0)
        worst, widest = max(worst, float(lift) / (impact.velocity * time[k])), widest | inside
    longest = float(np.diff(nodes[widest]).max(initial=0.0))
    own = max(math.sqrt(impact.wave_constant * impact.damping), impact.shear_length)
    if worst <= LARGEST_LIFT or (own > 0.0 and own >= DAMPED * longest):
        return []
    return [
        f"the contact zone lifts off the wall by up to {worst:.2g} V₀t in the last decade of time (numbers good to "
        f"1 % need {LARGEST_LIFT:g}): impacts of the unresolved start, or the contact law, have thrown it off; use "
        "finer elements at the centre, a later end time, or Signorini's condition at the new position with contact "
        "at nodes (signorini_position, node)"
    ]
