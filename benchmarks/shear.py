r"""Timoshenko's beam on a rigid or an elastic wall: from when it is Euler and Bernoulli's; shear and the largest force.

``python -m benchmarks.shear`` prints both (two minutes). Units t_s = √(EIμ)/(κ_sGA), ℓ_s = √(EI/κ_sGA), V₀ leave κ/ν
and g = κ_sG/E (pipe 0.2, solid section 0.33). For the displacement η by the wall and the angle φ

    η_tt = Q_x + R,   Q = η_x − φ,   gφ_tt = M_x + Q,   M = φ_x,   R ≥ 0 where p = t − (κ/ν)x²/2 − η ≥ 0,

by leapfrog steps, η and M at the points of the grid, Q and φ between. A rigid wall stops a point that has arrived; an
elastic one pushes with p(t_s/t_k)². No wave comes back from the end of the grid.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from theory import contact_parameters
from theory.elastic_wall import PeakForce, peak_force

Array = NDArray[np.float64]


class Run(NamedTuple):
    """Over time (t_s): force (V₀√(κ_sGAμ)), impulse, rim of the zone (ℓ_s) and first moment of the force."""

    time: Array
    force: Array
    impulse: Array
    rim: Array
    moment: Array


def run(kappa_over_nu: float, end: float, dx: float, ratio: float, wall_time: float = 0.0) -> Run:
    """The impact until ``end``. wall_time : t_k of an elastic wall, 0: rigid. dx : distance of points, ℓ_s."""
    dt = 0.9 * dx * np.sqrt(ratio / (1.0 + 0.25 * dx**2))
    points = int((0.55 * end / np.sqrt(ratio) + np.sqrt(2.0 * end / kappa_over_nu) + 5.0) / dx)
    x, width = dx * np.arange(points + 1), np.full(points + 1, 2.0 * dx)  # of both sides
    width[0] = dx
    velocity, place, moment = np.zeros((3, points + 1))
    shear, turning = np.zeros((2, points))
    times = dt * np.arange(1, int(end / dt) + 1)
    found = np.zeros((4, times.size))
    for k, time in enumerate(times):
        velocity += dt / dx * np.concatenate([[2.0 * shear[0]], np.diff(shear), [-shear[-1]]])
        turning += dt / ratio * (np.diff(moment) / dx + shear)
        depth = time - dt - kappa_over_nu * x**2 / 2.0 - place
        push = dt * depth / wall_time**2 if wall_time else 1.0 - velocity
        push = np.where(depth >= 0.0, np.maximum(push, 0.0), 0.0)
        velocity += push
        place += dt * velocity
        shear += dt * (np.diff(velocity) / dx - turning)
        moment[:-1] += dt / dx * np.concatenate([[2.0 * turning[0]], np.diff(turning)])
        touched = np.flatnonzero(push)
        rim = x[touched[-1]] if touched.size else 0.0
        found[:, k] = (push @ width) / dt, push @ width, rim, push @ (width * x) / dt
    found[1] = np.cumsum(found[1])
    return Run(times, *found)


def late(kappa_over_nu: float, time: float, dx: float, ratio: float) -> dict[str, float]:
    """At ``time`` on a rigid wall, over Euler and Bernoulli's: impulse, place of the force − 1; and rim − λ₀√t."""
    exact, done = contact_parameters(kappa_over_nu), run(kappa_over_nu, 1.1 * time, dx, ratio)
    around = np.abs(done.time / time - 1.0) < 0.1
    expected = 4.0 * np.sqrt(2.0 * done.time / np.pi) * exact.r0
    found = {"impulse": float(np.mean((done.impulse / expected)[around])) - 1.0}
    if exact.lambda0 > 0.0:
        front = exact.lambda0 * np.sqrt(time)
        found["place"] = float(done.moment[around].sum() / done.force[around].sum() / front) - 1.0
        found["rim"] = float(np.mean(done.rim[around] - exact.lambda0 * np.sqrt(done.time[around])))
    return found


def peak(kappa_over_nu: float, f: PeakForce, wall_time: float, dx: float, ratio: float) -> tuple[float, float]:
    """Largest force on a wall of t_k = ``wall_time``, over f V₀√μ(EI k)^{1/4} and over 2V₀√(κ_sGAμ)."""
    largest = float(run(kappa_over_nu, 1.6 * f.time * wall_time, dx, ratio, wall_time).force.max())
    return largest * np.sqrt(wall_time) / f.value, largest / 2.0


def _main() -> None:
    for ratio in (0.2, 0.33):
        print(f"\nκ_sG/E = {ratio}: rigid wall, what Timoshenko's beam has more than Euler and Bernoulli's")
        for kappa, times in (
            (0.05, (20, 100, 400)),
            (0.2, (20, 100)),
            (0.5, (20, 100)),
            (0.8, (10, 50, 120)),
            (2, (10, 20)),
        ):
            for time in times:
                values = late(kappa, time, 0.1, ratio)
                print(f"κ/ν = {kappa:4g}, t = {time:4g} t_s:", *(f"{k} {v:+.4f}" for k, v in values.items()))
        print("elastic wall: largest force over Euler and Bernoulli's, and over 2V₀√(κ_sGAμ)")
        for kappa in (0.05, 0.2, 0.5, 1.0, 2.0, 5.0):
            f = peak_force(kappa)
            for wall_time in (0.1, 1.0, 3.0, 10.0, 30.0):
                both = peak(kappa, f, wall_time, 0.04 * max(0.3, wall_time**0.5), ratio)
                print(f"κ/ν = {kappa:4g}, t_k = {wall_time:4g} t_s: {both[0]:.4f}  {both[1]:.3f}", flush=True)


if __name__ == "__main__":
    _main()
