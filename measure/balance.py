"""Checks of a run from its state, which an energy budget cannot replace: momentum, initial energy, complementarity.

The momentum of the beam is integrated from the saved velocities, its mass taken from the problem, so that a wrong
impulse, a lost mass or a missing load shows, whatever the solver books:

    [∫μ v dx]₀ᵗ = pL t − J,    p the uniform load, less NK where N pulls along the tangents of the bow's ends.

v is taken as piecewise cubic: ∫v = Σ [h/2 (v₁ + v₂) + h²/12 (v₁′ − v₂′)], slopes by differences.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory

__all__ = ["Balance", "balance_of"]

Array = NDArray[np.float64]
PUSH = 1e-6  # of the largest gain of a contact point between two saved instants: less is no push
OUT_OF_BALANCE = 0.01  # of μLV₀
ROUND_OFF = 1e-9
LAST = 0.5  # of the run, of which pushes are looked at: earlier, the start is not resolved


@dataclass(frozen=True)
class Balance:
    """momentum : largest |momentum residual| over μLV₀; initial_energy : (recorded − ½μLV₀²)/½μLV₀² at t = 0, where the
    beam arrives with one velocity and no force bends it; gap_of_push : largest gap at the end of an interval in which
    a contact point pushed, over V₀t, in the second half of the run. ``None`` where a number means nothing."""

    momentum: float | None
    initial_energy: float | None
    gap_of_push: float | None

    @property
    def warnings(self) -> list[str]:
        """What is out of balance by more than a resolved run is."""
        found = []
        if self.momentum is not None and self.momentum > OUT_OF_BALANCE:
            found.append(
                f"momentum, impulse and loads do not balance: the residual is {100.0 * self.momentum:.2g} % of mu L V0"
            )
        if self.initial_energy is not None and abs(self.initial_energy) > ROUND_OFF:
            found.append(f"the initial kinetic energy is off by {100.0 * self.initial_energy:.2g} %: mass is missing")
        return found


def balance_of(history: ImpactHistory) -> Balance:
    """The checks of one run."""
    return Balance(_momentum_residual(history), _initial_energy(history), _gap_of_push(history))


def _momentum_residual(history: ImpactHistory) -> float | None:
    """``None`` where ends or an absorbing layer act on the beam, or the mesh moves along it."""
    impact, far = history.impact, history.settings.get("far_field") or {}
    absorbs = history.energy("loss_absorbed")[-1] != 0.0
    bent = impact.fourth_derivative or (impact.axial_force and impact.curvature_rate)  # ends that follow carry forces
    if "position" in history or "velocity" not in history or absorbs or _end(far) == "following" or (bent and not far):
        return None
    x, time = history.positions(0), history.time
    if abs(2.0 * float(np.abs(x).max()) / impact.length - 1.0) > 1e-4:  # a part of the beam
        return None
    mass = impact.mass_per_length * impact.length
    velocity = np.stack([_mean(x, history.array("velocity", k)) for k in range(time.size)])
    force = impact.net_load * impact.length
    residual = mass * (velocity - velocity[0]) - force * time + history.array("total_impulse")
    return float(np.abs(residual).max() / (mass * impact.velocity))


def _end(far: object) -> object:
    return far.get("end") if isinstance(far, dict) else None


def _mean(x: Array, v: Array) -> float:
    """Mean along the beam of a piecewise cubic through node values."""
    h, slope = np.diff(x), np.gradient(v, x, edge_order=2)
    whole = float(np.sum(0.5 * h * (v[1:] + v[:-1]) + h**2 / 12.0 * (slope[:-1] - slope[1:])))
    return whole / float(x[-1] - x[0])


def _initial_energy(history: ImpactHistory) -> float | None:
    impact = history.impact
    if impact.loaded or impact.rotation or "position" in history or "kinetic_energy" not in history:
        return None
    modelled = 2.0 * float(np.abs(history.positions(0)).max())
    whole = 0.5 * impact.mass_per_length * modelled * impact.velocity**2
    return float(history.array("kinetic_energy")[0]) / whole - 1.0


def _gap_of_push(history: ImpactHistory) -> float | None:
    """``None`` where contact points are no nodes, or nothing pushed."""
    places, x = history.contact_positions(0), history.positions(0)
    if "contact_position" in history or "position" in history or not np.all(np.isin(places, x)):
        return None
    nodes = np.searchsorted(x, places)
    first = int(np.searchsorted(history.time, LAST * history.time[-1]))
    largest, most = 0.0, 0.0
    before = history.array("impulse", first)
    gains, gaps = [], []
    for k in range(first + 1, history.time.size):
        impulse = history.array("impulse", k)
        gains.append(impulse - before)
        gaps.append(np.abs(history.array("gap", k)[nodes]) / (history.impact.velocity * history.time[k]))
        before = impulse
    most = max((float(gain.max()) for gain in gains), default=0.0)
    if most <= 0.0:
        return None
    for gain, gap in zip(gains, gaps):
        largest = max(largest, float(gap[gain > PUSH * most].max(initial=0.0)))
    return largest
