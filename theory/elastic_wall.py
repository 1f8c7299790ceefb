r"""A wall of stiffness k and damping c: the beam's Green's function with springs and dashpots that never pull (new;
derived in docs/theory.md, section 9).

The wall pushes with R = max(0, k p + c ṗ) per length where the penetration p = V₀t − Kx²/2 − η is positive. In units
t_k = √(μ/k), ℓ_k = (EI/k)^{1/4}, V₀, with ζ = c/(2√(kμ)) and κ/ν for K,

    p = t − (κ/ν)x²/2 − η,   R = max(0, p + 2ζṗ) where p > 0,   η(x,t) = ∫∫ G(x−x′, t−t′) R(x′,t′) dx′dt′,
    Ġ = Re S,   S = e^{ix²/4t}/√(4πit),                                                  (thesis 2.3.1–3)

so that the force F = ∫R dx has the largest value f(κ/ν, ζ) V₀√μ(EI k)^{1/4}. S obeys a heat equation, S_t = iS_xx.
Its n-fold integral over place and m-fold integral over time are therefore iterated error functions,

    S_n = ½(2√(it))^{n−1} i^{n−1}erfc z,   z = e^{−iπ/4}x/(2√t),   ∫…∫S_n = S_{n+2m}/i^m.

The Volterra equation is solved step by step. Loads are linear in time between steps and, between points of a grid,
linear in place; the rim of the zone lies anywhere between two points, and R is integrated up to it. Both errors are of
second order. Richardson's rule over a grid and one twice as fine takes them away, and its step is the error bar.

**κ/ν → 0.** Each section lands at t = (κ/ν)x²/2 and is an oscillator of its own, p̈ + 2ζṗ + p = 0, p(0) = 0, ṗ(0) = 1,
which the wall pushes with R = −p̈:   f√(κ/ν) → 2√2 max_T ∫₀^{√T} R(T − s²) ds.

**κ/ν → ∞, ζ = 0.** In t = (κ/ν)^{1/4}τ, p(0,t) = (κ/ν)^{1/4}Π, F = (κ/ν)^{−1/8}Φ the beam answers as to a point force,
p is a parabola of the bow's curvature, and with the moment under the force, m = ∫Φ/√(8π(τ−s)) ds, to order ν/κ

    Π = τ − ∫Φ(s) √((τ−s)/2π) ds + (ν/κ) ∫ΦΠ/(5√(8π(τ−s))) ds,     Φ = (4√2/3) Π^{3/2} (1 + m ν/2κ).
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
import scipy

from bent_beam.checks import between, positive
from theory._fresnel import TURN, FloatArray, scaled_iterated_erfc

#: Range of κ/ν and the largest ζ; `flat_limit` and `sharp_limit` are what the force tends to beyond.
FLATTEST, SHARPEST, MOST_DAMPED = 1e-6, 1e6, 5.0
_CELLS = 24  # of the coarsest grid, two steps of time a cell
_SETTLED = 1e-9  # change of the loads over the force at which a step is solved
_MOST_ITERATIONS = 100
_HERTZ = 4.0 * math.sqrt(2.0) / 3.0
_LATEST, _STEPS = 2.2, 800  # τ; the force is largest at 2.01


@dataclass(frozen=True)
class WallHistory:
    """The zone as a whole over time, arrays of one shape, in t_k, V₀√μ(EI k)^{1/4}, ℓ_k, V₀t_k and kV₀t_k.

    half_contact_length : distance of the outermost point that the wall pushes from the middle; 0: no contact.
    penetration, pressure : the largest of any point at the time.
    """

    time: FloatArray
    force: FloatArray
    half_contact_length: FloatArray
    penetration: FloatArray
    pressure: FloatArray

    @property
    def impulse(self) -> FloatArray:
        """∫F dt from 0 to each time, V₀√μ(EI k)^{1/4} t_k."""
        return np.asarray(scipy.integrate.cumulative_trapezoid(self.force, self.time, initial=0.0))


@dataclass(frozen=True)
class PeakForce:
    """The largest force with its error bar and the largest penetration and pressure, units as above.

    error : what Richardson's rule adds, and how far it is from the same rule on grids twice as coarse.
    time, half_contact_length : when the force is largest, to 1 % and 2 %.
    penetration, pressure : the largest at any place and time; relative error 1e-2.
    penetration_time : when, to 1 %.
    """

    value: float
    error: float
    time: float
    half_contact_length: float
    penetration: float
    penetration_time: float
    pressure: float


def peak_force(kappa_over_nu: float, wall_damping_ratio: float = 0.0) -> PeakForce:
    """f(κ/ν, ζ), in V₀√μ(EI k)^{1/4}, for κ/ν = K√(EI/μ)/V₀ from 1e-6 to 1e6 and ζ = c/(2√(kμ)) from 0 to 5.
    Raises ``ValueError`` for others."""
    ratio = between("kappa_over_nu", kappa_over_nu, FLATTEST, SHARPEST)
    return _peak_force(ratio, between("wall_damping_ratio", wall_damping_ratio, 0.0, MOST_DAMPED))


@cache  # asked at each damping of the beam, which does not change it
def _peak_force(kappa_over_nu: float, wall_damping_ratio: float) -> PeakForce:
    # the first run finds the time scale, the second what happens on it
    end = 3.5 * max(1.0, kappa_over_nu**0.25)
    scout = wall_history(kappa_over_nu, wall_damping_ratio, end=end, cells=_CELLS, steps=2 * _CELLS)
    late = int(max(scout.force.argmax(), scout.penetration.argmax()))
    whole = _again(scout, late, 3, kappa_over_nu, wall_damping_ratio)
    runs = [_again(whole, int(whole.force.argmax()), n, kappa_over_nu, wall_damping_ratio) for n in (1, 2, 4)]
    (_, coarsest), (_, coarse), (time, fine) = (largest(run.time, run.force) for run in runs)
    deep = whole
    while deep.penetration.argmax() == deep.time.size - 1:  # a damped wall gives for longer
        end *= 2.0
        deep = wall_history(kappa_over_nu, wall_damping_ratio, end=end, cells=3 * _CELLS, steps=6 * _CELLS)
    step, (deepest, depth) = (fine - coarse) / 3.0, largest(deep.time, deep.penetration)
    return PeakForce(
        value=fine + step,
        error=abs(step) + abs(fine + step - coarse - (coarse - coarsest) / 3.0),
        time=time,
        half_contact_length=float(runs[-1].half_contact_length[runs[-1].force.argmax()]),
        penetration=depth,
        penetration_time=deepest,
        pressure=float(max(whole.pressure.max(), runs[-1].pressure.max())),
    )


def _again(run: WallHistory, instant: int, factor: int, kappa_over_nu: float, damping_ratio: float) -> WallHistory:
    """A run until a little after an instant of another, on a grid as wide as its zone and `factor` times as fine."""
    end, cells = 1.1 * float(run.time[instant]), factor * _CELLS
    width = 1.1 * float(run.half_contact_length[run.time <= end].max())
    return wall_history(kappa_over_nu, damping_ratio, end=end, cells=cells, steps=2 * cells, width=width)


def largest(time: FloatArray, values: FloatArray) -> tuple[float, float]:
    """Time and height of the parabola's top through the largest value and its neighbours."""
    i = min(max(int(values.argmax()), 1), values.size - 2)
    before, here, after = values[i - 1 : i + 2]
    bend = before - 2.0 * here + after
    shift = 0.5 * (before - after) / bend if bend < 0.0 else 0.0
    return float(time[i] + shift * (time[i] - time[i - 1])), float(here - 0.25 * (before - after) * shift)


