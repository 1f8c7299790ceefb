"""When shear matters: the whole impact over the slenderness with and without shear; and one stopped point, whose force,
impulse and moment the theory has exactly, on both paths.

``python -m benchmarks.figures.shear`` writes ``shear.png`` in ``docs/figures`` (a minute).
"""

from pathlib import Path

import numpy as np

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.measure.moments import mean_reaction
from bent_beam.measure.numbers import Number
from bent_beam.method import method_from_tables
from comparison.bouncing import bounce
from comparison.figures import style
from theory.shear import StoppedPoint

RATIO, DAMPING = 0.2, 3e-3  # κ_sG/E of a pipe, η/T*
KAPPAS = (0.5, 2.0)
SLENDERNESS = np.geomspace(25.0, 600.0, 9)  # L/i, i the radius of gyration
PATHS = {"hermite": SLENDERNESS, "exudyn": SLENDERNESS[[2, 4, 6]]}
STOPPED = 1e4  # κ/ν of what stands for one point
STEPS = {  # of a run with elements of one length
    "hermite": lambda element: {
        "integrator": {"kind": "moreau_jean", "theta": 0.5, "time_step": 0.2 * element},
        "far_field": {"kind": "viscosity", "viscosity": 0.0},
    },
    "exudyn": lambda element: {"integrator": {"kind": "trapezoidal", "time_step": 0.5 * element}},
}
ELEMENTS = {"hermite": 0.05, "exudyn": 0.025}  # l_s; the penalty is as soft as an element


def sheared(kappa_over_nu: float, slenderness: float) -> Impact:
    """The free beam of this slenderness: l_s = i/√g."""
    length = 2.0 / (slenderness * np.sqrt(RATIO))
    return Impact.whole_beam(kappa_over_nu, relative_damping=DAMPING, shear_length=length, shear_ratio=RATIO)


def numbers(path: str, impact: Impact) -> tuple[Number, Number]:
    """Largest moment and restitution with their bars."""
    found = bounce(impact, method_from_tables(path, {}), save=500).numbers
    return found["peak_moment"], found["restitution"]  # the beam is damped: no bands


def draw(out: Path) -> list[Path]:
    """``shear``: (a) largest moment, (b) restitution over slenderness, (c) force of one point over time."""
    with style.figure(2, 2, width=style.PAGE, height=5.2) as (fig, ((left, middle), (right, last))):
        for kappa, fill in zip(KAPPAS, ("none", None)):
            bare = numbers("hermite", Impact.whole_beam(kappa, relative_damping=DAMPING))
            for axis, number in zip((left, middle), bare):
                axis.axhline(number.known, color="black", lw=0.8, ls="--")
            for path, slenderness in PATHS.items():
                mark = style.mark(path) | {"mfc": fill, "label": rf"{path}, $\kappa/\nu={kappa:g}$"}
                rows = [numbers(path, sheared(kappa, x)) for x in slenderness]
                for axis, found in zip((left, middle), zip(*rows)):
                    style.bars(axis, slenderness, [one.known for one in found], [one.bar for one in found], mark)
        time = np.geomspace(0.05, 30.0, 120)
        right.loglog(time, 2.0 * np.sqrt(2.0 / (np.pi * time)), color="black", lw=0.8, ls="--", label="without shear")
        right.loglog(time, StoppedPoint(RATIO).reaction(time), **style.THEORY | {"lw": 1.0})
        for path, element in ELEMENTS.items():
            history, coarse = (stopped_run(path, factor * element) for factor in (1.0, 2.0))
            kept = np.arange(7, history.time.size - 8, 12)
            force = [mean_reaction(history, float(history.time[k])) for k in kept]
            right.loglog(history.time[kept], force, **style.mark(path) | {"ms": 3.0, "label": path})
            for name, fill, aside in (("impulse", "none", 0.99), ("moment", None, 1.01)):
                ratios, others = (over_theory(run, name) for run in (history, coarse))
                bars = 2.0 * np.abs(ratios - np.interp(history.time, coarse.time, others))[kept]
                mark = style.mark(path) | {"mfc": fill, "label": f"{path}, {name}"}
                style.bars(last, aside * history.time[kept], 100.0 * (ratios[kept] - 1.0), 100.0 * bars, mark)
        right.set_yticks([0.3, 0.5, 1.0, 2.0, 5.0], labels=["0.3", "0.5", "1", "2", "5"])
        right.set_xticks([0.1, 1.0, 10.0], labels=["0.1", "1", "10"])
        right.tick_params(which="minor", labelleft=False)
        for axis, name in ((left, r"$M_{\max}/(V_0\sqrt{EI\mu})$  (1)"), (middle, r"$e$  (1)")):
            axis.set(xscale="log", xlabel=r"slenderness $L/i$  (1)", ylabel=name)
            axis.set_xticks([25, 50, 100, 200, 500], labels=["25", "50", "100", "200", "500"])
            axis.tick_params(which="minor", labelbottom=False)
        right.set(xlabel=r"$t/t_s$  (1)", ylabel=r"$R/(V_0\sqrt{\kappa_sGA\,\mu})$  (1)")
        last.set(xscale="log", xlabel=r"$t/t_s$  (1)", ylabel="simulation over theory $-$ 1  (%)")
        last.set(ylim=(-5.5, 4.0), xlim=(1.7, 25.0))
        last.set_xticks([2.0, 5.0, 10.0, 20.0], labels=["2", "5", "10", "20"])
        last.tick_params(which="minor", labelbottom=False)
        middle.legend(loc="center")
        right.legend()
        last.legend()
        style.label_panels(left, middle, right, last)
        return style.save(fig, out, "shear")


def stopped_run(path: str, element: float, end: float = 33.0) -> ImpactHistory:
    """One point that is stopped, in units t_s = l_s = V₀ = 1."""
    impact = Impact(1.0, 1.0, 2.0 * 45.0, STOPPED, 1.0, shear_stiffness=1.0, rotary_inertia=RATIO)
    method = method_from_tables(path, {"mesh": {"kind": "uniform", "element_length": element}} | STEPS[path](element))
    return method.simulate(impact, end_time=end, save=np.geomspace(0.8, end, 121))


def over_theory(history: ImpactHistory, name: str) -> np.ndarray:
    """Impulse, or moment under the point, over the theory's; 1 at t = 0."""
    point, time = StoppedPoint(RATIO), history.time[1:]
    found, theory = history.array("total_impulse"), point.impulse(time)
    if name == "moment":
        found, theory = history.array("bending_moment")[:, 0], point.moment(time)
    return np.append(1.0, found[1:] / theory)


if __name__ == "__main__":
    print(*draw(Path("docs/figures")))
