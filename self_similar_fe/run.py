"""The impact of an infinite beam on a mesh that expands with √t: the front stands still in it.

Elements are laid in ζ = ξ/√τ and move with ξ = ζ√τ. In the units of the fast layer (l*, t*, V₀t*) and with s = ln τ,
w = τ W(ζ, s) and D = ∂_s − (ζ/2)∂_ζ, which is τ∂_τ at a fixed place,

    w_ττ + w_ξξξξ − n w_ξξ = load − r̃      becomes      D(D + 1) W + W_ζζζζ − nτ W_ζζ = τ (load − r̃)

with coefficients free of time but for the axial force n = N/(μV₀²), a perturbation that grows like τ. Only the fast
part w₀ − w = τη is unknown (thesis 2.2.19–20), pushed by ρ = τr̃; the free motion

    w₀ = τ W₀,   W₀ = 1 − κζ²/2 + ετ (α/2 + χζ²/2 + ψζ⁴/24)                                        (2.2.31)

enters as an obstacle alone, 0 ≤ ρ ⊥ η − W₀ ≥ 0 at the nodes. Waves that leave are carried outward by dξ/dτ of the nodes
and absorbed by a ramp of viscous damping σ(ζ)(D + 1)η. Implicit Euler in τ with steps in proportion to τ, and an active
set at the new position. The first state is the self-similar one with the nodes behind the front held; the front's node
is found by bisection (held as far as it is pushed). From there on every node is free to leave. Why it is quiet where
fixed meshes are noisy, and exact in time for both orders: docs/numerics.md. Nothing is taken from ``theory/``.
"""

import math
import time as clock
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import affordable, whole
from bent_beam.errors import SimulationError
from bent_beam.fields import describe
from bent_beam.history import ImpactHistory, end_curvatures
from bent_beam.impact import Impact
from bent_beam.method import Progress, Save, checked_times
from self_similar_fe.mesh import Array, ExpandingMesh
from self_similar_fe.similarity import leading_obstacle, similarity

MOST_WORK = 1e9  # steps x nodes: about an hour
LARGEST_PULL = 0.1  # in any step, over the largest push: sound runs under loads reach 0.03 by round-off
MOST_WIDENED = 100.0  # times a tolerance of the active set that had to be widened in a step
OF_CONTACTS = ("impulse", "in_contact")  # all else along the beam is at its nodes


def simulate_expanding(
    impact: Impact, mesh: ExpandingMesh, *, end_time: float, save: Save = 200, progress: Progress | None = None
) -> ImpactHistory:
    """Follow an impact that :class:`self_similar_fe.SelfSimilarFE` takes over ``mesh.decades`` decades of time up to
    ``end_time`` (s).

    save : number of saved instants (logarithmic over the last three decades, whole steps: fewer where two fall into
        one step), at least 2; of given times only the number counts.

    The history's energies are those of the fast part z = y₀ − y (an infinite beam has no finite energy of its own):
    ``work_of_loads`` is the work V₀∫R dt (+ first-order terms) that the wall does on it, ``loss_absorbed`` what the
    absorber took. Raises :class:`bent_beam.SimulationError` when the active set does not settle, the front leaves the
    fine mesh, or a number is no longer finite.
    """
    count: Any = checked_times(save, end_time).size if np.ndim(save) else save
    wanted = whole("the number of saved times" if np.ndim(save) else "save", count, 2)
    began = clock.perf_counter()
    try:
        run = Run(impact, mesh, end_time, wanted)
    except ArithmeticError as error:
        raise SimulationError(str(error), time=0.0, step=0, advice="a larger mesh.front_resolution") from None
    try:
        run.follow(progress)
    except ArithmeticError as error:
        raise SimulationError(
            str(error),
            time=run.tau * impact.time_scale,
            step=run.steps,
            advice="a smaller mesh.step_ratio, a larger mesh.front_resolution, or an earlier end time",
            history=run.history(clock.perf_counter() - began, False) if len(run.records) > 1 else None,
        ) from None
    return run.history(clock.perf_counter() - began, True)


