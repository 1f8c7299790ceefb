"""The lowest mode of held beams: closed forms, and the equations of bending, shear and tension themselves."""

import math

import numpy as np
import pytest

from bent_beam import Impact, InputError
from bent_beam.cases import case_from_tables
from bent_beam.loads import ENDS
from bent_beam.modes import lowest_frequency, lowest_mode

BEAM = Impact(2.0, 8.0, 3.0, 0.0, 1.0)  # EI, μ, L
BETA = {("clamped", "clamped"): 4.730040744862704, ("clamped", "hinged"): 3.926602312047919,
        ("clamped", "free"): 1.875104068711961, ("hinged", "hinged"): math.pi}  # fmt: skip


@pytest.mark.parametrize("ends", BETA)
@pytest.mark.parametrize("turned", [False, True])
def test_without_shear_and_tension_it_is_blevins_s(ends, turned) -> None:
    """Formulas for Natural Frequency and Mode Shape (1979), table 8-1; ξ = 0 … 1 from the clamp."""
    left, right = reversed(ends) if turned else ends
    impact, beta = BEAM.replace(left_end=left, right_end=right), BETA[ends]
    x, sign = np.linspace(-1.5, 1.5, 31), 1.0 if ends[1] == "free" else -1.0
    sigma = (np.cosh(beta) + sign * np.cos(beta)) / (np.sinh(beta) + sign * np.sin(beta))

    def exact(place):
        z = beta * (0.5 + place / 3.0)
        if ends == ("hinged", "hinged"):
            return np.array([np.sin(z), beta / 3.0 * np.cos(z)])
        bent = np.cosh(z) - np.cos(z) - sigma * (np.sinh(z) - np.sin(z))
        return np.array([bent, beta / 3.0 * (np.sinh(z) + np.sin(z) - sigma * (np.cosh(z) - np.cos(z)))])

    side = -1.0 if turned else 1.0
    w, slope = exact(side * x) / exact(0.0)[0]
    mode, angle = lowest_mode(impact, x)
    assert mode == pytest.approx(w, abs=1e-12) and angle == pytest.approx(side * slope, abs=1e-12)
    assert lowest_frequency(impact) == pytest.approx(beta**2 / 9.0 * 0.5 / (2.0 * math.pi), rel=1e-10)


def test_a_beam_that_nothing_bends_flies_or_swings_as_it_is() -> None:
    known = (("free", "free", [1, 1, 1]), ("hinged", "free", [0, 1, 2]), ("free", "hinged", [2, 1, 0]))
    for left, right, mode in known:
        impact = BEAM.replace(left_end=left, right_end=right)
        found, angle = lowest_mode(impact, np.array([-1.5, 0.0, 1.5]))
        assert found.tolist() == mode and angle * 3.0 == pytest.approx(np.full(3, mode[2] - mode[0]))
        assert lowest_frequency(impact) == 0.0


OF_CLAMPED = ((40.0, False), (0.0, True), (40.0, True), (-0.5, True))  # N; whether it shears
BENT = [("clamped", end, *about) for end in ENDS for about in OF_CLAMPED]
BENT += [("hinged", "free", 40.0, shears) for shears in (False, True)]


