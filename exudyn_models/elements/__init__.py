"""Beam elements: each a small file; ``ELEMENTS`` names them for ``[exudyn.element]``."""

from exudyn_models.elements.ancf_cable import ANCFCable
from exudyn_models.elements.beam import Beam, Element
from exudyn_models.elements.geometrically_exact import GeometricallyExact

__all__ = ["ELEMENTS", "ANCFCable", "Beam", "Element", "GeometricallyExact"]

ELEMENTS: dict[str, type] = {"ancf_cable": ANCFCable, "geometrically_exact": GeometricallyExact}
