"""Compile the steps of integrators, so that tests find them: python tests/compile_kernels.py S P V A."""

from __future__ import annotations

import sys

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import (
    GeneralizedAlphaPenalty,
    Integrator,
    NonsmoothGeneralizedAlpha,
    SignoriniPosition,
)
from hermite_fe.model import beam_model
from hermite_fe.run import Stepper

KINDS: dict[str, Integrator] = {
    "S": SignoriniPosition(1e-3),  # and Moreau–Jean, which has the same steps
    "P": GeneralizedAlphaPenalty(1e-3, stiffness=1e5, damping=1.0),
    "V": NonsmoothGeneralizedAlpha(1e-3, levels="velocity"),
    "A": NonsmoothGeneralizedAlpha(1e-3),
}


def main() -> None:
    impact, contact = Impact.dimensionless(0.5, length=4.0), NodeContact(hold=0, hold_until=0.0)
    model = beam_model(impact, UniformMesh(0.1).nodes(2.0), contact, GridViscosity(), full=False)
    for kind in sys.argv[1:]:
        Stepper(model.system, model.displacement, model.velocity, KINDS[kind], 1.0).compile()


if __name__ == "__main__":
    main()
