"""Chapter 2, section 2.7.1: first order, continuous contact (α + ψ > 0)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY, beam_panel, key_below
from comparison.studies.sentences import signed
from theory import ImpactFields, contact_parameters, phi

EPSILON = 0.1
PUSHED = ((4.0, 0.0, 0.0), (2.0, 0.0, 0.0), (1.0, 1.0, 0.0), (1.0, 1.0, 1.0), (0.0, 2.0, 0.0))


def functions_of(sheet: Sheet, names: Sequence[tuple[str, str]], largest: float = 6.0) -> None:
    """φ functions over λ."""
    lam = np.linspace(0.0, largest, 301)
    dashes = ("-", "--", "-.", ":")
    with sheet.figure() as (_, axis):
        axis.set_xlabel(r"$\lambda$  (1)")
        axis.set_ylabel(r"$\varphi$  (1)")
        for i, (name, symbol) in enumerate(names):
            values = np.asarray(getattr(phi, name)(lam))
            sheet.line(axis, lam, values, series=symbol, color=style.SEQUENCE[i], ls=dashes[i])
        axis.set_xlim(0, largest)
        axis.legend()


@item(
    "fig-2.10",
    "φ_p, φ_α, φ_λ",
    group="theory",
    caption=(
        "Functions φ_p (2.7.17), φ_α and φ_λ (2.7.23): deflection at the middle by the uniform reaction, r₁ and λ₁."
    ),
)
def deflection_functions(sheet: Sheet) -> None:
    functions_of(
        sheet, (("phi_p", r"$\varphi_p$"), ("phi_alpha", r"$\varphi_\alpha$"), ("phi_lambda", r"$\varphi_\lambda$"))
    )


@item(
    "fig-2.11",
    "φ_ṗ, φ_κ̇, φ_λ̇",
    group="theory",
    caption=(
        "Functions φ_ṗ (2.7.34), φ_κ̇ and φ_λ̇ (2.7.38): curvature at the middle by the uniform reaction, r₁ and λ₁."
    ),
)
def curvature_functions(sheet: Sheet) -> None:
    functions_of(
        sheet,
        (
            ("phi_pdot", r"$\varphi_{\dot{p}}$"),
            ("phi_kappadot", r"$\varphi_{\dot{\kappa}}$"),
            ("phi_lambdadot", r"$\varphi_{\dot{\lambda}}$"),
        ),
    )


def solution(
    sheet: Sheet,
    name: str,
    symbol: str,
    sets: Sequence[tuple[float, float, float]],
    limits: tuple[float, float],
    smallest: float = 0.08,
) -> None:
    """r₁ or λ₁ over κ/ν from ``smallest`` for several (α, ψ, χ)."""
    ratio = np.unique(np.concatenate([np.linspace(smallest, 1.2, 400), [0.3, 0.5, 0.8, 1.0]]))
    dashes = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))
    with sheet.figure(width=4.2, height=2.9) as (_, axis):
        axis.set_xlabel(r"$\kappa/\nu$  (1)")
        axis.set_ylabel(f"{symbol}  (1)")
        for i, first in enumerate(sets):
            values = np.array(getattr(contact_parameters(ratio, *first), name), float)
            if name == "lambda1":
                values[ratio == 1.0] = np.nan  # it jumps to 0 there: no line across
            label = ", ".join(f"{v:g}" for v in first)
            sheet.line(axis, ratio, values, series=label, color=style.SEQUENCE[i], ls=dashes[i])
        axis.axhline(0.0, color=style.COLOURS["grey"], lw=0.5)
        axis.axvline(1.0, color=style.COLOURS["grey"], lw=0.6, ls=":")
        axis.set_xlim(0.0 if smallest < 0.1 else smallest, 1.2)
        axis.set_ylim(*limits)
        axis.legend(title=r"$\alpha$, $\psi$, $\chi$", loc="center left", bbox_to_anchor=(1.0, 0.5))


SETS = "The sets (α, ψ, χ) of the thesis's legend are not in its text; these include all that its text names."


@item(
    "fig-2.12a",
    "r₁ for α + ψ > 0",
    group="theory",
    caption="First-order reaction r₁ over κ/ν, continuous contact (2.7.40); 2α in the discrete regime.",
)
def pushed_reaction(sheet: Sheet) -> str:
    solution(sheet, "r1", "$r_1$", PUSHED, (-6.0, 14.0))
    found = contact_parameters(0.5, 0.0, 2.0, 0.0)
    return f"{SETS} r₁ = {found.r1:.4f} for (0, 2, 0) at κ/ν = 0.5: negative, as the thesis notes."


@item(
    "fig-2.12b",
    "λ₁ for α + ψ > 0",
    group="theory",
    caption="First-order contact length λ₁ over κ/ν, continuous contact (2.7.40); 0 in the discrete regime.",
)
def pushed_length(sheet: Sheet) -> str:
    solution(sheet, "lambda1", r"$\lambda_1$", PUSHED, (-1.0, 12.0))
    return f"{SETS} λ₁ = {contact_parameters(0.5, 4.0).lambda1:.4f} for (4, 0, 0) at κ/ν = 0.5 (thesis: 5.665)."


@item(
    "fig-2.13",
    "No penetration over the contact zone, first order",
    group="theory",
    caption=(
        "Free motion (2.7.41) as printed, truncated after the first order in ε, and fast layer (2.7.42) at ξ = "
        "aλ_c(τ); dotted, "
        "the free motion with λ_c² not truncated. ν = 1, χ = 0, ε = 0.1."
    ),
)
def complementarity(sheet: Sheet) -> str:
    left, right = (0.8, 0.0, 2.0), (0.5, 4.0, 0.0)
    worst: list[float] = []
    whole: list[float] = []
    with sheet.figure(2, 2, width=style.PAGE, height=4.6) as (fig, axes):
        for axis, letter, ((kappa, alpha, psi), tau) in zip(
            axes.flat, "abcd", ((left, 0.1), (right, 0.1), (left, 0.5), (right, 0.5))
        ):
            fields = ImpactFields(contact_parameters(kappa, alpha, psi), epsilon=EPSILON)
            a = np.linspace(-1.5, 1.5, 121)
            xi = a * float(fields.half_contact_length(tau))
            free, fast = fields.slow_motion(xi, tau).deflection, fields.fast_layer(xi, tau).deflection
            p, inside = fields.parameters, np.abs(a) <= 1.0
            # (2.7.41): of κξ²/2 with ξ = a√τ(λ₀ + ελ₁τ) it keeps the terms up to ε
            dropped = 0.5 * kappa * (EPSILON * a * p.lambda1 * tau) ** 2 * tau
            quartic = EPSILON * psi * ((xi**4) - (a * p.lambda0 * np.sqrt(tau)) ** 4) / 24.0
            printed = free + dropped - quartic
            worst.append(float((fast - printed)[-1 - np.argmax(inside[::-1])]))
            whole.append(float(np.abs(free - fast)[inside].max()))
            axis.set_xlabel("$a$  (1)")
            axis.set_ylabel(r"$\eta$  (1)")
            sheet.line(axis, a, printed, series="free motion (2.7.41)", color=style.COLOURS["grey"], ls="--", lw=1.4)
            sheet.line(axis, a, free, series="not truncated", color=style.COLOURS["purple"], ls=":", lw=1.2)
            sheet.line(axis, a, fast, series="fast layer", **THEORY)
            for edge in (-1.0, 1.0):
                axis.axvline(edge, color=style.COLOURS["vermilion"], lw=0.6, ls=":")
            sheet.panel(
                axis, letter, text=rf"$\kappa = {kappa}$, $\alpha = {alpha:g}$, $\psi = {psi:g}$, $\tau = {tau}$"
            )
        key_below(fig, axes[0, 0], 3)
    listed = ", ".join(f"{signed(round(v, 4))} ({letter})" for v, letter in zip(worst, "abcd"))
    return (
        f"Fast layer less free motion as printed at a = 1: {listed}; not truncated the two differ by up to "
        f"{', '.join(f'{v:.4f}' for v in whole)} within |a| ≤ 1. In (d) ελ₁τ is a quarter of λ₀ and more: the "
        "expansion, not "
        "the solution, ends there, as the thesis says."
    )


@item(
    "fig-2.14",
    "A beam against the wall, first order",
    group="theory",
    caption="First order with ν = 1, α = ψ = 1, χ = 0, ε = 0.1: κ = 0.5 (left) and κ = 2 (right).",
)
def impact(sheet: Sheet) -> str:
    with sheet.figure(3, 2, width=style.PAGE, height=6.4) as (fig, axes):
        for row, tau in enumerate((0.1, 0.25, 0.35)):
            for column, kappa in enumerate((0.5, 2.0)):
                axis = axes[row, column]
                fields = ImpactFields(contact_parameters(kappa, 1.0, 1.0), epsilon=EPSILON)
                beam_panel(sheet, axis, fields, tau, limits=(-0.6 if column == 0 else -1.6, 0.5))
                sheet.panel(axis, "abcdef"[2 * row + column], text=rf"$\kappa = {kappa}$, $\tau = {tau}$")
        key_below(fig, axes[0, 0], 4)
    found = contact_parameters(0.5, 1.0, 1.0)
    return (
        f"For κ = 0.5, λ₁ = {found.lambda1:.4f} and r₁ = {found.r1:.4f}; the zone carries the uniform reaction "
        "ε(α + ψ) = 0.2."
    )
