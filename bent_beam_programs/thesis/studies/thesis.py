"""The thesis's numerical settings (Table 3.3 and 3.2.1), scaled to any case, and the methods to compare them with.

Δx = 0.05 l* (2.5·10⁻³ m at V₀ = 20 m/s), at least twelve elements in the contact zone at the end; h = 10⁻⁵ t*, at
most a thousandth of the run (2.5·10⁻⁸ s); uniform elements over twice the contact zone of the leading order (which
gives the element counts of Table 3.2, 3.3.2), growth 1.25 outside; nonsmooth generalised-α with constraints at
position, velocity and acceleration level, ρ∞ = 0.8, restitution 0; contact at element middles or at nodes; no
bilateral start, no absorbing layer. The mass matrix is lumped, as the thesis's first impacts ask for
(:data:`THESIS_MASS`), or the printed one, (3.1.8).
"""

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np

from bent_beam import Case, Impact, ImpactHistory
from bent_beam.errors import ANY_FAILURE, SimulationError
from bent_beam.meshes import GradedMesh, Mesh
from bent_beam.method import Method, Save, simulated
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.outcome import MEASURES, Outcome, outcome_of, saved_times
from comparison.workers import Count, run_all
from hermite_fe import CONTACTS, FAR_FIELDS, INTEGRATORS, HermiteFE
from hermite_fe.contacts import MiddleContact
from hermite_fe.masses import ConsistentMass, LumpedMass, Mass
from self_similar_fe import SelfSimilarFE

CONSISTENT = ConsistentMass()  # (3.1.8)
THESIS_MASS = LumpedMass(rotary=1.0 / 105.0)
"""Half an element at each node and the 4l²/420 that (3.1.8) has on its rotation: of the lumpings tried, the one whose
lifts and strain energies, with nodes and with middles, come closest to the thesis's (docs/numerics.md)."""
MASSES: dict[str, Mass] = {"lumped": THESIS_MASS, "consistent": CONSISTENT}
"""Which one the thesis used is not known: figures of its runs are drawn with both."""


@dataclass(frozen=True)
class StraightContact(MiddleContact):
    """Element middles of straight lines between the nodes, as 3.3.5 words it: g = −½(w₁ + w₂); slopes do not count."""

    slope_share: ClassVar[float] = math.inf


POINTS: dict[str, type] = CONTACTS | {"straight": StraightContact}


@dataclass(frozen=True)
class Settings:
    """A run on a fixed mesh of the Hermite path, m and s. ``mesh`` replaces element length and growth."""

    element_length: float
    time_step: float
    zone: float
    growth: float = 1.25
    spectral_radius: float = 0.8
    contact: str = "middle"
    restitution: float = 0.0
    hold: int = 0
    viscosity: float = 0.0
    sponge: bool = False
    mass: Mass = THESIS_MASS
    mesh: Mesh | None = None

    def replace(self, **changes: Any) -> Self:
        return dataclasses.replace(self, **changes)

    def method(self) -> HermiteFE:
        scheme = INTEGRATORS["nonsmooth_generalized_alpha"]
        return HermiteFE(
            mesh=self.mesh or GradedMesh(self.element_length, self.growth, zone=self.zone),
            integrator=scheme(time_step=self.time_step, spectral_radius=self.spectral_radius),
            contact=POINTS[self.contact](restitution=self.restitution, hold=self.hold, hold_until=0.0),
            far_field=FAR_FIELDS["sponge" if self.sponge else "viscosity"](viscosity=self.viscosity),
            mass=self.mass,
        )


def thesis_settings(impact: Impact, end_time: float) -> Settings:
    exact = Exact(impact)
    reach = float(exact.parameters.lambda0) * impact.length_scale * math.sqrt(end_time / impact.time_scale)
    front = max(float(exact.front(end_time)), reach)
    element = min(0.05 * impact.length_scale, impact.half_length / 60.0)
    if front > 0.0:
        element = min(element, front / 12.0)
    step, zone = min(1e-5 * impact.time_scale, end_time / 1000.0), max(2.0 * reach, 25.0 * element)
    return Settings(element, step, zone=min(zone, impact.half_length))


@dataclass(frozen=True)
class Variant:
    """One run to be made.

    reference : a method to compare the others with, drawn with the mark of its path.
    save : instants to keep (``None``: :func:`saved_times`). value, setting, refine : see :class:`Outcome`.
    """

    label: str
    impact: Impact
    end_time: float
    method: Method
    value: float | None = None
    reference: bool = False
    save: Save | None = None
    setting: str = ""
    refine: float = 1.0

    @property
    def about(self) -> dict[str, Any]:
        return {"mark": self.method.path if self.reference else None, "setting": self.setting, "refine": self.refine}

    def lost(self, reason: str, *, refused: bool = False) -> Outcome:
        """The outcome of a run that gave none."""
        curves, numbers, why = (np.zeros(0),) * 7, dict.fromkeys(MEASURES), " ".join(reason.split())
        about = self.about | {"failure": why, "refused": refused}
        return Outcome(self.label, self.impact, self.value, *curves, numbers, **about)

    def history(self) -> ImpactHistory:
        save = saved_times(self.end_time) if self.save is None else self.save
        return simulated(self.method.simulate, self.impact, end_time=self.end_time, save=save)


Runs = dict[str, tuple[float | None, dict[str, Any]]]  # label → (value of the parameter, changes of the settings)


def varied(case: Case, base: Settings, runs: Runs, *more: Variant) -> list[Variant]:
    """Runs with ``base`` but for some changes, ``more`` of them, and the references."""
    about = case.impact, case.end_time
    own = [Variant(label, *about, base.replace(**new).method(), value) for label, (value, new) in runs.items()]
    return [*own, *more, *references(*about)]


def references(impact: Impact, end_time: float) -> list[Variant]:
    """This project's own choices: the fixed mesh, and the infinite beam in similarity coordinates, at leading order
    over the two decades of time that figures and fits use."""
    endless = SelfSimilarFE().chosen_for(impact, end_time)
    if Exact(impact).leading and endless.mesh is not None:  # more decades change nothing, and cost
        endless = dataclasses.replace(endless, mesh=dataclasses.replace(endless.mesh, decades=2.0))
    methods: tuple[Method, ...] = (HermiteFE(), endless)
    return [Variant(m.label, impact, end_time, m, reference=True) for m in methods]


def _outcome(variant: Variant) -> Outcome:
    """One variant in a worker; a solver that cannot finish, and a method that refuses, are answers too."""
    try:
        history = variant.history()
    except (SimulationError, ArithmeticError, ValueError) as error:
        return variant.lost(str(error), refused=isinstance(error, ValueError))
    try:
        return outcome_of(history, variant.label, value=variant.value, **variant.about)
    except ANY_FAILURE as error:
        return variant.lost(f"no number can be estimated from this run: {error}")


def run_variants(asked: Sequence[Variant | Outcome], *, jobs: int = 1, progress: Count | None = None) -> list[Outcome]:
    """Run all, on ``jobs`` processes; outcomes in order, those among them that were known before."""
    runs = [(one,) for one in asked if isinstance(one, Variant)]
    done = iter(run_all(_outcome, runs, jobs=jobs, progress=progress, on_death=lambda i, why: runs[i][0].lost(why)))
    return [next(done) if isinstance(one, Variant) else one for one in asked]
