"""The self-similar path as a method."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Annotated, ClassVar

from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact, checked_impact
from bent_beam.loads import unmodelled
from bent_beam.method import Progress, Save
from self_similar_fe.mesh import MESHES, ExpandingMesh
from self_similar_fe.run import simulate_expanding

MODELLED = ("acceleration", "curvature_rate", "fourth_derivative", "axial_force")
"""The loads that :mod:`self_similar_fe.run` models."""

BREAKS = {
    "damping": "set beam.damping = 0",
    "rotation": "set impact.rotation = 0",
    "first_touch": "set impact.first_touch = 0",
    "opposite_wall": "leave wall.opposite out",
}
"""What leaves no motion that is always the same over √t, and what to do without it."""


@dataclass(frozen=True)
class SelfSimilarFE(Part):
    """Finite elements in similarity coordinates: an infinite beam, steady at leading order.

    >>> from bent_beam import Impact
    >>> from self_similar_fe import SelfSimilarFE
    >>> history = SelfSimilarFE().simulate(Impact.dimensionless(0.5), end_time=0.1)
    >>> bool(abs(history.array("total_impulse")[-1] - 1.188) < 0.001)
    True
    """

    path: ClassVar[str] = "self_similar"
    perturbation: ClassVar[float] = 0.025
    """How much a load may change the free motion at the end of a run that measures λ₁ and r₁, over V₀t.

    At twice as much r₁ under ψ is 3 % off by its third order, at less than half the front that passes from element to
    element makes noise of 2 %.
    """
    PARTS: ClassVar[dict[str, dict[str, type]]] = {"mesh": MESHES}

    mesh: ExpandingMesh | None = None
    refine: Annotated[float, Quantity("", "refinement factor of elements; steps follow", above=0.0)] = 1.0
    label: str = "Self-similar"

    def refuses(self, impact: Impact) -> str | None:
        """Why this method cannot take ``impact``, naming the field (``None``: it can)."""
        for name, instead in BREAKS.items():
            if value := getattr(checked_impact(impact), name):
                why = f"{name} breaks the self-similarity that this path rests on (got {value:.4g})"
                return f"{why}: {instead}, or take the path hermite or exudyn"
        if impact.relative_curvature == 0.0:
            return "curvature must be positive: a flat beam meets the wall everywhere at once (got 0.0)"
        return unmodelled(impact, MODELLED)

    def simulate(
        self, impact: Impact, *, end_time: float | None = None, save: Save = 200, progress: Progress | None = None
    ) -> ImpactHistory:
        """Follow ``impact`` over the mesh's decades of time up to ``end_time``, s (by default 0.1 t*, but 0.01 T* at
        most)."""
        end = checked_impact(impact).checked_end_time(end_time)
        if reason := self.refuses(impact):
            raise InputError(reason)
        return simulate_expanding(impact, self._mesh_for(impact), end_time=end, save=save, progress=progress)

    def chosen_for(self, impact: Impact, end_time: float) -> SelfSimilarFE:
        """A copy with the mesh that the load of ``impact`` asks for."""
        return dataclasses.replace(self, mesh=self._mesh_for(impact), refine=1.0)

    def _mesh_for(self, impact: Impact) -> ExpandingMesh:
        return (self.mesh or chosen_mesh(impact)).refined(self.refine)

    def refined(self, factor: float) -> SelfSimilarFE:
        """A copy with elements and steps ``factor`` times finer."""
        return dataclasses.replace(self, refine=self.refine * factor)


def chosen_mesh(impact: Impact) -> ExpandingMesh:
    """The mesh of a run of which none is given."""
    if impact.zone_pressure > 0.0:
        # The load must close the last trace of lift long before the fit begins: early start, finest front.
        # Nothing happens within a step but that, so steps may be long.
        return ExpandingMesh(front_resolution=0.0015, interior_elements=60, step_ratio=0.06, decades=6.0)
    if impact.zone_pressure < 0.0:
        # The contact is one or two nodes that the front passes on: steps shorter than its passage.
        return ExpandingMesh(front_resolution=0.005, interior_elements=60, step_ratio=0.01, decades=6.0)
    if impact.axial_force:
        # Tension alone moves the front: it must pass the finest elements, whose size is the noise of λ_c.
        return ExpandingMesh(front_resolution=0.003, step_ratio=0.01)
    return ExpandingMesh()
