"""Maxwell branches beside the beam's bending stiffness, as θ-steps see them (:mod:`bent_beam.hysteresis`).

Each branch is a spring g_jK in series with a dashpot of relaxation time τ_j; z_j, the stretch of its spring, obeys
ż_j = ė − z_j/τ_j, and the beam feels K(e + Σ g_j z_j). Bending strains e = Bq of an element, θ₁ − c and θ₂ − c with the
slope c of its chord, hold z_j: two numbers an element, no rigid motion in them. A θ-step with ė_θ = Bv_θ,

    z_θ = (z + θh ė_θ)/(1 + θh/τ),     z⁺ = z + h(ė_θ − z_θ/τ),

needs no further unknown: its matrix is M + θhC + θ²h²K(1 + Σ g/(1 + θh/τ)). Exactly, per step,

    Δ ½Σ g zᵀKz = h v_θᵀKΣ g z_θ − Σ (hg/τ) z_θᵀKz_θ − (θ − ½)Σ g ΔzᵀKΔz:

the work of the beam, less the dashpots' loss, less algorithmic loss. (Simo, Hughes, Computational Inelasticity, 1998,
section 10.3, and Kaliske, Rothert, Computational Mechanics 19 (1997) 228–239, integrate z exactly for constant ė; the
θ-rule in its place is what closes the energies.)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.compiled import compiled
from hermite_fe.solver import Solver
from hermite_fe.system import Bending

__all__ = ["add_branch_forces", "branch_energy", "stiffen", "step_branches"]

Array = NDArray[np.float64]


@compiled
def stiffen(bending: Bending, h: float, theta: float, solver: Solver) -> None:
    """Add θ²h²KΣ g/(1 + θh/τ) to a step matrix that is just made, and keep the weights 1/(1 + θh/τ)."""
    share, n = 0.0, bending.matrix.shape[1]
    for j in range(bending.shares.size):
        bending.weights[j] = 1.0 / (1.0 + theta * h * bending.rates[j])
        share += theta * theta * h * h * bending.shares[j] * bending.weights[j]
    for i in range(n):
        for m in range(min(4, n - i)):
            apart = solver.unknown[i + m] - solver.unknown[i]
            if apart < 5:  # else never coupled
                solver.S[apart, solver.unknown[i]] += share * bending.matrix[m, i]


@compiled
def strains_of(bending: Bending, q: Array, e: int) -> tuple[float, float]:
    """e = Bq of one element."""
    chord = (q[2 * e + 2] - q[2 * e]) / bending.lengths[e]
    return q[2 * e + 1] - chord, q[2 * e + 3] - chord


@compiled
def form(first: float, second: float) -> float:
    """eᵀKe of one element over 4EI/length."""
    return first * first + first * second + second * second


@compiled
def add_branch_forces(bending: Bending, z: Array, v: Array, h: float, theta: float, b: Array) -> None:
    """b −= hKΣ g(z + θhBv)/(1 + θh/τ): what the branches do at v, of which Δv is still to be added."""
    count, moved = z.shape[1], theta * h
    for e in range(bending.lengths.size if count > 0 else 0):
        rates = strains_of(bending, v, e)
        first = second = 0.0
        for j in range(count):
            share = bending.shares[j] * bending.weights[j]
            first += share * (z[2 * e, j] + moved * rates[0])
            second += share * (z[2 * e + 1, j] + moved * rates[1])
        stiffness = h * bending.stiffness / bending.lengths[e]
        left, right = stiffness * (4.0 * first + 2.0 * second), stiffness * (2.0 * first + 4.0 * second)
        across = (left + right) / bending.lengths[e]
        b[2 * e] -= across
        b[2 * e + 1] -= left
        b[2 * e + 2] += across
        b[2 * e + 3] -= right


@compiled
def step_branches(bending: Bending, v_theta: Array, h: float, theta: float, z: Array) -> tuple[float, float]:
    """z⁺ in place of z; returns the loss in the dashpots and the algorithmic one, J."""
    loss = algorithmic = 0.0
    count, moved = z.shape[1], theta * h
    for e in range(bending.lengths.size if count > 0 else 0):
        rates = strains_of(bending, v_theta, e)
        lost = own = 0.0
        for j in range(count):
            share, rate, weight = bending.shares[j], bending.rates[j], bending.weights[j]
            first, second = weight * (z[2 * e, j] + moved * rates[0]), weight * (z[2 * e + 1, j] + moved * rates[1])
            lost += share * rate * form(first, second)
            first, second = h * (rates[0] - rate * first), h * (rates[1] - rate * second)
            own += share * form(first, second)
            z[2 * e, j] += first
            z[2 * e + 1, j] += second
        stiffness = 4.0 * bending.stiffness / bending.lengths[e]
        loss += h * stiffness * lost
        algorithmic += (theta - 0.5) * stiffness * own
    return loss, algorithmic


@compiled
def branch_energy(bending: Bending, z: Array) -> float:
    """½Σ g zᵀKz, J."""
    energy = 0.0
    for e in range(bending.lengths.size):
        for j in range(z.shape[1]):
            share = 2.0 * bending.stiffness / bending.lengths[e] * bending.shares[j]
            energy += share * form(z[2 * e, j], z[2 * e + 1, j])
    return energy
