"""The in-house finite-element path: Hermite beams, unilateral contact, nonsmooth time integration.

To read it, follow a run: :mod:`.simulate`, :mod:`.resolution` (mesh and steps), :mod:`.model` (the beam as a
:class:`.system.System`), :mod:`.run`, an integrator, :mod:`.active_set` (which constraints are closed),
:mod:`.constraints` (the system under them), :mod:`.banded`.

| symbol | meaning | symbol | meaning |
| --- | --- | --- | --- |
| q, v, M, C, K | dofs, velocities, matrices | g = gap + Gq ≥ 0, p | constraints and their impulses |
| S | step matrix M + cC + kK | U, D | its factors; in generalised-α U, W are jumps of q and v |
| e, θ, ρ∞ | restitution, θ-scheme, spectral radius | h, t | step length, time, s |
| K, K_w | in :mod:`.model` curvatures of beam and wall | V₀, a₀, c₀, q₀ | the free motion (:mod:`bent_beam.impact`) |
| l*, t* | scales of the first instants, √(EI/μ)/V₀ and √(EI/μ)/V₀² | T* | slow time scale √(μ/EI)(L/2)² |
| κ/ν | K√(EI/μ)/V₀, decides the impact | λ₀, r₀ | coefficients of contact length and reaction |
"""

from hermite_fe.contacts import CONTACTS
from hermite_fe.far_fields import FAR_FIELDS
from hermite_fe.integrators import INTEGRATORS
from hermite_fe.masses import MASSES
from hermite_fe.method import HermiteFE
from hermite_fe.simulate import simulate

__all__ = ["CONTACTS", "FAR_FIELDS", "INTEGRATORS", "MASSES", "HermiteFE", "simulate"]
