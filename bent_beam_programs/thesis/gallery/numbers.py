"""The table of printed numbers: every one that this project can compute, section by section, beside its own."""

import math
from collections.abc import Callable, Iterator

import numpy as np

from bent_beam_programs.thesis.gallery import chapter3_first_order as first
from bent_beam_programs.thesis.gallery.chapter3_contact_point import FLAT, run
from bent_beam_programs.thesis.gallery.chapter3_leading_order import CURVATURE, DURATION, ELEMENT, MIDDLE, first_impact
from bent_beam_programs.thesis.gallery.chapter3_parameters import ELEMENTS, SQUARE, count_of, table_nodes
from bent_beam_programs.thesis.gallery.runs import case, thesis
from bent_beam_programs.thesis.sheet import Sheet, item
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.first_order_case import FITTED, fitted, old_settings, predicted
from bent_beam_programs.thesis.studies.thesis import MASSES
from bent_beam_programs.thesis.verdicts import RULE, Printed, counts, summary
from comparison.readable import readable
from theory import contact_parameters


def on_runs(where: str, what: str, printed: str, measured: Callable[[str], float], how: str) -> Printed:
    """A number read off runs: ours with lumped masses, with the printed matrix beside it. measured : of a mass."""
    return Printed(where, what, printed, measured("lumped"), how, read=True, consistent=measured("consistent"))


def straight(measured: Callable[[str], float]) -> str:
    """The same of middles on straight lines between the nodes (3.3.5)."""
    lumped, consistent = (readable(measured(mass), 3) for mass in ("lumped", "consistent"))
    return f"middles of straight lines (3.3.5): {lumped}; with (3.1.8) {consistent}"


def lift(contact: str) -> Callable[[str], float]:
    """Lift of 3.3.5 with a mass, m."""
    return lambda mass: run(contact, mass).lift


def strain_energy(contact: str) -> Callable[[str], float]:
    """Strain energy of 3.3.5 with a mass, J."""
    return lambda mass: float(run(contact, mass).strain[-1])


def of_theory(name: str, *load: float) -> float:
    """A number of the theory at κ/ν = 0.5."""
    return float(getattr(contact_parameters(0.5, *load), name))


# fmt: off
def chapter2() -> Iterator[Printed]:
    lambda0, pushed, pulled = of_theory("lambda0"), of_theory("lambda1", 4.0), of_theory("lambda1", -1.0, -1.0)
    yield Printed("2.7.1", "λ₀ at κ/ν = 0.5", "1.019", lambda0)
    yield Printed("2.7.1", "λ₁ at κ/ν = 0.5 for (α, ψ, χ) = (4, 0, 0)", "5.665", pushed)
    for tau, leading, correction in ((0.1, "0.3222", "0.0179"), (0.5, "0.7205", "0.2003")):
        yield Printed("2.7.1", f"λ₀√τ at τ = {tau}", leading, math.sqrt(tau) * lambda0, "from the rounded 1.019",
                      rule=math.sqrt(tau) * 1.019)
        yield Printed("2.7.1", f"ελ₁τ√τ at τ = {tau}, ε = 0.1", correction, 0.1 * tau**1.5 * pushed)
    yield Printed("2.7.2, Fig. 2.18", "λ₀ at κ/ν = 0.5", "1.1089", lambda0, "digits: the same page prints 1.0189")
    yield Printed("2.7.2", "λ₁ at κ/ν = 0.5 for (−1, −1, 0)", "-1.7729", pulled)
    yield Printed("2.7.2", "|λ₁|τ√τ at τ = 0.5", "0.6268", -0.5**1.5 * pulled,
                  "compared there with λ₀√τ without ε, which is not given; with the 0.1 of Fig. 2.14 it is 9 % of λ₀√τ")


