"""The ground floor: the impact problem, case files, meshes and the record of a run, shared by all paths."""

from bent_beam.cases import Case, load_case
from bent_beam.history import ImpactHistory, SimulationError
from bent_beam.impact import Impact
from bent_beam.parts import InputError

__all__ = ["Case", "Impact", "ImpactHistory", "InputError", "SimulationError", "load_case"]
