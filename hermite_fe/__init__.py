"""The in-house finite-element path: Hermite beams, unilateral contact, nonsmooth time integration."""

from hermite_fe.contacts import CONTACTS
from hermite_fe.far_fields import FAR_FIELDS
from hermite_fe.integrators import INTEGRATORS
from hermite_fe.masses import MASSES
from hermite_fe.method import HermiteFE
from hermite_fe.simulate import simulate

__all__ = ["CONTACTS", "FAR_FIELDS", "INTEGRATORS", "MASSES", "HermiteFE", "simulate"]
