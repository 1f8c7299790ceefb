"""The mesh (thesis 3.3.2, Figs 3.10–3.16): element length, growth outside the contact zone, "square" and scale-free
elements.
"""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from bent_beam.meshes import ScaleFreeMesh, SquareMesh
from comparison.studies.base import Study
from comparison.studies.exact import Exact
from comparison.studies.outcome import Outcome
from comparison.studies.thesis import Settings, Variant, cured, thesis_settings
from comparison.studies.words import between, cure, number, of_kind, signed

__all__ = ["STUDY", "square_mesh"]

LENGTHS = (2.0, 1.0, 0.6, 0.3)
GROWTHS = (1.05, 1.02)
PER_ELEMENT = 5.0  # the thesis's a: steps a front spends in each element of the square mesh


def square_mesh(case: Case, settings: Settings, per_element: float = PER_ELEMENT) -> SquareMesh | None:
    """x_i = λ₀√(ah)·√i over the zone (3.3.5–9), ``None`` when the contact does not spread or too many elements were
    needed.
    """
    exact = Exact(case.impact)
    first = float(exact.front(per_element * settings.time_step))
    if first <= 0.0 or (settings.zone / first) ** 2 > 6000:
        return None
    return SquareMesh(first_element=first, zone=settings.zone, growth=settings.growth)


def variants(case: Case) -> list[Variant]:
    base = thesis_settings(case.impact, case.end_time)
    runs = []
    for f in LENGTHS:
        length = f * base.element_length
        runs.append(
            Variant(
                f"Δx = {length:.2g} m, e = 1.25",
                case.impact,
                case.end_time,
                value=length,
                settings=base.replace(element_length=length),
            )
        )
    for growth in GROWTHS:
        runs.append(
            Variant(
                f"Δx = {base.element_length:.2g} m, e = {growth}",
                case.impact,
                case.end_time,
                value=growth,
                settings=base.replace(growth=growth),
            )
        )
    laid = square_mesh(case, base)
    if laid is not None:
        runs.append(Variant('"square" mesh', case.impact, case.end_time, settings=base.replace(mesh=laid)))
    even = ScaleFreeMesh(element_length=0.1 * base.element_length, growth=1.02)
    runs.append(
        Variant(
            "scale-free, held, damped",
            case.impact,
            case.end_time,
            settings=base.replace(mesh=even, hold=16, viscosity=0.3),
        )
    )
    return [*runs, cured(case.impact, case.end_time)]


def conclude(outcomes: Sequence[Outcome]) -> str:
    old = of_kind(outcomes, "thesis")
    lengths = [o for o in old if "e = 1.25" in o.label]
    base = lengths[1] if len(lengths) > 1 else lengths[0]
    slow = [o for o in old if "e = 1.02" in o.label]
    errors = [o.measures["reaction_error"] or 0.0 for o in lengths]
    falling = errors == sorted(errors, reverse=True) and errors[-1] > 0.0
    over = ": the reaction is overestimated while an element is longer than the front is thick" if falling else ""
    text = [
        f"Shorter elements {'lower' if _falls(lengths) else 'hardly change'} the lift ({between(lengths, 'lift')} "
        f"V₀t) and bring r₀ from {signed(errors[0])} % to {signed(errors[-1])} % of theory{over}."
    ]
    if slow:
        graded = _growth_words(base, slow[0])
        text.append(graded)
    square = [o for o in old if "square" in o.label]
    if square:
        m = square[0].measures
        text.append(
            f'The "square" mesh spreads the steps of λ_c evenly (the thesis\'s point) and gives a lift of '
            f"{number(m['lift'] or 0.0)} V₀t and r₀ {signed(m['reaction_error'] or 0.0)} %: its first elements "
            "are its longest, so the start is resolved worst."
        )
    text.append(cure(outcomes))
    return " ".join(text)


def _falls(lengths: Sequence[Outcome]) -> bool:
    first, last = (o.measures["lift"] or 0.0 for o in (lengths[0], lengths[-1]))
    return last < 0.7 * first


def _growth_words(base: Outcome, slow: Outcome) -> str:
    before, after = base.measures["noise"] or 0.0, slow.measures["noise"] or 0.0
    if after < 0.8 * before:
        return (
            f"Growing by 2 % an element in place of 25 % brings the noise of the reaction from {number(before)} to "
            f"{number(after)} % and the lift from {number(base.measures['lift'] or 0.0)} to "
            f"{number(slow.measures['lift'] or 0.0)} V₀t: here the coarse elements send waves back, "
            f"although the thesis found no effect of e."
        )
    return (
        f"Growing by 2 % an element in place of 25 % changes little here (noise {number(before)} and "
        f"{number(after)} %): the thesis is right for this case, whose waves are as short as its elements and do "
        "not leave the zone anyway."
    )


STUDY = Study("mesh", "Mesh", variants, conclude, heading="mesh")
