"""Tables for people and documents for programs, from the same rows."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from comparison.matching import MatchFailure, MatchRow
from comparison.store import write_atomically

__all__ = ["match_document", "match_table", "relative_error", "run_table", "write_match"]


def relative_error(value: float, exact: float) -> float:
    """Error relative to max(|exact|, 1), as everywhere in this project; λ₀ and r₀ relative to themselves when > 0."""
    return (value - exact) / max(abs(exact), 1.0)


def leading_error(value: float, exact: float) -> float:
    """Relative error of λ₀ or r₀; absolute for λ₀ = 0 (discrete contact)."""
    return (value - exact) / exact if exact > 0.0 else value


def match_document(rows: Sequence[MatchRow], failures: Sequence[MatchFailure]) -> dict[str, Any]:
    """The contract of ``bentbeam match --json``: ``rows``, and ``failures`` with how to ask again."""
    return {"rows": [asdict(r) for r in rows], "failures": [asdict(f) for f in failures]}


def match_table(rows: Sequence[MatchRow], failures: Sequence[MatchFailure] = ()) -> str:
    """A plain text table: value ± error bar, and the difference from theory in per cent."""
    head = [
        "path",
        "kappa/nu",
        "alpha,psi,chi",
        "lambda0",
        "%",
        "r0",
        "%",
        "lambda1",
        "%",
        "r1",
        "%",
        "lift/(V0 t)",
        "s",
    ]
    body = []
    for r in rows:
        first = r.lambda1 is not None
        body.append(
            [
                r.path,
                f"{r.kappa_over_nu:.6g}",
                f"{r.alpha:g},{r.psi:g},{r.chi:g}" if first else "-",
                f"{r.lambda0:.6g}±{r.lambda0_error:.0e}",
                f"{100 * leading_error(r.lambda0, r.lambda0_theory):+.3f}",
                f"{r.r0:.6g}±{r.r0_error:.0e}",
                f"{100 * leading_error(r.r0, r.r0_theory):+.3f}",
                *_first_cells(r.lambda1, r.lambda1_error, r.lambda1_theory),
                *_first_cells(r.r1, r.r1_error, r.r1_theory),
                f"{r.flatness:.0e}",
                f"{r.seconds:.1f}",
            ]
        )
    widths = [max(len(row[i]) for row in [head, *body]) for i in range(len(head))]
    lines = ["  ".join(cell.rjust(w) for cell, w in zip(row, widths)) for row in [head, *body]]
    lines.insert(1, "  ".join("-" * w for w in widths))
    notes = [f"warning: {r.path}, kappa/nu = {r.kappa_over_nu:g}: {w}" for r in rows for w in r.warnings]
    lost = [f"failed: {f.path}, kappa/nu = {f.kappa_over_nu:g}: {f.reason}" for f in failures]
    return "\n".join([*lines, *notes, *lost])


def _first_cells(value: float | None, error: float | None, exact: float | None) -> list[str]:
    if value is None or error is None or exact is None:
        return ["-", "-"]
    return [f"{value:.4g}±{error:.0e}", f"{100 * relative_error(value, exact):+.2f}"]


def run_table(found: dict[str, Any]) -> str:
    """The summary of one run for a reader."""
    exact = found["theory"] or {}

    def line(name: str, unit: str, value: float | None, other: float | None = None) -> str:
        text = f"{name:>30}  {'-' if value is None else f'{value:.6g}'} {unit}"
        return text + ("" if other is None else f"   (theory {other:.6g})")

    energy = found["energy"]
    lines = [
        f"{found['path']} path, {found['steps']} steps in {found['seconds']:.2f} s",
        line("time", "s", found["time"]),
        line("half contact length", "m", found["half_contact_length"], exact.get("half_contact_length")),
        line("total impulse", "N s", found["total_impulse"], exact.get("total_impulse")),
        line("largest gap inside the zone", "m", found["largest_gap_in_contact_zone"]),
    ]
    if found["lambda0"] is not None:
        lines.append(
            f"{'lambda0':>30}  {found['lambda0']:.6g} ± {found['lambda0_error']:.1g}"
            + (f"   (theory {exact['lambda0']:.6g})" if exact else "")
        )
        lines.append(
            f"{'r0':>30}  {found['r0']:.6g} ± {found['r0_error']:.1g}"
            + (f"   (theory {exact['r0']:.6g})" if exact else "")
        )
    lines += [line(name.replace("_", " "), "J", value) for name, value in energy.items()]
    lines += [f"warning: {w}" for w in found["warnings"]]
    if found["file"]:
        lines.append(f"history: {found['file']}")
    return "\n".join(lines)


def rows_csv(rows: Sequence[MatchRow]) -> str:
    """The rows as CSV with a header."""
    stream = io.StringIO()
    if rows:
        writer = csv.DictWriter(stream, fieldnames=list(asdict(rows[0])), lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({k: "; ".join(map(str, v)) if isinstance(v, list) else v for k, v in asdict(row).items()})
    return stream.getvalue()


def write_match(rows: Sequence[MatchRow], failures: Sequence[MatchFailure], out: Path) -> list[Path]:
    """``match.json``, ``match.csv`` and the matching plots in ``out``; returns the files."""
    from comparison.figures.matching import draw_matching

    files = [out / "match.json", out / "match.csv"]
    write_atomically(files[0], json.dumps(match_document(rows, failures), indent=1, allow_nan=False))
    write_atomically(files[1], rows_csv(rows))
    return files + draw_matching(rows, out)
