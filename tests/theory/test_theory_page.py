"""The tables of docs/theory.md are what the theory gives; worked examples have the orders that expansions promise."""

import numpy as np
import pytest
from markdown_tables import lines_after, stated

from theory import worked_examples as examples
from theory.contact import contact_parameters
from theory.similarity import peak_moment
from theory.stopped_beam import StoppedBeam


def agrees(value, cell):
    number, unit = stated(cell)
    assert value == pytest.approx(number, abs=0.51 * unit), cell


def table(words):
    return {line[0].replace("$", ""): line[1:] for line in lines_after("docs/theory.md", words)}


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
    for column, damping in enumerate(found[r"t_d/T^*"]):
        factor, _, power = damping.strip("$").rpartition("10^{")
        release = StoppedBeam(float(factor.removesuffix(r"\cdot") or 1) * 10.0 ** int(power.rstrip("}"))).release()
        agrees(release.time, found["first release t_r/T^*"][column])
        agrees(release.impulse, found["J(t_r)"][column])


def test_perturbed_roots_are_third_order_exact() -> None:
    # the next terms are −ε⁴/128 and +ε⁴/128
    epsilon = np.array([0.4, 0.2, 0.1])
    error = np.abs(examples.perturbed_roots(epsilon) - examples.exact_roots(epsilon))
    np.testing.assert_allclose(error, np.tile(epsilon**4 / 128.0, (2, 1)), rtol=0.02)


def test_multiple_scales_stay_true_where_the_regular_expansion_grows() -> None:
    times, epsilon = np.linspace(0.0, 60.0, 2001), 0.1
    exact = examples.duffing_numerical(times, epsilon)
    regular = np.abs(examples.duffing_regular(times, epsilon) - exact)
    scales = np.abs(examples.duffing_multiple_scales(times, epsilon) - exact)
    assert np.max(scales) < 0.2 < 1.5 < np.max(regular)
    times = np.linspace(0.0, 3.0, 31)  # both are of second order at a fixed time
    for expansion in (examples.duffing_regular, examples.duffing_multiple_scales):
        errors = [np.max(np.abs(expansion(times, e) - examples.duffing_numerical(times, e))) for e in (0.02, 0.01)]
        assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
