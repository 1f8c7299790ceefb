"""What a run is made of: the list of parts, each given or left to be chosen from the problem."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import ClassVar, Self, cast

from bent_beam.checks import one_of, positive
from bent_beam.impact import Impact
from bent_beam.meshes import MESHES, Mesh
from exudyn_models.contacts import CONTACTS, Contact, Penalty
from exudyn_models.elements import ELEMENTS, ANCFCable, Element
from exudyn_models.geometry import GEOMETRIES, Geometry
from exudyn_models.integrators import INTEGRATORS, Integrator
from exudyn_models.resolution import refined_choice
from exudyn_models.solvers import SOLVERS, NewtonSolver

__all__ = ["Chosen", "Composition"]


@dataclass(frozen=True)
class Chosen:
    """The parts of one run, none of them open."""

    mesh: Mesh
    element: Element
    integrator: Integrator
    contact: Contact
    geometry: Geometry
    solver: NewtonSolver


@dataclass(frozen=True)
class Composition:
    """The parts of a method.

    mesh : of the half beam, laid over the whole half length (a ``NodesMesh`` may end short of it); None: elements in
        proportion to the distance from the centre, as far out as waves travel, or uniform ones where waves are back
        from the ends before the end time (:func:`exudyn_models.chosen_mesh`).
    element, integrator, contact, geometry, solver : None: ANCF cable, generalised-α, nodal penalty, the linear limit,
        modified Newton, unless the contact asks for others. ``geometry`` may be "linear" or "true".
    full_beam : model both halves instead of one with a symmetry support.
    refine : elements and steps so many times finer than the parts say, for studies of convergence.
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
    geometry: Geometry | str | None = None
    solver: NewtonSolver | None = None
    full_beam: bool = False
    refine: float = 1.0

    def __post_init__(self) -> None:
        if not isinstance(self.full_beam, bool):
            raise ValueError(f"full_beam must be true or false (got {self.full_beam!r})")
        positive("refine", self.refine)
        if isinstance(self.geometry, str):
            object.__setattr__(self, "geometry", GEOMETRIES[one_of("geometry", self.geometry, GEOMETRIES)]())

    def refined(self, factor: float) -> Self:
        """A copy with elements and steps ``factor`` times finer."""
        return dataclasses.replace(self, refine=self.refine * factor)

    def chosen(self, impact: Impact, end_time: float, shorter: float = 1.0) -> Chosen:
        """The parts of a run of ``impact`` to ``end_time`` (s). Open steps are ``shorter`` times shorter."""
        contact, element, integrator, geometry = self._joined()
        mesh, integrator = refined_choice(
            self.mesh,
            integrator,
            impact,
            end_time,
            open_steps=self.integrator is None,
            refine=self.refine,
            shorter=shorter,
        )
        solver = contact.solver() if self.solver is None else self.solver
        return Chosen(mesh, element, integrator, contact, geometry, solver)

    def refuses(self, impact: Impact) -> str | None:
        """Why the model cannot take ``impact`` (``None``: it can)."""
        contact, element, integrator, geometry = self._joined()
        reason = self._refuses_asymmetry(impact) or contact.refuses(impact, element, integrator)
        if not reason and geometry.true and impact.off_centre:
            reason = "exudyn.geometry.kind true knows the symmetric bow only: with rotation or first_touch take linear"
        return reason

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

    def _joined(self) -> tuple[Contact, Element, Integrator, Geometry]:
        """The parts that do not depend on the problem."""
        contact = Penalty() if self.contact is None else self.contact
        return (
            contact,
            ANCFCable() if self.element is None else self.element,
            contact.integrator() if self.integrator is None else self.integrator,
            contact.geometry() if self.geometry is None else cast(Geometry, self.geometry),
        )
