"""The verdict on one beam: the theory at the times asked, until when it holds, whether the beam bounces, and, on
request, the same times by the whole-beam solver."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from bent_beam.cases import Case
from bent_beam.errors import InputError
from comparison.text_table import text_table
from comparison.whole_impact.stored_map import bounce_from_map
from theory import predict

__all__ = ["verdict", "verdict_text"]

TENSION = 1.0  # |nτ| from which on an expansion in it says nothing
SIMULATED = "hermite"  # the path that answers --simulate
INSTANTS = 400
SHARE = 0.9  # of the work of both runs, the finer's: it takes eight times the other's


def verdict(
    case: Case,
    times: Sequence[float],
    *,
    simulate: bool = False,
    progress: Callable[[float], None] | None = None,
) -> dict[str, Any]:
    """The contract of ``bentbeam predict --json``. ``progress``: called with the finished fraction of the simulation.

    Raises :class:`bent_beam.InputError` for a tension that the theory bears at none of the ``times``,
    :class:`bent_beam.SimulationError` where the simulation cannot finish.
    """
    impact = case.impact
    earliest = min(times) / impact.time_scale
    if abs(impact.epsilon_axial) * earliest > TENSION and not simulate:
        latest = TENSION * impact.time_scale / abs(impact.epsilon_axial)
        raise InputError(
            f"beam.axial_force: {impact.axial_force:.6g} N bends the answer beyond any expansion at {min(times):.3g} s "
            f"(N t/sqrt(mu EI) = {abs(impact.epsilon_axial) * earliest:.3g}); ask for times well before "
            f"{latest:.3g} s, or --simulate"
        )
    prediction = predict(impact, times, section=case.section)
    document = prediction.to_dict()
    document["warnings"] = [*case.warnings, *document["warnings"]]
    bounce = bounce_from_map(impact.kappa_over_nu, impact.relative_damping) if _free(case) else None
    document["bounce"] = None if bounce is None else {name: number.to_dict() for name, number in bounce.items()}
    document["warnings"] += _left(document)
    if simulate:
        document["simulated"] = _simulated(case, times, progress)
    document["summary"] = prediction.summary()
    return document


def _left(document: dict[str, Any]) -> list[str]:
    """A sentence on the times at which the beam has left the wall for good, where the map tells that."""
    last = None if document["bounce"] is None else document["bounce"]["last_contact"]
    if last is None:
        return []
    band = last.get("band")
    latest = band["mean"] + 2.0 * band["std"] if band else last["value"] + last["error"] if last["value"] else None
    later = [] if latest is None else [r for r in document["times"] if r["time"] > latest * document["slow_time_scale"]]
    if not later:
        return []
    instants = [f"{row['time']:.4g} s" for row in later]
    return [
        f"At {', '.join(instants)} the beam has left the wall: its last contact is over by "
        f"{latest * document['slow_time_scale']:.3g} s."
    ]


def _free(case: Case) -> bool:
    """Whether the whole impact is that of the map: a beam without loads, tension, rocking or a second wall."""
    i = case.impact
    return not (i.loaded or i.off_centre) and i.opposite_wall is None


def _simulated(
    case: Case, times: Sequence[float], progress: Callable[[float], None] | None
) -> list[dict[str, float | None]]:
    """The rows at ``times`` from one run of the whole beam with half as long steps and elements beside it."""
    from bent_beam.method import for_whole_beam, method_from_tables  # here: a prediction does without
    from comparison.estimators import last_tenth, local_front, moments
    from comparison.reduction import bending_moments

    impact = case.impact
    rows = []
    for factor, before, share in ((1.0, 0.0, SHARE), (0.5, SHARE, 1.0 - SHARE)):
        method = for_whole_beam(method_from_tables(SIMULATED, {"refine": factor}), impact)
        end = max(times)
        wanted = np.unique(np.concatenate([np.linspace(0.0, end, INSTANTS + 1)[1:], [t for t in times if t > 0.0]]))

        def tell(done: float, before: float = before, share: float = share) -> None:
            if progress is not None:
                progress(before + share * done)

        history = method.simulate(impact, end_time=end, save=wanted, progress=tell)
        found = moments(history)
        front = local_front(history.time, found.impulse, found.moment)
        total = history.array("total_impulse")
        run = []
        for t in times:
            k = int(np.argmin(np.abs(history.time - t)))
            j = last_tenth(history.time, k)
            span = history.time[k] - history.time[j]
            moment, _ = bending_moments(history, k)
            peak = float(np.abs(moment).max())
            run.append(
                {
                    "time": float(history.time[k]),
                    "half_contact_length": float(front[k]) * impact.length_scale,
                    "reaction": float((total[k] - total[j]) / span) if span > 0.0 else None,
                    "impulse": float(total[k]),
                    "peak_moment": peak,
                    "peak_stress": None if case.section is None else case.section.stress(peak, impact.axial_force),
                    "lift": float(found.lift[k]),
                }
            )
        rows.append(run)
    fine, coarse = rows
    for row, other in zip(fine, coarse):
        for name in ("half_contact_length", "reaction", "impulse", "peak_moment"):
            a, b = row[name], other[name]
            row[f"{name}_error"] = None if a is None or b is None else 1.5 * abs(a - b)
    return fine


def verdict_text(document: dict[str, Any]) -> str:
    """The verdict for a reader, in the order in which it is asked for."""
    lines = [document["summary"]]
    if document.get("simulated"):
        head = ["time, s", "half contact, m", "reaction, N", "impulse, N s", "moment, N m", "stress, Pa"]
        names = ("half_contact_length", "reaction", "impulse", "peak_moment")

        def cell(row: dict[str, Any], name: str) -> str:
            value, bar = row[name], row[f"{name}_error"]
            return "-" if value is None else f"{value:.5g}" + ("" if bar is None else f" ± {bar:.1g}")

        body = [
            [
                f"{row['time']:.4g}",
                *(cell(row, name) for name in names),
                "-" if row["peak_stress"] is None else f"{row['peak_stress']:.4g}",
            ]
            for row in document["simulated"]
        ]
        lines += ["", "The whole beam, simulated (reactions are means over the last tenth of the time):"]
        lines += [text_table(head, body)]
    lines += [f"warning: {w}" for w in document["warnings"] if w not in document["summary"]]
    bounce = document["bounce"]
    if bounce is not None:
        e = bounce["restitution"]
        if e.get("band"):
            said = f"between {e['band']['mean'] - e['band']['std']:.2g} and {e['band']['mean'] + e['band']['std']:.2g}"
            lines.append(f"The whole impact: the beam leaves with {said} of its velocity (no damping: a band).")
        elif e["value"] is not None:
            last = bounce["last_contact"]["value"]
            lines.append(
                f"The whole impact: the beam leaves with {e['value']:.3g} ± {e['error']:.1g} of its velocity, the last "
                f"contact at {last * document['slow_time_scale']:.3g} s."
                if last is not None
                else f"The whole impact: the beam leaves with {e['value']:.3g} ± {e['error']:.1g} of its velocity."
            )
    return "\n".join(lines)
