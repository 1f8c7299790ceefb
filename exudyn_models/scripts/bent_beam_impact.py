"""A naturally bent beam hits a rigid wall: μ y_tt + EI y_xxxx = −r, 0 ≤ r ⊥ −y ≥ 0 (thesis 2.1.1–2).

Change a part, run, look: python exudyn_models/scripts/bent_beam_impact.py --kappa-over-nu 0.5   (docs/exudyn.md)
"""

import argparse
from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np

import exudyn_models as em
from bent_beam import Impact
from bent_beam.measure.estimators import leading_order
from bent_beam.measure.moments import moments

EXACT = {0.1: (4.25760478009, 2.74499113477), 0.5: (1.01886591389, 1.17721208090)}  # kappa/nu: thesis 2.6.21-22


def main(arguments: Sequence[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--kappa-over-nu", type=float, default=0.5, help="K sqrt(EI/mu)/V0 (default 0.5)")
    options.add_argument("--geometry", choices=["linear", "true"], default="linear")
    options.add_argument("--duration", type=float, help="end time in units of t* (default 0.1; true: 1e-3)")
    options.add_argument("--coarsen", type=float, default=1.0, help="factor on the element lengths")
    options.add_argument("--out", default="bent_beam_impact.png", help="file to save the figure in")
    options.add_argument("--view", action="store_true", help="watch in Exudyn's viewer (best with --geometry true)")
    chosen = options.parse_args(arguments)
    impact = Impact.dimensionless(chosen.kappa_over_nu)  # or Impact(bending_stiffness=..., ...) in SI units
    end_time = (chosen.duration or (1e-3 if chosen.geometry == "true" else 0.1)) * impact.time_scale
    history = em.simulate(
        impact,
        end_time=end_time,
        mesh=em.chosen_mesh(impact, end_time, coarsen=chosen.coarsen),
        element=em.ELEMENTS["ancf_cable"](),  # or geometrically_exact
        integrator=em.INTEGRATORS["generalized_alpha"](),  # or newmark, trapezoidal, rk44, velocity_verlet
        contact=em.CONTACTS["penalty"](),  # or rigid with newmark, or segment_friction
        geometry=em.GEOMETRIES[chosen.geometry](),
        view=chosen.view,
    )
    found = leading_order(moments(history))
    print(f"lambda0 = {found.lambda0}, r0 = {found.r0}")
    for value, exact in zip((found.lambda0, found.r0), EXACT.get(chosen.kappa_over_nu, ())):
        print(f"theory {exact:.6g}, off by {value.known / exact - 1:+.3%}")
    print(*history.warnings, sep="\n", end="")
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    reach = 1.6 * max(found.lambda0.known, 0.5) * impact.length_scale * np.sqrt(history.time[-1] / impact.time_scale)
    x, depth = history.array("x"), -history.array("gap")
    for share in (0.0, 0.25, 0.5, 1.0):
        k = int(np.argmin(np.abs(history.time - share * end_time)))
        left.plot(x[x < reach], depth[k, x < reach], label=f"t = {history.time[k]:.3g} s")
    top = 0.06 * impact.curvature * reach**2
    left.axhspan(0.0, top, color="0.85", zorder=0)
    left.set(xlabel="x, m", ylabel="y, m (wall: grey)", title="half of the beam at the wall", ylim=(-8 * top, top))
    left.legend()
    right.plot(history.time, history.array("total_impulse"))
    right.set(xlabel="t, s", ylabel="impulse, N s", title="impulse of the reaction")
    figure.savefig(chosen.out, dpi=150)


if __name__ == "__main__":
    main()
