"""A code that is not ours, for faults to be put into: finite differences, a θ-rule, non-negative least squares.

    M(v⁺ − v) + hC v_θ + hK(u + θh v_θ) = p,   u⁺ = u + h v_θ,   0 ≤ p ⊥ g − u⁺ ≥ 0   (or p = hk⟨u⁺ − g + dv⁺⟩)

Written from the equations of docs/guide/enter.md, without a line of this project. Every keyword of :func:`solve` is
something that a fault changes; the fields of a result file come out.
"""

import json

import numpy as np
from scipy.linalg import cho_factor, cho_solve, cholesky, solve_triangular
from scipy.optimize import nnls


def solve(
    kappa=0.5, *, size=0.02, half=3.0, steps=400, theta=1.0, stiffness=1.0, mass=1.0, speed=1.0, shape=1.0, shift=0.0,
    gravity=0.0, every=1, reach=9.0, bounce=0.0, spring=None, dashpot=0.0, grid=0.2, clamped=False, middle=2.0,
):  # fmt: skip
    n, h = round(half / size), 0.1 / steps
    x = size * np.arange(n + 1)
    bend = np.diff(np.eye(n + 1), 2, axis=0)
    bend = np.vstack([2.0 * (np.eye(n + 1)[1] - np.eye(n + 1)[0]), bend]) / size**2  # symmetric about the first node
    K = stiffness * size * bend.T @ (np.r_[1.0 / middle, np.ones(n - 1)][:, None] * bend)
    m = mass * size * np.r_[0.5, np.ones(n - 1), 1e9 if clamped else 0.5]
    C = grid * size**2 * K  # viscosity at grid scale
    inverse = cho_solve(cho_factor(np.diag(m) + h * theta * C + (h * theta) ** 2 * K), np.eye(n + 1))
    gap = shape * kappa * x**2 / 2.0 + shift
    may = (np.arange(n + 1) % every == 0) & (x <= reach)
    u, v = np.zeros(n + 1), np.full(n + 1, speed)
    tau, pushed, energy = h * np.arange(steps + 1), np.zeros((steps + 1, n + 1)), np.zeros((2, steps + 1))
    energy[0, 0] = v @ (m * v)  # of both halves
    when, snaps, speeds = np.round(np.linspace(0.1, 1.0, 10) * steps).astype(int), [], []
    for k in range(1, steps + 1):
        right = m * (v + h * gravity) - h * (K @ (u + h * theta * (1.0 - theta) * v)) - h * (1.0 - theta) * (C @ v)
        free, p = inverse @ right, np.zeros(n + 1)
        most = ((gap - u) / h - (1.0 - theta) * v) / theta  # the velocity that just closes the gap
        if bounce:
            most = np.where(u >= gap - 1e-12, -bounce * np.maximum(v, 0.0), most)
        if spring is not None:
            on = (free > most) & may
            for _ in range(60):
                c = np.flatnonzero(on)
                rate = h * spring * (h * theta + dashpot)
                force = h * spring * (u + h * (1.0 - theta) * v - gap)[c] + rate * free[c]
                p[:] = 0.0
                p[c] = np.linalg.solve(np.eye(c.size) + rate * inverse[np.ix_(c, c)], force)
                new = (free - inverse @ p > most) & may
                if (new == on).all():
                    break
                on = new
        else:
            c = np.flatnonzero(may & (free > most - 0.02 / h))
            if c.size:
                lower = cholesky(inverse[np.ix_(c, c)], lower=True)
                wanted = solve_triangular(lower, (free - most)[c], lower=True)
                p[c] = nnls(lower.T, wanted, maxiter=50 * c.size)[0]
        new = free - inverse @ p
        u, v = u + h * ((1.0 - theta) * v + theta * new), new
        pushed[k] = pushed[k - 1] + p
        energy[:, k] = v @ (m * v), u @ K @ u
        if k in when:
            snaps.append(kappa * x**2 / 2.0 - u), speeds.append(v.copy())
        if np.abs(v).max() > 1e30:
            raise FloatingPointError("it blew up")
    model = {"half_length": half, "smallest_element": size, "time_step": h}
    about = json.dumps({"tool": "foreign", "version": "1", "seconds": 1.0, "steps": steps, "model": model})
    return {"outcome": "completed", "problem": f"leading-{kappa:g}", "metadata": about, "tau": tau, "node_x": x,
            "node_impulse": pushed, "x": x, "snap_tau": tau[when], "snap_gap": np.array(snaps),
            "snap_v": np.array(speeds), "E_kin": energy[0], "E_el": energy[1]}  # fmt: skip
