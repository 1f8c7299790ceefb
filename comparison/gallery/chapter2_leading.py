"""Chapter 2, section 2.6: the leading order."""

from __future__ import annotations

import numpy as np

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY, beam_panel, dashed, key_below
from theory import ImpactFields, contact_parameters, phi

TIMES = (0.1, 0.25, 0.5)


@item(
    "fig-2.7a",
    "φ_ν, φ_κ and their ratio",
    group="theory",
    caption=(
        "Functions φ_ν (2.6.18), φ_κ (2.6.20) and their ratio over λ: the contact length is where the ratio is κ/ν."
    ),
)
def functions(sheet: Sheet) -> str:
    lam = np.linspace(0.0, 6.0, 301)
    nu, kappa = np.asarray(phi.phi_nu(lam)), np.asarray(phi.phi_kappa(lam))
    with sheet.figure() as (_, axis):
        axis.set_xlabel(r"$\lambda$  (1)")
        axis.set_ylabel(r"$\varphi$  (1)")
        sheet.line(axis, lam, nu, series=r"$\varphi_\nu$", color=style.COLOURS["blue"], ls="-")
        sheet.line(axis, lam, kappa, series=r"$\varphi_\kappa$", **dashed("vermilion"))
        sheet.line(axis, lam, kappa / nu, series=r"$\varphi_\kappa/\varphi_\nu$", color="black", ls="-.")
        axis.set_xlim(0, 6)
        axis.set_ylim(0, 1.02)
        axis.legend()
    return "At λ = 0 all three are 1: the contact is discrete for κ/ν ≥ 1."


@item(
    "fig-2.7b",
    "λ₀ and r₀/ν over κ/ν",
    group="theory",
    caption="Contact length λ₀ (2.6.21) and reaction r₀/ν (2.6.22) of the leading order over κ/ν.",
)
def solutions(sheet: Sheet) -> str:
    ratio = np.unique(np.concatenate([np.linspace(0.02, 1.5, 400), [0.1, 0.5, 0.8, 1.0]]))
    found = contact_parameters(ratio)
    with sheet.figure() as (_, axis):
        axis.set_xlabel(r"$\kappa/\nu$  (1)")
        axis.set_ylabel(r"$\lambda_0$,  $r_0/\nu$  (1)")
        sheet.line(axis, ratio, found.lambda0, series=r"$\lambda_0$", color=style.COLOURS["blue"], ls="-")
        sheet.line(axis, ratio, found.r0, series=r"$r_0/\nu$", **dashed("vermilion"))
        axis.axvline(1.0, color=style.COLOURS["grey"], lw=0.6, ls=":")
        axis.set_xlim(0, 1.5)
        axis.set_ylim(0, 6)
        axis.legend()
    return "Left of κ/ν = 1 the contact spreads, right of it only the middle touches, with r₀ = ν."


@item(
    "fig-2.8",
    "No penetration over the contact zone, leading order",
    group="theory",
    caption=(
        "Free motion (2.6.31) and fast layer (2.6.32) at ξ = aλ₀√τ, ν = 1: where they agree, the beam lies on the wall."
    ),
)
def complementarity(sheet: Sheet) -> str:
    worst = 0.0
    with sheet.figure(2, 2, width=style.PAGE, height=4.6) as (fig, axes):
        for axis, letter, (kappa, tau) in zip(axes.flat, "abcd", ((0.5, 0.1), (0.5, 0.5), (0.8, 0.1), (0.8, 0.5))):
            fields = ImpactFields(contact_parameters(kappa))
            a = np.linspace(-1.5, 1.5, 121)
            xi = a * float(fields.half_contact_length(tau))
            free, fast = fields.slow_motion(xi, tau).deflection, fields.fast_layer(xi, tau).deflection
            worst = max(worst, float(np.abs(free - fast)[np.abs(a) <= 1.0].max()))
            axis.set_xlabel("$a$  (1)")
            axis.set_ylabel(r"$\eta_0$  (1)")
            sheet.line(axis, a, free, series="free motion", color=style.COLOURS["grey"], ls="--", lw=1.4)
            sheet.line(axis, a, fast, series="fast layer", **THEORY)
            for edge in (-1.0, 1.0):
                axis.axvline(edge, color=style.COLOURS["vermilion"], lw=0.6, ls=":")
            sheet.panel(axis, letter, text=rf"$\kappa = {kappa}$, $\tau = {tau}$")
        key_below(fig, axes[0, 0])
    return (
        f"Within |a| ≤ 1 the two differ by at most {worst:.0e}. (2.6.25–26) of the thesis lack the factor r₀/π "
        "that (2.6.29) has; with it they agree."
    )


@item(
    "fig-2.9",
    "A beam against the wall, leading order",
    group="theory",
    caption=("Leading order with ν = 1: κ = 0.5, contact spreads (left); κ = 2, contact stays at the middle (right)."),
)
def impact(sheet: Sheet) -> str:
    with sheet.figure(3, 2, width=style.PAGE, height=6.4) as (fig, axes):
        for row, tau in enumerate(TIMES):
            for column, kappa in enumerate((0.5, 2.0)):
                axis = axes[row, column]
                fields = ImpactFields(contact_parameters(kappa))
                beam_panel(sheet, axis, fields, tau, limits=(-0.6 if column == 0 else -1.6, 0.65))
                sheet.panel(axis, "abcdef"[2 * row + column], text=rf"$\kappa = {kappa}$, $\tau = {tau}$")
        key_below(fig, axes[0, 0], 4)
    return "The wall is grey; triangles are the contact points ±λ₀√τ, λ₀(0.5) = 1.0189 and λ₀(2) = 0."
