"""Restitutions in the tables of the docs: a fresh run gives the same. Each is one run to the last separation (Exudyn's:
tests/exudyn_models/test_exudyn_whole_beam.py)."""

import pytest
from markdown_tables import lines_after, stated

from bent_beam.impact import Impact
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.method import simulate_to_separation
from hermite_fe import HermiteFE
from hermite_fe.integrators import MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from hermite_fe.whole_beam import ELEMENTS

RESTITUTIONS = [
    pytest.param(float(kappa), stated(damping.replace("10", "1e", 1))[0], hermite, id=f"{kappa}-{damping}")
    for kappa, damping, _, _, hermite in lines_after("docs/exudyn.md", "## The whole impact")[2:]
]
SCHEMES = {
    "Signorini": SignoriniPosition(theta=0.5),
    "Moreau": MoreauJean(theta=0.5),
    "generalised": NonsmoothGeneralizedAlpha(spectral_radius=0.8),
}
ROUNDING = 3e-4  # hits that follow one another amplify round-off, which differs between processors (seen: 2.5e-4)
PARTS = {"1": 1.0, "½": 0.5, "¼": 0.25}
TITLES, _, *LINES = lines_after("docs/whole_impact.md", "How much the parts matter")
PARTED = [
    pytest.param(scheme, part, title, cell, id=f"{scheme}-{part}-{title}")
    for scheme, part, *columns in LINES
    for title, cell in zip(TITLES[2:], columns)
]


def near(unit, least=0.0):
    """How near a cell is met: to its last digit; where that is the fourth, to what rounding changes."""
    return max(1.01 * unit, ROUNDING if 0.99e-4 < unit < 1.01e-4 else least)


def restitution(method, kappa_over_nu, damping):
    impact = Impact.whole_beam(kappa_over_nu, relative_damping=damping)
    return whole_impact(simulate_to_separation(method, impact)).restitution


@pytest.mark.verify
@pytest.mark.parametrize(("kappa_over_nu", "damping", "cell"), RESTITUTIONS)
def test_a_default_run_gives_the_restitution_of_the_page(kappa_over_nu, damping, cell):
    value, unit = stated(cell)
    assert restitution(HermiteFE(), kappa_over_nu, damping) == pytest.approx(value, abs=near(unit, 1e-4))


@pytest.mark.verify
@pytest.mark.parametrize(("scheme", "part", "title", "cell"), PARTED)
def test_a_scheme_with_its_steps_gives_the_restitution_of_the_page(scheme, part, title, cell):
    value, unit = stated(cell)
    kappa, damping = (stated(word.replace("10", "1e"))[0] for word in title.strip("()").split(", "))
    integrator = next(made for name, made in SCHEMES.items() if scheme.startswith(name))
    method = HermiteFE(integrator=integrator.with_steps(PARTS[part] / ELEMENTS**2, 0.0))
    assert restitution(method, kappa, damping) == pytest.approx(value, abs=near(unit))
