"""The Exudyn path as a method: its parts, each given or left to be chosen from the problem, and one impact by them.

    μ y_tt + EI y_xxxx = EI q₀ + μ a₀ − r,   0 ≤ r ⊥ −y ≥ 0                       (thesis 2.1.1–2)

and what :data:`MODELLED` adds to it, by the equations of :mod:`bent_beam.impact`. The beam, its loads and its supports
are laid out by :mod:`exudyn_models.assembly`.
"""

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Self

import numpy as np

from bent_beam.errors import InputError, SimulationError
from bent_beam.fields import Part, Quantity
from bent_beam.free_flight import Separation
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact, checked_impact
from bent_beam.loads import unmodelled
from bent_beam.meshes import MESHES, Mesh
from bent_beam.method import Progress, Save, made_of, separation_times
from exudyn_models import whole_beam
from exudyn_models.assembly import MODELLED, Chosen, lay_out
from exudyn_models.contacts import CONTACTS, Contact, Penalty, Rigid, Springs
from exudyn_models.elements import ELEMENTS, Element, chosen_element
from exudyn_models.geometry import GEOMETRIES, Array, Geometry, supports_or_plate
from exudyn_models.integrators import INTEGRATORS, Implicit, Integrator
from exudyn_models.recording import Recorder
from exudyn_models.resolution import THIN, chosen_mesh, chosen_steps
from exudyn_models.solvers import SOLVERS, USUAL, NewtonSolver, filled, quiet
from exudyn_models.stepping import Stepping, Until, saved_times
from exudyn_models.warnings_of_run import warnings_of_run

FIRST_ORDER_HOLD = 16  # elements behind the front; it ends when waves may be back, and every run states it
MOST_STRAIN = 1e-3  # under an axial force, of a given axial stiffness: lengths are wrong by as much
FIRST_ORDER_STEPS = 4.0  # so many times shorter steps: λ₁ of (−1, −1, 0) at κ/ν = 0.8 is 5 % off without, 0.4 % with


