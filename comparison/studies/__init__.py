"""Parameter studies: what a numerical or physical parameter does to geometry, contact length, reaction and energy.

One small file a study; ``STUDIES`` names them, :func:`run_study` runs one on any case::

    from bent_beam.cases import load_case
    from comparison.studies import run_study

    print(run_study("mesh", load_case("cases/thesis_K10.toml")).text())
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from bent_beam.cases import Case
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
    name: str, case: Case, *, out: Path | None = None, jobs: int = 1, progress: Callable[[int, int], None] | None = None
) -> StudyResult:
    """Run the study ``name`` on ``case``; with ``out`` its picture, data and conclusion are written there.

    Raises ``ValueError`` for an unknown name or a flat beam.
    """
    if name not in STUDIES:
        raise ValueError(f"study {name!r} is not known (known: {', '.join(STUDIES)})")
    return perform(STUDIES[name], case, out=out, jobs=jobs, progress=progress)
