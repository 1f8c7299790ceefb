"""What a reader should know of a case itself, whatever is computed for it."""

from __future__ import annotations

import math

from bent_beam.impact import Impact
from bent_beam.section import Section

__all__ = ["doubts", "steepness"]

STEEP = 0.3  # slope of the bow at the beam's ends from which the small-slope theory deserves a warning
STRAIGHTENED = 0.1  # N L²/(π² EI) from which a tension deserves one


def steepness(impact: Impact) -> list[str]:
    """A sentence on a steep bow."""
    slope = impact.relative_curvature * impact.half_length
    steep = (
        f"the bow's own slope at its ends is {slope:.2g}: theory and simulation are for small slopes (at 0.5 the force "
        "is about 10 % larger)"
    )
    return [steep] if slope >= STEEP else []


def doubts(impact: Impact, section: Section | None) -> list[str]:
    """Sentences on straight beams, bows that a tension straightens, and what a stress includes."""
    found = []
    alike = not (impact.supported or impact.off_centre or impact.wall_in_part)
    if impact.relative_curvature == 0.0 and alike and impact.wall_stiffness is None:
        found.append(
            "a straight beam touches a rigid wall with its whole length at once: its rebound is that of the contact "
            "law, from 0 to 1, not of the beam; give it a bow, or the wall a stiffness"
        )
    force, pull = impact.axial_force, impact.axial_force * impact.length**2
    pull /= math.pi**2 * impact.bending_stiffness
    if pull > STRAIGHTENED and impact.curvature and not impact.supported:
        found.append(
            f"the bow is free of stress and not in equilibrium under the tension, which straightens it (at rest to "
            f"about {100.0 / (1.0 + pull):.2g} % of its height); where other forces hold it, give "
            'beam.tension_direction = "tangent" and impact.acceleration = 0'
        )
    if force and section is not None:
        found.append(f"stresses include |N|/A = {1e-6 * section.stress(0.0, force):.4g} MPa of the axial force")
    return found
