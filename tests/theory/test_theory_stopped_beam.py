"""One point stopped, of a beam with its own damping: Laplace inversion, the beam without ends, its release."""

import itertools
from functools import cache

import numpy as np
import pytest
from mpmath import mp

from theory import contact_parameters, damped_point
from theory.stopped_beam import StoppedBeam


@cache
def transformed(damping: float, s: mp.mpc) -> dict[str, mp.mpc]:
    """The half beam as a boundary value problem at complex frequency s; no modes."""
    stiffness = 1 + mp.mpf(damping) * s
    wave = mp.sqrt(mp.sqrt(s * s / stiffness))
    roots = [wave * mp.exp(1j * mp.pi * (2 * j + 1) / 4) for j in range(4)]
    # y(0) = 1/s² imposed, y′(0) = 0, y″(1) = y‴(1) = 0; growing waves measured at the far end
    scale = [mp.exp(-r) if mp.re(r) > 0 else mp.mpf(1) for r in roots]
    free = ([r**k * e * mp.exp(r) for r, e in zip(roots, scale, strict=True)] for k in (2, 3))
    matrix = mp.matrix([scale, [r * e for r, e in zip(roots, scale, strict=True)], *free])
    c = mp.lu_solve(matrix, mp.matrix([1 / s**2, 0, 0, 0]))
    second = sum(c[j] * scale[j] * roots[j] ** 2 for j in range(4))
    third = sum(c[j] * scale[j] * roots[j] ** 3 for j in range(4))
    push = 2 * stiffness * third
    return {"impulse": push / s, "reaction": push, "midspan_moment": -stiffness * second}


@pytest.mark.parametrize("damping", [3.0, 2.0 / 3.51601526850015, 1e-2])  # the second: a mode damped critically
def test_modes_give_what_laplace_inversion_by_talbots_contour_gives(damping: float) -> None:
    beam = StoppedBeam(damping)
    for time, kind in itertools.product((1e-3, 0.02, 0.3), ("impulse", "reaction", "midspan_moment")):
        with mp.workdps(30):
            transform = lambda s, kind=kind: transformed(damping, s)[kind]  # noqa: E731
            exact = mp.invertlaplace(transform, time, method="talbot", degree=50)
        assert float(getattr(beam, kind)(time)) == pytest.approx(float(exact), rel=1e-12, abs=1e-13)


@pytest.mark.parametrize("damping", [0.0246, 1e-2, 3e-3, 1e-3, 1e-4])  # the first: shorter than between two looks
def test_first_release_is_where_the_reaction_first_changes_sign(damping: float) -> None:
    beam = StoppedBeam(damping)
    found = beam.release()
    assert found.impulse == pytest.approx(float(beam.impulse(found.time)), rel=1e-12)
    before = np.append(np.linspace(0.02, 1.0 - 1e-6, 400), 1.0 - 1e-9) * found.time
    assert np.all(beam.reaction(before) > 0.0) and beam.reaction(found.time * (1.0 + 1e-9)) < 0.0


def test_little_damping_begins_with_the_leading_order_and_the_impulse_ends_at_the_momentum_of_the_beam() -> None:
    time, early = 3e-4, StoppedBeam(1e-8)
    r0 = contact_parameters(2.0).r0
    assert early.impulse(time) == pytest.approx(4.0 * np.sqrt(2.0 / np.pi * time) * r0, rel=1e-5)
    assert early.midspan_moment(time) == pytest.approx(1.0, rel=1e-9)
    beam = StoppedBeam(1e-2)
    assert beam.impulse(0.0) == 0.0
    # held for ever the beam comes to rest: all of its momentum, 2μℓV₀, has gone into the wall
    assert beam.impulse(600.0) == pytest.approx(2.0, abs=1e-9)
    assert beam.impulse(np.full((2, 3), 0.1)).shape == (2, 3)


@pytest.mark.parametrize("m", [0, 1, 2])
def test_a_damped_point_is_the_inverse_of_its_laplace_transform_at_every_age(m: int) -> None:
    """(1 + s)^{1/4} s^{−1/2−m} over s^{1/4−1/2−m}·…: the ratio to η = 0 is found by numerical inversion."""
    ratios = (damped_point.reaction_ratio, damped_point.impulse_ratio, damped_point.impulse_ratio_of_acceleration)
    for age in (1e-3, 0.1, 1.0, 7.0, 60.0):
        with mp.workdps(30):
            found = mp.invertlaplace(lambda s: (1 + s) ** 0.25 * s ** (-0.5 - m), age, method="talbot")
            undamped = mp.mpf(age) ** (m - 0.5) / mp.gamma(m + 0.5)
        assert float(ratios[m](age)) == pytest.approx(float(found / undamped), rel=1e-8)


def test_the_moment_of_a_damped_point_and_the_age_at_which_a_zone_spreads() -> None:
    for age in (1e-4, 0.1, 3.0, 50.0):
        with mp.workdps(30):
            moment = mp.invertlaplace(lambda s: (1 + s) ** 0.5 / s, age, method="talbot")
        assert float(damped_point.moment_ratio(age)) == pytest.approx(float(moment), rel=1e-8)
    for kappa in (1e-3, 0.5, 1.0 - 1e-10):
        assert np.sqrt(damped_point.age_of_spreading(kappa)) == pytest.approx(float(mp.erfinv(kappa)), rel=1e-9)
    assert damped_point.age_of_spreading(1.0) == damped_point.age_of_spreading(3.0) == np.inf