@dataclass(frozen=True)
class ExudynModel(Part):
    """Exudyn's cable or beam elements with contact against a rigid or elastic wall.

    The parts that are ``None`` are chosen for the problem (:mod:`exudyn_models.resolution`). The mesh is that of the
    half beam, laid over the whole half length (a ``NodesMesh`` may end short of it). Unless contact, shear or a whole
    impact asks for others: ANCF cable, generalised-α, nodal penalty, the linear limit, modified Newton.

    label : how rows and curves call it.
    """

    path: ClassVar[str] = "exudyn"
    PARTS: ClassVar[dict[str, dict[str, type]]] = {
        "mesh": MESHES,
        "element": ELEMENTS,
        "integrator": INTEGRATORS,
        "contact": CONTACTS,
        "geometry": GEOMETRIES,
        "solver": SOLVERS,
    }

    DEFAULT_KINDS: ClassVar[dict[str, str]] = {
        "element": "ancf_cable",
        "integrator": "generalized_alpha",
        "contact": "penalty",
    }

    mesh: Mesh | None = None
    element: Element | None = None
    integrator: Integrator | None = None
    contact: Contact | None = None
    geometry: Geometry | None = None
    solver: NewtonSolver | None = None
    full_beam: Annotated[bool, Quantity("", "both halves instead of one with a symmetry support")] = False
    refine: Annotated[float, Quantity("", "refinement factor of elements; steps follow", above=0.0)] = 1.0
    label: str = "Exudyn"

    for_whole_beam = whole_beam.for_whole_beam
    cross_checks = whole_beam.cross_checks
    varied = whole_beam.varied

    def refined(self, factor: float) -> Self:
        """A copy with elements and steps ``factor`` times finer."""
        return dataclasses.replace(self, refine=self.refine * factor)

    def chosen(self, impact: Impact, end_time: float, *, for_loads: bool = False) -> Chosen:
        """The parts of a run of ``impact`` to ``end_time`` (s); what is open goes with the contact, and mesh and steps
        with the problem.

        for_loads : the run measures what the loads of ``impact`` change: an open contact holds, and open
        steps are shorter before a rigid wall, until waves are back from the ends.
        """
        shorter = FIRST_ORDER_STEPS if for_loads and self.integrator is None and impact.loaded_to_first_order else 1.0
        rigid = impact.wall_stiffness is None
        contact = held_for(self.contact, impact) if rigid and for_loads else self.contact
        contact = contact or (Penalty() if rigid else Springs())
        integrator = self.integrator or contact.integrator
        mesh = (self.mesh or chosen_mesh(impact, end_time, explicit=integrator.explicit)).refined(self.refine)
        if isinstance(integrator, Implicit) and integrator.is_open:
            integrator = chosen_steps(integrator, self.refine * shorter, mesh, impact, end_time)
        else:
            integrator = integrator.refined(self.refine * shorter)
        return Chosen(
            mesh=mesh,
            element=self.element or chosen_element(impact),
            integrator=integrator,
            contact=contact,
            geometry=self.geometry or contact.geometry,
            solver=filled(filled(self.solver, contact.solver), USUAL),
            full_beam=self.full_beam or impact.off_centre,
            plastic=min(self.refine, 1.0),
            mesh_given=self.mesh is not None,
        )

    def chosen_for(self, impact: Impact, end_time: float) -> Self:
        """A copy with mesh, element, steps and hold chosen for ``impact``: other impacts then run on the same ones."""
        chosen = self.chosen(impact, end_time, for_loads=True)
        names = ["mesh", "element", "integrator"]
        if impact.wall_stiffness is None:  # a wall that gives way is a contact by itself
            names.append("contact")
        return dataclasses.replace(self, **{name: getattr(chosen, name) for name in names}, refine=1.0)

    def refuses(self, impact: Impact) -> str | None:
        """Why the model cannot take ``impact`` (``None``: it can)."""
        return next(self._reasons(checked_impact(impact)), None)

    def _reasons(self, impact: Impact) -> Iterator[str]:
        if impact.wall_stiffness is not None and self.contact is not None:
            yield f"exudyn.contact has no effect on a wall with a stiffness: leave it out (got {self.contact!r})"
        contact = self.contact or (Penalty() if impact.wall_stiffness is None else Springs())
        true = (self.geometry or contact.geometry).true
        if unknown := unmodelled(impact, MODELLED):
            yield unknown
        bending = ("curvature_rate", "fourth_derivative", "axial_force")  # what is not modelled together with …
        apart: dict[str, tuple[str, ...]] = {n: bending for n in ("rotation", "first_touch") if getattr(impact, n)}
        if supports_or_plate(impact):
            name = "ends" if impact.supported else "wall_from, wall_to"
            apart[name] = ("opposite_wall", "axial_force")
            if not isinstance(contact, Penalty | Springs):
                yield f"{name}: exudyn.contact.kind must be penalty (got {type(contact).__name__})"
            if true and impact.supported:
                yield "left_end, right_end: exudyn.geometry.kind true knows free ends only: take linear"
        for name, others in apart.items():
            for other in others:
                if given := getattr(impact, other):
                    yield f"{other} is not modelled together with {name} (got {given!r}); the Hermite path follows both"
        element, integrator = self.element or chosen_element(impact), self.integrator or contact.integrator
        of_contact = contact.refuses(impact, element, integrator)
        unfit = None if true else _unfit_stiffness(element, impact)
        yield from filter(None, (element.refuses(impact), of_contact, unfit))
        yield from self._unused_of_solver(contact, integrator)
        if true and impact.off_centre:
            yield "exudyn.geometry.kind true knows the symmetric bow only: with rotation or first_touch take linear"

    def _unused_of_solver(self, contact: Contact, integrator: Integrator) -> Iterator[str]:
        """Of settings for what this run does not do: Newton's iterations, or repetitions of a step."""
        explicit, rigid = integrator.explicit, isinstance(contact, Rigid)
        if self.solver is None or not (explicit or rigid):
            return
        usual = filled(contact.solver, USUAL)  # which a run that is repeated from its record states
        for name, value in vars(self.solver).items():
            if value not in (None, getattr(usual, name)) and (explicit or name.startswith("contact_")):
                other = f"{type(integrator).__name__}, which is explicit" if explicit else "exudyn.contact.kind rigid"
                yield f"exudyn.solver.{name} has no effect with {other}: leave it out (got {value!r})"

    def simulate(
        self, impact: Impact, *, end_time: float | None = None, save: Save = 200, progress: Progress | None = None
    ) -> ImpactHistory:
        """Follow ``impact`` to ``end_time`` (s); see :func:`exudyn_models.simulate`."""
        return simulate(impact, end_time=end_time, save=save, progress=progress, **made_of(self))

    def simulate_to_separation(
        self, impact: Impact, *, longest: float | None = None, save: int = 2000, progress: Progress | None = None
    ) -> ImpactHistory:
        """Follow ``impact`` until the beam has left for good (:func:`bent_beam.method.simulate_to_separation`)."""
        times, separation = separation_times(impact, longest, save), Separation(impact)

        def until(run: Recorder, t: float, q: Array, v: Array) -> bool:
            time, closed = t * run.scaling.end_time, bool(run.active.any())
            return separation(time, run.pushes, lambda: run.whole_beam(q, v), closed=closed)

        parts = made_of(self.for_whole_beam(impact))
        return simulate(impact, end_time=float(times[-1]), save=times, progress=progress, until=until, **parts)


