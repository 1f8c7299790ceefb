"""A study of given methods in place of the thesis's settings: its parameter varied on each, a line a method."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter

from bent_beam.cases import Case
from bent_beam.method import Method, refined
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.studies.base import Progress, Study, StudyResult, used_measures, write_result
from comparison.studies.outcome import Outcome, failed
from comparison.studies.sentences import between, signed
from comparison.studies.thesis import Variant, run_variants
from comparison.studies.variation import NotVaried

__all__ = ["asked_of", "perform_on_methods"]

SAME = 30  # characters of a warning that tell its kind: its numbers differ from run to run
SMALLEST = 1e-6  # in the picture, of what is drawn on a logarithmic axis
PANELS: dict[str, str] = {
    "reaction_error": "error of $r_0$  (%)",
    "contact_length_error": r"error of $\lambda_0$  (%)",
    "lift": r"lift $/(V_0t)$  (1)",
    "noise": "noise of $R$  (%)",
}


def perform_on_methods(
    study: Study,
    case: Case,
    methods: Sequence[Method],
    refines: Sequence[float] = (1.0,),
    *,
    out: Path | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
) -> StudyResult:
    """Run ``study`` on each of ``methods``, with elements and steps ``refines`` times finer.

    A method that the study cannot use, and a setting that a method refuses, are rows with the reason.
    """
    asked = [one for method in methods for factor in refines for one in asked_of(study, case, method, factor)]
    runs = [one for one in asked if isinstance(one, Variant)]
    done = iter(run_variants(runs, jobs=jobs, progress=progress))
    outcomes = [next(done) if isinstance(one, Variant) else one for one in asked]
    several = len(set(refines)) > 1 or any(f != 1.0 for f in refines)
    result = StudyResult(
        name=study.name,
        title=study.title,
        case=case.title,
        columns={
            "label": "method",
            **({"refine": "refine"} if several else {}),
            "setting": study.heading,
            **used_measures(outcomes),
        },
        rows=[o.row() for o in outcomes],
        conclusion=_conclusion(outcomes),
        outcomes=outcomes,
        warnings=_warnings(outcomes),
    )
    sheet = Sheet()
    if out is not None:
        _draw(sheet, study, outcomes)
        result.files = write_result(result, sheet, out)
    sheet.close()
    return result


def asked_of(study: Study, case: Case, method: Method, factor: float) -> list[Variant | Outcome]:
    """The runs of one method at one resolution, or the row that says why there are none."""

    def none(reason: str) -> list[Variant | Outcome]:
        return [failed(method.label, case.impact, None, " ".join(reason.split()), refine=factor, refused=True)]

    finer = refined(method, factor)
    if finer is None:
        return none(f"refine: {method.path} does not know how to be refined (got {factor:g})")
    reason = finer.refuses(case.impact)
    if reason:
        return none(reason)
    if study.vary is None:
        return none(f"study {study.name} does not vary methods")
    try:
        settings = study.vary(finer, case)
    except NotVaried as error:
        return none(f"not varied: {error}")
    except ValueError as error:
        return none(str(error))
    return [
        Variant(
            method.label,
            case.impact if one.impact is None else one.impact,
            case.end_time if one.end_time is None else one.end_time,
            one.method,
            value=one.value,
            setting=one.name,
            refine=factor,
        )
        for one in settings
    ]


# --- what it shows -------------------------------------------------------------------------------------------------


def _lines(outcomes: Sequence[Outcome]) -> dict[str, list[Outcome]]:
    """Finished runs by method and resolution, as they are called in words."""
    found: dict[str, list[Outcome]] = {}
    for o in outcomes:
        if o.failure is None:
            found.setdefault(o.method, []).append(o)
    return found


def _warnings(outcomes: Sequence[Outcome]) -> list[str]:
    """What the runs of a method warn of, each kind once: with the first run that does, and how many do."""
    found: dict[tuple[str, str], list[tuple[Outcome, str]]] = {}
    for o in outcomes:
        for text in o.warnings:
            found.setdefault((o.method, text[:SAME]), []).append((o, text))
    return [
        f"{method}, {given[0][0].setting}{f' and {len(given) - 1} more' if len(given) > 1 else ''}: {given[0][1]}"
        for (method, _), given in found.items()
    ]


def _conclusion(outcomes: Sequence[Outcome]) -> str:
    text = [_of_method(name, runs) for name, runs in _lines(outcomes).items()]
    left = [f"{o.name} ({o.failure})" for o in outcomes if o.failure is not None]
    if left:
        text.append(f"Without a number: {'; '.join(left)}.")
    return " ".join(text)


def _of_method(name: str, runs: Sequence[Outcome]) -> str:
    errors = [(abs(e), o) for o in runs if (e := o.measures.get("reaction_error")) is not None]
    text = (
        f"{name}: over {len(runs)} settings λ₀ is off by {between(runs, 'contact_length_error', ' %')}, r₀ by "
        f"{between(runs, 'reaction_error', ' %')}; lift {between(runs, 'lift')} V₀t, noise "
        f"{between(runs, 'noise', ' %')}"
    )
    if len(errors) > 1:
        best = min(errors, key=lambda pair: pair[0])[1]
        text += f"; r₀ is nearest with {best.setting} ({signed(best.measures['reaction_error'])} %)"
    return f"{text}."


def _draw(sheet: Sheet, study: Study, outcomes: Sequence[Outcome]) -> None:
    """Errors, lift and noise over the settings, a line a method (and resolution)."""
    lines = _lines(outcomes)
    if not lines:
        return
    settings = list(dict.fromkeys(o.setting for o in outcomes if o.failure is None))
    marks = style.marks(lines)
    legend = 0.17 * -(-len(lines) // 2) + 0.2
    ticks = 0.06 * max(map(len, settings))
    with sheet.figure(2, 2, width=style.PAGE, height=4.2 + legend + ticks, sharex=True) as (fig, axes):
        for axis, (name, title), letter in zip(axes.flat, PANELS.items(), "abcd"):
            for label, runs in lines.items():
                points = [(settings.index(o.setting), abs(v)) for o in runs if (v := o.measures.get(name)) is not None]
                if points:
                    x, y = np.array(points, float).T
                    look = {k: v for k, v in marks[label].items() if k != "label"}
                    sheet.line(axis, x, np.maximum(y, SMALLEST), series=label, **{**look, "ls": "-", "lw": 0.7})
            _decades(axis, [line.get_ydata() for line in axis.lines])
            axis.set_ylabel(title)
            axis.set_xticks(range(len(settings)), settings, rotation=45.0, ha="right", rotation_mode="anchor")
            axis.set_xlim(-0.4, len(settings) - 0.6)
            sheet.panel(axis, letter)
        for axis in axes[-1]:
            axis.set_xlabel(study.heading)
        handles, labels = max((a.get_legend_handles_labels() for a in axes.flat), key=lambda pair: len(pair[1]))
        missing = sum(o.failure is not None for o in outcomes)
        said = f"left out, no number: {missing} row{'s' if missing > 1 else ''} of the table" if missing else None
        fig.legend(
            handles, labels, loc="outside lower center", ncols=2, fontsize=6.5, title=said, title_fontsize=6.5
        )


def _decades(axis: Axes, drawn: Sequence[Any]) -> None:
    """A logarithmic axis over whole decades."""
    axis.set_yscale("log")
    axis.yaxis.set_minor_formatter(NullFormatter())
    if drawn:
        low, high = (float(f(np.concatenate(drawn))) for f in (np.min, np.max))
        axis.set_ylim(10.0 ** np.floor(np.log10(low) - 0.02), 10.0 ** np.ceil(np.log10(high) + 0.02))
