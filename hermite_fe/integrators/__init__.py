"""Time integrators. A new one is one small file here and a line in the registry."""

from hermite_fe.integrators.base import Integrator
from hermite_fe.integrators.generalized_alpha_penalty import GeneralizedAlphaPenalty
from hermite_fe.integrators.massless_boundary import MasslessBoundary
from hermite_fe.integrators.midpoint import Midpoint
from hermite_fe.integrators.nonsmooth_generalized_alpha import NonsmoothGeneralizedAlpha
from hermite_fe.integrators.theta import MoreauJean, SignoriniPosition

__all__ = [
    "INTEGRATORS", "GeneralizedAlphaPenalty", "Integrator", "MasslessBoundary", "Midpoint", "MoreauJean",
    "NonsmoothGeneralizedAlpha", "SignoriniPosition",
]  # fmt: skip

INTEGRATORS: dict[str, type] = {
    "moreau_jean": MoreauJean,
    "nonsmooth_generalized_alpha": NonsmoothGeneralizedAlpha,
    "signorini_position": SignoriniPosition,
    "generalized_alpha_penalty": GeneralizedAlphaPenalty,
    "midpoint": Midpoint,
    "massless_boundary": MasslessBoundary,
}
"""Kinds of a case file's ``[hermite.integrator]`` table."""
