"""When shear matters: the whole impact over the slenderness with and without shear, and the force of one stopped point.

``python -m benchmarks.figures.shear`` writes ``shear.png`` in ``docs/figures`` (a minute). Paths that do not model a
beam are left out.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.measure.moments import mean_reaction
from bent_beam.measure.numbers import Number
from bent_beam.method import Method, method_from_tables
from comparison.bouncing import bounce
from comparison.figures import style
from theory.shear import StoppedPoint

__all__ = ["draw"]

RATIO, DAMPING = 0.2, 3e-3  # κ_sG/E of a pipe, η/T*
KAPPAS = (0.5, 2.0)
SLENDERNESS = np.geomspace(25.0, 600.0, 9)  # L/i, i the radius of gyration
PATHS = {"hermite": SLENDERNESS, "exudyn": SLENDERNESS[[2, 4, 6]]}
STOPPED = 1e3  # κ/ν of what stands for one point


def sheared(kappa_over_nu: float, slenderness: float) -> Impact:
    """The free beam of this slenderness: l_s = i/√g."""
    length = 2.0 / (slenderness * np.sqrt(RATIO))
    return Impact.whole_beam(kappa_over_nu, relative_damping=DAMPING, shear_length=length, shear_ratio=RATIO)


def numbers(method: Method, impact: Impact) -> tuple[Number, Number] | None:
    """Largest moment and restitution with their bars; ``None``: the path does not take this beam."""
    if method.refuses(impact) is not None:
        return None
    found = bounce(impact, method, save=500).numbers
    moment, restitution = found["peak_moment"], found["restitution"]
    assert isinstance(moment, Number) and isinstance(restitution, Number)  # the beam is damped
    return moment, restitution


def draw(out: Path) -> list[Path]:
    """``shear``: (a) largest moment, (b) restitution over slenderness, (c) force of one point over time."""
    with style.figure(1, 3, width=style.PAGE, height=2.7) as (fig, (left, middle, right)):
        for kappa, fill in zip(KAPPAS, ("none", None)):
            bare = numbers(method_from_tables("hermite", {}), Impact.whole_beam(kappa, relative_damping=DAMPING))
            for axis, number in zip((left, middle), bare or ()):
                axis.axhline(number.known, color="black", lw=0.8, ls="--")
            for path, slenderness in PATHS.items():
                method = method_from_tables(path, {})
                rows = [(x, one) for x in slenderness if (one := numbers(method, sheared(kappa, x))) is not None]
                mark = style.mark(path) | {"mfc": fill, "label": rf"{path}, $\kappa/\nu={kappa:g}$"}
                for axis, i in ((left, 0), (middle, 1)):
                    if rows:
                        values, errors = zip(*((one[i].known, one[i].bar) for _, one in rows))
                        style.bars(axis, [x for x, _ in rows], values, errors, mark)
        time = np.geomspace(0.05, 30.0, 120)
        right.loglog(time, 2.0 * np.sqrt(2.0 / (np.pi * time)), color="black", lw=0.8, ls="--", label="without shear")
        right.loglog(time, StoppedPoint(RATIO).reaction(time), **style.THEORY | {"lw": 1.0})
        history = stopped_run()
        kept = range(36, history.time.size - 12, 12)
        force = [mean_reaction(history, float(history.time[k])) for k in kept]
        right.loglog(history.time[kept], force, **style.mark("hermite") | {"ms": 3.0, "label": "hermite"})
        right.set_yticks([0.3, 0.5, 1.0, 2.0, 5.0], labels=["0.3", "0.5", "1", "2", "5"])
        right.set_xticks([0.1, 1.0, 10.0], labels=["0.1", "1", "10"])
        right.tick_params(which="minor", labelleft=False)
        for axis, name in ((left, r"$M_{\max}/V_0\sqrt{EI\mu}$  (1)"), (middle, r"$e$  (1)")):
            axis.set(xscale="log", xlabel=r"slenderness $L/i$  (1)", ylabel=name)
            axis.set_xticks([25, 50, 100, 200, 500], labels=["25", "50", "100", "200", "500"])
            axis.tick_params(which="minor", labelbottom=False)
        right.set(xlabel=r"$t/t_s$  (1)", ylabel=r"$R/V_0\sqrt{\kappa_sGA\,\mu}$  (1)")
        middle.legend(loc="center")
        right.legend()
        style.label_panels(left, middle, right)
        return style.save(fig, out, "shear")


def stopped_run() -> ImpactHistory:
    """One point that is stopped, until 30 t_s, in units t_s = l_s = V₀ = 1, on the Hermite path."""
    impact = Impact(1.0, 1.0, 2.0 * 45.0, STOPPED, 1.0, shear_stiffness=1.0, rotary_inertia=RATIO)
    tables = {
        "mesh": {"kind": "uniform", "element_length": 0.1},
        "integrator": {"kind": "moreau_jean", "theta": 0.5, "time_step": 0.02},
        "far_field": {"kind": "viscosity", "viscosity": 0.0},
    }
    times = np.geomspace(0.1, 33.0, 150)
    return method_from_tables("hermite", tables).simulate(impact, end_time=33.0, save=times)


if __name__ == "__main__":
    print(*draw(style.asked_folder()))
