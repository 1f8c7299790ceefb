r"""A beam that shears on a rigid or an elastic wall, by the Hermite path: what its theory lacks, and the largest force.

``python -m benchmarks.shear`` prints both (two minutes): the constants of :mod:`theory.shear` and docs/wall.md rest on
them. Units t_s = l_s = V₀ = 1 leave κ/ν and g = κ_sG/E (pipe 0.2, solid section 0.33). No wave comes back.
"""

import numpy as np

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.measure.moments import half_contact_length
from bent_beam.measure.reduction import wall_peaks
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import Integrator, Midpoint, MoreauJean
from theory import contact_parameters
from theory.elastic_wall import peak_force
from theory.shear import first_instants, forgotten_after

QUIET = GridViscosity(viscosity=0.0)


def run(kappa_over_nu: float, end: float, element: float, ratio: float, wall_time: float = 0.0) -> ImpactHistory:
    """The impact until ``end``. wall_time : t_k of an elastic wall, 0: rigid. All in t_s and l_s."""
    half = 0.55 * end / np.sqrt(ratio) + np.sqrt(2.0 * end / kappa_over_nu) + 5.0
    impact = Impact(1.0, 1.0, 2.0 * half, kappa_over_nu, 1.0, shear_stiffness=1.0, rotary_inertia=ratio)
    scheme: Integrator = MoreauJean(theta=0.5, time_step=0.3 * element, growth=0.0)
    if wall_time:
        impact = impact.replace(wall_stiffness=wall_time**-2.0)
        scheme = Midpoint(min(0.3 * element, 0.02 * wall_time), 0.0)
    method = HermiteFE(mesh=UniformMesh(element), integrator=scheme, far_field=QUIET)
    return method.simulate(impact, end_time=end, save=np.linspace(0.0, end, 401)[1:])


def lacking(kappa_over_nu: float, time: float, element: float, ratio: float) -> dict[str, float]:
    """What the run has more than :func:`theory.shear.first_instants` at ``time``: share of the impulse; rim, l_s."""
    history = run(kappa_over_nu, 1.1 * time, element, ratio)
    k = int(np.searchsorted(history.time, time))
    solved = contact_parameters(kappa_over_nu)
    rim, _, impulse = first_instants(kappa_over_nu, solved, ratio, float(history.time[k]))
    found = {"impulse": float(history.array("total_impulse")[k]) / impulse - 1.0}
    return found if kappa_over_nu > 1.0 else found | {"rim": half_contact_length(history, k) - rim}


def peak(kappa_over_nu: float, wall_time: float, element: float, ratio: float) -> float:
    """Largest force on a wall of t_k = ``wall_time`` over that without shear."""
    f = peak_force(kappa_over_nu)
    found = wall_peaks(run(kappa_over_nu, 1.6 * f.time * wall_time, element, ratio, wall_time))
    return found.force * np.sqrt(wall_time) / f.value


def _main() -> None:
    for ratio in (0.2, 0.33):
        print(f"\nκ_sG/E = {ratio}: rigid wall, what the beam has more than theory")
        for kappa in (0.05, 0.1, 0.2, 0.5, 0.8, 1.0, 1.2, 2.0, 5.0):
            after = forgotten_after(kappa)
            for time in (after, 3.0 * after) if kappa >= 0.2 else (after,):
                values = (f"{name} {value:+.4f}" for name, value in lacking(kappa, time, 0.1, ratio).items())
                print(f"κ/ν = {kappa:4g}, t = {time:4g} t_s:", *values, flush=True)
        print("elastic wall: largest force over Euler and Bernoulli's")
        for kappa in (0.05, 0.5, 1.0, 5.0):
            for wall_time in (1.0, 3.0, 10.0):
                force = peak(kappa, wall_time, 0.04 * max(0.3, wall_time**0.5), ratio)
                print(f"κ/ν = {kappa:4g}, t_k = {wall_time:4g} t_s: {force:.4f}", flush=True)


if __name__ == "__main__":
    _main()
