r"""Limits of the largest force f(κ/ν, ζ) on an elastic wall (`theory.elastic_wall`; new).

**κ/ν → 0.** Bending plays no part. A section lands at t = (κ/ν)x²/2 and is an oscillator of its own, p̈ + 2ζṗ + p = 0,
p(0) = 0, ṗ(0) = 1, which the wall pushes with R = −p̈:

    f√(κ/ν) → 2√2 max_T ∫₀^{√T} R(T − s²) ds.

**κ/ν → ∞, ζ = 0.** The zone is short against the bending waves. In t = (κ/ν)^{1/4}τ, p(0,t) = (κ/ν)^{1/4}Π,
F = (κ/ν)^{−1/8}Φ the beam answers as to a point force, and p is a parabola of the bow's curvature:

    Π = τ − ∫Φ(s) √((τ−s)/2π) ds,     Φ = (4√2/3) Π^{3/2}.

To the next order in ν/κ the moment under the force, m = ∫Φ/√(8π(τ−s)) ds, takes its part of the curvature away, and
the force is spread over a zone of ⟨x²⟩ = 2Π/5 (ν/κ)^{3/4}, which bends the beam's middle less:

    Π = τ − ∫Φ(s) √((τ−s)/2π) ds + (ν/κ) ∫ΦΠ/(5√(8π(τ−s))) ds,     Φ = (4√2/3) Π^{3/2} (1 + m ν/2κ).

What is left is of order (ν/κ)^{3/2}: f (κ/ν)^{1/8} → f₀ + f₁ ν/κ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

from theory._fresnel import FloatArray

_HERTZ = 4.0 * math.sqrt(2.0) / 3.0
_LATEST, _STEPS = 2.2, 800  # τ; the force is largest at 2.01


def flat_limit(wall_damping_ratio: float) -> tuple[float, float]:
    """f√(κ/ν) and the time of the largest force, t_k, as κ/ν → 0; relative error 1e-10 of the value."""
    zeta = wall_damping_ratio
    nodes, weights = np.polynomial.legendre.leggauss(40)

    def force(time: float) -> float:
        root = 0.5 * math.sqrt(time)
        age = time - (root * (1.0 + nodes)) ** 2
        turn = np.sqrt(complex(1.0 - zeta**2)) * age
        sine = (age * np.sinc(turn / np.pi)).real  # sin(ωT)/ω, also for ζ ≥ 1
        pressure = np.exp(-zeta * age) * (2.0 * zeta * np.cos(turn).real + (1.0 - 2.0 * zeta**2) * sine)
        return float(2.0 * math.sqrt(2.0) * root * (weights @ pressure))

    found = minimize_scalar(lambda t: -force(t), bounds=(1e-6, 2.4), method="bounded", options={"xatol": 1e-10})
    return force(float(found.x)), float(found.x)


@dataclass(frozen=True)
class SharpLimit:
    """As κ/ν → ∞, ζ = 0: f (κ/ν)^{1/8} = `value` + `correction` ν/κ, at `time` (κ/ν)^{1/4} t_k.

    The largest penetration is `penetration` (κ/ν)^{1/4} V₀t_k. Error below 1e-5.
    """

    value: float
    correction: float
    time: float
    penetration: float


def sharp_limit() -> SharpLimit:
    """Product integration: Φ is linear between steps."""
    dt = _LATEST / _STEPS
    t: FloatArray = dt * np.arange(_STEPS + 2.0)
    of_root = _weights(4.0 / 15.0 * t**2.5, dt) / math.sqrt(2.0 * math.pi)
    of_inverse = _weights(4.0 / 3.0 * t**1.5, dt) / math.sqrt(8.0 * math.pi)
    place, force, place1, force1, moment, spread = np.zeros((6, _STEPS + 1))
    for n in range(1, _STEPS + 1):
        past = slice(n - 1, 0, -1)
        free = t[n] - of_root[past] @ force[1:n]
        place[n] = free
        for _ in range(5):  # converges at once, for a step's own share is of order dt^{3/2}
            place[n] = free - of_root[0] * _HERTZ * place[n] ** 1.5
        force[n] = _HERTZ * place[n] ** 1.5
        moment[n] = of_inverse[n - 1 :: -1] @ force[1 : n + 1]
        spread[n] = of_inverse[n - 1 :: -1] @ (force * place)[1 : n + 1] / 5.0
        stiffness = 1.5 * _HERTZ * math.sqrt(place[n])
        late = spread[n] - of_root[past] @ force1[1:n] - of_root[0] * force[n] * moment[n] / 2.0
        place1[n] = late / (1.0 + of_root[0] * stiffness)
        force1[n] = stiffness * place1[n] + force[n] * moment[n] / 2.0
    i = int(force.argmax())
    bend = np.polyfit(t[i - 1 : i + 2], force[i - 1 : i + 2], 2)
    at = -0.5 * bend[1] / bend[0]
    return SharpLimit(float(np.polyval(bend, at)), float(np.interp(at, t[:-1], force1)), float(at), float(place.max()))


def _weights(twice_integrated: FloatArray, dt: float) -> FloatArray:
    """∫ kernel × hat functions of width 2dt, 0, 1, 2 … steps ago."""
    return np.append(twice_integrated[1], np.diff(twice_integrated, 2)) / dt
