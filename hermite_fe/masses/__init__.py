"""Mass matrices: what the nodes carry of the beam's inertia. One small file each."""

from hermite_fe.masses.base import Mass
from hermite_fe.masses.consistent import ConsistentMass
from hermite_fe.masses.lumped import LumpedMass

__all__ = ["MASSES", "ConsistentMass", "LumpedMass", "Mass"]

MASSES: dict[str, type] = {"consistent": ConsistentMass, "lumped": LumpedMass}
"""Kinds of a case file's ``[hermite.mass]`` table."""
