"""Chapter 2, section 2.7.2: first order, the middle lifts off (α + ψ < 0)."""

from __future__ import annotations

import numpy as np

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.chapter2_first_order import EPSILON, SETS, functions_of, solution
from comparison.gallery.drawing import beam_panel, key_below
from theory import ImpactFields, contact_parameters

PULLED = ((-1.0, -1.0, 0.0), (-1.0, -1.0, 1.0), (-2.0, 0.0, 0.0), (0.0, -2.0, 0.0), (-4.0, 0.0, 0.0))


@item(
    "fig-2.15",
    "φ_r, φ_q, φ_s, φ_t",
    group="theory",
    caption="Functions φ_r, φ_q (2.7.53) and φ_s, φ_t (2.7.68): deflection and slope at ξ = λ_c by λ₁ and r₁.",
)
def functions(sheet: Sheet) -> None:
    functions_of(
        sheet,
        (("phi_r", r"$\varphi_r$"), ("phi_q", r"$\varphi_q$"), ("phi_s", r"$\varphi_s$"), ("phi_t", r"$\varphi_t$")),
        largest=8.0,
    )


@item(
    "fig-2.16a",
    "r₁ for α + ψ < 0",
    group="theory",
    caption="First-order reaction r₁ over κ/ν, detached contact (2.7.71); 2α in the discrete regime.",
)
def pulled_reaction(sheet: Sheet) -> str:
    solution(sheet, "r1", "$r_1$", PULLED, (-24.0, 12.0), smallest=0.2)
    found = contact_parameters(0.3, -1.0, -1.0, 1.0)
    return (
        f"{SETS} r₁ = {found.r1:.4f} and λ₁ = {found.lambda1:.4f} for (−1, −1, 1) at κ/ν = 0.3: positive, as the "
        "thesis notes."
    )


@item(
    "fig-2.16b",
    "λ₁ for α + ψ < 0",
    group="theory",
    caption="First-order contact length λ₁ over κ/ν, detached contact (2.7.71); 0 in the discrete regime.",
)
def pulled_length(sheet: Sheet) -> str:
    solution(sheet, "lambda1", r"$\lambda_1$", PULLED, (-10.0, 8.0))
    return (
        f"{SETS} λ₁ = {contact_parameters(0.5, -1.0, -1.0).lambda1:.4f} for (−1, −1, 0) at κ/ν = 0.5 (thesis: −1.7729)."
    )


@item(
    "fig-2.17",
    "A beam against the wall, discrete and pulled back",
    group="theory",
    caption="First order with ν = 1, κ = 2, α = ψ = −1, χ = 0, ε = 0.1: only the middle touches.",
)
def discrete(sheet: Sheet) -> str:
    fields = ImpactFields(contact_parameters(2.0, -1.0, -1.0), epsilon=EPSILON)
    with sheet.figure(1, 3, width=style.PAGE, height=2.6) as (fig, axes):
        for axis, letter, tau, reach in zip(axes, "abc", (0.1, 0.25, 0.5), (1.5, 0.5, 1.5)):
            limits = (-1.6, 0.6) if reach > 1.0 else (-0.16, 0.06)
            beam_panel(sheet, axis, fields, tau, reach=reach, limits=limits, fast=reach > 1.0)
            sheet.panel(axis, letter, text=rf"$\tau = {tau}$" + (", zoom" if reach < 1.0 else ""))
        key_below(fig, axes[0], 4)
    return f"r₀ = 1, r₁ = 2α = {fields.parameters.r1:g}, λ₀ = λ₁ = 0."


@item(
    "fig-2.18",
    "A beam against the wall, the middle lifting off",
    group="theory",
    caption="First order with ν = 1, κ = 0.5, α = ψ = −1, χ = 0, ε = 0.1; zooms on the contact to the right.",
)
def lifting(sheet: Sheet) -> str:
    fields = ImpactFields(contact_parameters(0.5, -1.0, -1.0), epsilon=EPSILON)
    depths, lifts = [], []
    with sheet.figure(3, 2, width=style.PAGE, height=6.4) as (fig, axes):
        for row, tau in enumerate((0.1, 0.25, 0.5)):
            front = float(fields.half_contact_length(tau))
            beam = fields.beam(np.linspace(0.0, 1.6 * front, 161), tau).deflection
            depths.append(float(beam.max()))
            lifts.append(float(-fields.beam(0.0, tau).deflection))
            beam_panel(sheet, axes[row, 0], fields, tau, limits=(-0.6, 0.65))
            tall = 1.6 * max(lifts[-1], depths[-1])
            beam_panel(sheet, axes[row, 1], fields, tau, reach=1.5 * front, limits=(-tall, tall), fast=False)
            sheet.panel(axes[row, 0], "ace"[row], text=rf"$\tau = {tau}$")
            sheet.panel(axes[row, 1], "bdf"[row], text=rf"$\tau = {tau}$, zoom")
            axes[row, 1].set_ylabel(r"deflection $w$  ($10^{-3}$)")
            axes[row, 1].yaxis.set_major_formatter(lambda value, _: f"{1e3 * value:.3g}".replace("-", "−"))
        key_below(fig, axes[0, 0], 4)
    p = fields.parameters
    return (
        f"The middle is {lifts[0]:.1e}, {lifts[1]:.1e}, {lifts[2]:.1e} off the wall at the three times; what "
        f"enters it near ±λ_c, up to {depths[0]:.0e}, {depths[1]:.0e}, {depths[2]:.0e}, is the expansion's O(ε²). "
        f"λ₀ = {p.lambda0:.4f} (the thesis's text prints 1.1089 once, and 1.0189), λ₁ = {p.lambda1:.4f}; the "
        "thesis compares |λ₁|τ√τ with λ₀√τ and leaves out ε = 0.1: the correction is "
        f"{100 * 0.1 * abs(p.lambda1) * 0.5 / p.lambda0:.0f} % at τ = 0.5."
    )
