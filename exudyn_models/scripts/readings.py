"""What a model script reads off its history, by the two integrals of the reaction that leading and first order give
in closed form:

    I(t) = c + 4√(2/π) μV₀√(√(EI/μ)) √t (r₀ + ελ…)        total impulse
    M(t) = Σ x_i I_i(t) = c + √(2/π) μV₀√(EI/μ) t (r₀λ₀ + …)    its moment about x = 0, one side

fitted over the last decade of time, where the offset c takes up the unresolved start. The estimators of record are in
``comparison``; these are short enough to read along.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bent_beam import ImpactHistory

__all__ = ["first_order", "leading_order"]

Array = NDArray[np.float64]
ROOT = np.sqrt(2.0 / np.pi)


def _integrals(history: ImpactHistory) -> tuple[Array, Array, Array]:
    """τ, total impulse and one-sided moment in units of the fast layer, over the last decade of time."""
    impact = history.impact
    tau = history.time / impact.time_scale
    unit = impact.mass_per_length * impact.length_scale * impact.velocity
    moment = history.array("impulse") @ np.abs(history.array("contact_x")) / (unit * impact.length_scale)
    if history.dataset.attrs["symmetry"] == "full":
        moment = moment / 2.0
    last = tau >= 0.1 * tau[-1]
    return tau[last], history.array("total_impulse")[last] / unit, moment[last]


def _fit(values: Array, *basis: Array) -> Array:
    columns = np.stack([np.ones_like(values), *basis], axis=1)
    scale = np.abs(columns).max(axis=0)
    return np.asarray(np.linalg.lstsq(columns / scale, values, rcond=None)[0] / scale)[1:]


def leading_order(history: ImpactHistory) -> tuple[float, float]:
    """λ₀ and r₀ (ν = 1) of a run."""
    tau, impulse, moment = _integrals(history)
    r0 = _fit(impulse, 4 * ROOT * np.sqrt(tau))[0]
    return float(_fit(moment, ROOT * tau)[0] / r0), float(r0)


def first_order(history: ImpactHistory, base: ImpactHistory, lambda0: float, r0: float) -> tuple[float, float]:
    """ελ₁ and εr₁ (ν = 1) of a run, from its difference against the same run without acceleration, load or rates.

    The uniform reaction ε(α+ψ) in the zone, where it is positive, is taken out of both integrals.
    """
    tau, impulse, moment = _integrals(history)
    _, base_impulse, base_moment = _integrals(base)
    uniform = max(history.impact.epsilon_alpha + history.impact.epsilon_psi, 0.0)
    impulse = impulse - base_impulse - uniform * 2 * lambda0 * tau**1.5 / 1.5
    moment = moment - base_moment - uniform * lambda0**2 * tau**2 / 4
    r1 = _fit(impulse, np.sqrt(tau), 4 * ROOT * tau**1.5 / 3)[1]
    moment1 = _fit(moment, tau, ROOT * tau**2 / 2)[1]
    return float((moment1 - r1 * lambda0) / r0), float(r1)
