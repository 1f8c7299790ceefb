"""How far the first-order theory is from the full simulation: measured once on the self-similar path, kept as data that
the second-order theory is tested against.

Simulation and theory at ε = 0 agree to 10⁻⁵, so what differs at ε > 0 is what the expansion leaves out: terms in (ετ)².
The error

    e(x) = max(|λ_c/λ_c,theory − 1|, |R/R_theory − 1|)   at   x = max(ε|λ₁|τ/λ₀, ε|r₁|τ/r₀)

depends on the regime, on κ/ν and on x. ``measured.json`` beside this module holds it for a load α alone; it is made by
``python -m comparison.validity`` (a minute).
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

__all__ = ["CORRECTIONS", "RATIOS", "measure", "measured"]

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
    """Reaction (0) or contact length (1) around τ = ``at``, from a parabola through a third of an e-fold of
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


if __name__ == "__main__":
    print(write())
