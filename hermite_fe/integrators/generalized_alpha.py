"""Compiled pieces of generalised-α (Chung & Hulbert 1993) with jumps, shared by the schemes that are built on it.

    v⁺ = v + h(1 − γ)a + hγa⁺ + W,    q⁺ = q + hv + h²(½ − β)a + h²βa⁺ + U   (thesis 3.3.10–11)
    (1 − α_m)a⁺ + α_m a = (1 − α_f)v̇⁺ + α_f v̇                                                (3.3.12)

with the coefficients of (3.3.13–16); W and U are the jumps that the contact makes. With s = (1 − α_f)/(1 − α_m), the
part of a⁺ that is known, a* = (α_f v̇ − α_m a)/(1 − α_m), and the predictions v*, q* made with it,

    v⁺ = v* + hγs v̇⁺ + W,    q⁺ = q* + h²βs v̇⁺ + U,    (M + hγsC + h²βsK)v̇⁺ = F⁺ − Cv* − Kq* + Gᵀλ.

Energy, per step (bars: means over the step, Δ: changes, p: the impulse of all reactions). The scheme misses momentum
and motion of the mean state by

    r_p = MΔv − h(F̄ − Cv̄ − Kq̄) − Gᵀp = h(½ − α_f)[MΔ(v̇ − a) − GᵀΔ(λ − λ_a)] + h[½J + ½J⁺ − E⁺],
    r_q = Δq − h v̄ = h²(β − ½γ)Δa + U − ½hW,                                    J = CW + KU,

λ_a the reactions λ through the filter of (3.3.12), J the forces of a step's jumps, which its v̇⁺ has not felt, E
those that the jump W was made with. From Δ(T + V) = v̄ᵀMΔv + q̄ᵀKΔq follows, exactly,

    Δ(T + V) = F̄ᵀΔq − h v̄ᵀCv̄ + pᵀGv̄ + v̄ᵀr_p + (Kq̄ − F̄)ᵀr_q:

the work of the loads, less viscous losses, less loss in impacts −pᵀGv̄, less algorithmic loss. The last is evaluated
from the right-hand sides of r_p and r_q and not as a remainder, so that a wrong force, velocity or energy shows as an
energy residual.
"""

from typing import Annotated, NamedTuple

import numpy as np

from bent_beam.errors import InputError
from bent_beam.fields import Quantity
from hermite_fe.active_set import SOLVED
from hermite_fe.banded import dot, multiply, stiff_multiply
from hermite_fe.compiled import Array, Flags, compiled_within, recompiling
from hermite_fe.constraints import row_times
from hermite_fe.stepping import Problem, State, add_energies, end_step, initial_acceleration, mean_forces, prepare

SpectralRadius = Annotated[float, Quantity("", "ρ∞ at infinite frequency (1: none is damped)", least=0.0, most=1.0)]


class Scheme(NamedTuple):
    """Coefficients of (3.3.13–16), and s = (1 − α_f)/(1 − α_m)."""

    alpha_m: float
    alpha_f: float
    gamma: float
    beta: float
    s: float


def scheme_of(spectral_radius: float) -> Scheme:
    """The coefficients for ρ∞."""
    alpha_m = (2.0 * spectral_radius - 1.0) / (spectral_radius + 1.0)
    alpha_f = spectral_radius / (spectral_radius + 1.0)
    gamma = 0.5 + alpha_f - alpha_m
    return Scheme(alpha_m, alpha_f, gamma, 0.25 * (gamma + 0.5) ** 2, (1.0 - alpha_f) / (1.0 - alpha_m))


class Reactions(NamedTuple):
    """Reactions of the smooth motion, (rows,): λ, λ_a, λ − λ_a at the start of the step, and the impulse p of the step.

    at_rest : constraints that are closed and have not rebounded; with_spring : those whose penalty springs are in the
        step matrix.
    """

    value: Array
    filtered: Array
    lag: Array
    impulse: Array
    at_rest: Flags
    with_spring: Flags


class Vectors(NamedTuple):
    """Vectors (dofs,). a and jump_force (J) persist from step to step.

    Of a step: old_q, old_v; predicted : a*; lag : v̇ − a at the start; new_jump_force : J⁺; missed_momentum : ½J⁺ − E⁺;
    missed_motion : r_q; b, x, force, scratch : work arrays.
    """

    a: Array
    jump_force: Array
    old_q: Array
    old_v: Array
    predicted: Array
    lag: Array
    new_jump_force: Array
    missed_momentum: Array
    missed_motion: Array
    b: Array
    x: Array
    force: Array
    scratch: Array


class Motion(NamedTuple):
    """What the scheme remembers of the motion from step to step."""

    scheme: Scheme
    vectors: Vectors
    reactions: Reactions


