"""Chapter 2, sections 2.2 and 2.3: Duffing's oscillator and the kernel."""

from __future__ import annotations

import numpy as np

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY, dashed
from theory import kernel, worked_examples

DUFFING = 0.2


@item(
    "fig-2.2",
    "Duffing's oscillator: two expansions",
    group="theory",
    caption=(
        "Duffing's oscillator (2.2.4) by direct integration, by regular expansion (2.2.8) and by multiple "
        "scales (2.2.13)."
    ),
)
def duffing(sheet: Sheet) -> str:
    times = np.linspace(0.0, 60.0, 1201)
    exact = worked_examples.duffing_numerical(times, DUFFING)
    regular = worked_examples.duffing_regular(times, DUFFING)
    scales = worked_examples.duffing_multiple_scales(times, DUFFING)
    with sheet.figure(width=style.PAGE, height=2.3) as (_, axis):
        axis.set_xlabel("$t$  (1)")
        axis.set_ylabel("$y$  (1)")
        sheet.line(axis, times, exact, series="numerical", **THEORY)
        sheet.line(axis, times, regular, series="regular expansion", **dashed("vermilion"))
        sheet.line(axis, times, scales, series="multiple scales", color=style.COLOURS["blue"], lw=0.9, ls="-.")
        axis.set_xlim(0, 60)
        axis.legend(ncols=3, loc="lower left", bbox_to_anchor=(0.0, 1.0))
    worst = [float(np.abs(y - exact).max()) for y in (regular, scales)]
    return (
        f"ε = {DUFFING:g} (the thesis does not print its value). Over 0 ≤ t ≤ 60 the regular expansion is off by up to "
        f"{worst[0]:.2g}, growing with t; multiple scales by up to {worst[1]:.2g}."
    )


@item(
    "fig-2.3",
    "The kernel H",
    group="theory",
    caption="Shape of the deflection under an impulse, H(β) with β = ξ/√τ (2.3.3).",
)
def kernel_shape(sheet: Sheet) -> str:
    beta = np.linspace(-10.0, 10.0, 801)
    with sheet.figure() as (_, axis):
        axis.set_xlabel(r"$\beta = \xi/\sqrt{\tau}$  (1)")
        axis.set_ylabel(r"$H$  (1)")
        sheet.line(axis, beta, np.asarray(kernel.H(beta)), series="H", **THEORY)
        axis.axhline(0.0, color=style.COLOURS["grey"], lw=0.5)
        axis.set_xlim(-10, 10)
    return "H(0) = 1; H and H′ tend to zero, which lets the fast layer match the slow motion."
