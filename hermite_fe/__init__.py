"""The in-house finite-element path: Hermite beams, unilateral contact, nonsmooth time integration."""

from hermite_fe.contacts import CONTACTS
from hermite_fe.far_fields import FAR_FIELDS
from hermite_fe.integrators import INTEGRATORS
from hermite_fe.simulate import simulate

__all__ = ["CONTACTS", "FAR_FIELDS", "INTEGRATORS", "REGISTRIES", "simulate"]

REGISTRIES: dict[str, dict[str, type]] = {
    "integrator": INTEGRATORS,
    "contact": CONTACTS,
    "far_field": FAR_FIELDS,
}
"""Kinds of the tables ``[hermite.integrator]``, ``[hermite.contact]``, ``[hermite.far_field]`` of a case
file."""