def motion_of(problem: Problem, state: State, spectral_radius: float) -> Motion:
    """The motion at the start: v̇ = a, all else zero. Raises ``ValueError`` for a mass matrix that is singular."""
    m, vectors = state.impulse.size, Vectors(*np.zeros((13, state.q.size)))
    status = recompiling(lambda: initial_acceleration(problem, state, vectors.b, vectors.scratch))
    if status != SOLVED:
        raise InputError("mass must be positive definite for generalised-α, which starts with the accelerations")
    vectors.a[:] = state.acceleration
    reactions = Reactions(*np.zeros((4, m)), *np.zeros((2, m), np.bool_))
    return Motion(scheme_of(spectral_radius), vectors, reactions)


@compiled_within
def prepare_step(problem: Problem, scheme: Scheme, h: float, t: float) -> float:
    """Make M + hγsC + h²βsK, the matrix of v̇⁺ and of the jumps, for a step to t; returns the length of the step."""
    return prepare(problem, h * scheme.gamma * scheme.s, h * h * scheme.beta * scheme.s, h, t)


@compiled_within
def predict(state: State, motion: Motion, h: float) -> None:
    """Save q and v of the start of the step, and replace them by q*, v*."""
    alpha_m, alpha_f, gamma, beta, _ = motion.scheme
    q, v, rate, vectors = state.q, state.v, state.acceleration, motion.vectors
    for i in range(q.size):
        a = vectors.a[i]
        known = (alpha_f * rate[i] - alpha_m * a) / (1.0 - alpha_m)
        vectors.old_q[i], vectors.old_v[i], vectors.predicted[i], vectors.lag[i] = q[i], v[i], known, rate[i] - a
        q[i] += h * v[i] + h * h * ((0.5 - beta) * a + beta * known)
        v[i] += h * ((1.0 - gamma) * a + gamma * known)


@compiled_within
def correct(state: State, motion: Motion, h: float) -> None:
    """Set v̇⁺ to ``vectors.x``, and compute a⁺, q⁺, v⁺ without jumps."""
    _, _, gamma, beta, s = motion.scheme
    vectors = motion.vectors
    for i in range(state.q.size):
        before, a = vectors.a[i], vectors.predicted[i] + s * vectors.x[i]
        vectors.a[i], state.acceleration[i] = a, vectors.x[i]
        state.q[i] = vectors.old_q[i] + h * vectors.old_v[i] + h * h * ((0.5 - beta) * before + beta * a)
        state.v[i] = vectors.old_v[i] + h * ((1.0 - gamma) * before + gamma * a)
        vectors.missed_motion[i] = h * h * (beta - 0.5 * gamma) * (a - before)


@compiled_within
def take_reaction(scheme: Scheme, reactions: Reactions, h: float, j: int, force: float) -> None:
    """Set constraint j's reaction at the end of the step to ``force``, and compute its impulse over the step by the
    recursion (3.3.12) of v̇."""
    alpha_m, alpha_f, gamma, _, s = scheme
    value, filtered = reactions.value[j], reactions.filtered[j]
    new = (alpha_f * value - alpha_m * filtered) / (1.0 - alpha_m) + s * force
    reactions.lag[j] = value - filtered
    reactions.value[j], reactions.filtered[j] = force, new
    reactions.impulse[j] = h * ((1.0 - gamma) * filtered + gamma * new)


@compiled_within
def finish_step(problem: Problem, state: State, motion: Motion, t: float, h: float) -> int:
    """Add the energies of the step, by the formulas of the module docstring, and store its jump forces for the next;
    returns the status."""
    scheme, vectors, reactions = motion
    matrices, q, v, rate = problem.matrices, state.q, state.v, state.acceleration
    mean_q, mean_v, lag, J = vectors.old_q, vectors.old_v, vectors.lag, vectors.jump_force
    force, product, change, half = vectors.force, vectors.scratch, vectors.b, 0.5 - scheme.alpha_f
    mean_forces(matrices.load, t, h, 0.5, force)
    # mean_q, mean_v and lag are those of the start until here, then means and the change of the lag
    for i in range(q.size):
        change[i] = q[i] - mean_q[i]
        mean_q[i] = 0.5 * (q[i] + mean_q[i])
        mean_v[i] = 0.5 * (v[i] + mean_v[i])
        lag[i] = (rate[i] - vectors.a[i]) - lag[i]
    stiff_multiply(matrices.K, matrices.K_sums, mean_q, product)
    motion_term, momentum = 0.0, 0.0
    for i in range(q.size):
        motion_term += (product[i] - force[i]) * vectors.missed_motion[i]
    multiply(matrices.M, lag, product)
    for i in range(q.size):
        momentum += mean_v[i] * (half * product[i] + 0.5 * J[i] + vectors.missed_momentum[i])
        J[i] = vectors.new_jump_force[i]
    for j in range(reactions.value.size):
        lag_change = reactions.value[j] - reactions.filtered[j] - reactions.lag[j]
        if lag_change != 0.0:
            momentum -= half * lag_change * row_times(problem.rows, mean_v, j)
    loss = -motion_term - h * momentum
    add_energies(problem, state, h, dot(force, change), reactions.impulse, mean_v, mean_v, loss, product)
    return end_step(state)
