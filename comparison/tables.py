"""Tables for people and documents for programs, from the same rows."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from comparison.plain import json_text, plain
from comparison.readable import text_table
from comparison.rows import LEAST, MatchRow, failures
from comparison.store import write_atomically

__all__ = ["LEAST", "match_document", "match_table", "write_match"]

LEGEND = (
    "± is the error bar, % the difference from theory. lift: largest gap inside the contact zone; pull: largest",
    "adhesive over largest contact impulse; held: end of the bilateral start; s: seconds of the run.",
)


def match_document(rows: Sequence[MatchRow]) -> dict[str, Any]:
    """The contract of ``bentbeam match --json``: ``rows``, and ``failures``, those that failed unexpectedly."""
    names = ("label", "path", "kappa_over_nu", "reason")
    lost = [{name: getattr(row, name) for name in names} for row in failures(rows)]
    return {"rows": [asdict(r) for r in rows], "failures": lost}


def match_table(rows: Sequence[MatchRow]) -> str:
    """Value ± error bar, and the difference from theory in per cent."""
    first, refined = any(r.of_first_order for r in rows), any(r.refine != 1.0 for r in rows)
    elastic, names = any(r.wall for r in rows), ("lambda0", "r0", "lambda1", "r1")[: 4 if first else 2]
    head = ["method", "kappa/nu", *["refine"] * refined, *["alpha,psi,chi,N"] * first]
    head += [title for name in names for title in (name, "%")]
    head += ["F/(V0 sqrt(mu)(EI k)^1/4)"] * elastic
    head += ["lift/(V0 t)", "pull", "momentum", "gap of push", "held", "s"]
    body = []
    for r in rows:
        line = [r.label, f"{r.kappa_over_nu:.6g}", *[f"{r.refine:g}"] * refined]
        line += [",".join(f"{v:g}" for v in r.first) if r.of_first_order else "-"] * first
        for name in names:
            number = getattr(r, name)
            off = number.relative(LEAST[name])
            line += [str(number), "-" if off is None else f"{100 * off:+.3f}"]
        line += [str(r.peak_force)] * elastic
        line += ["-" if v is None else f"{v:.0e}" for v in (r.lift, r.pull, r.momentum_residual, r.gap_of_push)]
        line += ["-" if r.hold is None else f"until {r.hold['until']:.2g}"]
        body.append([*line, "-" if r.seconds is None else f"{r.seconds:.1f}"])
    notes = [f"{row_name(r)}: {r.reason}" for r in rows if r.reason]
    notes += [f"warning: {row_name(r)}: {w}" for r in rows for w in r.warnings]
    return "\n".join([text_table(head, body), "", *LEGEND, *notes])


def row_name(row: MatchRow) -> str:
    """A row in words."""
    text = f"{row.label}, kappa/nu = {row.kappa_over_nu:.6g}"
    text += f", (alpha, psi, chi, N) = ({', '.join(f'{v:g}' for v in row.first)})" if row.of_first_order else ""
    return text + (f", refined {row.refine:g} times" if row.refine != 1.0 else "")


def rows_csv(rows: Sequence[MatchRow]) -> str:
    """The rows as CSV with a header; compared numbers become three columns, missing ones stay empty."""
    table = []
    for row in rows:
        flat: dict[str, Any] = {}
        for key, value in plain(asdict(row)).items():
            if isinstance(value, dict) and set(value) == {"value", "error", "theory"}:
                flat |= {key: value["value"], f"{key}_error": value["error"], f"{key}_theory": value["theory"]}
            elif isinstance(value, dict):
                flat[key] = json_text(value)
            else:
                flat[key] = "; ".join(map(str, value)) if isinstance(value, list) else value
        table.append(flat)
    stream = io.StringIO()
    writer = csv.DictWriter(stream, fieldnames=list(table[0]) if table else [], lineterminator="\n")
    writer.writeheader()
    writer.writerows(table)
    return stream.getvalue()


def write_match(rows: Sequence[MatchRow], out: Path) -> list[Path]:
    """``match.json``, ``match.csv`` and the plots that the rows have data for, in ``out``; returns the files."""
    from comparison.figures.matching import draw_matching
    from comparison.figures.work_precision import draw_work_precision

    files = [out / "match.json", out / "match.csv"]
    write_atomically(files[0], json_text(match_document(rows), indent=1))
    write_atomically(files[1], rows_csv(rows))
    return files + draw_matching(rows, out) + draw_work_precision(rows, out)
