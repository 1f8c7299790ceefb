"""A naturally bent beam hits a rigid wall: μ y_tt + EI y_xxxx = −r, 0 ≤ r ⊥ −y ≥ 0 (thesis 2.1.1–2).

Change a part below, run, look:  python exudyn_models/scripts/bent_beam_impact.py --kappa-over-nu 0.5
Every part and its settings: docs/exudyn.md.
"""

import argparse

import matplotlib.pyplot as plt
import numpy as np

import exudyn_models
from bent_beam import Impact
from exudyn_models.contacts import Penalty
from exudyn_models.elements import ANCFCable
from exudyn_models.integrators import GeneralizedAlpha
from exudyn_models.scripts.readings import leading_order

# exact leading order (thesis 2.6.21–22): κ/ν → λ₀, r₀/ν
EXACT = {
    0.05: (6.23692857563, 3.93727884942),
    0.1: (4.25760478009, 2.74499113477),
    0.25: (2.26148623298, 1.66800147203),
    0.5: (1.01886591389, 1.17721208090),
    0.8: (0.296846693037, 1.01915199895),
}

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--kappa-over-nu", type=float, default=0.5, help="K sqrt(EI/mu)/V0 (default 0.5)")
parser.add_argument("--geometry", choices=["linear", "true"], default="linear")
parser.add_argument("--duration", type=float, default=None, help="end time in units of t* (default 0.1; true: 1e-3)")
parser.add_argument("--coarsen", type=float, default=1.0, help="factor on the element lengths")
parser.add_argument("--figure", default="bent_beam_impact.png", help="file to save the figure in")
parser.add_argument("--view", action="store_true", help="watch in Exudyn's viewer (best with --geometry true)")
chosen = parser.parse_args()

impact = Impact.dimensionless(chosen.kappa_over_nu)  # or Impact(bending_stiffness=..., ...) in SI units
duration = chosen.duration or (1e-3 if chosen.geometry == "true" else 0.1)
end_time = duration * impact.time_scale
history = exudyn_models.simulate(
    impact,
    end_time=end_time,
    mesh=exudyn_models.chosen_mesh(impact, end_time, coarsen=chosen.coarsen),
    element=ANCFCable(),  # or GeometricallyExact()
    integrator=GeneralizedAlpha(spectral_radius=0.5),  # or Newmark(), Trapezoidal(), RK44(), VelocityVerlet() ...
    contact=Penalty(),  # or Rigid() with Newmark(), or SegmentFriction(friction=0.2)
    geometry=chosen.geometry,
    view=chosen.view,
)

lambda0, r0 = leading_order(history)
exact = EXACT.get(chosen.kappa_over_nu)
print(f"steps {history.steps}, {history.seconds:.1f} s in Exudyn, {history.settings['nodes']} nodes")
for name, found, k in (("lambda0", lambda0, 0), ("r0", r0, 1)):
    print(f"{name} = {found:.5f}" + (f", exact {exact[k]:.5f}, off by {found / exact[k] - 1:+.3%}" if exact else ""))
for warning in history.warnings:
    print("warning:", warning)

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
scale = history.impact.length_scale * np.sqrt(history.time[-1] / history.impact.time_scale)
near = np.abs(history.array("x")) < 4 * scale
for k in np.linspace(0, history.time.size - 1, 5).astype(int):
    left.plot(history.array("x")[near], -history.array("gap")[k, near], label=f"t = {history.time[k]:.3g} s")
left.axhline(0.0, color="black", linewidth=0.8)
left.set(xlabel="x, m", ylabel="y, m (wall at 0)", title="deflection")
left.legend()
right.plot(history.time, history.array("total_impulse"))
right.set(xlabel="t, s", ylabel="impulse, N s", title="impulse of the reaction")
figure.savefig(chosen.figure, dpi=150)
print("figure:", chosen.figure)
