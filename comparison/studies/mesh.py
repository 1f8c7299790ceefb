"""The mesh (thesis 3.3.2, Figs 3.10–3.16): element length, growth outside the contact zone, "square" and scale-free
elements.
"""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from bent_beam.meshes import ScaleFreeMesh, SquareMesh
from bent_beam.method import Method
from comparison.studies.base import Study
from comparison.studies.exact import Exact
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import between, number, reference_sentences, signed, values, varied
from comparison.studies.thesis import Settings, Variant, references, thesis_settings
from comparison.studies.variation import Setting, resolution, with_growth

__all__ = ["STUDY", "square_mesh"]

LENGTHS = (2.0, 1.0, 0.6, 0.3)
GROWTHS = (1.05, 1.02)
OF_METHODS = (2.0, 1.0, 0.5)  # times the elements of a method's own mesh
PER_ELEMENT = 5.0  # the thesis's a: steps a front spends in each element of the square mesh
SQUARE, SCALE_FREE = '"square" mesh', "scale-free, held, damped"


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
    impact, end = case.impact, case.end_time
    base = thesis_settings(impact, end)

    def run(label: str, value: float | None, **changes: object) -> Variant:
        return Variant(label, impact, end, base.replace(**changes).method(), value=value)

    lengths = [f * base.element_length for f in LENGTHS]
    runs = [run(f"Δx = {length:.2g} m, e = 1.25", length, element_length=length) for length in lengths]
    runs += [run(f"Δx = {base.element_length:.2g} m, e = {g}", g, growth=g) for g in GROWTHS]
    laid = square_mesh(case, base)
    if laid is not None:
        runs.append(run(SQUARE, None, mesh=laid))
    even = ScaleFreeMesh(element_length=0.1 * base.element_length, growth=1.02)
    runs.append(run(SCALE_FREE, None, mesh=even, hold=16, viscosity=0.3))
    return [*runs, *references(impact, end)]


def vary(method: Method, case: Case) -> list[Setting]:
    """Elements so many times longer, then other growths; the steps stay."""
    mesh, laid_on = resolution(method, case)
    found = [Setting(f"Δx × {f:g}", laid_on(mesh.refined(1.0 / f)), f) for f in OF_METHODS]
    grown = {growth: with_growth(mesh, growth) for growth in GROWTHS}
    return found + [Setting(f"e = {e:g}", laid_on(other), e) for e, other in grown.items() if other is not None]


def conclude(outcomes: Sequence[Outcome]) -> str:
    runs = varied(outcomes)
    lengths = [o for o in runs if "e = 1.25" in o.label]
    errors = values(lengths, "reaction_error")
    text = []
    if len(errors) > 1:
        falling = errors == sorted(errors, reverse=True) and errors[-1] > 0.0
        over = ": the reaction is overestimated while an element is longer than the front is thick" if falling else ""
        lower = lengths[-1].measure("lift") < 0.7 * lengths[0].measure("lift")
        text.append(
            f"Shorter elements {'lower' if lower else 'hardly change'} the lift ({between(lengths, 'lift')} "
            f"V₀t) and bring r₀ from {signed(errors[0])} % to {signed(errors[-1])} % of theory{over}."
        )
    slow = [o for o in runs if "e = 1.02" in o.label]
    if slow and len(lengths) > 1:
        text.append(_growth(lengths[1], slow[0]))
    for o in runs:
        if o.label == SQUARE:
            text.append(
                f'The "square" mesh spreads the steps of λ_c evenly (the thesis\'s point) and gives a lift of '
                f"{number(o.measures['lift'])} V₀t and r₀ {signed(o.measures['reaction_error'])} %: its first elements "
                "are its longest, so the start is resolved worst."
            )
    return " ".join([*text, reference_sentences(outcomes)])


def _growth(base: Outcome, slow: Outcome) -> str:
    before, after = base.measure("noise"), slow.measure("noise")
    if after < 0.8 * before:
        return (
            f"Growing by 2 % an element in place of 25 % brings the noise of the reaction from {number(before)} to "
            f"{number(after)} % and the lift from {number(base.measures['lift'])} to "
            f"{number(slow.measures['lift'])} V₀t: "
            "here the coarse elements send waves back, although the thesis found no effect of e."
        )
    return (
        f"Growing by 2 % an element in place of 25 % changes little here (noise {number(before)} and "
        f"{number(after)} %): the thesis is right for this case, whose waves are as short as its elements and do "
        "not leave the zone anyway."
    )


STUDY = Study("mesh", "Mesh", variants, conclude, vary=vary, heading="mesh")
