"""Results with one seeded fault each, made by the project's nonsmooth solver, for the doctor to find."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from bent_beam import Impact
from bent_beam.meshes import GradedMesh, ScaleFreeMesh, UniformMesh
from hermite_fe import simulate
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import GeneralizedAlphaPenalty, MoreauJean, SignoriniPosition
from open_benchmark.result import Result, result_from_history

__all__ = ["FAULTS", "clean", "made"]

END = 0.1
Rng = np.random.Generator


def spread(kappa: float) -> float:
    """λ₀ as roughly as needed to place a fault."""
    return math.sqrt(2.0 / kappa)


def run(kappa: float, half_length: float = 5.0, **parts: object) -> Result:
    impact = Impact.dimensionless(kappa, length=2.0 * half_length)
    parts.setdefault("contact", NodeContact(hold=0, hold_until=0.0))
    history = simulate(impact, end_time=END, save=500, **parts)  # type: ignore[arg-type]
    return result_from_history(history)


def uniform(size: float, steps: float = 40.0) -> dict[str, object]:
    return {
        "mesh": UniformMesh(element_length=size),
        "integrator": SignoriniPosition(time_step=size / steps, growth=0.0),
        "far_field": GridViscosity(viscosity=0.3),
    }


def clean(rng: Rng) -> Result:
    """A good mesh, good steps, far ends: uniform or scale-free, any κ/ν that spreads."""
    kappa = float(rng.uniform(0.12, 0.85))
    if rng.random() < 0.3:
        start = NodeContact(hold=0, hold_until=None)
        mesh = ScaleFreeMesh(element_length=float(rng.uniform(1e-3, 2e-3)), growth=1.01)
        return run(max(kappa, 0.2), float(rng.uniform(4.0, 8.0)), mesh=mesh, contact=start)
    return run(
        kappa, float(rng.uniform(4.0, 6.0)), **uniform(float(rng.uniform(0.004, 0.008)), rng.uniform(35.0, 60.0))
    )


def reflection(rng: Rng) -> Result:
    kappa, size = float(rng.uniform(0.2, 0.7)), float(rng.uniform(0.006, 0.01))
    parts = uniform(size)
    parts["far_field"] = GridViscosity(viscosity=0.0)
    if rng.random() < 0.5:
        return run(kappa, float(rng.uniform(0.55, 1.0)), **parts)
    zone = 1.3 * spread(kappa) * math.sqrt(END) * 0.7
    parts["mesh"] = GradedMesh(element_length=size, growth=float(rng.uniform(1.2, 1.35)), zone=zone)
    return run(kappa, 5.0, **parts)


def front_unresolved(rng: Rng) -> Result:
    kappa = float(rng.uniform(0.05, 0.3))
    thickness = 2.0 * math.sqrt(END) / spread(kappa)
    return run(kappa, 5.0, **uniform(thickness * float(rng.uniform(0.6, 1.2)), 400.0))


def start_unresolved(rng: Rng) -> Result:
    kappa = float(rng.uniform(0.04, 0.12))
    mesh = ScaleFreeMesh(element_length=float(rng.uniform(1e-3, 3e-3)), growth=1.01)
    return run(kappa, 5.0, mesh=mesh)


def rectified_noise(rng: Rng) -> Result:
    kappa, size = float(rng.uniform(0.06, 0.15)), float(rng.uniform(0.005, 0.01))
    return run(
        kappa,
        25.0,  # so that no wave is back: the noise is that of the contact
        mesh=UniformMesh(element_length=size),
        integrator=MoreauJean(theta=float(rng.uniform(0.5, 0.56)), time_step=size / 40.0, growth=0.0),
        far_field=GridViscosity(viscosity=0.0),
    )


def adhesion(rng: Rng) -> Result:
    parts = uniform(float(rng.uniform(0.006, 0.01)))
    parts["contact"] = NodeContact(hold=int(rng.integers(6, 30)), hold_until=0.0)
    return run(float(rng.uniform(0.1, 0.5)), 5.0, **parts)


def penalty(size: float, stiffness: float, damping: float, step: float) -> dict[str, object]:
    return {
        "mesh": UniformMesh(element_length=size),
        "integrator": GeneralizedAlphaPenalty(
            spectral_radius=0.8, stiffness=stiffness, damping=damping, time_step=step, growth=0.0
        ),
        "far_field": GridViscosity(viscosity=0.3),
    }


def soft_penalty(rng: Rng) -> Result:
    stiffness = 10.0 ** float(rng.uniform(2.5, 3.7))
    return run(float(rng.uniform(0.2, 0.8)), 5.0, **penalty(0.01, stiffness, 2.0 * math.sqrt(stiffness), 1e-4))


def rattling(rng: Rng) -> Result:
    stiffness = 10.0 ** float(rng.uniform(5.0, 6.0))
    return run(float(rng.uniform(0.2, 0.8)), 5.0, **penalty(0.01, stiffness, 0.0, 0.3 / math.sqrt(stiffness) / 10.0))


def steps_too_long(rng: Rng) -> Result:
    size = float(rng.uniform(0.004, 0.008))
    parts = uniform(size)
    parts["integrator"] = SignoriniPosition(time_step=END / float(rng.uniform(20.0, 60.0)), growth=0.0)
    return run(float(rng.uniform(0.1, 0.5)), 5.0, **parts)


def energy_gained(rng: Rng) -> Result:
    stiffness = 10.0 ** float(rng.uniform(6.3, 7.0))
    parts = penalty(0.01, stiffness, 0.0, 3.0 / math.sqrt(stiffness))
    parts["integrator"] = GeneralizedAlphaPenalty(
        spectral_radius=1.0, stiffness=stiffness, damping=0.0, time_step=3.0 / math.sqrt(stiffness), growth=0.0
    )
    parts["far_field"] = GridViscosity(viscosity=0.0)
    return run(float(rng.uniform(0.2, 0.6)), 5.0, **parts)


FAULTS: dict[str, Callable[[Rng], Result]] = {
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
    return (clean if name == "clean" else FAULTS[name])(rng)
