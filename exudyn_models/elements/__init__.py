"""Beam elements: each a small file; ``ELEMENTS`` names them for ``[exudyn.element]``."""

from bent_beam import Impact
from exudyn_models.elements.ancf_cable import ANCFCable
from exudyn_models.elements.beam import Beam, Element
from exudyn_models.elements.geometrically_exact import GeometricallyExact

__all__ = ["ELEMENTS", "ANCFCable", "Beam", "Element", "GeometricallyExact", "chosen_element"]

ELEMENTS: dict[str, type] = {"ancf_cable": ANCFCable, "geometrically_exact": GeometricallyExact}


def chosen_element(impact: Impact) -> Element:
    """The element of a beam for which none is asked: one with shear where the beam has it."""
    return (ANCFCable if impact.shear_stiffness is None else GeometricallyExact)()