def wall_history(
    kappa_over_nu: float,
    wall_damping_ratio: float = 0.0,
    *,
    end: float,
    cells: int,
    steps: int,
    width: float | None = None,
) -> WallHistory:
    """Force, zone, penetration and pressure until `end` (t_k) in `steps`, on a grid of `cells` over half the zone.
    Raises ``ValueError`` for a value outside its range.

    width : half length of the grid, ℓ_k; by default a little more than the zone of a beam that does not bend.
    """
    between("kappa_over_nu", kappa_over_nu, FLATTEST, SHARPEST)
    between("wall_damping_ratio", wall_damping_ratio, 0.0, MOST_DAMPED)
    positive("end", end)
    width = width or 1.1 * math.sqrt(2.0 * end / kappa_over_nu)
    dt, dx = end / steps, width / cells
    x = dx * np.arange(cells + 1)
    time: FloatArray = dt * np.arange(steps + 1.0)
    of_place, of_velocity = (_responses(cells, dx, steps, dt, m) for m in (1, 0))
    twice = 2.0 * wall_damping_ratio
    responses = np.stack([of_place, of_place + twice * of_velocity], axis=1)  # of the penetration, of the pressure
    spectra = np.zeros((steps + 1, 2 * cells + 1))  # of the loads, which are even in x
    loads, rows = np.zeros(cells + 1), np.zeros((steps + 1, 4))
    rows[0, 3] = twice  # a dashpot pushes at once
    for n in range(1, steps + 1):
        free = time[n] + np.array([[0.0], [twice]]) - kappa_over_nu * x**2 / 2.0
        past = np.einsum("ikj,ij->kj", responses[n - 1 : 0 : -1], spectra[1:n])
        spectra[n] = 2.0 * spectra[n - 1] - spectra[max(n - 2, 0)]
        for _ in range(_MOST_ITERATIONS):
            p, pressure = free - scipy.fft.irfft(past + responses[0] * spectra[n], 4 * cells)[:, : cells + 1]
            before, (loads, force, rim) = loads, _loads(p, pressure, dx)
            spectra[n] = scipy.fft.rfft(np.concatenate([loads, np.zeros(2 * cells - 1), loads[:0:-1]])).real
            if np.abs(loads - before).max() <= _SETTLED * (1.0 + force):
                break
        else:
            raise ArithmeticError(f"the loads did not settle at t = {time[n]:.4g} t_k: take more steps")
        rows[n] = force, rim, p.max(), max(0.0, float(pressure[p > 0.0].max(initial=0.0)))
    return WallHistory(time, *rows.T)


