"""The Exudyn path: the beam of ANCF cable elements (or geometrically exact ones) against a rigid or elastic wall.

One call, every part a small frozen object that may be swapped or left to be chosen from the problem::

    from bent_beam import Impact
    import exudyn_models

    history = exudyn_models.simulate(Impact.dimensionless(0.5))

To read it, follow a run: :mod:`.method` (parts, given or chosen), :mod:`.resolution` and :mod:`.whole_beam` (mesh and
steps), :mod:`.geometry` (model units, how the beam is laid), :mod:`.assembly` (the Exudyn system of :mod:`.elements`
and :mod:`.contacts`), :mod:`.stepping` in :mod:`.segments`, :mod:`.settling` (which contacts are closed),
:mod:`.recording`. :mod:`.building` lays the same system for Exudyn alone.
"""

from exudyn_models.building import Built, build
from exudyn_models.contacts import CONTACTS
from exudyn_models.elements import ELEMENTS
from exudyn_models.geometry import GEOMETRIES
from exudyn_models.integrators import INTEGRATORS
from exudyn_models.method import ExudynModel, simulate
from exudyn_models.resolution import chosen_half_length, chosen_mesh
from exudyn_models.solvers import SOLVERS

__all__ = [
    "CONTACTS", "ELEMENTS", "GEOMETRIES", "INTEGRATORS", "SOLVERS", "Built", "ExudynModel", "build",
    "chosen_half_length", "chosen_mesh", "simulate",
]  # fmt: skip
