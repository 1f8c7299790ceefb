"""The nonsmooth finite-element path as a method: what it is made of, and a run of it."""

import dataclasses
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from bent_beam.errors import InputError
from bent_beam.free_flight import Separation
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact, checked_impact
from bent_beam.meshes import MESHES, UniformMesh
from bent_beam.method import Progress, Save, made_of, separation_times
from hermite_fe import resolution, whole_beam
from hermite_fe.contacts import CONTACTS, NodeContact
from hermite_fe.far_fields import FAR_FIELDS, GridViscosity
from hermite_fe.integrators import INTEGRATORS, MoreauJean, SignoriniPosition
from hermite_fe.masses import MASSES
from hermite_fe.model import BeamModel
from hermite_fe.resolution import Composition
from hermite_fe.run import Stepper
from hermite_fe.simulate import refusal, simulate, spreads


@dataclass(frozen=True)
class HermiteFE(Composition):
    """Hermite beam elements with unilateral contact and a nonsmooth time integrator, on a fixed mesh.

    The parts are those of :class:`hermite_fe.resolution.Composition`.

    >>> from bent_beam import Impact
    >>> from hermite_fe import HermiteFE
    >>> from hermite_fe.integrators import MoreauJean
    >>> history = HermiteFE(integrator=MoreauJean(theta=1.0)).simulate(Impact.dimensionless(0.5), end_time=0.1)
    >>> bool(abs(history.array("total_impulse")[-1] - 1.188) < 0.01)
    True
    """

    path: ClassVar[str] = "hermite"
    perturbation: ClassVar[float] = 0.01
    """How much a load may change the free motion at the end of a run that measures λ₁ and r₁, over V₀t."""
    PARTS: ClassVar[dict[str, dict[str, type]]] = {
        "mesh": MESHES,
        "integrator": INTEGRATORS,
        "contact": CONTACTS,
        "far_field": FAR_FIELDS,
        "mass": MASSES,
    }

    label: str = "Hermite"

    def refuses(self, impact: Impact) -> str | None:
        """Why this method cannot take ``impact``, naming the field (``None``: it can)."""
        return refusal(checked_impact(impact), self.contact)

    def simulate(
        self, impact: Impact, *, end_time: float | None = None, save: Save = 200, progress: Progress | None = None
    ) -> ImpactHistory:
        """Follow ``impact`` to ``end_time`` (s); see :func:`hermite_fe.simulate`.

        What is no impact of a front that spreads from the middle (rocking, a first touch off it, a second wall,
        supports, a stop) gets the parts that suit the whole beam.
        """
        end = checked_impact(impact).checked_end_time(end_time)
        chosen = self if spreads(impact) else self.for_whole_beam(impact, end)
        return simulate(impact, end_time=end_time, save=save, progress=progress, **made_of(chosen))

    def chosen_for(self, impact: Impact, end_time: float) -> Self:
        """A copy with every open part chosen for ``impact`` (:meth:`for_loads`): other impacts then run on the same
        mesh and steps."""
        parts = self.for_loads(impact, end_time)
        return dataclasses.replace(parts, **resolution.choose(impact, end_time, parts).parts(), refine=1.0)

    def for_loads(self, impact: Impact, end_time: float) -> Self:
        """A copy of these parts for a run that measures what the loads of ``impact`` change.

        A long beam is cut where nothing arrives, its ends following the free motion. A zone that the load presses is
        held behind the front: the small gap that the bare impact leaves there would otherwise bear the load before the
        wall does. Without loads, and where the wall gives way, nothing changes.
        """
        if not impact.loaded_to_first_order or impact.wall_stiffness is not None:
            return self
        contact, domain = self.contact, self.domain
        if domain is None and self.far_field is None:
            domain = resolution.chosen_domain(impact, end_time)
        if contact is None and impact.zone_pressure > 0.0 and (self.integrator is None or self.integrator.holds_zone):
            contact = NodeContact(hold=resolution.PRESSED_HOLD)
        half = resolution.modelled_half_length(impact, domain)
        mesh = self.mesh or resolution.chosen_mesh(impact, half, end_time, loaded=True)
        return dataclasses.replace(self, mesh=mesh, contact=contact, domain=domain)

    def for_whole_beam(self, impact: Impact, end_time: float | None = None) -> Self:
        """A copy whose open parts are those of a whole beam, short enough for a run that ends at ``end_time``, s; its
        ``refine`` is worked in."""
        if self.domain is not None:
            raise InputError(
                "domain cuts a free beam that touches at its middle alone, before one long wall, at first: "
                f"leave it out here (got {self.domain!r})"
            )
        mesh = (self.mesh or UniformMesh(whole_beam.element(impact, end_time))).refined(self.refine)
        shortest = float(np.diff(mesh.nodes(impact.half_length)).min())
        contact = self.contact or NodeContact()
        chosen = self.integrator or whole_beam.scheme(impact, contact, shortest, end_time)
        integrator = chosen.with_defaults(impact, end_time)  # first: refined() leaves open what is open
        step = whole_beam.step(impact, shortest)
        if integrator.time_step is None and impact.wall_stiffness is None:
            # `step` is that of refined elements, without shear refine² times shorter: stated growth and penalty follow
            integrator = integrator.refined(self.refine**2).with_steps(step, 0.0)
        else:
            integrator = integrator.with_steps(step, 0.0).refined(self.refine)
        return dataclasses.replace(
            self,
            mesh=mesh,
            integrator=integrator,
            contact=contact if impact.wall_stiffness is None else self.contact,
            far_field=self.far_field or GridViscosity(viscosity=0.0),
            full_beam=self.full_beam or impact.off_centre,
            refine=1.0,
        )

    def cross_checks(self, impact: Impact) -> dict[str, Self]:
        """Companions for error bars, by cause: one with the impact law of another scheme; below ``ONE_POINT`` also
        the same on half of the elements, as laws may agree by chance. Without shear their steps are twice as long:
        they cost half, and the bar counts the error of the steps twice. None before a wall that gives way, nor of
        contact that may pull."""
        chosen = self.for_whole_beam(impact)
        integrator, contact = chosen.integrator, chosen.contact
        assert integrator is not None
        if integrator.elastic or contact is None or contact.sticks:
            return {}
        law: type[MoreauJean] | type[SignoriniPosition] = MoreauJean
        if isinstance(integrator, MoreauJean):  # nodes that rebound have another law in those that do not
            law = MoreauJean if contact.restitution else SignoriniPosition
            contact = dataclasses.replace(contact, restitution=0.0)
        finer = 0.5 if impact.shear_stiffness is None else 1.0
        other = law(theta=0.5, time_step=integrator.time_step, growth=0.0).refined(finer)
        found = {"contact_law": dataclasses.replace(chosen, contact=contact, integrator=other)}
        if impact.kappa_over_nu < whole_beam.ONE_POINT:
            found["contact_law_coarser"] = found["contact_law"].refined(0.5)
        return found

    def varied(self, impact: Impact, random: np.random.Generator) -> Self:
        """A copy for an ensemble: elements, steps and impact law drawn at random.

        Moreau–Jean with θ = ½ throughout, which keeps the energy between impacts; where the wall gives way, what is
        chosen for it.
        """
        if impact.wall_stiffness is not None:
            return self.refined(2.0 ** random.uniform(-1.0, 0.0)).for_whole_beam(impact)
        length = impact.half_length / int(random.integers(2 * whole_beam.ELEMENTS // 5, 4 * whole_beam.ELEMENTS // 5))
        step = 2.0 ** random.uniform(-1.0, 1.0) * length**2 / impact.wave_constant
        restitution = (0.0, 0.5, 1.0)[int(random.integers(3))]
        return dataclasses.replace(
            self,
            mesh=UniformMesh(length),
            integrator=MoreauJean(theta=0.5, time_step=step, growth=0.0),
            contact=NodeContact(restitution=restitution),
        )

    def simulate_to_separation(
        self, impact: Impact, *, longest: float | None = None, save: int = 2000, progress: Progress | None = None
    ) -> ImpactHistory:
        """Follow ``impact`` until the beam has left for good (:func:`bent_beam.method.simulate_to_separation`)."""
        if self.far_field is not None and self.far_field.absorbs:
            raise InputError(
                f"hermite.far_field.kind: {self.far_field.damper} absorbs waves that the ends send back, and these "
                f"belong to a whole impact: take viscosity (got {self.far_field!r})"
            )
        times, separation = separation_times(impact, longest, save), Separation(impact)

        def until(model: BeamModel, run: Stepper) -> bool:
            state = run.state
            return separation(
                float(run.instants[run.step]),
                float(state.impulse.sum()),
                lambda: (model.beam.nodes, model.gap(state.q), state.v[0::2], model.copies * run.energy()),
                closed=bool(np.any(state.closed)),
            )

        parts = made_of(self.for_whole_beam(impact))
        return simulate(impact, end_time=float(times[-1]), save=times, progress=progress, until=until, **parts)
