"""Compile the steps of integrators, so that tests find them: python tests/compile_kernels.py S P V A."""

from __future__ import annotations

import sys

from half_beams import half_beam, stepper

from hermite_fe.integrators import GeneralizedAlphaPenalty, Integrator, NonsmoothGeneralizedAlpha, SignoriniPosition

KINDS: dict[str, Integrator] = {
    "S": SignoriniPosition(1e-3),  # and Moreau–Jean, which has the same steps
    "P": GeneralizedAlphaPenalty(1e-3, stiffness=1e5, damping=1.0),
    "V": NonsmoothGeneralizedAlpha(1e-3, levels="velocity"),
    "A": NonsmoothGeneralizedAlpha(1e-3),
}


def main() -> None:
    model = half_beam(kappa=0.5, half_length=2.0, nodes=21)
    for kind in sys.argv[1:]:
        stepper(model, KINDS[kind]).compile()


if __name__ == "__main__":
    main()
