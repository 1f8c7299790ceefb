"""Time integrators; ``INTEGRATORS`` names them for ``[exudyn.integrator]``."""

from exudyn_models.integrators.base import Averages, Integrator
from exudyn_models.integrators.explicit import DOPRI5, RK44, VelocityVerlet
from exudyn_models.integrators.implicit import GeneralizedAlpha, Newmark, Trapezoidal

__all__ = [
    "DOPRI5",
    "INTEGRATORS",
    "RK44",
    "Averages",
    "GeneralizedAlpha",
    "Integrator",
    "Newmark",
    "Trapezoidal",
    "VelocityVerlet",
]

INTEGRATORS: dict[str, type] = {
    "generalized_alpha": GeneralizedAlpha,
    "newmark": Newmark,
    "trapezoidal": Trapezoidal,
    "rk44": RK44,
    "dopri5": DOPRI5,
    "velocity_verlet": VelocityVerlet,
}