def _unfit_stiffness(element: Element, impact: Impact) -> str | None:
    """Why the linear limit cannot take a given axial stiffness: it matters under an axial force, and must bear that."""
    stiffness, least = element.axial_stiffness, abs(impact.axial_force) / MOST_STRAIN
    if stiffness is None or 0.0 < least <= stiffness:
        return None
    said = f"must be {least:g} N at least, to bear axial_force" if least else "has no effect without axial_force"
    return f"exudyn.element.axial_stiffness {said}, in the linear limit (got {stiffness!r})"


def held_for(contact: Contact | None, impact: Impact) -> Contact:
    """The contact with the hold that suits the load, for the runs with and without load."""
    spreads = THIN <= impact.kappa_over_nu < 1.0
    if impact.zone_pressure > 0.0 and contact is None and spreads:
        # The load first closes what the rebound of the first instants has left. λ₁ of (4, 0, 0) at κ/ν = 0.5 is
        # 12 % off without the hold, 0.1 % with it. Behind a thin front nothing rebounds, behind a point nothing is.
        return Penalty(hold=FIRST_ORDER_HOLD)
    contact = contact or Penalty()
    if impact.lifts and isinstance(contact, Penalty) and contact.hold_start is None:
        return dataclasses.replace(contact, hold_start=0.0)  # of the run without the load, too
    return contact


def simulate(
    impact: Impact,
    *,
    end_time: float | None = None,
    save: Save = 200,
    view: bool = False,
    progress: Progress | None = None,
    until: Until | None = None,
    **parts: Any,
) -> ImpactHistory:
    """Simulate one impact with Exudyn: the history in SI units.

    end_time : s; None: 0.1 t*, but 0.01 T* at most.
    save : number of saved instants after t = 0, spread evenly in √t, or their times, s; snapped to steps. The run ends
        with the last of them.
    view : watch the run in Exudyn's viewer, until its window is told to go on (Q or Escape); without a display a line
        on standard error says so.
    progress : called with the finished fraction.
    until : asked at every saved instant; the run ends with the first at which it says so.
    parts : mesh, element and so on, the fields of :class:`exudyn_models.method.ExudynModel`. Those left
        open are chosen as for a whole impact if the beam is supported or the wall covers only a part of it.

    Sums (energies, ``total_impulse``) are of both halves of the modelled beam; a half model's ``impulse`` is that of
    x ≥ 0, half of the total.

    Raises ``ValueError`` for parts that cannot work together, an unstable explicit step, a beam that cannot be laid
    out; ``TypeError`` for a part of an unknown name; :class:`bent_beam.SimulationError`, with the history up to there,
    where Exudyn's solver failed, contact states did not settle, or the state stopped being finite.
    """
    end, method = checked_impact(impact).checked_end_time(end_time), ExudynModel(**parts)
    if supports_or_plate(impact):
        method = method.for_whole_beam(impact)
    if reason := method.refuses(impact):
        raise InputError(reason)
    targets, chosen = saved_times(save, end), method.chosen(impact, end)
    with quiet():
        stepping = Stepping(lay_out(impact, end, chosen), chosen, targets, progress, until)
        stepping.through(view)
    if not stepping.run.record["time"]:
        raise SimulationError(stepping.failure or "", time=0.0, step=0, advice=stepping.advice)
    saved = targets[: stepping.saved] * end if stepping.left else np.asarray(save)  # what a rerun needs
    settings = {"end_time": end, "save": saved.tolist(), **stepping.settings_of_run()}
    steps, failure = stepping.steps, stepping.failure
    history = stepping.run.history(settings=settings, steps=steps, seconds=stepping.seconds, completed=failure is None)
    history = history.with_warnings(warnings_of_run(stepping, history))
    if failure is not None:
        time, advice = float(history.time[-1]), stepping.advice
        raise SimulationError(failure, time=time, step=steps, advice=advice, history=history)
    return history
