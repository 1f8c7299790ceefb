"""How far the first-order theory is from the full simulation: measured once on the Hermite path, kept as data, quoted
by ``predict``.

Simulation and theory at ε = 0 agree to 10⁻⁵, so what differs at ε > 0 is what the expansion leaves out: terms in (ετ)².
The error

    e(x) = max(|λ_c/λ_c,theory − 1|, |R/R_theory − 1|)   at   x = max(ε|λ₁|τ/λ₀, ε|r₁|τ/r₀)

depends on the regime, on κ/ν and on x. ``measured.json`` beside this module holds it for a load α alone; it is made by
``python -m comparison.validity`` (a minute) and read by :func:`measured_error` and the figure.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam.files import write_atomically
from bent_beam.impact import Impact
from bent_beam.versions import stamp
from comparison.estimators import Moments, moments
from theory import contact_parameters

__all__ = ["CORRECTIONS", "RATIOS", "add_measured_errors", "draw_validity", "measure", "measured", "measured_error"]

DATA = Path(__file__).with_name("measured.json")
CORRECTIONS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.3)
RATIOS = {
    "continuous": (0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8),
    "detached": (0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8),
    "discrete": (1.25, 2.0),
}
LOADS = {"continuous": 1.0, "detached": -1.0, "discrete": 1.0}


def measure(regime: str, kappa: float, corrections: Sequence[float] = CORRECTIONS) -> list[float]:
    """e(x) at ``corrections`` for a load α of the regime's sign, from one pair of runs on the expanding mesh."""
    from self_similar_fe.mesh import ExpandingMesh
    from self_similar_fe.run import simulate_expanding

    alpha = LOADS[regime]
    exact = contact_parameters(kappa, alpha, 0.0, 0.0)
    slope = abs(exact.r1) / exact.r0
    if exact.lambda0 > 0.0:
        slope = max(slope, abs(exact.lambda1) / exact.lambda0)
    end = 1.05 * max(corrections) / slope  # of ετ; ε = 1 and τ to match
    pressed = regime == "continuous"
    mesh = ExpandingMesh(
        front_resolution=0.003 if pressed else 0.01,
        interior_elements=60,
        step_ratio=0.03 if pressed else 0.02,
        decades=5.0,
    )
    loaded, bare = (
        moments(
            simulate_expanding(Impact.dimensionless(kappa, epsilon_alpha=a), mesh, end_time=end, save=300),
            uniform=a > 0.0 and pressed,
        )
        for a in (alpha, 0.0)
    )
    found = []
    for x in corrections:
        at = x / slope
        force, front = (
            (_local(loaded, at, i) / _local(bare, at, i) for i in (0, 1))
            if exact.lambda0 > 0.0
            else (_local(loaded, at, 0) / _local(bare, at, 0), None)
        )
        error = abs(force / (1.0 + exact.r1 / exact.r0 * at) - 1.0)
        if front is not None:
            error = max(error, abs(front / (1.0 + exact.lambda1 / exact.lambda0 * at) - 1.0))
        found.append(float(error))
    return found


def _local(run: Moments, at: float, which: int) -> float:
    """Reaction (0) or contact length (1) around τ = ``at``, from a straight line through a third of an e-fold of
    impulses.
    """
    inside = (run.tau > at / 1.18) & (run.tau < at * 1.18)
    root, tau = np.sqrt(run.tau[inside]), run.tau[inside]
    force = np.polyfit(root - np.sqrt(at), run.impulse[inside], 2)[1]
    if which == 0:
        return float(force)
    return float(np.polyfit(tau - at, run.moment[inside], 2)[1] / force)


def write() -> Path:
    """Measure everything anew and write ``measured.json``."""
    table = {
        regime: [{"kappa_over_nu": k, "error": measure(regime, k)} for k in ratios] for regime, ratios in RATIOS.items()
    }
    about = {
        "what": "relative error of first-order theory against simulation at relative corrections x, by kappa/nu",
        **stamp("python -m comparison.validity"),
        "settings": {"path": "self_similar", "loads": LOADS},
    }
    write_atomically(DATA, json.dumps(about | {"corrections": CORRECTIONS, "regimes": table}, indent=1) + "\n")
    return DATA


@cache
def measured() -> dict[str, Any]:
    """The stored measurement."""
    return dict(json.loads(DATA.read_text()))


def measured_error(regime: str, kappa_over_nu: float, correction: float) -> float | None:
    """Measured relative error of the first-order theory at a relative ``correction`` x, the larger of the two nearest
    κ/ν.

    ``None`` beyond the measured corrections (x > 0.3); at x = 0 the agreement of the leading order, 10⁻⁴.
    """
    table = measured()
    x = np.array([0.0, *table["corrections"]])
    if not correction <= x[-1]:
        return None
    rows = sorted(table["regimes"][regime], key=lambda r: abs(np.log(r["kappa_over_nu"] / kappa_over_nu)))[:2]
    return max(float(np.interp(correction, x, [1e-4, *row["error"]])) for row in rows)


def add_measured_errors(prediction: dict[str, Any]) -> list[str]:
    """Add ``measured_error`` to each time of a prediction (``Prediction.to_dict()``); returns it in plain sentences."""
    notes = []
    for row in prediction["times"]:
        size = prediction["epsilon"] * row["tau"]
        correction = size * abs(prediction["r1"]) / prediction["r0"]
        if prediction["lambda0"] > 0.0:
            correction = max(correction, size * abs(prediction["lambda1"]) / prediction["lambda0"])
        row["correction"] = correction
        found = measured_error(prediction["regime"], prediction["kappa_over_nu"], correction)
        row["measured_error"] = found
        if correction == 0.0:
            continue
        what = "further than was measured" if found is None else f"within {100 * found:.2g} % of full simulation there"
        notes.append(f"At t = {row['time']:.4g} s first order changes the result by {100 * correction:.2g} %: {what}.")
    return notes


def draw_validity(out: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """The validity map: e over x, a line for each κ/ν, a panel for each regime."""
    from comparison.figures import style

    table = measured()
    x = np.array(table["corrections"])
    with style.figure(1, 3, width=style.PAGE, height=2.8, sharey=True) as (fig, axes):
        for axis, (regime, rows) in zip(axes, table["regimes"].items()):
            for i, row in enumerate(rows):
                axis.loglog(
                    x,
                    100 * np.maximum(row["error"], 1e-6),
                    marker=".",
                    color=style.SEQUENCE[i % len(style.SEQUENCE)],
                    label=f"{row['kappa_over_nu']:g}",
                )
            axis.loglog(x, 100 * x**2, **{**style.OLD, "label": r"$x^2$"})
            axis.set_xlabel(r"$\max(\varepsilon|\lambda_1|\tau/\lambda_0,\ \varepsilon|r_1|\tau/r_0)$  (1)")
            axis.legend(title=rf"{regime}, $\kappa/\nu$", ncols=2, fontsize=6.5)
        axes[0].set_ylabel("theory against simulation  (%)")
        return style.save(fig, out, "validity", formats)


if __name__ == "__main__":
    print(write())
