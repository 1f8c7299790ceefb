"""A wall that gives way, by theory: force over time, the largest force, and how the rigid wall's law comes back.

``python -m benchmarks.figures.elastic_wall`` writes ``wall-force.png``, ``wall-peak-force.png`` and ``wall-return.png``
in ``docs/figures`` (a minute).
"""

from pathlib import Path

import numpy as np

from comparison.figures import style
from theory.contact import contact_parameters
from theory.elastic_wall import flat_limit, peak_force, sharp_limit, wall_history
from theory.wall_prediction import zone_offset

RATIOS = (0.05, 0.2, 0.5, 1.0, 5.0)
DAMPINGS = (0.0, 0.1, 0.25, 0.5, 1.0)
TIME = r"$t/t_k$  (1)"
UNIT = r"(V_0\sqrt{\mu}\,(EIk)^{1/4})"


def draw_force(out: Path) -> list[Path]:
    """``wall-force``: (a) five κ/ν without damping, (b) five ζ at κ/ν = 0.5."""
    with style.figure(1, 2, width=style.PAGE, height=2.7) as (fig, (left, right)):
        for ratio, colour in zip(RATIOS, style.SEQUENCE):
            found = wall_history(ratio, end=8.0, cells=80, steps=320)
            left.plot(found.time, np.sqrt(ratio) * found.force, color=colour, lw=1.0, label=rf"$\kappa/\nu={ratio:g}$")
        for damping, colour in zip(DAMPINGS, style.SEQUENCE):
            found = wall_history(0.5, damping, end=8.0, cells=80, steps=480)
            right.plot(found.time, found.force, color=colour, lw=1.0, label=rf"$\zeta={damping:g}$")
        left.set_ylabel(rf"$F\sqrt{{\kappa/\nu}}\,/\,{UNIT}$  (1)")
        right.set_ylabel(rf"$F/{UNIT}$  (1)")
        for axis, text in ((left, r"(a)  $\zeta=0$"), (right, r"(b)  $\kappa/\nu=0.5$")):
            axis.set(xlabel=TIME, xlim=(0.0, 8.0), ylim=(0.0, None))
            axis.legend()
            style.panel_label(axis, text)
        return style.save(fig, out, "wall-force")


def draw_peak_force(out: Path) -> list[Path]:
    """``wall-peak-force``: f over κ/ν for five ζ, with its limits."""
    ratios, limit = np.geomspace(0.02, 10.0, 21), sharp_limit()
    with style.figure(1, 1, width=style.COLUMN, height=2.9) as (fig, axis):
        for damping, colour in zip((*DAMPINGS, 2.0), style.SEQUENCE):
            values = [peak_force(ratio, damping).value for ratio in ratios]
            axis.loglog(ratios, values, color=colour, lw=1.0, label=rf"$\zeta={damping:g}$")
            flat = ratios[ratios < 0.3]
            axis.loglog(flat, flat_limit(damping)[0] / np.sqrt(flat), color=colour, lw=0.8, ls=":")
        sharp = ratios[ratios > 1.0]
        in_limit = sharp**-0.125 * (limit.value + limit.correction / sharp)
        axis.loglog(sharp, in_limit, color="black", lw=0.8, ls="--", label=r"$\kappa/\nu\to\infty,\ \zeta=0$")
        axis.plot([], [], color="black", lw=0.8, ls=":", label=r"$\kappa/\nu\to0$")
        axis.set(xlabel=r"$\kappa/\nu$  (1)", ylabel=rf"$F_{{\max}}/{UNIT}$  (1)")
        axis.set_xticks([0.02, 0.1, 0.5, 2.0, 10.0], labels=["0.02", "0.1", "0.5", "2", "10"])
        axis.set_yticks([1.0, 2.0, 5.0, 10.0, 20.0], labels=["1", "2", "5", "10", "20"])
        axis.tick_params(which="minor", labelleft=False, labelbottom=False)
        axis.legend(ncols=2)
        return style.save(fig, out, "wall-peak-force")


def draw_return(out: Path) -> list[Path]:
    """``wall-return``: (a) what the zone is longer by than on a rigid wall, (b) the impulse over the rigid wall's."""
    end = 100.0
    with style.figure(1, 2, width=style.PAGE, height=2.7) as (fig, (left, right)):
        cases = ((0.2, 1.0), (0.5, 1.0), (0.5, 0.25), (0.5, 0.0), (2.0, 0.0))
        for (ratio, damping), colour in zip(cases, style.SEQUENCE):
            found, rigid = wall_history(ratio, damping, end=end, cells=120, steps=1000), contact_parameters(ratio)
            time, label = found.time[1:], rf"$\kappa/\nu={ratio:g},\ \zeta={damping:g}$"
            impulse = found.impulse[1:] / (4.0 * np.sqrt(2.0 * time / np.pi) * rigid.r0)
            right.semilogx(time, impulse, color=colour, lw=1.0, label=label)
            if damping > 0.0:
                longer = found.half_contact_length[1:] - rigid.lambda0 * np.sqrt(time)
                left.semilogx(time, longer, color=colour, lw=1.0, label=label)
        left.axhline(zone_offset(0.5), color="black", lw=0.8, ls="--", label=r"$(4EI/k)^{1/4}=\sqrt{2}\,\ell_k$")
        right.axhline(1.0, color="black", lw=0.8, ls="--", label="rigid wall")
        shared = {"xlabel": TIME, "xlim": (0.5, end)}
        left.set(ylabel=r"$(x_c-\lambda_0\sqrt{ct})/\ell_k$  (1)", ylim=(0.0, 2.0), **shared)
        right.set(ylabel="impulse over the rigid wall's  (1)", ylim=(0.0, 2.4), **shared)
        left.legend(loc="lower right")
        right.legend(loc="upper right", ncols=2)
        style.label_panels(left, right)
        return style.save(fig, out, "wall-return")


if __name__ == "__main__":
    folder = Path("docs/figures")
    for draw in (draw_force, draw_peak_force, draw_return):
        print(*draw(folder))
