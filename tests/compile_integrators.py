"""Compile every integrator by a small impact: python -m tests.compile_integrators."""

import hermite_fe
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.integrators import INTEGRATORS

NEEDS = {"midpoint": {"wall_stiffness": 1e4}, "hysteretic": {"hysteretic_loss": 0.1, "loss_frequency": 5.0}}

if __name__ == "__main__":
    for kind in (*INTEGRATORS, "hysteretic"):
        impact = Impact.dimensionless(0.5, length=4.0).replace(**NEEDS.get(kind, {}))
        scheme = INTEGRATORS.get(kind, INTEGRATORS["signorini_position"])(1e-3)
        contact = hermite_fe.contacts.AlternateContact() if kind == "massless_boundary" else None
        hermite_fe.simulate(impact, end_time=1e-2, mesh=UniformMesh(0.1), integrator=scheme, contact=contact)
