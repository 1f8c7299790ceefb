"""Chapter 2: the beam against the wall at leading order (2.6) and at first order, continuous (2.7.1) and detached
(2.7.2)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from bent_beam_programs.thesis.gallery.drawing import beam_panel, plain_line
from bent_beam_programs.thesis.sheet import Sheet, item, items
from comparison.figures import style
from comparison.readable import readable
from theory import ImpactFields, contact_parameters

EPSILON = 0.1
REGULAR, WHOLE = plain_line("grey", "--", 1.4), plain_line("purple", ":", 1.2)
PLACES = np.linspace(-1.5, 1.5, 121)  # a = ξ/λ_c of the figures of the contact zone


def zone_panel(axis: Axes, symbol: str) -> None:
    """Axis over a, the contact points dotted."""
    axis.set(xlabel="$a$  (1)", ylabel=f"{symbol}  (1)")
    for edge in (-1.0, 1.0):
        axis.axvline(edge, color=style.COLOURS["vermilion"], lw=0.6, ls=":")
    axis.yaxis.set_major_formatter(lambda value, _: readable(value, 3))


@item("fig-2.8")
def leading_zone(sheet: Sheet) -> None:
    """No penetration over the contact zone, leading order

    Free motion (2.6.31) and fast layer (2.6.32) at ξ = aλ₀√τ, ν = 1, and their difference (below): where they agree,
    the beam lies on the wall. (2.6.25–26) of the thesis lack the factor r₀/π that (2.6.29) has; with it they agree.
    """
    shown = ((0.5, 0.1), (0.5, 0.5), (0.8, 0.1), (0.8, 0.5))
    texts = [rf"$\kappa = {kappa}$, $\tau = {tau}$" for kappa, tau in shown]
    worst = []
    with sheet.figure(4, 2, height=6.8, texts=[*texts[:2], "", "", *texts[2:]], legend=3) as (_, axes):
        for axis, below, (kappa, tau) in zip(axes[0::2].flat, axes[1::2].flat, shown):
            fields = ImpactFields(contact_parameters(kappa))
            xi = PLACES * float(fields.half_contact_length(tau))
            free, fast = fields.slow_motion(xi, tau).deflection, fields.fast_layer(xi, tau).deflection
            worst.append(float(np.abs(free - fast)[np.abs(PLACES) <= 1.0].max()))
            zone_panel(axis, r"$\eta_0$")
            sheet.line(axis, PLACES, free, series="free motion", **REGULAR)
            sheet.line(axis, PLACES, fast, series="fast layer", **style.THEORY)
            zone_panel(below, r"free $-$ fast")
            sheet.line(below, PLACES, free - fast, series="free motion less fast layer", **style.THEORY)
    sheet.numbers["largest difference within |a| ≤ 1"] = max(worst)


@item("fig-2.13")
def first_order_zone(sheet: Sheet) -> None:
    """No penetration over the contact zone, first order

    Free motion (2.7.41) as printed, truncated after the first order in ε, and fast layer (2.7.42) at ξ = aλ_c(τ);
    dotted, the free motion with λ_c² not truncated; below each, their differences from the fast layer. ν = 1, χ = 0,
    ε = 0.1. In (f) ελ₁τ is a quarter of λ₀ and more: the expansion, not the solution, ends there, as the thesis says.
    """
    shown = [(*load, tau) for tau in (0.1, 0.5) for load in ((0.8, 0.0, 2.0), (0.5, 4.0, 0.0))]
    inside = np.abs(PLACES) <= 1.0
    texts = [rf"$\kappa = {k}$, $\alpha = {a:g}$, $\psi = {p:g}$, $\tau = {t}$" for k, a, p, t in shown]
    with sheet.figure(4, 2, height=6.8, texts=[*texts[:2], "", "", *texts[2:]], legend=3) as (_, axes):
        for axis, below, letter, (kappa, alpha, psi, tau) in zip(axes[0::2].flat, axes[1::2].flat, "abef", shown):
            fields = ImpactFields(contact_parameters(kappa, alpha, psi), epsilon=EPSILON)
            p, xi = fields.parameters, PLACES * float(fields.half_contact_length(tau))
            free, fast = fields.slow_motion(xi, tau).deflection, fields.fast_layer(xi, tau).deflection
            # (2.7.41): of κξ²/2 with ξ = a√τ(λ₀ + ελ₁τ) it keeps the terms up to ε
            dropped = 0.5 * kappa * (EPSILON * PLACES * p.lambda1 * tau) ** 2 * tau
            quartic = EPSILON * psi * (xi**4 - (PLACES * p.lambda0 * np.sqrt(tau)) ** 4) / 24.0
            printed = free + dropped - quartic
            zone_panel(axis, r"$\eta$")
            sheet.line(axis, PLACES, printed, series="free motion (2.7.41)", **REGULAR)
            sheet.line(axis, PLACES, free, series="not truncated", **WHOLE)
            sheet.line(axis, PLACES, fast, series="fast layer", **style.THEORY)
            zone_panel(below, r"free $-$ fast")
            below.set(xlim=(-1.1, 1.1))
            kept = np.abs(PLACES) <= 1.1
            for series, off, line in (("(2.7.41)", printed - fast, REGULAR), ("not truncated", free - fast, WHOLE)):
                sheet.line(below, PLACES[kept], off[kept], series=f"{series} less fast layer", **line)
            sheet.numbers |= {
                f"({letter}) fast layer less printed free motion at a = 1": float((fast - printed)[inside][-1]),
                f"({letter}) largest difference, not truncated": float(np.abs(free - fast)[inside].max()),
            }


def two_columns(sheet: Sheet, times: Sequence[float], high: float, load: tuple[float, ...] = ()) -> None:
    """The beam at several times for κ = 0.5 (left) and κ = 2 (right); λ₁ and r₁ where there is a load."""
    shown = [(tau, kappa, low) for tau in times for kappa, low in ((0.5, -0.6), (2.0, -1.6))]
    texts = [rf"$\kappa = {kappa}$, $\tau = {tau}$" for tau, kappa, _ in shown]
    with sheet.figure(3, 2, height=6.4, texts=texts, legend=4) as (_, axes):
        for axis, (tau, kappa, low) in zip(axes.flat, shown):
            fields = ImpactFields(contact_parameters(kappa, *load), epsilon=EPSILON if load else 0.0)
            beam_panel(sheet, axis, fields, tau, (low, high))
    if load:
        found = contact_parameters(0.5, *load)
        sheet.numbers |= {"λ₁ for κ = 0.5": float(found.lambda1), "r₁ for κ = 0.5": float(found.r1)}


items(__name__, two_columns, (
    ("fig-2.9", "A beam against the wall, leading order",
     "Leading order with ν = 1: κ = 0.5, contact spreads (left); κ = 2, contact stays at the middle (right). The wall "
     "is grey; triangles are the contact points ±λ₀√τ, λ₀(0.5) = 1.0189 and λ₀(2) = 0.",
     (0.1, 0.25, 0.5), 0.65),
    ("fig-2.14", "A beam against the wall, first order",
     "First order with ν = 1, α = ψ = 1, χ = 0, ε = 0.1: κ = 0.5 (left) and κ = 2 (right). For κ = 0.5 the zone "
     "carries the uniform reaction ε(α + ψ) = 0.2.",
     (0.1, 0.25, 0.35), 0.5, (1.0, 1.0)),
))  # fmt: skip


@item("fig-2.17")
def discrete(sheet: Sheet) -> None:
    """A beam against the wall, discrete and pulled back

    First order with ν = 1, κ = 2, α = ψ = −1, χ = 0, ε = 0.1: only the middle touches. r₀ = 1, r₁ = 2α = −2, λ₀ = λ₁ =
    0.
    """
    fields = ImpactFields(contact_parameters(2.0, -1.0, -1.0), epsilon=EPSILON)
    texts = [r"$\tau = 0.1$", r"$\tau = 0.25$, zoom", r"$\tau = 0.5$"]
    with sheet.figure(1, 3, height=2.6, texts=texts, legend=4) as (_, axes):
        beam_panel(sheet, axes[0], fields, 0.1, (-1.6, 0.6))
        beam_panel(sheet, axes[1], fields, 0.25, (-0.16, 0.06), zoom=0.5)
        beam_panel(sheet, axes[2], fields, 0.5, (-1.6, 0.6))


@item("fig-2.18")
def lifting(sheet: Sheet) -> None:
    """A beam against the wall, the middle lifting off

    First order with ν = 1, κ = 0.5, α = ψ = −1, χ = 0, ε = 0.1; zooms on the contact to the right. The penetration near
    ±λ_c is the expansion's O(ε²). λ₀ = 1.0189 (the thesis's text prints 1.1089 once, and 1.0189). The thesis compares
    |λ₁|τ√τ, without ε, with λ₀√τ; its caption gives no ε, that of Fig. 2.14 has 0.1.
    """
    fields = ImpactFields(contact_parameters(0.5, -1.0, -1.0), epsilon=EPSILON)
    times = (0.1, 0.25, 0.5)
    texts = [rf"$\tau = {tau}${zoom}" for tau in times for zoom in ("", ", zoom")]
    with sheet.figure(3, 2, height=6.4, texts=texts, legend=4) as (_, axes):
        for (left, right), tau in zip(axes, times):
            front = float(fields.half_contact_length(tau))
            depth = float(fields.beam(np.linspace(0.0, 1.6 * front, 161), tau).deflection.max())
            lift = -float(fields.beam(0.0, tau).deflection)
            sheet.numbers |= {f"middle off the wall at τ = {tau}": lift, f"penetration at τ = {tau}": depth}
            beam_panel(sheet, left, fields, tau, (-0.6, 0.65))
            high = 1.6 * max(lift, depth)
            beam_panel(sheet, right, fields, tau, (-high, high), zoom=1.5 * front)
            right.set_ylabel(r"deflection $w$  ($10^{-3}$)")
            right.yaxis.set_major_formatter(lambda value, _: f"{1e3 * value:.3g}".replace("-", "−"))
    p = fields.parameters
    sheet.numbers |= {"λ₀": float(p.lambda0), "λ₁": float(p.lambda1)}
    sheet.numbers["ε|λ₁|τ/λ₀ at τ = 0.5"] = float(EPSILON * abs(p.lambda1) * 0.5 / p.lambda0)
