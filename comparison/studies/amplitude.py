"""How far the linear theory carries: Exudyn's true geometry at growing slopes against its linear limit on
the same mesh.

Slopes over the front are of order √τ, τ = t/t* (:class:`exudyn_models.geometry.TrueGeometry`): the end time sets
them. The beam is cut where it would turn by more than 1.5 rad; the linear run on the same mesh takes what that
costs out of the difference.
"""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from bent_beam.impact import Impact
from bent_beam.method import Method
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import number, signed
from comparison.studies.thesis import Variant
from comparison.studies.variation import Setting, kinds_of, with_parts

__all__ = ["STUDY", "exudyn"]

DURATIONS = (1e-3, 1e-2, 3e-2, 1e-1)
TURN = 1.5  # rad
STEP = 5e-3  # h/t
SAVED = 250


def exudyn(geometry: str) -> Method:
    """The Exudyn path with its own choices, in larger steps than its default."""
    from exudyn_models import INTEGRATORS, ExudynModel
    from exudyn_models.geometry import GEOMETRIES

    integrator = INTEGRATORS["generalized_alpha"](relative_step=STEP)
    return ExudynModel(geometry=GEOMETRIES[geometry](), integrator=integrator)


def cut(case: Case) -> Impact:
    """The case's beam, cut where it would turn too far."""
    return case.impact.replace(length=min(case.impact.length, 2.0 * TURN / case.impact.curvature))


def vary(method: Method, case: Case) -> list[Setting]:
    """Every geometry that the method knows, over ever longer times."""
    impact = cut(case)
    return [
        Setting(
            f"{name}, τ = {tau:g}",
            with_parts(method, geometry=kind()),
            tau**0.5,
            impact,
            tau * impact.time_scale,
        )
        for tau in DURATIONS
        for name, kind in kinds_of(method, "geometry").items()
    ]


def variants(case: Case) -> list[Variant]:
    impact = cut(case)
    return [
        Variant(
            f"{geometry}, τ = {tau:g}",
            impact,
            tau * impact.time_scale,
            exudyn(geometry),
            value=tau**0.5,
            reference=True,
            save=SAVED,
        )
        for tau in DURATIONS
        for geometry in ("linear", "true")
    ]


def conclude(outcomes: Sequence[Outcome]) -> str:
    by_label = {o.label: o.measures for o in outcomes}
    drifts = []
    for tau in DURATIONS:
        linear, true = by_label.get(f"linear, τ = {tau:g}"), by_label.get(f"true, τ = {tau:g}")
        if linear is None or true is None:
            continue
        length, reaction = (_drift(linear[name], true[name]) for name in ("contact_length_error", "reaction_error"))
        if length is not None and reaction is not None:
            drifts.append((tau, length, reaction))
    if not drifts:
        return "At no amplitude did both geometries give numbers to compare."
    listed = "; ".join(f"√τ = {t**0.5:.2g}: λ₀ {signed(a)} %, r₀ {signed(b)} %" for t, a, b in drifts)
    per_square = [b / t for t, _, b in drifts[:-1]] or [drifts[0][2] / drifts[0][0]]
    even = max(per_square) < 2.0 * min(per_square)
    rule = f" While small, the drift of r₀ is the slope squared times {number(per_square[-1] / 100.0)}." if even else ""
    inside = [t**0.5 for t, a, b in drifts if max(abs(a), abs(b)) < 1.0]
    last = drifts[-1]
    verdict = (
        f"Linear theory holds within one per cent up to slopes of {max(inside):.2g}"
        if inside
        else "Linear theory is off by more than one per cent at all of them"
    )
    verdict += f"; at {last[0] ** 0.5:.2g} it is off by {number(max(abs(last[1]), abs(last[2])))} %."
    return f"What the true geometry changes against the linear limit on the same mesh: {listed}.{rule} {verdict}"


def _drift(linear: float | None, true: float | None) -> float | None:
    return None if linear is None or true is None else true - linear


STUDY = Study("amplitude", "True geometry against linear theory", variants, conclude, vary=vary, heading="geometry")
