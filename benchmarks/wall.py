r"""An elastic wall: since when it is as good as rigid, and what the beam's own damping takes of the largest force.

``python -m benchmarks.wall`` prints both (two minutes). The times of :mod:`theory.wall_prediction` are read off
:mod:`theory.elastic_wall`, :data:`~theory.wall_prediction.MOST_OWN_DAMPING` off the Hermite path. Units t_k, ℓ_k, V₀.
"""

import math

import numpy as np

from benchmarks.shear import QUIET
from bent_beam.impact import Impact
from bent_beam.measure.reduction import wall_peaks
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE
from hermite_fe.integrators import Midpoint
from theory import contact_parameters
from theory.elastic_wall import peak_force, wall_history
from theory.validity import TOLERANCE

TENTH = 0.05  # of a time: what a reaction is a mean over, either way


def settled(
    kappa_over_nu: float, damping_ratio: float, end: float, cells: int = 120, steps: int = 1500
) -> dict[str, float]:
    """t_k after which the impulse, and the force over a tenth of the time, are within 2 % of the rigid wall's until
    ``end``; of a zone also λ₀√(ct), ℓ_k, after which the place of its force is, 1/β·√½ behind the rim."""
    found = wall_history(kappa_over_nu, damping_ratio, end=end, cells=cells, steps=steps)
    solved = contact_parameters(kappa_over_nu)
    time = found.time[1:]
    rigid = 4.0 * math.sqrt(2.0 / math.pi) * solved.r0 * np.sqrt(found.time)
    inner = time[time < end / (1.0 + TENTH)]
    gained, expected = (
        np.interp((1.0 + TENTH) * inner, found.time, one) - np.interp((1.0 - TENTH) * inner, found.time, one)
        for one in (found.impulse, rigid)
    )
    times = {"impulse": _last(time, found.impulse[1:] / rigid[1:]), "force": _last(inner, gained / expected)}
    if solved.lambda0 > 0.0:
        place = (found.half_contact_length[1:] - math.sqrt(2.0)) / (solved.lambda0 * np.sqrt(time))
        times["place"] = float(solved.lambda0 * math.sqrt(_last(time, place)))
    return times


def _last(time: np.ndarray, ratio: np.ndarray) -> float:
    """The last time at which a ratio is off one by more than the tolerance; 0: never."""
    off = np.flatnonzero(np.abs(ratio - 1.0) > TOLERANCE)
    return float(time[off[-1]]) if off.size else 0.0


def change_by_damping(kappa_over_nu: float, damping: float, element: float = 0.04) -> float:
    """What a damping time of the beam, t_k, changes of the largest force, by Hermite elements; a share."""
    end = 1.6 * peak_force(kappa_over_nu).time
    half = math.sqrt(2.0 * end / kappa_over_nu) + 8.0 * math.sqrt(end) + 5.0
    beam = Impact(1.0, 1.0, 2.0 * half, kappa_over_nu, 1.0, wall_stiffness=1.0)
    method = HermiteFE(mesh=UniformMesh(element), integrator=Midpoint(0.01, 0.0), far_field=QUIET)
    runs = (method.simulate(one, end_time=end, save=50) for one in (beam, beam.replace(damping=damping)))
    bare, damped = (wall_peaks(history).force for history in runs)
    return damped / bare - 1.0


def _main() -> None:
    print("within 2 % of the rigid wall's after, t_k; place: λ₀√(ct), ℓ_k")
    cases = [(0.35, 0.25), (0.35, 1.0), (0.5, 0.25), (0.7, 0.25), (0.9, 1.0)]
    cases += [(kappa, 0.0) for kappa in (1.0, 1.2, 2.0, 5.0, 20.0, 100.0)]
    for kappa, damping in cases:
        values = settled(kappa, damping, 300.0 if damping else 60.0 * kappa**0.25)
        print(f"κ/ν = {kappa:4g}, ζ = {damping:4g}:", *(f"{k} {v:.3g}" for k, v in values.items()), flush=True)
    print("the beam's own damping: change of the largest force")
    for kappa in (0.05, 0.5, 1.0, 5.0):
        for damping in (0.1, 0.2, 0.4):
            print(f"κ/ν = {kappa:4g}, η = {damping:g} t_k: {change_by_damping(kappa, damping):+.4f}", flush=True)


if __name__ == "__main__":
    _main()
