"""Far fields: what becomes of the waves that leave the contact. One small file each."""

from hermite_fe.far_fields.base import FarField
from hermite_fe.far_fields.sponge import Sponge
from hermite_fe.far_fields.viscosity import GridViscosity

__all__ = ["FAR_FIELDS", "FarField", "GridViscosity", "Sponge"]

FAR_FIELDS: dict[str, type] = {"viscosity": GridViscosity, "sponge": Sponge}
"""Kinds of a case file's ``[hermite.far_field]`` table."""