def scales() -> Iterator[Printed]:
    """Scales and beams of chapter 3."""
    flat, strong, plain = case(FLAT, 0.1).impact, first.impact(700.0), first.impact(0.0)
    yield Printed("3.1", "bd³/12 for b = d = 0.01 m, m⁴", "8.33e-10", 0.01**4 / 12.0)
    fits = "; EI = 4.67·10⁶ N m², five hundred times the printed one, fits this axis and that of Fig. 3.{}"
    yield Printed("Fig. 3.3", "end of the axis; largest deflection with the printed EI, m", "0.3",
                  5e5 * 125.0 / (48.0 * 9.345e3), "no number is printed" + fits.format(5), axes=True)
    yield Printed("Fig. 3.5", "end of the axis; largest deflection with the printed EI, m", "8",
                  8e5 * 125.0 / (3.0 * 9.345e3), "no number is printed" + fits.format(3), axes=True)
    yield Printed("3.3.1", "time of τ = 0.01 at V₀ = 20 m/s, s", "2.5e-5", 0.01 * flat.time_scale)
    yield Printed("3.4", "time of τ = 0.1 at V₀ = 20 m/s, s", "2.5e-4", 0.1 * flat.time_scale)
    yield Printed("3.3.3, 3.3.4", "κ/ν of K = 1/40 1/m", "1.3e-3", 1.0 / 40.0 / 20.0,
                  "K is not printed there; of Table 3.4 it is the one that fits")
    yield Printed("3.4", "ε for L = 50 m, V₀ = 20 m/s", "2e-3", (1.0 / (20.0 * 25.0)) ** 2,
                  "(3.4.1) is a square: 1/500 was left without it")
    yield Printed("3.5", "ε for L = 2 m, V₀ = 3.5 m/s", "0.0816", (1.0 / 3.5) ** 2)
    for tau, printed in ((0.1, "8e-3"), (0.05, "4e-3")):
        yield Printed("3.5", f"time of τ = {tau} at V₀ = 3.5 m/s, s", printed, tau * strong.time_scale)
    yield Printed("3.5, (3.5.8)", "ν/α for ντ = ετ²α/2, ε = τ = 0.1", "5e-3", 0.1 * 0.1 / 2.0)
    yield Printed("3.5, (3.5.8)", "a₀ = V₀/(5·10⁻³ s), m/s²", "700", 3.5 / 5e-3)
    for tau, acceleration, printed in ((0.05, 700.0, "5.8e-3"), (0.05, 17.0, "1.42e-4"), (0.5, 17.0, "1.42e-2")):
        yield Printed("3.5", f"½a₀t² at τ = {tau}, a₀ = {acceleration:g} m/s², m", printed,
                      0.5 * acceleration * (tau * strong.time_scale) ** 2)
    yield Printed("3.5, (3.5.7)", "a₀ for α = 4, ν = 0.1, V₀ = 3.5 m/s, m/s²", "17", 4.0 * 3.5 / 0.1,
                  "17 m/s² is εα = a₀t*/V₀ = 0.4, that is α = 4 with ε = 0.1 and ν = 1")
    yield Printed("3.5", "contact zone of both sides at τ = 0.05, m", "0.6",
                  2.0 * float(Exact(plain).front(0.05 * strong.time_scale)), "“of order”", read=True)
    whole, p = Exact(strong), Exact(strong).parameters
    share = float(whole.side_reaction(1e-4) / Exact(plain).side_reaction(1e-4)) - 1.0
    yield Printed("3.5, (3.5.10)", "first order over leading order of R at ±λ_c at 10⁻⁴ s, a₀ = 700 m/s²", "1e-4",
                  float(p.r1 * whole.tau(1e-4) / p.r0), "it assumes that r₁ and r₀ are of one order, though their "
                  "units differ by a time: t = 10⁻⁴ is left; with the uniform reaction beside it the whole side has "
                  f"{100.0 * share:.2g} %", rule=1e-4)


def meshes() -> Iterator[Printed]:
    """Section 3.3.2."""
    zone = "its uniform zone is not printed; 25 elements a side, twice the contact zone"
    for growth, count in ELEMENTS.items():
        yield Printed("Table 3.2", f"elements for e = {growth:g}", str(count), 2.0 * (table_nodes(growth).size - 1),
                      zone, read=True)
    yield Printed("3.3.2", "largest element for e = 1.25, m", "0.2994", float(np.diff(table_nodes(1.25))[-1]),
                  "does not fit its 120 elements: the last one must reach the end of the beam")
    yield Printed("3.3.2", "elements, κ/ν = 6.25·10⁻⁴, τ = 0.1", "1496", float(count_of(FLAT)), zone, read=True)
    yield Printed("3.3.2", "elements, κ/ν = 0.5, τ = 0.1, uniform zone", "96", float(count_of(10.0)), zone, read=True)
    yield Printed("3.3.2", 'elements, κ/ν = 0.5, τ = 0.1, "square" mesh', "4210",
                  float(count_of(10.0, square=True)), "x_i = λ₀√(ah)·√i over the contact zone (a = 5, "
                  "h = 2.5·10⁻⁸ s), growth 1.25 beyond, no cap on lengths", read=True)
    yield Printed("3.3.2", "elements, uniform, L = 5 m, Δx = 2.5·10⁻³ m", "2000", 2.0 * round(2.5 / 2.5e-3))
    yield on_runs("3.3.2, Fig. 3.14", "central node inside the wall, square mesh, m", "1.8e-4",
                  lambda mass: -float(thesis("", FLAT, 0.01, mesh=SQUARE, mass=MASSES[mass]).gap[0]), "middles")


