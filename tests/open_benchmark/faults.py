"""Results with one drawn fault each, for the doctor to find: faults of a run, and of what is booked.

A fault of a run is a function of a random generator that returns κ/ν, half length and the parts of the method; a fault
of the books changes the result of a good run.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from bent_beam import Impact
from bent_beam.meshes import GradedMesh, ScaleFreeMesh, UniformMesh
from bent_beam_programs.open_benchmark.histories import result_from_history
from bent_beam_programs.open_benchmark.problem import problem
from bent_beam_programs.open_benchmark.result import Result
from hermite_fe import simulate
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import GeneralizedAlphaPenalty, MoreauJean, SignoriniPosition
from theory import contact_parameters

__all__ = ["FAULTS", "faulty"]

END = 0.1
Rng = np.random.Generator
Run = tuple[float, float, dict[str, Any]]


def signorini(step: float) -> SignoriniPosition:
    return SignoriniPosition(time_step=step, growth=0.0)


def uniform(size: float, steps: float = 40.0, **changes: Any) -> dict[str, Any]:
    parts = {"mesh": UniformMesh(element_length=size), "integrator": signorini(size / steps)}
    return {**parts, "far_field": GridViscosity(viscosity=0.3), **changes}


def penalty(stiffness: float, damping: float, step: float, radius: float = 0.8, viscosity: float = 0.3) -> Any:
    scheme = GeneralizedAlphaPenalty(
        spectral_radius=radius, stiffness=stiffness, damping=damping, time_step=step, growth=0.0
    )
    return uniform(0.01, integrator=scheme, far_field=GridViscosity(viscosity=viscosity))


def clean(rng: Rng) -> Run:
    """A good mesh, good steps, far ends: uniform or scale-free, any κ/ν that spreads."""
    kappa = float(rng.uniform(0.12, 0.85))
    if rng.random() < 0.3:
        mesh = ScaleFreeMesh(element_length=float(rng.uniform(1e-3, 2e-3)), growth=1.01)
        contact = NodeContact()
        return max(kappa, 0.2), float(rng.uniform(4.0, 8.0)), {"mesh": mesh, "contact": contact}
    length = float(rng.uniform(4.0, 6.0))
    return kappa, length, uniform(float(rng.uniform(0.004, 0.008)), rng.uniform(35.0, 60.0))


def reflection(rng: Rng) -> Run:
    kappa, size = float(rng.uniform(0.2, 0.7)), float(rng.uniform(0.006, 0.01))
    parts = uniform(size, far_field=GridViscosity(viscosity=0.0))
    if rng.random() < 0.5:
        return kappa, float(rng.uniform(0.55, 1.0)), parts
    zone = 0.91 * math.sqrt(2.0 / kappa * END)  # about λ₀√τ, as roughly as a fault needs it
    mesh = GradedMesh(element_length=size, growth=float(rng.uniform(1.2, 1.35)), zone=zone)
    return kappa, 5.0, {**parts, "mesh": mesh}


def front_unresolved(rng: Rng) -> Run:
    kappa = float(rng.uniform(0.05, 0.3))
    thickness = math.sqrt(2.0 * kappa * END)
    return kappa, 5.0, uniform(thickness * float(rng.uniform(0.6, 1.2)), 400.0)


def start_unresolved(rng: Rng) -> Run:
    """Steps short enough that single nodes meet the wall, one after the other, before the mesh carries the front."""
    kappa = float(rng.uniform(0.04, 0.12))
    mesh = ScaleFreeMesh(element_length=float(rng.uniform(1e-3, 3e-3)), growth=1.01)
    return kappa, 5.0, {"mesh": mesh, "integrator": SignoriniPosition(time_step=3e-7, growth=4e-3)}


def rectified_noise(rng: Rng) -> Run:
    kappa, size = float(rng.uniform(0.06, 0.15)), float(rng.uniform(0.005, 0.01))
    scheme = MoreauJean(theta=float(rng.uniform(0.5, 0.56)), time_step=size / 40.0, growth=0.0)
    # so long that no wave is back: the noise is that of the contact
    return kappa, 25.0, uniform(size, integrator=scheme, far_field=GridViscosity(viscosity=0.0))


def adhesion(rng: Rng) -> Run:
    parts = uniform(float(rng.uniform(0.006, 0.01)))
    parts["contact"] = NodeContact(hold=int(rng.integers(6, 30)), hold_until=0.0)
    return float(rng.uniform(0.1, 0.5)), 5.0, parts


def soft_penalty(rng: Rng) -> Run:
    stiffness = 10.0 ** float(rng.uniform(2.5, 3.7))
    return float(rng.uniform(0.2, 0.8)), 5.0, penalty(stiffness, 2.0 * math.sqrt(stiffness), 1e-4)


def rattling(rng: Rng) -> Run:
    stiffness = 10.0 ** float(rng.uniform(5.0, 6.0))
    return float(rng.uniform(0.2, 0.8)), 5.0, penalty(stiffness, 0.0, 0.03 / math.sqrt(stiffness))


def steps_too_long(rng: Rng) -> Run:
    parts = uniform(float(rng.uniform(0.004, 0.008)))
    parts["integrator"] = signorini(END / float(rng.uniform(20.0, 60.0)))
    return float(rng.uniform(0.1, 0.5)), 5.0, parts


def energy_gained(rng: Rng) -> Run:
    stiffness = 10.0 ** float(rng.uniform(7.8, 8.2))
    return float(rng.uniform(0.2, 0.6)), 5.0, penalty(stiffness, 0.0, 3.0 / math.sqrt(stiffness), 1.0, 0.0)


# --- faults of the books -------------------------------------------------------------------------------------------


def ratio(rng: Rng, good: Result) -> Result:
    """Half or twice the force, a power of ten, a sign: of the impulse, of its moment, or of both."""
    factor = float(rng.choice([0.5, 2.0, -1.0, 10.0 ** rng.integers(1, 6), 10.0 ** -rng.integers(1, 6)]))
    pairs = (factor, factor), (factor, 1.0), (1.0, 2.0 if factor == -1.0 else factor)
    of_impulse, of_moment = pairs[rng.integers(3)]
    return replace(good, J=of_impulse * good.J, Jm=of_moment * good.Jm, snap_v=None)


def momentum(rng: Rng, good: Result) -> Result:
    """Impulses that are not booked: a share from the start, or all of some time."""
    kept = np.full(good.tau.size, rng.uniform(0.6, 0.93))
    if rng.random() < 0.5:
        kept = np.where(good.tau > rng.uniform(0.02, 0.05), kept - 0.2, 1.0)
    books = (np.cumsum(kept * np.diff(series, prepend=0.0)) for series in (good.J, good.Jm))
    return replace(good, J=next(books), Jm=next(books))


def unsettled(rng: Rng, good: Result) -> Result:
    """Impulses that jitter, or a force in place of an impulse."""
    if rng.random() < 0.3:
        force = np.gradient(good.J, good.tau)
        return replace(good, J=force / force.max(), Jm=np.gradient(good.Jm, good.tau), snap_v=None)
    jitter = 1.0 + rng.uniform(0.01, 0.05) * rng.standard_normal(good.tau.size)
    return replace(good, J=jitter * good.J, snap_v=None)


def off(rng: Rng, good: Result) -> Result:
    """Another speed, another clock, or the answer to another problem."""
    kind, factor = rng.integers(3), float(rng.choice([rng.uniform(0.6, 0.9), rng.uniform(1.15, 1.7)]))
    if kind == 0:
        return replace(good, J=factor * good.J, Jm=factor * good.Jm, snap_v=None)
    if kind == 1:
        slower = [np.interp(0.8 * good.tau, good.tau, series) for series in (good.J, good.Jm)]
        return replace(good, J=slower[0], Jm=slower[1], snap_v=None)
    other = problem(f"leading-{good.problem.kappa_over_nu * (0.8 if rng.random() < 0.5 else 1.12):.6f}")
    return replace(good, problem=other)


def too_exact(rng: Rng, good: Result) -> Result:
    """The closed form, printed."""
    found, side = contact_parameters(good.problem.kappa_over_nu), math.sqrt(2.0 / math.pi)
    J, Jm = 4.0 * side * found.r0 * np.sqrt(good.tau), side * found.r0 * found.lambda0 * good.tau
    return replace(good, J=J, Jm=Jm, snap_v=None)


BOOKS: dict[str, Callable[[Rng, Result], Result]] = {
    fault.__name__: fault for fault in (ratio, momentum, unsettled, off, too_exact)
}
RUNS: dict[str, Callable[[Rng], Run]] = {
    fault.__name__: fault
    for fault in (
        reflection, front_unresolved, start_unresolved, rectified_noise, adhesion, soft_penalty, rattling,
        steps_too_long, energy_gained,
    )
}  # fmt: skip
FAULTS = (*RUNS, *BOOKS)


def faulty(name: str, *seed: int) -> Result:
    """A result with the fault, or a clean one."""
    if name not in FAULTS:
        return good(*seed)
    rng = np.random.default_rng([*seed, FAULTS.index(name)])
    return BOOKS[name](rng, good(*seed)) if name in BOOKS else result(RUNS[name](rng))


@lru_cache(maxsize=1)
def good(*seed: int) -> Result:
    """The clean result of a seed, to which faults of the books are done."""
    return result(clean(np.random.default_rng([*seed, 99])))


def result(run: Run) -> Result:
    """Of a run, at as many instants as a result needs: what is cumulated is linear within a step."""
    kappa, half_length, parts = run
    impact = Impact.dimensionless(kappa, length=2.0 * half_length)
    parts = {"contact": NodeContact(hold=0, hold_until=0.0), **parts}
    found = result_from_history(simulate(impact, end_time=END, save=500, **parts))
    if found.tau.size >= 230:
        return found
    tau = np.linspace(0.0, END, 400)
    series = {name: np.interp(tau, found.tau, values) for name, values in found.series.items()}
    J, Jm = (np.interp(tau, found.tau, values) for values in (found.J, found.Jm))
    return replace(found, tau=tau, J=J, Jm=Jm, series=series)
