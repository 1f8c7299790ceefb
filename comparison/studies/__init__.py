"""Parameter studies: what a numerical or physical parameter does to geometry, contact length, reaction and energy.

One small file a study; ``STUDIES`` names them, :func:`run_study` runs one on any case::

    from bent_beam.cases import load_case
    from comparison.studies import run_study

    print(run_study("mesh", load_case("cases/thesis_K10.toml")).text())
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from bent_beam.cases import Case
from bent_beam.method import Method
from comparison.studies import (
    amplitude,
    conditioning,
    contact_point,
    damping,
    far_field,
    first_order_case,
    friction,
    mesh,
    penalty,
    restitution,
    time_step,
)
from comparison.studies.base import Study, StudyResult, perform
from comparison.studies.of_methods import perform_on_methods

__all__ = ["STUDIES", "Study", "StudyResult", "run_study"]

STUDIES: dict[str, Study] = {
    module.STUDY.name: module.STUDY
    for module in (
        time_step,
        mesh,
        damping,
        restitution,
        contact_point,
        far_field,
        penalty,
        amplitude,
        friction,
        first_order_case,
        conditioning,
    )
}


def run_study(
    name: str,
    case: Case,
    *,
    methods: Sequence[Method] = (),
    refines: Sequence[float] = (1.0,),
    out: Path | None = None,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> StudyResult:
    """Run the study ``name`` on ``case``; with ``out`` its picture, data and conclusion are written there.

    methods : whose settings are varied, each at the resolutions ``refines``, in place of the thesis's.
    Raises ``ValueError`` for an unknown name or a flat beam.
    """
    if name not in STUDIES:
        raise ValueError(f"study {name!r} is not known (known: {', '.join(STUDIES)})")
    if case.impact.curvature <= 0.0:
        raise ValueError("beam.curvature must be positive for a study (got 0.0): a flat beam meets the wall at once")
    if methods:
        return perform_on_methods(STUDIES[name], case, methods, refines, out=out, jobs=jobs, progress=progress)
    return perform(STUDIES[name], case, out=out, jobs=jobs, progress=progress)
