"""Made-up rows and real reduced impacts, small enough for every test of the report."""

from __future__ import annotations

from functools import cache

from comparison.matching import MatchFailure, MatchRow
from comparison.report.impacts import SHOWN, ShownImpact, show
from comparison.report.page import Content, machine
from comparison.report.studies import StudyNote
from theory import contact_parameters

NASTY = "<script>alert('x')</script> & \"quotes\" </script>"


def row(path: str, kappa: float, first: tuple[float, float, float] | None = None, off: float = 1e-4) -> MatchRow:
    """A row that is ``off`` (relative) from theory, with an error bar twice that."""
    exact = contact_parameters(kappa, *(first or (0.0, 0.0, 0.0)))
    lambda0, r0 = float(exact.lambda0), float(exact.r0)
    ones = {}
    for name in ("lambda1", "r1"):
        value = float(getattr(exact, name)) if first else None
        unit = max(abs(value), 1.0) if value is not None else None
        ones[name] = value + off * unit if unit else None
        ones[f"{name}_error"] = 2 * off * unit if unit else None
        ones[f"{name}_theory"] = value
    alpha, psi, chi = first or (0.0, 0.0, 0.0)
    return MatchRow(
        path=path, kappa_over_nu=kappa, alpha=alpha, psi=psi, chi=chi, regime=str(exact.regime),
        lambda0=lambda0 * (1 + off), lambda0_error=2 * off * lambda0, lambda0_theory=lambda0,
        r0=r0 * (1 - off), r0_error=2 * off * r0, r0_theory=r0, flatness=1e-9,
        seconds=0.5 if path == "hermite" else 5.0, epsilons=[0.1, 0.2] if first else [], warnings=[], **ones,
    )  # fmt: skip


def rows() -> list[MatchRow]:
    """Leading and first order on both paths; one row of each grade."""
    leading = [row(path, k) for k in (1 / 1600, 1 / 20, 0.25, 0.5) for path in ("hermite", "exudyn")]
    return [
        *leading,
        row("hermite", 0.5, (4, 0, 0), 2e-3),
        row("exudyn", 0.5, (4, 0, 0), 2.5e-2),
        row("hermite", 0.1, (1, 0, 0), 4e-2),
        row("hermite", 0.8, (-1, -1, 1), 0.2),
    ]


@cache
def impacts() -> tuple[ShownImpact, ...]:
    return tuple(show(s) for s in SHOWN)


def content(nasty: bool = False) -> Content:
    """All that a page shows; with ``nasty`` every string that comes from files holds markup."""
    every = rows()
    text = NASTY if nasty else "an ordinary warning"
    every[0].warnings.append(text)
    failure = MatchFailure("exudyn", 0.3, (1, 0, 0), text, f"bentbeam match --path exudyn # {text}")
    return Content(
        rows=every, failures=[failure], impacts=impacts(), lost_impacts=[text],
        studies=[StudyNote("mesh", text, text)], seconds=12.0, jobs=2,
        machine={**machine(), "processor": text},
    )  # fmt: skip
