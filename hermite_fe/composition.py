"""What a run is made of: the parts of a method, each given or left to be chosen from the problem."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Self

from bent_beam.checks import positive
from bent_beam.meshes import Mesh
from hermite_fe.contacts import Contact
from hermite_fe.far_fields import FarField
from hermite_fe.integrators import Integrator
from hermite_fe.masses import Mass

__all__ = ["Composition"]


@dataclass(frozen=True)
class Composition:
    """Parts of :class:`hermite_fe.HermiteFE`, which says what they are."""

    mesh: Mesh | None = None
    integrator: Integrator | None = None
    contact: Contact | None = None
    far_field: FarField | None = None
    mass: Mass | None = None
    full_beam: bool = False
    domain: float | None = None
    refine: float = 1.0

    def __post_init__(self) -> None:
        if not isinstance(self.full_beam, bool):
            raise ValueError(f"full_beam must be true or false (got {self.full_beam!r})")
        positive("refine", self.refine)
        if self.domain is not None:
            positive("domain", self.domain)

    def refined(self, factor: float) -> Self:
        """A copy with elements and steps ``factor`` times finer."""
        return dataclasses.replace(self, refine=self.refine * factor)