def contacts() -> Iterator[Printed]:
    """Sections 3.3.1, 3.3.5, 3.4 and A.7."""
    def bent(contact: str) -> Callable[[str], float]:
        return lambda mass: float(thesis("", 1.0, 0.01, contact=contact, mass=MASSES[mass]).gap[0])

    yield on_runs("3.3.1, Fig. 3.7", "lift in the middle, K = 1 1/m, t = 2.5·10⁻⁵ s, m", "2e-4", bent("middle"),
                  straight(bent("straight")))
    for contact, name, high, strain, rough in (("node", "nodes", "1.7e-4", "3.8", "1.5e-4"),
                                               ("middle", "middles", "1.7e-3", "38", "1.5e-3")):
        lines = [straight(of("straight")) for of in (lift, strain_energy)] if contact == "middle" else ["", ""]
        yield on_runs("3.3.5", f"lift at 2.5·10⁻⁴ s, {name}, m", high, lift(contact), lines[0])
        yield on_runs("3.4", f"“numerical errors” at τ = 0.1, {name}, m", rough, lift(contact), "the same lift")
        yield on_runs("3.3.5", f"strain energy at 2.5·10⁻⁴ s, {name}, J", strain, strain_energy(contact), lines[1])
    rule = "the thesis joins nodes by straight lines (3.3.5), which gives {}; the shape functions (A.6) KΔx²/8"
    for where, curvature, name, element, depth, delay in (
        ("3.3.5, A.7", FLAT, "1/80", 2.5e-3, "1.45e-8", "7e-10"),
        ("A.7", 1.0, "1", 2.5e-3, "1.5e-6", "7.5e-8"),
        ("3.4", CURVATURE, "25", ELEMENT, "1.57e-2", "7.85e-4"),
    ):
        ours = curvature * element**2 / 8.0
        what, at = "before a middle closes", f"K = {name} 1/m, Δx = {element:g} m"
        found = Printed(where, f"penetration {what}, {at}, m", depth, ours, rule.format(f"{readable(2.0 * ours)} m"),
                        rule=2.0 * ours)
        yield found
        theirs = (float(depth) if found.verdict == RULE else 2.0 * ours) / 20.0
        yield Printed(where, f"time {what}, {at}, s", delay, ours / 20.0, rule.format(f"{readable(theirs)} s"),
                      rule=theirs)
    scale = case(CURVATURE, 0.1).impact.time_scale
    yield Printed("3.4", "the last time in τ", "0.3", MIDDLE / scale, "as above", rule=float("7.85e-4") / scale)


def discrete() -> Iterator[Printed]:
    """Section 3.4."""
    yield Printed("3.4", "height of the neighbour node, K = 25 1/m, Δx = 0.05 m, m", "0.0312", 25.0 * 0.05**2 / 2.0,
                  "cut off or rounded to the even digit")
    yield Printed("3.4, Fig. 3.32c", "the constraint closes in a run that ends at τ = 0.01, s", "5e-5",
                  DURATION * case(CURVATURE, DURATION).impact.time_scale, "ours: the end of that run")
    yield on_runs("3.4, Fig. 3.32c", "energy lost in the first impact, J", "10",
                  lambda mass: first_impact(ELEMENT, MASSES[mass])[1], "")
    where, what = "3.4, Fig. 3.32d", "impulse of the first impact, Δx = {:g} m, N s"
    yield on_runs(where, what.format(5e-2), "1", lambda mass: first_impact(5e-2, MASSES[mass])[0], "")
    yield on_runs(where, what.format(1e-2), "0.2", lambda mass: first_impact(1e-2, MASSES[mass])[0], "")
    yield on_runs("3.4", "the same for h = 10⁻¹⁰ s, Δx = 0.05 m, N s", "1",
                  lambda mass: first_impact(ELEMENT, MASSES[mass], 1e-10)[0], "")


