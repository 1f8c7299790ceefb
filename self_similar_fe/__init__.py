"""The self-similar path: finite elements in similarity coordinates, for the infinite beam.

Steady at leading order: its first state already is the self-similar solution, found with the nodes behind the front
held. It is the sharpest numerical reference there is and no evidence for a time integrator.
"""

from self_similar_fe.mesh import ExpandingMesh
from self_similar_fe.method import SelfSimilarFE

__all__ = ["ExpandingMesh", "SelfSimilarFE"]
