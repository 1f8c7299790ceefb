"""The laws of contact with a rigid wall, by their kinds in ``[exudyn.contact]``; the springs of an elastic wall stand
beside the penalty."""

from exudyn_models.contacts.base import Contact, ContactRun, Wall
from exudyn_models.contacts.penalty import Penalty, Springs
from exudyn_models.contacts.rigid import Rigid
from exudyn_models.contacts.segment_friction import SegmentFriction

__all__ = ["CONTACTS", "Contact", "ContactRun", "Penalty", "Rigid", "SegmentFriction", "Springs", "Wall"]

CONTACTS: dict[str, type] = {"penalty": Penalty, "rigid": Rigid, "segment_friction": SegmentFriction}