def first_order() -> Iterator[Printed]:
    """Section 3.5, with the thesis's own step."""
    strong = first.impact(700.0)
    rule = old_settings(strong, first.DURATION * strong.time_scale).zone
    zones = ", ".join(f"{1e3 * first.old(700.0, zone=z).lift:.2g} mm for {z:g} m" for z in first.ZONES)
    for printed, where, digits in (("4.1e-4", "3.5, Fig. 3.33", "nodes"), ("4e-4", "3.5", "“in the order of”; nodes")):
        yield on_runs(where, "lift, a₀ = 0, m", printed, lambda mass: first.own(0.0, mass).lift, digits)
    yield on_runs("3.5, Fig. 3.33", "lift, a₀ = 700 m/s², m", "3.2e-4", lambda mass: first.own(700.0, mass).lift,
                  f"open; nodes. It depends on waves that come back from where the fine elements end, {rule:.3g} m by "
                  f"the rule of Table 3.2; lumped, with steps ten times as long: {zones}")
    for sign, slope in FITTED.items():
        a = 700.0 * sign
        yield on_runs("3.5", f"λ₁ fitted to the thesis's run, a₀ = {readable(a)} m/s², m/s^1.5", f"{slope:g}",
                      lambda mass, a=a: fitted(first.own(a, mass)),  # type: ignore[misc]
                      f"nodes; theory predicts {readable(predicted(first.impact(a)))} for t → 0")
    end = readable(Exact(first.impact(-700.0)).end_of_contact, 3)
    yield on_runs("3.5", "the beam leaves the wall, a₀ = −700 m/s², s", "3.7e-3",
                  lambda mass: first.last_push(first.own(-700.0, mass).history), f"nodes; ours: the last push of the "
                  f"wall. Theory of first order has R = 0 at {end} s; the thesis draws it beyond (Fig. 3.36)")
# fmt: on

PRINTED = (chapter2, scales, meshes, contacts, discrete, first_order)
COLUMNS = ("where", "what", "thesis", "ours", "ours : thesis", "class", "with (3.1.8)", "how measured, why")
HEAD = """\
# Every printed number that can be computed

Made by `bentbeam gallery table-numbers --out FOLDER`; each row is in one class, by rules that are the same for all:

- **within rounding**: ours, rounded to as many digits as are printed, is the printed number;
- **same order**: a number that the thesis read off a run or a mesh, or prints as an order of magnitude, and ours is
  between half and twice as large;
- **other rule, stated by the thesis**: the printed number follows, to one unit of its last digit, from a rule that the
  thesis states and that is not ours;
- **inferred from axes**: no number is printed, an axis shows how large it can be;
- **off**: the others.

Runs have the thesis's settings: h = 2.5·10⁻⁸ s, Δx = 2.5·10⁻³ m, e = 1.25, ρ∞ = 0.8, nonsmooth generalised-α,
restitution 0. It is not known for certain which mass matrix made the thesis's numbers. Ours is lumped, r = 1/105: of
the matrices that were tried the one that comes closest to these numbers ([numerics](numerics.md)), so that they cannot
confirm it. The number with the printed matrix, (3.1.8), and its class stand beside it in every row that tests a
simulation. The seconds and iterations of Table 3.1 stand beside ours in the gallery's table-3.1, the case that took
10–12 days in extra-a0-17, and the uniform mesh in extra-uniform.
"""


def markdown(found: list[list[str]]) -> str:
    """The page docs/thesis_numbers.md."""
    table = [list(COLUMNS), ["---"] * len(COLUMNS), *([cell.replace("|", "\\|") for cell in row] for row in found)]
    lines = "\n".join(f"| {' | '.join(row)} |" for row in table)
    return f"{HEAD}\n{summary(found)}\n\n{lines}\n"


@item("table-numbers", beside=first.__name__)
def numbers(sheet: Sheet) -> None:
    """Every printed number that can be computed

    Numbers printed in the thesis beside this project's, each in one of five classes, with a lumped mass and
    with (3.1.8).
    """
    found = [printed.row() for part in PRINTED for printed in part()]
    sheet.data(COLUMNS, found)
    sheet.page = markdown(found)
    for name, ours, other, _, _ in counts(found):
        sheet.numbers |= {name: float(ours), f"{name}, with (3.1.8)": float(other)}
