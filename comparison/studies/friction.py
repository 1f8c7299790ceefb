"""Friction at the wall: Exudyn's contact along the cable's segments with Coulomb friction, linear limit
and true geometry.
"""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from bent_beam.method import Method
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import number, values
from comparison.studies.thesis import Variant
from comparison.studies.variation import Setting, with_field

__all__ = ["STUDY", "friction_method"]

COEFFICIENTS = (0.0, 0.3, 0.6)
DURATION = 1e-3  # τ of the true geometry: slopes of about 0.03
STEP = 1e-2
SAVED = 250
GEOMETRIES = {"linear": "linear limit", "true": "true geometry"}


def friction_method(friction: float, geometry: str) -> Method:
    """The Exudyn path with friction."""
    from exudyn_models import CONTACTS, INTEGRATORS, ExudynModel
    from exudyn_models.geometry import GEOMETRIES as KINDS

    return ExudynModel(
        contact=CONTACTS["segment_friction"](friction=friction),
        integrator=INTEGRATORS["generalized_alpha"](relative_step=STEP),
        geometry=KINDS[geometry](),
    )


def variants(case: Case) -> list[Variant]:
    ends = {"linear": case.end_time, "true": DURATION * case.impact.time_scale}
    return [
        Variant(
            f"{name}, friction {friction:g}",
            case.impact,
            ends[kind],
            friction_method(friction, kind),
            value=friction,
            reference=True,
            save=SAVED,
        )
        for kind, name in GEOMETRIES.items()
        for friction in COEFFICIENTS
    ]


def vary(method: Method, case: Case) -> list[Setting]:
    return [Setting(f"friction {f:g}", with_field(method, "contact", case, friction=f), f) for f in COEFFICIENTS]


def conclude(outcomes: Sequence[Outcome]) -> str:
    text = []
    for name in GEOMETRIES.values():
        runs = [o for o in outcomes if o.label.startswith(name)]
        without = next((o for o in runs if o.value == 0.0), None)
        with_friction = [o for o in runs if o.value]
        if without is None or not with_friction:
            text.append(f"Friction could not be compared in the {name}: a run is missing.")
            continue
        reaction, length, lift = (
            _change(with_friction, without, m) for m in ("reaction_error", "contact_length_error", "lift")
        )
        text.append(
            f"Friction up to {max(o.value or 0.0 for o in with_friction):g} moves r₀ by {number(reaction)} % at most "
            f"in the {name}, "
            f"λ₀ by {number(length)} %, the lift by {number(lift)} V₀t."
            + (
                ""
                if reaction is None
                else " A point of the beam comes down on the wall almost without sliding: friction does not matter."
                if reaction < 0.1
                else " Friction matters: sliding is no longer small."
            )
        )
    return " ".join(text)


def _change(with_friction: Sequence[Outcome], without: Outcome, name: str) -> float | None:
    """Largest change of a measure by friction; ``None`` when there is none to compare."""
    before, after = without.measures.get(name), values(with_friction, name)
    return None if before is None or not after else max(abs(v - before) for v in after)


STUDY = Study("friction", "Friction at the wall", variants, conclude, vary=vary, heading="contact")
