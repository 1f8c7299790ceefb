"""What a run is made of: the parts of a method, each given or left to be chosen from the problem."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Annotated, Self

from bent_beam.fields import Part, Quantity
from bent_beam.meshes import Mesh
from hermite_fe.contacts import Contact
from hermite_fe.far_fields import FarField
from hermite_fe.integrators import Integrator
from hermite_fe.masses import Mass

__all__ = ["Composition"]


@dataclass(frozen=True)
class Composition(Part):
    """What a run is made of; parts that are ``None`` are chosen for the problem (:mod:`hermite_fe.resolution`)."""

    mesh: Mesh | None = None
    integrator: Integrator | None = None
    contact: Contact | None = None
    far_field: FarField | None = None
    mass: Mass | None = None
    full_beam: Annotated[bool, Quantity("", "both halves instead of one with a symmetry support")] = False
    domain: Annotated[
        float | None,
        Quantity("m", "half length to model; cut ends follow the free motion", above=0.0, absent="all of it"),
    ] = None
    refine: Annotated[float, Quantity("", "refinement factor of elements and steps", above=0.0)] = 1.0

    def refined(self, factor: float) -> Self:
        """A copy with elements and steps ``factor`` times finer."""
        return dataclasses.replace(self, refine=self.refine * factor)
