"""Compile the integrators by a small impact each: python -m tests.compile_integrators"""

import hermite_fe
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.integrators import INTEGRATORS

if __name__ == "__main__":
    impact, mesh = Impact.dimensionless(0.5, length=4.0), UniformMesh(0.1)
    for kind in ("signorini_position", "generalized_alpha_penalty", "nonsmooth_generalized_alpha"):
        hermite_fe.simulate(impact, end_time=1e-2, mesh=mesh, integrator=INTEGRATORS[kind](1e-3))