@pytest.mark.parametrize(("left", "right", "pull", "shears"), BENT)
def test_with_shear_and_tension_it_moves_by_their_equations(left, right, pull, shears) -> None:
    """S(w′ − φ)′ + N w″ + μω²w = 0 and EI φ″ + S(w′ − φ) + Jω²φ = 0, and nothing acts on a free end."""
    stiff = {"shear_stiffness": 30.0, "rotary_inertia": 0.2} if shears else {}
    impact = BEAM.replace(left_end=left, right_end=right, axial_force=pull, **stiff)
    x, omega = np.linspace(-1.5, 1.5, 6001), 2.0 * math.pi * lowest_frequency(impact)
    w, angle = lowest_mode(impact, x)

    def slope(field):
        return np.gradient(field, x, edge_order=2)

    moment = 2.0 * slope(angle)
    shear = 30.0 * (slope(w) - angle) if shears else -slope(moment)
    turning = slope(moment) + shear + 0.2 * shears * omega**2 * angle
    moving = slope(shear + pull * slope(w)) + 8.0 * omega**2 * w
    for residual, size in ((turning, np.abs(shear).max()), (moving, 8.0 * omega**2)):
        assert np.abs(residual[9:-9]).max() < 1e-4 * size
    force, near = shear + pull * slope(w), 3e-3 * np.abs(shear).max() + 1e-3
    nothing = {"clamped": ((w, 1e-12), (angle, 1e-12)), "hinged": ((w, 1e-12), (moment, 1e-3)),
               "free": ((moment, 1e-3), (force, near))}  # fmt: skip
    for end, place in ((left, 0), (right, -1)):
        assert all(abs(field[place]) < least for field, least in nothing[end]), end


@pytest.mark.parametrize(
    ("ends", "share"), [(("hinged", "hinged"), 1.0), (("clamped", "clamped"), 4.0), (("free", "clamped"), 0.25)]
)
@pytest.mark.parametrize("compliance", [0.0, 0.05])
def test_a_beam_with_shear_buckles_sooner_and_arrives_in_no_mode_beyond(ends, share, compliance) -> None:
    """N_E/(1 + N_E/S) (F. Engesser 1891), where its frequency is 0."""
    euler = share * math.pi**2 * 2.0 / 9.0
    held = BEAM.replace(left_end=ends[0], right_end=ends[1], shear_stiffness=1.0 / compliance if compliance else None)
    most = euler / (1.0 + euler * compliance)
    slow, free = (lowest_frequency(held.replace(axial_force=-part * most)) for part in (0.999, 0.0))
    assert 0.0 < slow < 0.04 * free
    for beyond in (1.001, 1.1, 3.0):
        with pytest.raises(InputError, match=r"^axial_force must not press"):
            lowest_mode(held.replace(axial_force=-beyond * most), np.zeros(1))


def test_a_string_sounds_as_a_string_and_bends_over_the_length_of_its_ends_alone() -> None:
    """N L²/EI = 4·10⁴: f = (1/2L)√(N/μ)(1 + 2δ/L), δ = √(EI/N), to second order of δ/L (N. H. Fletcher 1964)."""
    string = BEAM.replace(left_end="clamped", right_end="clamped", axial_force=4e4 * 2.0 / 9.0)
    plain, delta = math.sqrt(string.axial_force / 8.0) / 6.0, 1.0 / 200.0
    exact = plain * (1.0 + 2.0 * delta + (4.0 + math.pi**2 / 2.0) * delta**2)
    assert lowest_frequency(string) == pytest.approx(exact, rel=30.0 * delta**3)
    mode, _ = lowest_mode(string, np.array([0.75]))
    assert mode == pytest.approx(math.cos(math.pi / 4.0), abs=0.01)


def test_an_amplitude_at_another_frequency_than_its_own_is_refused_where_a_beam_swings_up_to_its_wall() -> None:
    beam = {"length": 1.0, "curvature": 0.0, "bending_stiffness": 1.0, "mass_per_length": 1.0, "ends": "hinged"}
    impact = {"amplitude": 2e-3, "frequency": 1.09 * math.pi / 2.0}
    tables = {"beam": beam, "wall": {"stiffness": 1e3, "clearance": 1e-3}, "impact": impact}
    assert case_from_tables(tables).impact.velocity == pytest.approx(1.09 * math.pi**2 * 2e-3)
    tables["impact"]["frequency"] = frequency = 1.11 * math.pi / 2.0
    with pytest.raises(InputError, match=r"impact.frequency = 1.74.* is not the beam's own, 1.571 Hz: .* 1.11 times"):
        case_from_tables(tables)
    tables["wall"]["clearance"] = 0.0  # it is at the wall, as fast as was said
    assert case_from_tables(tables).impact.velocity == pytest.approx(2.0 * math.pi * frequency * 2e-3)
