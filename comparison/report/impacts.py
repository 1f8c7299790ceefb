"""Impacts to look at: a history reduced to what a reader scrubs through, in units of the fast layer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from comparison.estimators import moments
from comparison.figures.force_map import force_map
from comparison.plain import plain
from theory import ContactParameters, contact_parameters

__all__ = ["SHOWN", "Shown", "ShownImpact", "reduce_history", "show"]

Array = NDArray[np.float64]
FRAMES = 60
POINTS = 121
BINS = 70
END = 0.1  # τ


@dataclass(frozen=True)
class Shown:
    """An impact to be shown: κ/ν, (α, ψ, χ) and the size ε of the first order, ν = 1."""

    name: str
    title: str
    kappa_over_nu: float = 0.5
    first: tuple[float, float, float] = (0.0, 0.0, 0.0)
    epsilon: float = 0.0

    @property
    def impact(self) -> Impact:
        alpha, psi, chi = self.first
        return Impact.dimensionless(
            self.kappa_over_nu,
            epsilon_alpha=self.epsilon * alpha,
            epsilon_psi=self.epsilon * psi,
            epsilon_chi=self.epsilon * chi,
        )


SHOWN = (
    Shown("plain", "no acceleration (ε = 0)"),
    Shown("pressed", "accelerated into the wall (α = 4)", first=(4.0, 0.0, 0.0), epsilon=0.25),
    Shown("released", "decelerated and bending back (α = ψ = −1)", first=(-1.0, -1.0, 0.0), epsilon=1.5),
)


@dataclass(frozen=True)
class ShownImpact:
    """A reduced history; see :func:`reduce_history` for what ``data`` holds."""

    shown: Shown
    data: Mapping[str, Any]
    settings: Mapping[str, Any]
    seconds: float
    steps: int
    warnings: tuple[str, ...]


def show(shown: Shown) -> ShownImpact:
    """Simulate on the Hermite path's expanding mesh and reduce. Raises :class:`bent_beam.SimulationError`."""
    from self_similar_fe.mesh import ExpandingMesh
    from self_similar_fe.run import simulate_expanding

    history = simulate_expanding(shown.impact, ExpandingMesh(), end_time=END * shown.impact.time_scale, save=400)
    exact = contact_parameters(shown.kappa_over_nu, *shown.first)
    return ShownImpact(
        shown,
        reduce_history(history, exact, shown.epsilon),
        history.settings,
        history.seconds,
        history.steps,
        tuple(history.warnings),
    )


def frames_of(time: Array, count: int = FRAMES) -> NDArray[np.int64]:
    """Saved instants nearest to ``count`` ones even in √t, from the first that leaves a tenth of the way."""
    wanted = np.linspace(0.1, 1.0, count) ** 2 * time[-1]
    nearest = np.abs(time[None, :] - wanted[:, None]).argmin(axis=1)
    return np.unique(np.maximum(nearest, 1))


def reduce_history(history: ImpactHistory, exact: ContactParameters, epsilon: float) -> dict[str, Any]:
    """What the page needs of a history of half a beam, JSON-ready, in units of the fast layer.

    ``time`` (frames,); ``x`` (points,) and ``gap`` (frames, points) over V₀t; ``front`` and ``reaction`` (one
    side's), measured and of theory; ``pressure`` of the zone; ``lift`` over V₀t; ``map``: force per length in
    bins of x between frames; energies.
    """
    impact = history.impact
    kept = frames_of(history.time)
    found = moments(history, uniform=bool(epsilon))
    tau = found.tau
    side = np.sqrt(2.0 / np.pi)
    reaction = np.gradient(found.impulse, np.sqrt(tau)) / (2.0 * np.sqrt(np.maximum(tau, 1e-300)))  # I ~ √τ
    widest = 1.25 * max(float(found.front.max()), 0.2 * np.sqrt(tau[-1]))
    x = np.linspace(0.0, 2.4 * widest / 1.25, POINTS)
    gap = np.array(
        [
            np.interp(x, history.positions(k) / impact.length_scale, history.array("gap")[k])
            / (impact.velocity * history.time[k])
            for k in kept
        ]
    )
    edges = np.linspace(0.0, widest, BINS + 1)
    energy = impact.mass_per_length * impact.length_scale * impact.velocity**2
    root = np.sqrt(tau[kept])
    return plain(
        {
            "time": _short(tau[kept]),
            "x": _short(x),
            "gap": [_short(g) for g in gap],
            "front": _short(found.front[kept]),
            "reaction": _short(reaction[kept]),
            "pressure": _short(found.pressure[kept]),
            "lift": _short(found.lift[kept]),
            "front_theory": _short(root * (exact.lambda0 + epsilon * exact.lambda1 * tau[kept])),
            "reaction_theory": _short(side * (exact.r0 + epsilon * exact.r1 * tau[kept]) / root),
            "map": {
                "x": _short(0.5 * (edges[1:] + edges[:-1])),
                "root_time": _short(root[1:]),
                "force": [_short(row) for row in force_map(history, kept, edges)],
            },
            "energy": {
                name: _short(history.array(name)[kept] / energy)
                for name in ("work_of_loads", "kinetic_energy", "strain_energy", "loss_absorbed")
            },
        }
    )


def _short(values: Array) -> list[float]:
    """Five significant digits: enough to look at."""
    return [float(f"{v:.5g}") for v in np.asarray(values, float)]
