"""The self-similar path: finite elements in similarity coordinates, for the infinite beam.

Steady at leading order: its first state is the self-similar solution, found with bilateral constraints behind the
front. It is a sharp numerical reference, but no evidence for a time integrator.
"""

from self_similar_fe.mesh import ExpandingMesh
from self_similar_fe.method import SelfSimilarFE

__all__ = ["ExpandingMesh", "SelfSimilarFE"]
