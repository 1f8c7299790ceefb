"""Contact discretisations: where along the beam g ≥ 0 is asked for. One small file each."""

from hermite_fe.contacts.base import Contact
from hermite_fe.contacts.node import NodeContact

__all__ = ["CONTACTS", "Contact", "NodeContact"]

CONTACTS: dict[str, type] = {"node": NodeContact}
"""Kinds of a case file's ``[hermite.contact]`` table."""
