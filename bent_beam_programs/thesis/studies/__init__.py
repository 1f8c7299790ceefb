"""Parameter studies: the effect of a numerical or physical parameter on geometry, contact length, reaction and energy.

All are listed in ``STUDIES``; :func:`run_study` runs one on any case::

    from bent_beam.cases import load_case
    from bent_beam_programs.thesis.studies import run_study

    print(run_study("mesh", load_case("cases/thesis_K10.toml")).text())
"""

import json
from collections.abc import Sequence
from pathlib import Path

from bent_beam import Case, Method
from bent_beam.files import write_atomically
from bent_beam_programs.thesis.sheet import Sheet
from bent_beam_programs.thesis.studies import conditioning, first_order_case, numerical, of_exudyn
from bent_beam_programs.thesis.studies.base import Study, StudyResult, outcomes_of
from bent_beam_programs.thesis.studies.of_methods import CONCLUSION, draw_methods, runs_of_methods
from bent_beam_programs.thesis.studies.outcome import MEASURES, Outcome
from bent_beam_programs.thesis.studies.thesis import run_variants
from comparison.workers import Count

SAME = 30  # characters of a warning that tell its kind: its numbers differ from run to run

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
    progress: Count | None = None,
) -> StudyResult:
    """Run the study ``name`` on ``case``; with ``out`` its picture, data and result are written there.

    methods : whose settings are varied in place of the thesis's, each with elements and steps ``refines`` times finer.
    Raises ``ValueError`` for an unknown name or a flat beam.
    """
    if name not in STUDIES:
        raise ValueError(f"study {name!r} is not known (known: {', '.join(STUDIES)})")
    if case.impact.curvature <= 0.0:
        raise ValueError("beam.curvature must be positive for a study (got 0.0): a flat beam meets the wall at once")
    study, heads = STUDIES[name], {"label": STUDIES[name].heading}
    if methods:
        outcomes = run_variants(runs_of_methods(study.vary, case, methods, refines), jobs=jobs, progress=progress)
        heads = {"label": "method", **({"refine": "refine"} if set(refines) != {1.0} else {}), "setting": study.heading}
    else:
        outcomes = outcomes_of(study, case, jobs=jobs, progress=progress)
    rows = [o.row() for o in outcomes]
    measured = MEASURES if methods else study.columns
    result = StudyResult(
        name=study.name,
        title=study.title,
        case=case.title,
        columns=heads | {k: h for k, h in measured.items() if any(r.get(k) is not None for r in rows)},
        rows=rows,
        conclusion=CONCLUSION if methods else study.conclusion,
        files=[],
        warnings=_warnings([o for o in outcomes if methods or o.mark is not None]),
    )
    if out is not None:
        sheet = Sheet()
        if methods:
            draw_methods(sheet, study.heading, outcomes)
        else:
            study.draw(sheet, outcomes)
        try:
            _write(result, sheet, out)
        except OSError as error:  # the answer is worth more than its files
            result.problem = f"out: {error}"
    return result


def _warnings(outcomes: Sequence[Outcome]) -> list[str]:
    """Each kind of warning of a method once, with its first run."""
    found: dict[tuple[str, str], str] = {}
    for o in outcomes:
        for text in o.warnings:
            found.setdefault((o.method, text[:SAME]), f"{o.name}: {text}")
    return list(found.values())


def _write(result: StudyResult, sheet: Sheet, out: Path) -> None:
    """Picture with its curves' CSV, the table's CSV, and the result as JSON."""
    if sheet.figure_ is not None:
        result.files += [str(f) for f in sheet.save(out, result.name)]
    table, document = out / f"{result.name}-table.csv", out / f"{result.name}.json"
    cells = Sheet()
    cells.data(list(result.columns.values()), result.table())
    write_atomically(table, cells.csv())
    result.files += [str(table), str(document)]
    write_atomically(document, json.dumps(result.to_dict(), indent=1, allow_nan=False))
