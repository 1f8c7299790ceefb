"""Friction at the wall: Exudyn's contact along the cable's segments with Coulomb friction, linear limit
and true geometry.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bent_beam.cases import Case
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.thesis import Variant
from comparison.studies.words import number

__all__ = ["STUDY", "rubbing"]

COEFFICIENTS = (0.0, 0.3, 0.6)
DURATION = 1e-3  # τ of the true geometry: slopes of about 0.03
STEP = 1e-2


def rubbing(
    impact: Impact, *, end_time: float, friction: float, geometry: str | None = None, save: int = 250, **parts: Any
) -> ImpactHistory:
    """The Exudyn path with friction."""
    import exudyn_models

    contact = exudyn_models.CONTACTS["segment_friction"](friction=friction)
    integrator = exudyn_models.INTEGRATORS["generalized_alpha"](relative_step=STEP)
    return exudyn_models.simulate(
        impact, end_time=end_time, contact=contact, geometry=geometry, save=save, integrator=integrator, **parts
    )


def variants(case: Case) -> list[Variant]:
    def run(name: str, geometry: str | None, friction: float, end: float) -> Variant:
        return Variant(
            f"{name}, friction {friction:g}",
            case.impact,
            end,
            kind="exudyn",
            value=friction,
            runner=rubbing,
            arguments={"friction": friction, "geometry": geometry},
        )

    end = DURATION * case.impact.time_scale
    return [
        *(run("linear limit", None, f, case.end_time) for f in COEFFICIENTS),
        *(run("true geometry", "true", f, end) for f in COEFFICIENTS),
    ]


def conclude(outcomes: Sequence[Outcome]) -> str:
    text = []
    for name, what in (("linear limit", "in the linear limit"), ("true geometry", "with the true geometry")):
        runs = {o.value: o.measures for o in outcomes if o.label.startswith(name)}
        without = runs.get(0.0)
        rubbed = {f: m for f, m in runs.items() if f}
        if without is None or not rubbed:
            text.append(f"Friction {what} could not be compared: a run is missing.")
            continue
        reaction, length, lift = (
            max(abs((m[name] or 0.0) - (without[name] or 0.0)) for m in rubbed.values())
            for name in ("reaction_error", "contact_length_error", "lift")
        )
        text.append(
            f"Friction up to {max(f for f in rubbed if f is not None):g} {what} moves r₀ by {number(reaction)} % "
            f"at most, λ₀ by {number(length)} %, the lift by {number(lift)} V₀t."
            + (
                " It does nothing that matters: a point of the beam comes down on the wall almost without sliding."
                if reaction < 0.1
                else " It matters: sliding is no longer small."
            )
        )
    return " ".join(text)


STUDY = Study("friction", "Friction at the wall", variants, conclude, heading="contact")
