"""Parameter studies: the effect of a numerical or physical parameter on geometry, contact length, reaction and energy.

All are listed in ``STUDIES``; :func:`run_study` runs one on any case::

    from bent_beam.cases import load_case
    from thesis.studies import run_study

    print(run_study("mesh", load_case("cases/thesis_K10.toml")).text())
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from bent_beam.cases import Case
from bent_beam.method import Method
from thesis.studies import conditioning, first_order_case, numerical, of_exudyn
from thesis.studies.base import Study, StudyResult, perform

__all__ = ["STUDIES", "Study", "StudyResult", "run_study"]

LISTED = (
    *(numerical.TIME_STEP, numerical.MESH, numerical.DAMPING, numerical.RESTITUTION, numerical.CONTACT_POINT),
    numerical.FAR_FIELD,
    *(of_exudyn.PENALTY, of_exudyn.AMPLITUDE, of_exudyn.FRICTION, first_order_case.STUDY, conditioning.STUDY),
)
STUDIES: dict[str, Study] = {study.name: study for study in LISTED}


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
    """Run the study ``name`` on ``case``; with ``out`` its picture, data and result are written there.

    methods : whose settings are varied, each at the resolutions ``refines``, in place of the thesis's.
    Raises ``ValueError`` for an unknown name or a flat beam.
    """
    if name not in STUDIES:
        raise ValueError(f"study {name!r} is not known (known: {', '.join(STUDIES)})")
    if case.impact.curvature <= 0.0:
        raise ValueError("beam.curvature must be positive for a study (got 0.0): a flat beam meets the wall at once")
    return perform(STUDIES[name], case, methods, refines, out=out, jobs=jobs, progress=progress)
