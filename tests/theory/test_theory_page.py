"""The numbers in the tables of docs/theory.md are what the theory gives."""

import pytest
from markdown_tables import lines_after, stated

from theory.contact import contact_parameters
from theory.similarity import peak_moment
from theory.stopped_beam import StoppedBeam

PAGE = "docs/theory.md"


def agrees(value, cell):
    number, unit = stated(cell)
    assert value == pytest.approx(number, abs=0.51 * unit), cell


def table(words):
    return {line[0].replace("$", ""): line[1:] for line in lines_after(PAGE, words)}


def test_tension():
    found = table("Limits, $\\nu=1$")
    for column, kappa in enumerate(found[r"\kappa/\nu"]):
        parameters = contact_parameters(float(kappa), axial=1.0)
        agrees(parameters.lambda_axial, found[r"\lambda_N"][column])
        agrees(parameters.r_axial, found["r_N"][column])


def test_largest_moment():
    found = table("## 7. The largest bending moment")
    for column, kappa in enumerate(found[r"\kappa/\nu"]):
        kappa_over_nu = stated(kappa)[0]
        moment = peak_moment(kappa_over_nu)
        agrees(moment.largest, found[r"m/\nu"][column])
        place = found[r"at x/\lambda_0"][column]
        if place in ("the contact from here on", ""):
            assert moment.at_contact > 0.9999 * moment.ahead
        else:
            agrees(moment.place_of_largest / contact_parameters(kappa_over_nu).lambda0, place)


def test_first_release_of_the_stopped_beam():
    found = table("**Stopped beam**")
    for column, damping in enumerate(found[r"\eta/T^*"]):
        factor, _, power = damping.strip("$").rpartition("10^{")
        release = StoppedBeam(float(factor.removesuffix(r"\cdot") or 1) * 10.0 ** int(power.rstrip("}"))).release()
        agrees(release.time, found["first release t_s/T^*"][column])
        agrees(release.impulse, found["J(t_s)"][column])
