"""The thesis's first-order impacts: a₀ = ±700 m/s², V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m, EI = μ = 1 (κ/ν = 0.1).

Theory predicts ελ₁V₀² = +300.0 and −280.6 m/s^{3/2}, εr₁ = +85.90 and −88.97 (thesis 2.7.40, 2.7.71). Both are
differences against the same run with a₀ = 0, whose own λ₀ and r₀ enter, nothing from theory.

python exudyn_models/scripts/first_order_impacts.py [--duration 0.008] [--out FILE]
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import matplotlib.pyplot as plt

import exudyn_models
from bent_beam import Impact
from bent_beam.measure.estimators import first_order, leading_order
from bent_beam.measure.moments import moments
from exudyn_models.contacts import Penalty
from exudyn_models.integrators import GeneralizedAlpha

EXACT = {700.0: (300.0 / 3.5**2, 85.90), -700.0: (-280.6 / 3.5**2, -88.97)}  # a0: eps lambda1, eps r1 with nu = 1


def main(arguments: Sequence[str] | None = None) -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--duration", type=float, default=8e-3, help="end time, in t* (default 0.008)")
    options.add_argument("--coarsen", type=float, default=1.0, help="factor on the element lengths and the steps")
    options.add_argument("--out", default="first_order_impacts.png", help="file to save the figure in")
    chosen = options.parse_args(arguments)
    impact = Impact(bending_stiffness=1.0, mass_per_length=1.0, length=2.0, curvature=0.35, velocity=3.5)
    end = chosen.duration * impact.time_scale
    mesh = exudyn_models.chosen_mesh(impact, end, coarsen=chosen.coarsen)
    integrator = GeneralizedAlpha().with_steps().refined(1.0 / chosen.coarsen)
    figure, axes = plt.subplots(layout="constrained")
    for acceleration in (700.0, -700.0):
        # a hold would pull on a zone that rightly lifts off
        contact = Penalty(hold=16) if acceleration > 0 else Penalty(hold_start=0.0)
        base, *runs = (
            exudyn_models.simulate(case, end_time=end, mesh=mesh, contact=contact, integrator=integrator)
            for case in (impact, *(impact.replace(acceleration=share * acceleration) for share in (0.5, 1.0)))
        )
        pairs = [(share, moments(run, uniform=True)) for share, run in zip((0.5, 1.0), runs)]
        found = first_order(pairs, moments(base), leading_order(moments(base)))
        for name, value, exact in zip(("lambda1", "r1"), (found.lambda1, found.r1), EXACT[acceleration]):
            off = value.known / exact - 1
            print(f"a0 = {acceleration:+g}: eps {name} = {value}, theory {exact:.4g}, off by {off:+.1%}")
        more = runs[-1].array("total_impulse") - base.array("total_impulse")
        axes.plot(runs[-1].time * 1e3, more, label=f"$a_0$ = {acceleration:+g} m/s²")
    axes.set(xlabel="t, ms", ylabel="impulse over that with $a_0$ = 0, N s", title="first-order impacts")
    axes.legend()
    figure.savefig(chosen.out, dpi=150)


if __name__ == "__main__":
    main()
