"""Compile the named integrators by a small impact each: python -m tests.compile_integrators signorini_position …"""

from __future__ import annotations

import sys

import hermite_fe
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.integrators import INTEGRATORS


def main() -> None:
    for kind in sys.argv[1:]:
        impact = Impact.dimensionless(0.5, length=4.0)
        hermite_fe.simulate(impact, end_time=1e-2, mesh=UniformMesh(0.1), integrator=INTEGRATORS[kind](1e-3))


if __name__ == "__main__":
    main()
