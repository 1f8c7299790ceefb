"""A study of given methods in place of the thesis's settings: its parameter varied on each, a line a method."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter

from bent_beam.cases import Case
from bent_beam.errors import ANY_FAILURE
from bent_beam.method import Method, refined
from comparison.figures import style
from thesis.sheet import Sheet
from thesis.studies.outcome import Outcome, failed
from thesis.studies.thesis import Variant
from thesis.studies.variation import NotVaried, Setting, Vary

CONCLUSION = (
    "Each row is one setting of one method on the same case, compared with theory; a row without numbers gives the "
    "reason."
)
SMALLEST = 1e-6  # in the picture, on a logarithmic axis
PANELS: dict[str, str] = {
    "reaction_error": "error of $r_0$  (%)",
    "contact_length_error": r"error of $\lambda_0$  (%)",
    "lift": r"lift $/(V_0t)$  (1)",
    "noise": "noise of $R$  (%)",
}


def runs_of_methods(
    vary: Vary, case: Case, methods: Sequence[Method], refines: Sequence[float]
) -> list[Variant | Outcome]:
    """The runs of all methods at all resolutions.

    A method that the study cannot use, and one that refuses the case, are rows with the reason.
    """
    return [one for method in methods for factor in refines for one in _runs(vary, case, method, factor)]


def _runs(vary: Vary, case: Case, method: Method, factor: float) -> list[Variant | Outcome]:
    reason = f"refine: {method.path} does not know how to be refined (got {factor:g})"
    try:
        finer = refined(method, factor)
        reason = reason if finer is None else str(finer.refuses(case.impact) or "")
        if finer is not None and not reason:
            return [_run(method.label, one, case, factor) for one in vary(finer, case)]
    except NotVaried as error:
        reason = f"not varied: {error}"
    except ANY_FAILURE as error:
        reason = str(error)
    return [failed(method.label, case.impact, None, reason, refine=factor, refused=True)]


def _run(label: str, one: Setting, case: Case, factor: float) -> Variant:
    impact, end = one.impact or case.impact, case.end_time if one.end_time is None else one.end_time
    return Variant(label, impact, end, one.method, one.value, setting=one.name, refine=factor)


def draw_methods(sheet: Sheet, heading: str, outcomes: Sequence[Outcome]) -> None:
    """Errors, lift and noise over the settings, a line a method (and resolution)."""
    finished = [o for o in outcomes if o.failure is None]
    if not finished:
        return
    settings = list(dict.fromkeys(o.setting for o in finished))
    marks = style.marks(o.method for o in finished)
    height = 4.4 + 0.17 * -(-len(marks) // 2) + 0.06 * max(map(len, settings))
    with sheet.figure(2, 2, width=style.PAGE, height=height, sharex=True) as (fig, axes):
        for axis, (name, title) in zip(axes.flat, PANELS.items()):
            for label, mark in marks.items():
                mine = [o for o in finished if o.method == label]
                points = [(settings.index(o.setting), abs(v)) for o in mine if (v := o.measures.get(name)) is not None]
                if points:
                    x, y = np.array(points, float).T
                    line: dict[str, Any] = {k: v for k, v in mark.items() if k != "label"} | {"ls": "-", "lw": 0.7}
                    sheet.line(axis, x, np.maximum(y, SMALLEST), series=label, **line)
            _decades(axis)
            axis.set_ylabel(title)
            axis.set_xticks(range(len(settings)), settings, rotation=45.0, ha="right", rotation_mode="anchor")
            axis.set_xlim(-0.4, len(settings) - 0.6)
        for axis in axes[-1]:
            axis.set_xlabel(heading)
        handles, labels = max((a.get_legend_handles_labels() for a in axes.flat), key=lambda pair: len(pair[1]))
        fig.legend(handles, labels, loc="outside lower center", ncols=2, fontsize=6.5)


def _decades(axis: Axes) -> None:
    """A logarithmic axis over whole decades."""
    axis.set_yscale("log")
    axis.yaxis.set_minor_formatter(NullFormatter())
    drawn = [line.get_ydata() for line in axis.lines]
    if drawn:
        values = np.concatenate([np.asarray(y, float) for y in drawn])
        low, high = np.log10([values.min(), values.max()])
        axis.set_ylim(10.0 ** np.floor(low - 0.02), 10.0 ** np.ceil(high + 0.02))
