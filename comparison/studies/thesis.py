"""The thesis's numerical settings (Table 3.3 and 3.2.1), scaled to any case, and what cures them.

Δx = 0.05 l* (2.5·10⁻³ m at V₀ = 20 m/s), at least twelve elements in the contact zone at the end; h = 10⁻⁵ t*, at
most a thousandth of the run (2.5·10⁻⁸ s); uniform elements over twice the contact zone (25 a side in Table 3.2),
growth 1.25 outside; nonsmooth generalised-α with constraints at position, velocity and acceleration level, ρ∞ =
0.8, restitution 0; contact at element middles or at nodes; nothing held, nothing absorbed. The cure is the
expanding mesh (:mod:`self_similar_fe.run`): front resolved at every time, radiated waves absorbed.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from bent_beam.history import ImpactHistory, SimulationError
from bent_beam.impact import Impact
from bent_beam.meshes import GradedMesh, Mesh, UniformMesh
from comparison.studies.exact import Exact
from comparison.studies.outcome import Outcome, failed, outcome_of, saved_times
from comparison.workers import run_all
from hermite_fe import CONTACTS, FAR_FIELDS, INTEGRATORS
from hermite_fe import simulate as hermite

__all__ = ["Settings", "Variant", "cured", "run_variants", "thesis_settings"]

GROWTH, RADIUS = 1.25, 0.8


@dataclass(frozen=True)
class Settings:
    """A run on a fixed mesh of the Hermite path; lengths in m, times in s. ``mesh`` overrides element length and
    growth.
    """

    element_length: float
    time_step: float
    zone: float
    growth: float = GROWTH
    spectral_radius: float = RADIUS
    contact: str = "middle"
    restitution: float = 0.0
    hold: int = 0
    viscosity: float = 0.0
    sponge: bool = False
    mesh: Mesh | None = None

    def replace(self, **changes: Any) -> Settings:
        return dataclasses.replace(self, **changes)

    def laid(self) -> Mesh:
        """The mesh."""
        if self.mesh is not None:
            return self.mesh
        if self.growth == 1.0:
            return UniformMesh(self.element_length)
        return GradedMesh(self.element_length, self.growth, zone=self.zone)

    def parts(self) -> dict[str, Any]:
        """Arguments of ``hermite_fe.simulate``."""
        far = FAR_FIELDS["sponge"] if self.sponge else FAR_FIELDS["viscosity"]
        return {
            "mesh": self.laid(),
            "integrator": INTEGRATORS["nonsmooth_generalized_alpha"](
                time_step=self.time_step, spectral_radius=self.spectral_radius
            ),
            "contact": CONTACTS[self.contact](restitution=self.restitution, hold=self.hold, hold_until=0.0),
            "far_field": far(viscosity=self.viscosity),
        }


def thesis_settings(impact: Impact, end_time: float) -> Settings:
    """The thesis's settings for a case (see the module's text)."""
    exact = Exact(impact)
    front = max(float(exact.front(end_time)), 0.0)
    reach = float(exact.parameters.lambda0) * impact.length_scale * math.sqrt(end_time / impact.time_scale)
    front = max(front, reach)
    element = 0.05 * impact.length_scale
    if front > 0.0:
        element = min(element, front / 12.0)
    element = min(element, impact.half_length / 60.0)
    zone = min(max(2.0 * front, 25.0 * element), impact.half_length)
    step = min(1e-5 * impact.time_scale, end_time / 1000.0)
    return Settings(element_length=element, time_step=step, zone=zone)


@dataclass(frozen=True)
class Variant:
    """One run to be made: ``make(impact, end_time, save)`` returns its history; a plain function and its arguments."""

    label: str
    impact: Impact
    end_time: float
    kind: str = "thesis"
    value: float | None = None
    settings: Settings | None = None
    runner: Callable[..., ImpactHistory] | None = None
    arguments: dict[str, Any] = field(default_factory=dict)

    def history(self) -> ImpactHistory:
        if self.runner is not None:
            return self.runner(self.impact, end_time=self.end_time, **self.arguments)
        assert self.settings is not None
        return hermite(self.impact, end_time=self.end_time, save=saved_times(self.end_time), **self.settings.parts())


def expanding(impact: Impact, *, end_time: float, save: int = 400, **mesh: Any) -> ImpactHistory:
    """The Hermite path on its expanding mesh: an infinite beam, its front resolved at every time."""
    from self_similar_fe.mesh import ExpandingMesh
    from self_similar_fe.run import simulate_expanding

    return simulate_expanding(impact, ExpandingMesh(**mesh), end_time=end_time, save=save)


def cured(impact: Impact, end_time: float, label: str = "Hermite, expanding mesh") -> Variant:
    """What cures it all."""
    return Variant(label, impact, end_time, kind="hermite", runner=expanding)


def _outcome(variant: Variant) -> Outcome:
    """One variant in a worker; a solver that cannot finish is an answer too."""
    try:
        return outcome_of(variant.history(), variant.label, variant.kind, variant.value)
    except (SimulationError, ArithmeticError) as error:
        reason = " ".join(str(error).split())
        return failed(variant.label, variant.kind, variant.impact, variant.value, reason)


def run_variants(
    variants: Sequence[Variant], *, jobs: int = 1, progress: Callable[[int, int], None] | None = None
) -> list[Outcome]:
    """Run all, on ``jobs`` processes; outcomes in order."""
    return list(
        run_all(
            _outcome,
            [(v,) for v in variants],
            jobs=jobs,
            progress=progress,
            on_death=lambda i, why: failed(
                variants[i].label, variants[i].kind, variants[i].impact, variants[i].value, why
            ),
        )
    )
