"""Contact discretisations: where along the beam g ≥ 0 is asked for. One small file each."""

from hermite_fe.contacts.base import Contact
from hermite_fe.contacts.mean import MeanContact
from hermite_fe.contacts.middle import MiddleContact
from hermite_fe.contacts.node import NodeContact

__all__ = ["CONTACTS", "Contact", "MeanContact", "MiddleContact", "NodeContact"]

CONTACTS: dict[str, type] = {"node": NodeContact, "middle": MiddleContact, "mean": MeanContact}
"""Kinds of a case file's ``[hermite.contact]`` table."""