class Run:
    """Time loop of one run in the units of the fast layer, and its record."""

    def __init__(self, impact: Impact, mesh: ExpandingMesh, end_time: float, saves: int) -> None:
        self.impact, self.mesh, self.end_time, self.saves = impact, mesh, end_time, saves
        self.state = similarity(impact.kappa_over_nu, mesh)
        zeta = self.state.zeta
        self.front = self.state.front
        self.end = end_time / impact.time_scale
        self.axial = impact.epsilon_axial
        ratio = mesh.step_ratio
        affordable("mesh.step_ratio and mesh", mesh.decades * math.log(10.0) / ratio, zeta.size, saves, MOST_WORK)
        self.total = math.ceil(mesh.decades * math.log(10.0) / ratio)
        self.ratio = math.exp(mesh.decades * math.log(10.0) / self.total)  # τ_new/τ_old
        recorded = min(self.total, math.ceil(min(3.0, mesh.decades) * math.log(10.0) / math.log(self.ratio)))
        self.stride = math.ceil(recorded / (saves - 1))
        self.first_saved = self.total - (recorded // self.stride) * self.stride
        units = impact.length_scale, impact.time_scale, impact.deflection_scale
        self.loads = impact.free_motion(0.0).scaled(*units).first_order()  # at ξ = ζ√τ: τ² of what they are at ζ, τ = 1
        self.leading, self.first = leading_obstacle(zeta, impact.kappa_over_nu), self.loads(zeta, 1.0)
        # The free motion is a Taylor polynomial: far from the contact its terms mean nothing, so nothing touches there.
        self.near = zeta <= 1.5 * self.front + 0.5
        self.tau = self.end / self.ratio**self.total
        self.steps = 0
        reaction = float(self.state.reaction.sum())
        # Before the first instant all was the same at a smaller scale: R ~ τ^−1/2, so ∫R = 2Rτ; centroid and energies
        # alike.
        root = math.sqrt(self.tau)
        self.impulse = self.state.reaction * 2.0 * root
        self.held = float(np.minimum(self.impulse, 0.0).sum())  # what the held start pulled; nothing is held after it
        self.moment = reaction * self.front * self.tau
        self.work = 2.0 * float(self.state.reaction @ self.rate_of_obstacle(0.0)) * root
        self.energy, self.power, absorbing = self.stored_and_powers()
        self.absorbed = 2.0 * absorbing * root
        self.dissipated = 0.0  # by implicit Euler and the motion of the mesh
        self.records: list[dict[str, Any]] = []

    def rate_of_obstacle(self, tau: float) -> Array:
        """∂w₀/∂τ at the nodes: what the wall must undo there."""
        return np.asarray(1.0 + tau * self.loads(self.state.zeta, 1.0, by_t=1))

    def stored_and_powers(self) -> tuple[float, float, float]:
        """Kinetic and strain energy, and the powers of the scheme's internal forces and of the absorber, ∫σ η_τ² dζ,
        both divided by their τ^−1/2."""
        state, velocity = self.state, self.full_velocity()
        absorbed = float(velocity @ (state.operators.damping @ velocity))
        return math.sqrt(self.tau) * state.stored(velocity), float(velocity @ state.internal_force()), absorbed

    def full_velocity(self) -> Array:
        """η_τ = (D + 1) η as Hermite degrees of freedom (value, and ζ-derivative by the curvature of both elements)."""
        state = self.state
        eta, zeta = state.eta, state.zeta
        left, right = end_curvatures(zeta, eta[0::2], eta[1::2]).T
        bend = np.concatenate([[left[0]], 0.5 * (right[:-1] + left[1:]), [right[-1]]])
        velocity = np.empty_like(eta)
        velocity[0::2] = state.rate[0::2] + eta[0::2] - 0.5 * zeta * eta[1::2]
        velocity[1::2] = state.rate[1::2] + 0.5 * eta[1::2] - 0.5 * zeta * bend
        return velocity

    def follow(self, progress: Progress | None) -> None:
        state = self.state
        backward = self.ratio / (self.ratio - 1.0)
        state.set_step(backward)
        if self.first_saved == 0:
            self.record()
        while self.steps < self.total:
            tau_old = self.tau
            self.steps += 1
            self.tau = tau_old * self.ratio if self.steps < self.total else self.end
            before = state.reaction
            if self.axial:
                state.set_step(backward, self.axial * self.tau)
            state.step(np.where(self.near, self.leading + self.tau * self.first, -1.0))
            # reactions are ρ/√τ and moments ρζ; the mean of both ends integrates ρ = const and ρ ~ τ to second order
            roots = 2.0 * (math.sqrt(self.tau) - math.sqrt(tau_old))
            mean = 0.5 * (before + state.reaction)
            self.impulse = self.impulse + mean * roots
            self.moment += float(mean @ state.zeta) * (self.tau - tau_old)
            self.work += float(mean @ self.rate_of_obstacle(0.5 * (self.tau + tau_old))) * roots
            # what the scheme's own forces took in, less what is found to be stored
            stored, power = self.energy, self.power
            self.energy, self.power, absorbing = self.stored_and_powers()
            self.absorbed += absorbing * roots
            self.dissipated += 0.5 * (power + self.power) * roots - (self.energy - stored)
            if state.active[self.near][-3:].any():
                raise ArithmeticError("the contact has left the finely meshed zone")
            if self.steps >= self.first_saved and (self.steps - self.first_saved) % self.stride == 0:
                self.record()
                if progress is not None:
                    progress(self.steps / self.total)

    def record(self) -> None:
        """One more instant, SI units."""
        state, tau, p = self.state, self.tau, self.impact
        obstacle = self.leading + tau * self.first
        root = math.sqrt(tau)
        velocity, eta = self.full_velocity(), state.eta
        deflection, push = p.deflection_scale, p.mass_per_length * p.length_scale * p.velocity  # μ l* V₀, N s
        energy, force = push * p.velocity, push / p.time_scale
        gap = -tau * (obstacle - eta[0::2]) * deflection
        kinetic = 0.5 * float(velocity @ (state.operators.mass @ velocity)) * root
        slope_free = -p.curvature * p.length_scale * state.zeta + tau * self.loads(state.zeta, 1.0, by_x=1)
        product = float(np.abs(state.reaction * (eta[0::2] - obstacle)).max()) * root
        self.records.append(
            {
                "time": tau * p.time_scale,
                "position": state.zeta * root * p.length_scale,
                "gap": gap,
                "velocity": (self.rate_of_obstacle(tau) - velocity[0::2]) * p.velocity,
                "slope": root * (slope_free - eta[1::2]) * (deflection / p.length_scale),
                "impulse": self.impulse * push,
                "in_contact": state.active,
                "total_impulse": 2.0 * float(self.impulse.sum()) * push,
                "impulse_moment": self.moment * push * p.length_scale,
                "kinetic_energy": 2.0 * kinetic * energy,
                "strain_energy": 2.0 * self._strain(tau) * root * energy,
                "loss_algorithmic": 2.0 * self.dissipated * energy,
                "work_of_loads": 2.0 * self.work * energy,
                "loss_absorbed": 2.0 * self.absorbed * energy,
                "held_impulse": 2.0 * self.held * push,
                "smallest_gap": float(np.min(gap[self.near])),
                "smallest_reaction": float(state.reaction.min()) / root * force,
                "complementarity_product": product * force * deflection,
                "lift": float(np.max(gap[state.zeta <= 0.9 * state.front], initial=0.0)),
            }
        )

    def _strain(self, tau: float) -> float:
        """½∫η_ζζ² dζ + ½nτ∫η_ζ² dζ, by the elements' curvatures and slopes."""
        h, w, t = np.diff(self.state.zeta), self.state.eta[0::2], self.state.eta[1::2]
        left, right = end_curvatures(self.state.zeta, w, t).T
        bending = float(np.sum(h * (left**2 + left * right + right**2)) / 6.0)
        left, right, middle = t[:-1], t[1:], 1.5 * np.diff(w) / h - 0.25 * (t[1:] + t[:-1])
        squares = 2.0 * (left**2 + right**2 + (left + right) * middle) + 8.0 * middle**2 - left * right
        tension = float(np.sum(h * squares)) / 15.0  # ∫ of the square of a quadratic slope
        return bending + 0.5 * self.axial * tau * tension

    def history(self, seconds: float, completed: bool) -> ImpactHistory:
        """The record."""
        column = {name: np.array([record[name] for record in self.records]) for name in self.records[0]}
        time, places, state = column.pop("time"), column["position"], self.state
        fields: dict[str, tuple[Sequence[str], NDArray[Any]]] = {
            name: (("time", "contact" if name in OF_CONTACTS else "x")[: values.ndim], values)
            for name, values in column.items()
        }
        return ImpactHistory.build(
            impact=self.impact,
            path="self_similar",
            symmetry="half",
            settings={
                "mesh": describe(self.mesh),
                "end_time": self.end_time,
                "save": self.saves,
                "integrator": "implicit Euler, steps ∝ time",
                "contact": "node, Signorini at position level",
                "nodes": int(state.zeta.size),
                "iterations": state.iterations,
                "widened": state.widened,
                "largest_pull": state.pull / state.push,
                "energies": "of the fast part z = y0 - y",
            },
            time=time,
            x=places[-1],
            contact_x=places[-1],
            fields=fields | {"contact_position": (("time", "contact"), places)},
            warnings=tuple(self.warnings()),
            steps=self.steps,
            seconds=seconds,
            completed=completed,
        )

    def warnings(self) -> Iterator[str]:
        """What a reader of the result should know."""
        state, half_length = self.state, self.impact.half_length
        reach = state.zeta[-1] * math.sqrt(self.tau) * self.impact.length_scale
        moved = abs(state.front - self.front) / max(self.front, 2.0 / math.sqrt(1.0 + self.front**2))  # its thickness
        if reach > half_length:
            yield (
                f"an infinite beam was simulated: the waves followed here reach {reach:.3g} m, beyond the half length "
                f"{half_length:.3g} m"
            )
        if moved > 0.3:
            yield f"the front moved by {moved:.0%} of the contact length, out of the mesh's finest part"
        if (pull := state.pull / state.push) > LARGEST_PULL or state.widened > MOST_WIDENED:
            yield (
                f"the wall pulls by up to {pull:.2g} of its largest push in a step, contacts being judged with "
                f"{state.widened:.2g} times the tolerance of round-off: a larger mesh.front_resolution or a smaller "
                "mesh.step_ratio settles them"
            )
