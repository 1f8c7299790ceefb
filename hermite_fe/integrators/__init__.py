"""Time integrators. A new one is one small file here and a line in the registry."""

from hermite_fe.integrators.base import Integrator
from hermite_fe.integrators.moreau_jean import MoreauJean
from hermite_fe.integrators.signorini_position import SignoriniPosition

__all__ = ["INTEGRATORS", "Integrator", "MoreauJean", "SignoriniPosition"]

INTEGRATORS: dict[str, type] = {
    "moreau_jean": MoreauJean,
    "signorini_position": SignoriniPosition,
}
"""Kinds of a case file's ``[hermite.integrator]`` table."""