def _responses(cells: int, dx: float, steps: int, dt: float, m: int) -> FloatArray:
    """Spectra over place of the displacement (m = 1) or velocity (m = 0), 0…steps steps after a load whose share of
    place and time is a hat of width 2dx and 2dt; shape (steps + 1, 2 cells + 1)."""
    x: FloatArray = dx * np.abs(np.arange(-1.0, 2.0 * cells + 2.0))
    ramps = np.zeros((steps + 2, x.size))
    ramps[1:] = _integrals(x, dt * np.arange(1.0, steps + 2.0)[:, None], m + 2)
    hats = np.diff(ramps, 2, axis=1) / dx**2
    hats = np.concatenate([hats[1:2], np.diff(hats, 2, axis=0)]) / dt
    return np.asarray(scipy.fft.rfft(np.concatenate([hats, hats[:, -2:0:-1]], axis=1), axis=1).real)


def _integrals(x: FloatArray, t: FloatArray, m: int) -> FloatArray:
    """The m-fold integral of Re S over time and its twofold integral over place, even in x (x ≥ 0, t > 0)."""
    root = np.sqrt(t)
    z = TURN / root * x
    _, _, before, last = scaled_iterated_erfc(z)
    for n in range(4, 2 + 2 * m):
        before, last = last, (before - 2.0 * z * last) / (2.0 * n)
    wave = 0.5 * (2.0 * np.exp(0.25j * np.pi) * root) ** (1 + 2 * m) * np.exp(-(z**2)) * last
    return np.asarray((wave / 1j**m).real + x * t**m / (2.0 * math.factorial(m)))


def _loads(p: FloatArray, pressure: FloatArray, dx: float) -> tuple[FloatArray, float, float]:
    """Loads of the points, force on the whole zone and its rim; p and pressure are linear between points."""
    both = np.array([p, pressure])
    a, b = both[:, :-1], both[:, 1:]
    crossing = a / np.where(a == b, 1.0, a - b)
    # the part of a cell with a load: both lines are above 0 there
    low = np.where((a <= 0.0) & (b > 0.0), crossing, 0.0).max(axis=0)
    high = np.maximum(low, np.where(b > 0.0, 1.0, np.where(a > 0.0, crossing, 0.0)).min(axis=0))
    start, slope = pressure[:-1], np.diff(pressure)
    total = dx * (start * (high - low) + slope * (high**2 - low**2) / 2.0)
    right = dx * (start * (high**2 - low**2) / 2.0 + slope * (high**3 - low**3) / 3.0)
    loads = np.append(total - right, 0.0)
    loads[1:] += right
    loads[0] *= 2.0  # both sides
    touched = np.flatnonzero(high > low)
    rim = float(dx * (touched[-1] + high[touched[-1]])) if touched.size else 0.0
    return loads, 2.0 * float(total.sum()), rim


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

    options = {"xatol": 1e-10}
    found = scipy.optimize.minimize_scalar(lambda t: -force(t), bounds=(1e-6, 2.4), method="bounded", options=options)
    return force(float(found.x)), float(found.x)


@dataclass(frozen=True)
class SharpLimit:
    """As κ/ν → ∞, ζ = 0: f (κ/ν)^{1/8} = `value` + `correction` ν/κ, at `time` (κ/ν)^{1/4} t_k. The largest penetration
    is `penetration` (κ/ν)^{1/4} V₀t_k. Error below 1e-5."""

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
    at, value = largest(t, force)
    return SharpLimit(value, float(np.interp(at, t[:-1], force1)), at, float(place.max()))


def _weights(twice_integrated: FloatArray, dt: float) -> FloatArray:
    """∫ kernel × hat functions of width 2dt, 0, 1, 2 … steps ago."""
    return np.append(twice_integrated[1], np.diff(twice_integrated, 2)) / dt
