"""One point stopped, of a beam with its own damping: Laplace inversion, the beam without ends, its release, moments."""

import itertools
import math
from functools import cache

import numpy as np
import pytest
from mpmath import mp

from bent_beam import Impact
from theory import contact_parameters, damped_point, peak_moment, predict
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


AGEING = [("reaction_ratio", 0.25, 0.5), ("impulse_ratio", 0.25, 1.5), ("impulse_ratio_of_acceleration", 0.25, 2.5)]


@pytest.mark.parametrize(("name", "p", "q"), [*AGEING, ("moment_ratio", 0.5, 1.0)])
def test_a_damped_point_is_the_inverse_of_its_laplace_transform_at_every_age(name: str, p: float, q: float) -> None:
    """That of (1 + s)ᵖ/s^q, over what 1/s^q gives without damping."""
    for age in (1e-4, 1e-3, 0.1, 1.0, 3.0, 7.0, 50.0, 60.0):
        with mp.workdps(30):
            exact = mp.invertlaplace(lambda s: (1 + s) ** p / s**q, age, method="talbot")
            ratio = exact / (mp.mpf(age) ** (q - 1) / mp.gamma(q))
        assert float(getattr(damped_point, name)(age)) == pytest.approx(float(ratio), rel=1e-8), age


def test_a_zone_spreads_at_the_age_at_which_the_moment_has_taken_its_curvature() -> None:
    for kappa in (1e-3, 0.5, 1.0 - 1e-10):
        assert np.sqrt(damped_point.age_of_spreading(kappa)) == pytest.approx(float(mp.erfinv(kappa)), rel=1e-9)
    assert damped_point.age_of_spreading(1.0) == damped_point.age_of_spreading(3.0) == np.inf


def test_the_moment_ahead_of_a_damped_point_has_no_number_in_its_first_75_damping_times() -> None:
    # at first 0.24 of that at the contact, in the end 0.56 of it: where it may be the largest nothing is said
    for elastic, known in ((0.0, True), (0.4, False), (1.0, False), (-3.0, True)):  # curvature of the bow, of 2
        point = Impact.whole_beam(2.0, relative_damping=1e-5).replace(natural_curvature=2.0 - elastic)
        touch, early, late = predict(point, [0.0, 7.4e-4, 7.6e-4]).times
        assert touch.peak_moment == pytest.approx(abs(elastic))  # before it
        assert (early.peak_moment is not None, early.peak_moment_place is not None) == (known, known)
        undamped = predict(point.replace(damping=0.0), 7.6e-4).times[0]
        assert late.peak_moment == pytest.approx(undamped.peak_moment, rel=1e-12)
    (spread,) = predict(Impact.whole_beam(0.3, relative_damping=1e-5), 6e-4).times  # no point any more: as without
    assert spread.peak_moment == pytest.approx(peak_moment(0.3).largest, rel=1e-12) and not spread.valid


@pytest.mark.parametrize(
    ("age", "near", "share"), [(1e-3, 12.25, 0.24), (damped_point.AHEAD_FROM, 2.5, 0.98 * 0.5597868)]
)
def test_the_elastic_moment_ahead_of_a_damped_point_becomes_that_without_damping(age, near, share) -> None:
    """Over that at the contact; times in η, places in √(cη), the largest near a multiple of the root of the age. The
    inverse of e^{−aX}(cos aX − sin aX)/(s√(1 + s))."""

    def moment(place: float) -> float:
        def transform(s: mp.mpc) -> mp.mpc:
            a = place * mp.sqrt(s / 2) / (1 + s) ** 0.25
            return mp.exp(-a) * (mp.cos(a) - mp.sin(a)) / (s * mp.sqrt(1 + s))

        return float(mp.invertlaplace(transform, age, method="talbot"))

    with mp.workdps(20):
        ahead = max(-moment(place) for place in np.linspace(0.7, 1.3, 7) * near * math.sqrt(age))
    assert ahead / float(damped_point.elastic_moment_ratio(age)) == pytest.approx(share, rel=5e-3)
