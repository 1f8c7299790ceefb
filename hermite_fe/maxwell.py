"""Maxwell branches beside the beam's bending stiffness, as steps of θ-schemes see them (:mod:`bent_beam.hysteresis`).

Each branch is a spring g_jK in series with a dashpot of relaxation time τ_j; z_j, the stretch of its spring, obeys
ż_j = ė − z_j/τ_j, and the beam feels K(e + Σ g_j z_j). Bending strains e = Bq of an element, θ₁ − c and θ₂ − c with the
slope c of its chord, hold z_j: two numbers an element, no rigid motion in them. With the strain rate ė = Bv_θ constant
over a step, z and its mean z̄ are known exactly, and need no further unknown:

    z̄ = (z + ϑh ė)/(1 + ϑh/τ),     z⁺ = z + h(ė − z̄/τ),     ϑ = 1/(1 − exp(−h/τ)) − τ/h,

the matrix of a step is M + θhC + θ²h²K + θh²KΣ ϑg/(1 + ϑh/τ), and

    Δ ½Σ g zᵀKz = h v_θᵀKΣ g z̄ − Σ g [(h/τ) z̄ᵀKz̄ + (ϑ − ½) ΔzᵀKΔz],

the work of the beam less the dashpots' loss, which is never negative: ϑ runs from ½ (τ ≫ h) to 1. Branches shorter
than a step do not ring, as they do with ϑ = θ = ½. (Exact recursions for constant ė: Simo, Hughes, Computational
Inelasticity, 1998, section 10.3; Kaliske, Rothert, Computational Mechanics 19 (1997) 228–239. The mean z̄ closes the
energies.)
"""

import math

import numpy as np

from bent_beam import hysteresis
from hermite_fe.compiled import Array, compiled, compiled_within
from hermite_fe.constraints import Solver
from hermite_fe.system import Bending, Branches


def branches_at_rest(matrix: Array, fitted: hysteresis.Branches) -> Branches:
    """Branches that are slack, of which no step matrix is made yet."""
    means, weights = np.zeros((2, fitted.times.size))
    slack = np.zeros((matrix.shape[1] - 2, fitted.times.size))
    return Branches(matrix, fitted.shares, 1.0 / fitted.times, means, weights, slack)


@compiled_within
def stiffen(branches: Branches, h: float, theta: float, solver: Solver) -> None:
    """Add θh²KΣ ϑg/(1 + ϑh/τ) to a step matrix that is just made, and keep the ϑ and the weights 1/(1 + ϑh/τ)."""
    if branches.shares.size == 0:
        return
    share, n = 0.0, branches.matrix.shape[1]
    for j in range(branches.shares.size):
        x = h * branches.rates[j]
        branches.means[j] = 0.5 + x / 12.0 if x < 1e-3 else -1.0 / math.expm1(-x) - 1.0 / x
        branches.weights[j] = 1.0 / (1.0 + branches.means[j] * x)
        share += theta * h * h * branches.means[j] * branches.shares[j] * branches.weights[j]
    for i in range(n):
        for m in range(min(4, n - i)):
            apart = solver.unknown[i + m] - solver.unknown[i]
            if apart < 5:  # else never coupled
                solver.S[apart, solver.unknown[i]] += share * branches.matrix[m, i]


@compiled_within
def strains_of(bending: Bending, q: Array, e: int) -> tuple[float, float]:
    """e = Bq of one element."""
    chord = (q[2 * e + 2] - q[2 * e]) / bending.lengths[e]
    return q[2 * e + 1] - chord, q[2 * e + 3] - chord


@compiled_within
def form(first: float, second: float) -> float:
    """eᵀKe of one element over 4EI/length."""
    return first * first + first * second + second * second


@compiled_within
def add_branch_forces(branches: Branches, bending: Bending, v: Array, h: float, b: Array) -> None:
    """b −= hKΣ g(z + ϑhBv)/(1 + ϑh/τ): what the branches do at v, of which Δv is still to be added."""
    if branches.shares.size == 0:
        return
    z = branches.z
    for e in range(bending.lengths.size):
        rates = strains_of(bending, v, e)
        first = second = 0.0
        for j in range(z.shape[1]):
            share, moved = branches.shares[j] * branches.weights[j], h * branches.means[j]
            first += share * (z[2 * e, j] + moved * rates[0])
            second += share * (z[2 * e + 1, j] + moved * rates[1])
        stiffness = h * bending.stiffness / bending.lengths[e]
        left, right = stiffness * (4.0 * first + 2.0 * second), stiffness * (2.0 * first + 4.0 * second)
        across = (left + right) / bending.lengths[e]
        b[2 * e] -= across
        b[2 * e + 1] -= left
        b[2 * e + 2] += across
        b[2 * e + 3] -= right


@compiled_within
def step_branches(branches: Branches, bending: Bending, v_theta: Array, h: float, stretch: Array) -> float:
    """z⁺ in place of z, and Σ g z̄ into ``stretch``; returns the loss in the dashpots, J."""
    if branches.shares.size == 0:
        return 0.0
    z, loss = branches.z, 0.0
    for e in range(bending.lengths.size):
        rates = strains_of(bending, v_theta, e)
        stretch[2 * e] = stretch[2 * e + 1] = lost = 0.0
        for j in range(z.shape[1]):
            mean, x, weight = branches.means[j], h * branches.rates[j], branches.weights[j]
            first = weight * (z[2 * e, j] + mean * h * rates[0])
            second = weight * (z[2 * e + 1, j] + mean * h * rates[1])
            change, other = h * rates[0] - x * first, h * rates[1] - x * second
            lost += branches.shares[j] * (x * form(first, second) + (mean - 0.5) * form(change, other))
            stretch[2 * e] += branches.shares[j] * first
            stretch[2 * e + 1] += branches.shares[j] * second
            z[2 * e, j] += change
            z[2 * e + 1, j] += other
        loss += 4.0 * bending.stiffness / bending.lengths[e] * lost
    return loss


@compiled
def branch_energy(branches: Branches, bending: Bending) -> float:
    """½Σ g zᵀKz, J."""
    z, energy = branches.z, 0.0
    for e in range(bending.lengths.size):
        for j in range(z.shape[1]):
            share = 2.0 * bending.stiffness / bending.lengths[e] * branches.shares[j]
            energy += share * form(z[2 * e, j], z[2 * e + 1, j])
    return energy
