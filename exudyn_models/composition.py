"""What a run is made of: the parts of a method, each given or left to be chosen from the problem."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Self

from bent_beam.checks import positive
from bent_beam.meshes import Mesh
from exudyn_models.contacts import Contact
from exudyn_models.elements import Element
from exudyn_models.geometry import Geometry
from exudyn_models.integrators import Integrator
from exudyn_models.solvers import NewtonSolver

__all__ = ["Composition"]


@dataclass(frozen=True)
class Composition:
    """Parts of :class:`exudyn_models.ExudynModel`, which says what they are."""

    mesh: Mesh | None = None
    element: Element | None = None
    integrator: Integrator | None = None
    contact: Contact | None = None
    geometry: Geometry | None = None
    solver: NewtonSolver | None = None
    full_beam: bool = False
    refine: float = 1.0

    def __post_init__(self) -> None:
        if not isinstance(self.full_beam, bool):
            raise ValueError(f"full_beam must be true or false (got {self.full_beam!r})")
        positive("refine", self.refine)

    def refined(self, factor: float) -> Self:
        """A copy with elements and steps ``factor`` times finer."""
        return dataclasses.replace(self, refine=self.refine * factor)
