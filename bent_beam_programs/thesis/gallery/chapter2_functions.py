"""Chapter 2: Duffing's oscillator (2.2), the kernel (2.3), the functions φ and the solutions over κ/ν."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from bent_beam_programs.thesis.gallery.drawing import GUIDE, NIL, plain_line
from bent_beam_programs.thesis.sheet import Sheet, item, items
from comparison.figures import style
from comparison.readable import readable
from theory import contact_parameters, kernel, phi, worked_examples

DUFFING = 0.2
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)))
IN_TURN: list[dict[str, Any]] = [{"color": colour, "ls": dashes} for colour, dashes in zip(style.SEQUENCE, DASHES)]
PUSHED = ((4.0, 0.0, 0.0), (2.0, 0.0, 0.0), (1.0, 1.0, 0.0), (1.0, 1.0, 1.0), (0.0, 2.0, 0.0))
PULLED = ((-1.0, -1.0, 0.0), (-1.0, -1.0, 1.0), (-2.0, 0.0, 0.0), (0.0, -2.0, 0.0), (-4.0, 0.0, 0.0))
Load = tuple[float, float, float]
SMALLEST = 0.03  # κ/ν, where r₁ and λ₁ are drawn from
LINES = (plain_line("blue", width=1.1), plain_line("vermilion", "--"), plain_line("black", "-.", 1.1))
OF_LAMBDA = {"xlabel": r"$\lambda$  (1)", "ylabel": r"$\varphi$  (1)"}


@item("fig-2.2")
def duffing(sheet: Sheet) -> None:
    """Duffing's oscillator: two expansions

    Duffing's oscillator (2.2.4) by direct integration, by regular expansion (2.2.8) and by multiple scales (2.2.13),
    ε = 0.2 (the thesis does not print its value). The error of the regular expansion grows with t.
    """
    times = np.linspace(0.0, 60.0, 1201)
    exact = worked_examples.duffing_numerical(times, DUFFING)
    with sheet.figure(width=style.PAGE, height=2.3) as (_, axis):
        axis.set(xlabel="$t$  (1)", ylabel="$y$  (1)", xlim=(0, 60))
        sheet.line(axis, times, exact, series="numerical", **style.THEORY)
        for name, expansion, line in (
            ("regular expansion", worked_examples.duffing_regular, plain_line("vermilion", "--")),
            ("multiple scales", worked_examples.duffing_multiple_scales, plain_line("blue", "-.", 0.9)),
        ):
            found = expansion(times, DUFFING)
            sheet.line(axis, times, found, series=name, **line)
            sheet.numbers[f"largest error of the {name}"] = float(np.abs(found - exact).max())
        axis.legend(ncols=3, loc="lower left", bbox_to_anchor=(0.0, 1.0))


def plot(sheet: Sheet, x: Any, curves: Mapping[str, Any], lines: Sequence[dict[str, Any]], **axes: Any) -> Axes:
    """Curves over x on one axis, returned; ``axes`` : its labels and limits."""
    axis: Axes
    with sheet.figure() as (_, axis):
        axis.set(**axes)
        for (series, y), line in zip(curves.items(), lines):
            sheet.line(axis, x, y, series=series, **line)
        if len(curves) > 1:
            axis.legend()
    return axis


@item("fig-2.3")
def kernel_shape(sheet: Sheet) -> None:
    """The kernel H

    Shape of the deflection under an impulse, H(β) with β = ξ/√τ (2.3.3). H(0) = 1; H and H′ tend to zero, so that the
    fast layer matches the slow motion.
    """
    beta = np.linspace(-10.0, 10.0, 801)
    label = r"$\beta = \xi/\sqrt{\tau}$  (1)"
    axis = plot(sheet, beta, {"H": kernel.H(beta)}, (style.THEORY,), xlabel=label, ylabel=r"$H$  (1)", xlim=(-10, 10))
    axis.axhline(0.0, **NIL)


@item("fig-2.7a")
def ratio(sheet: Sheet) -> None:
    """φ_ν, φ_κ and their ratio

    Functions φ_ν (2.6.18), φ_κ (2.6.20) and their ratio over λ: the contact length is where the ratio is κ/ν. At λ = 0
    all three are 1: the contact is discrete for κ/ν ≥ 1.
    """
    lam = np.linspace(0.0, 6.0, 301)
    nu, kappa = np.asarray(phi.phi_nu(lam)), np.asarray(phi.phi_kappa(lam))
    curves = {r"$\varphi_\nu$": nu, r"$\varphi_\kappa$": kappa, r"$\varphi_\kappa/\varphi_\nu$": kappa / nu}
    plot(sheet, lam, curves, LINES, **OF_LAMBDA, xlim=(0, 6), ylim=(0, 1.02))


@item("fig-2.7b")
def leading_solution(sheet: Sheet) -> None:
    """λ₀ and r₀/ν over κ/ν

    Contact length λ₀ (2.6.21) and reaction r₀/ν (2.6.22) of the leading order over κ/ν. Left of κ/ν = 1 the contact
    spreads, right of it only the middle touches, with r₀ = ν.
    """
    ratios = np.unique(np.concatenate([np.linspace(0.02, 1.5, 400), [0.1, 0.5, 0.8, 1.0]]))
    found = contact_parameters(ratios)
    curves = {r"$\lambda_0$": found.lambda0, r"$r_0/\nu$": found.r0}
    labels = {"xlabel": r"$\kappa/\nu$  (1)", "ylabel": r"$\lambda_0$,  $r_0/\nu$  (1)"}
    plot(sheet, ratios, curves, LINES, **labels, xlim=(0, 1.5), ylim=(0, 6)).axvline(1.0, **GUIDE)


def functions(sheet: Sheet, shown: Mapping[str, str], largest: float = 6.0) -> None:
    """Functions φ over λ. shown : name → index in mathtext."""
    lam = np.linspace(0.0, largest, 301)
    curves = {rf"$\varphi_{{{index}}}$": getattr(phi, f"phi_{name}")(lam) for name, index in shown.items()}
    plot(sheet, lam, curves, IN_TURN, **OF_LAMBDA, xlim=(0, largest))


items(__name__, functions, (
    ("fig-2.10", "φ_p, φ_α, φ_λ",
     "Functions φ_p (2.7.17), φ_α and φ_λ (2.7.23): deflection at the middle by the uniform reaction, r₁ and λ₁.",
     {"p": "p", "alpha": r"\alpha", "lambda": r"\lambda"}),
    ("fig-2.11", "φ_ṗ, φ_κ̇, φ_λ̇",
     "Functions φ_ṗ (2.7.34), φ_κ̇ and φ_λ̇ (2.7.38): curvature at the middle by the uniform reaction, r₁ and λ₁.",
     {"pdot": r"\dot{p}", "kappadot": r"\dot{\kappa}", "lambdadot": r"\dot{\lambda}"}),
    ("fig-2.15", "φ_r, φ_q, φ_s, φ_t",
     "Functions φ_r, φ_q (2.7.53) and φ_s, φ_t (2.7.68): deflection and slope at ξ = λ_c by λ₁ and r₁.",
     {"r": "r", "q": "q", "s": "s", "t": "t"}, 8.0),
))  # fmt: skip


def solution(
    sheet: Sheet, name: str, loads: tuple[Load, ...], limits: tuple[float, float], at: float, load: Load
) -> None:
    """r₁ or λ₁ over κ/ν for several (α, ψ, χ); the number beside it is that of ``load`` at κ/ν = ``at``."""
    symbol, short = {"r1": ("$r_1$", "r₁"), "lambda1": (r"$\lambda_1$", "λ₁")}[name]
    words = {one: ", ".join(map(readable, one)) for one in loads}
    ratios = np.unique([*np.geomspace(SMALLEST, 0.2, 100), *np.linspace(0.2, 1.2, 400), 0.3, 0.5, 0.8, 1.0])
    with sheet.figure(width=4.2, height=2.9) as (_, axis):
        axis.set(xlabel=r"$\kappa/\nu$  (1)", ylabel=f"{symbol}  (1)", ylim=limits)
        for one, line in zip(loads, IN_TURN):
            values = np.array(getattr(contact_parameters(ratios, *one), name), float)
            if name == "lambda1":
                values[ratios == 1.0] = np.nan  # it jumps to 0 there: no line across
            sheet.line(axis, ratios, values, series=words[one], **line)
        axis.axvline(1.0, **GUIDE)
        axis.axhline(0.0, **NIL)
        axis.set_xlim(SMALLEST, 1.2)
        axis.legend(title=r"$\alpha$, $\psi$, $\chi$", loc="center left", bbox_to_anchor=(1.0, 0.5))
    sheet.numbers[f"{short} for ({words[load]}) at κ/ν = {at:g}"] = float(getattr(contact_parameters(at, *load), name))


SETS = "The sets (α, ψ, χ) of the thesis's legend are not in its text; these include all that its text names"
items(__name__, solution, (
    ("fig-2.12a", "r₁ for α + ψ > 0",
     "First-order reaction r₁ over κ/ν, continuous contact (2.7.40); 2α in the discrete regime. "
     f"{SETS}. r₁ of (0, 2, 0) is negative, as the thesis notes.",
     "r1", PUSHED, (-6.0, 14.0), 0.5, (0.0, 2.0, 0.0)),
    ("fig-2.12b", "λ₁ for α + ψ > 0",
     "First-order contact length λ₁ over κ/ν, continuous contact (2.7.40); 0 in the discrete regime. "
     f"{SETS} (it prints 5.665 for (4, 0, 0) at κ/ν = 0.5).",
     "lambda1", PUSHED, (-1.0, 12.0), 0.5, (4.0, 0.0, 0.0)),
    ("fig-2.16a", "r₁ for α + ψ < 0",
     "First-order reaction r₁ over κ/ν, detached contact (2.7.71); 2α in the discrete regime. "
     f"{SETS}. r₁ of (−1, −1, 1) is positive at κ/ν = 0.3, as the thesis notes.",
     "r1", PULLED, (-24.0, 12.0), 0.3, (-1.0, -1.0, 1.0)),
    ("fig-2.16b", "λ₁ for α + ψ < 0",
     "First-order contact length λ₁ over κ/ν, detached contact (2.7.71); 0 in the discrete regime. "
     f"{SETS} (it prints −1.7729 for (−1, −1, 0) at κ/ν = 0.5).",
     "lambda1", PULLED, (-10.0, 8.0), 0.5, (-1.0, -1.0, 0.0)),
))  # fmt: skip
