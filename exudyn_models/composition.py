"""What a run is made of: the list of parts, each given or left to be chosen from the problem."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

from bent_beam.fields import Part, Quantity
from bent_beam.impact import Impact
from bent_beam.loads import unmodelled
from bent_beam.meshes import MESHES, Mesh
from exudyn_models.contacts import CONTACTS, Contact, Penalty, Springs
from exudyn_models.elements import ELEMENTS, ANCFCable, Element
from exudyn_models.geometry import GEOMETRIES, Geometry
from exudyn_models.integrators import INTEGRATORS, Integrator
from exudyn_models.solvers import SOLVERS, NewtonSolver

__all__ = ["Composition"]

LOADS = (
    "acceleration",
    "curvature_rate",
    "fourth_derivative",
    "axial_force",
    "rotation",
    "wall_stiffness",
    "wall_damping",
    "wall_from",
    "wall_to",
    "left_end",
    "right_end",
)
"""The loads and features that :mod:`exudyn_models.assembly` models."""


@dataclass(frozen=True)
class Composition(Part):
    """The parts of a method; those that are ``None`` are chosen for the problem (:mod:`exudyn_models.resolution`).

    The mesh is that of the half beam, laid over the whole half length (a ``NodesMesh`` may end short of it). Unless the
    contact asks for others, the other parts are: ANCF cable, generalised-α, nodal penalty, the linear limit, modified
    Newton.
    """

    PARTS: ClassVar[dict[str, dict[str, type]]] = {
        "mesh": MESHES,
        "element": ELEMENTS,
        "integrator": INTEGRATORS,
        "contact": CONTACTS,
        "geometry": GEOMETRIES,
        "solver": SOLVERS,
    }

    mesh: Mesh | None = None
    element: Element | None = None
    integrator: Integrator | None = None
    contact: Contact | None = None
    geometry: Geometry | None = None
    solver: NewtonSolver | None = None
    full_beam: Annotated[bool, Quantity("", "both halves instead of one with a symmetry support")] = False
    refine: Annotated[float, Quantity("", "refinement factor of elements and steps", above=0.0)] = 1.0

    def refined(self, factor: float) -> Self:
        """A copy with elements and steps ``factor`` times finer."""
        return dataclasses.replace(self, refine=self.refine * factor)

    def joined(self, impact: Impact) -> tuple[Contact, Element, Integrator, Geometry, NewtonSolver]:
        """The parts that do not depend on the problem; what is open goes with the contact."""
        contact = self.contact or (Penalty() if impact.wall_stiffness is None else Springs())
        return (
            contact,
            self.element or ANCFCable(),
            self.integrator or contact.integrator(),
            self.geometry or contact.geometry(),
            self.solver or contact.solver(),
        )

    def refuses(self, impact: Impact) -> str | None:
        """Why the model cannot take ``impact`` (``None``: it can)."""
        if impact.wall_stiffness is not None and self.contact is not None:
            return f"exudyn.contact has no effect on a wall with a stiffness: leave it out (got {self.contact!r})"
        contact, element, integrator, geometry, _ = self.joined(impact)
        reason = unmodelled(impact, LOADS) or self._refuses_asymmetry(impact)
        reason = reason or self._refuses_supports(impact, contact, geometry)
        reason = reason or contact.refuses(impact, element, integrator)
        if not reason and geometry.true and impact.off_centre:
            reason = "exudyn.geometry.kind true knows the symmetric bow only: with rotation or first_touch take linear"
        return reason

    def _refuses_supports(self, impact: Impact, contact: Contact, geometry: Geometry) -> str | None:
        """Ends that are held, and walls along a part of the beam."""
        name = "ends" if impact.supported else "wall_from, wall_to" if impact.wall_in_part else None
        if name is None:
            return None
        if not isinstance(contact, Penalty | Springs):
            return f"{name}: exudyn.contact.kind must be penalty (got {type(contact).__name__})"
        if geometry.true and impact.supported:
            return "left_end, right_end: exudyn.geometry.kind true knows free ends only: take linear"
        for other in ("opposite_wall", "axial_force"):
            if getattr(impact, other):
                return f"{other} is not modelled together with {name} (got {getattr(impact, other)!r})"
        return None

    def _refuses_asymmetry(self, impact: Impact) -> str | None:
        asymmetry = next((name for name in ("rotation", "first_touch") if getattr(impact, name)), None)
        if asymmetry is None:
            return None
        if not self.full_beam:
            return f"{asymmetry} needs exudyn.full_beam = true (got {getattr(impact, asymmetry)!r})"
        for name in ("curvature_rate", "fourth_derivative", "axial_force"):
            if getattr(impact, name):
                return f"{name} is not modelled together with {asymmetry} (got {getattr(impact, name)!r})"
        return None
