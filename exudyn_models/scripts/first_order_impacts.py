"""The thesis's first-order impacts: a₀ = ±700 m/s², V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m, EI = μ = 1 (κ/ν = 0.1).

Half contact length λ_c = √t (λ₀ + ελ₁V₀² t) with EI/μ = 1; first-order theory predicts ελ₁V₀² = +300.0 and −280.6
m/s^{3/2}, and for the reaction εr₁ = +85.90 and −88.97. Both are differences against the same run with a₀ = 0, and
are carried to t → 0 from two end times, since the expansion holds while ε|λ₁|t/t* is small against λ₀.

python exudyn_models/scripts/first_order_impacts.py [--duration 0.008]
"""

import argparse

import matplotlib.pyplot as plt

import exudyn_models
from bent_beam import Impact
from exudyn_models.contacts import Penalty
from exudyn_models.integrators import GeneralizedAlpha
from exudyn_models.scripts.readings import first_order

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--duration", type=float, default=8e-3, help="longer of the two end times, in t* (default 0.008)")
parser.add_argument("--coarsen", type=float, default=1.0, help="factor on the element lengths and the steps")
parser.add_argument("--figure", default="first_order_impacts.png")
chosen = parser.parse_args()

LAMBDA0, R0 = 4.25760478009, 2.74499113477  # exact at κ/ν = 0.1 (thesis 2.6.21–22)
EXACT = {700.0: (300.0, 85.90), -700.0: (-280.6, -88.97)}  # thesis 2.7.40 and 2.7.71
impact = Impact(bending_stiffness=1.0, mass_per_length=1.0, length=2.0, curvature=0.35, velocity=3.5)
integrator = GeneralizedAlpha(relative_step=2e-3 * chosen.coarsen)
figure, axes = plt.subplots(layout="constrained")

for acceleration, (exact_lambda1, exact_r1) in EXACT.items():
    contact = Penalty(hold=16 if acceleration > 0 else 0)  # a hold would pull on a zone that rightly lifts off
    found = []
    for duration in (chosen.duration / 2, chosen.duration):
        end = duration * impact.time_scale
        mesh = exudyn_models.chosen_mesh(impact, end, coarsen=chosen.coarsen)
        base, run = (
            exudyn_models.simulate(case, end_time=end, mesh=mesh, contact=contact, integrator=integrator)
            for case in (impact, impact.replace(acceleration=acceleration))
        )
        lambda1, r1 = first_order(run, base, LAMBDA0, R0)
        found.append((lambda1 * impact.velocity**2, r1))
    lambda1, r1 = (2 * short - long for short, long in zip(*found))
    print(
        f"a0 = {acceleration:+g}: eps lambda1 V0^2 = {lambda1:+.1f} m/s^1.5, theory {exact_lambda1:+.1f}, "
        f"off by {lambda1 / exact_lambda1 - 1:+.1%}"
    )
    print(f"a0 = {acceleration:+g}: eps r1 = {r1:+.2f}, theory {exact_r1:+.2f}, off by {r1 / exact_r1 - 1:+.1%}")
    axes.plot(
        run.time, run.array("total_impulse") - base.array("total_impulse"), label=f"$a_0$ = {acceleration:+g} m/s²"
    )

axes.set(xlabel="t, s", ylabel="impulse over that with $a_0$ = 0, N s", title="first-order impacts")
axes.legend()
figure.savefig(chosen.figure, dpi=150)
print("figure:", chosen.figure)
