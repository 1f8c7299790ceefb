"""Mesh and steps before a wall that gives way: its scales ℓ_k and t_k (:mod:`bent_beam.loads`) rule.

The pressure falls off at the rim of the zone over some ℓ_k, and the force rises and falls over some t_k, whatever the
zone does. A zone that is short when the force is largest, κ/ν > 1, has then a half length of about ℓ_k(κ/ν)^−⅜.
"""

from __future__ import annotations

from bent_beam.impact import Impact
from bent_beam.loads import WallScales
from bent_beam.meshes import GradedMesh, Mesh

__all__ = ["ELASTIC_STEP", "elastic_mesh", "even_element"]

ELEMENT, LARGEST = 0.08, 0.25  # of ℓ_k: elements over the zone, and of a whole beam
GROWTH_OUTSIDE = 1.015
REACH = 4.0  # ℓ_k beyond the front
MOST_ELEMENTS = 2_000  # over the zone
ELASTIC_STEP = 0.01  # of t_k


def elastic_mesh(impact: Impact, wall: WallScales, half: float, front: float) -> Mesh:
    """Elements over the zone up to the crude place ``front``, m, of its end and some ℓ_k beyond."""
    zone = min(front + REACH * wall.length, half)
    short = min(1.0, max(impact.kappa_over_nu, 1e-9) ** -0.375)
    element = min(max(ELEMENT * short * wall.length, zone / MOST_ELEMENTS), 0.1 * half)
    return GradedMesh(element_length=element, growth=GROWTH_OUTSIDE, zone=zone, size_ratio=1e6)


def even_element(wall: WallScales, half: float) -> float:
    """Length of equal elements of the whole beam, m."""
    return max(LARGEST * wall.length, half / MOST_ELEMENTS)
