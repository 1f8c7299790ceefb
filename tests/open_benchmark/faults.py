"""Results with one seeded fault each, made by the project's nonsmooth solver, for the doctor to find.

A fault is a function of a random generator that returns κ/ν, half length and the parts of the method.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from bent_beam import Impact
from bent_beam.meshes import GradedMesh, ScaleFreeMesh, UniformMesh
from hermite_fe import simulate
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import GeneralizedAlphaPenalty, MoreauJean, SignoriniPosition
from open_benchmark.histories import result_from_history
from open_benchmark.result import Result

__all__ = ["FAULTS", "made"]

END = 0.1
Rng = np.random.Generator
Run = tuple[float, float, dict[str, Any]]


def spread(kappa: float) -> float:
    """λ₀ as roughly as needed to place a fault."""
    return math.sqrt(2.0 / kappa)


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
    zone = 1.3 * spread(kappa) * math.sqrt(END) * 0.7
    mesh = GradedMesh(element_length=size, growth=float(rng.uniform(1.2, 1.35)), zone=zone)
    return kappa, 5.0, {**parts, "mesh": mesh}


def front_unresolved(rng: Rng) -> Run:
    kappa = float(rng.uniform(0.05, 0.3))
    thickness = 2.0 * math.sqrt(END) / spread(kappa)
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
    stiffness = 10.0 ** float(rng.uniform(6.3, 7.0))
    return float(rng.uniform(0.2, 0.6)), 5.0, penalty(stiffness, 0.0, 3.0 / math.sqrt(stiffness), 1.0, 0.0)


FAULTS: dict[str, Callable[[Rng], Run]] = {
    f.__name__: f
    for f in (
        reflection,
        front_unresolved,
        start_unresolved,
        rectified_noise,
        adhesion,
        soft_penalty,
        rattling,
        steps_too_long,
        energy_gained,
    )
}


def made(name: str, seed: int) -> Result:
    """One result of a fault, or a clean one, of a seed."""
    rng = np.random.default_rng([seed, sorted(FAULTS).index(name) if name in FAULTS else 99])
    kappa, half_length, parts = (FAULTS | {"clean": clean})[name](rng)
    strict = {"contact": NodeContact(hold=0, hold_until=0.0)}
    impact = Impact.dimensionless(kappa, length=2.0 * half_length)
    return result_from_history(simulate(impact, end_time=END, save=500, **strict | parts))
