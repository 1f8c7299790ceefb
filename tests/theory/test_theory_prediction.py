"""The prediction in SI units: scales, the direct link to α, and its own validity."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import erfinv

from bent_beam import Impact
from theory import contact_parameters, peak_moment, predict, validity
from theory.stopped_beam import StoppedBeam

PIPE = Impact(
    bending_stiffness=4.0e6, mass_per_length=29.0, length=2000.0, curvature=1.0 / 600.0, velocity=2.0
)


def test_the_thesis_case_follows_from_the_acceleration_itself() -> None:
    # a₀ = ±700 m/s², V₀ = 3.5 m/s, K = 0.35 1/m: ελ₁V₀² = 300.0 and −280.6 m/s^{3/2}
    for acceleration, expected in ((700.0, 300.007351675), (-700.0, -280.567140089)):
        found = predict(Impact(1.0, 1.0, 50.0, 0.35, 3.5, acceleration=acceleration))
        assert found.kappa_over_nu == pytest.approx(0.1)
        assert found.epsilon_alpha == pytest.approx(math.copysign(16.326530612, acceleration))
        assert found.epsilon * found.lambda1 * 3.5**2 == pytest.approx(expected, rel=1e-9)


def test_groups_and_parameters_are_those_of_the_dimensionless_problem() -> None:
    impact = PIPE.replace(acceleration=0.3, curvature_rate=-1e-4, fourth_derivative=1e-8)
    found = predict(impact)
    solved = contact_parameters(found.kappa_over_nu, found.alpha, found.psi, found.chi)
    for name in ("lambda0", "r0", "lambda1", "r1"):
        assert getattr(found, name) == pytest.approx(getattr(solved, name), rel=1e-12)
    assert found.regime == solved.regime
    assert found.epsilon == pytest.approx(found.time_scale / found.slow_time_scale)


@pytest.mark.parametrize("acceleration", [0.0, 0.02, -0.02])
@pytest.mark.parametrize("curvature", [1.0 / 600.0, 0.02])
def test_impulse_is_the_time_integral_of_the_reaction(acceleration: float, curvature: float) -> None:
    impact = PIPE.replace(acceleration=acceleration, curvature=curvature)
    end = 0.4
    total, _ = quad(
        lambda root: 2.0 * root * predict(impact, root**2).times[0].reaction,
        0.0,
        math.sqrt(end),
        epsrel=1e-12,
    )
    assert predict(impact, end).times[0].impulse == pytest.approx(total, rel=1e-11)


def test_contact_length_and_reaction_in_plain_units() -> None:
    found = predict(PIPE, [0.09])
    row = found.times[0]
    root = (PIPE.bending_stiffness / PIPE.mass_per_length) ** 0.25
    assert row.half_contact_length == pytest.approx(root * 0.3 * found.lambda0, rel=1e-13)
    expected = 2.0 * math.sqrt(2.0 / math.pi) * PIPE.mass_per_length * PIPE.velocity * root * found.r0 / 0.3
    assert row.reaction == pytest.approx(expected, rel=1e-13)
    assert row.contact_force_per_length == 0.0


def test_the_uniform_reaction_is_the_inertia_of_the_load() -> None:
    # a decelerating force a₀ on every part of a beam in contact is carried by the wall: μ a₀
    found = predict(PIPE.replace(acceleration=0.05), [0.01])
    assert found.times[0].contact_force_per_length == pytest.approx(29.0 * 0.05, rel=1e-13)


def test_units_do_not_matter() -> None:
    # millimetres, tonnes and seconds: lengths × 1000, masses / 1000, hence EI × 1e6
    a = PIPE.replace(acceleration=0.05)
    b = Impact(4.0e6 * 1e6, 29.0e-6, 500e3, 1e-3 / 600.0, 2000.0, acceleration=50.0)
    one, other = predict(a, 0.05).times[0], predict(b, 0.05).times[0]
    assert other.half_contact_length == pytest.approx(1e3 * one.half_contact_length, rel=1e-12)
    assert other.reaction == pytest.approx(one.reaction, rel=1e-12)
    assert other.impulse == pytest.approx(one.impulse, rel=1e-12)


def test_only_products_with_epsilon_matter_to_the_contact() -> None:
    impact = PIPE.replace(acceleration=0.05)
    one, other = predict(impact, 0.05), predict(impact.replace(length=900.0), 0.05)
    assert one.epsilon != other.epsilon and one.alpha != other.alpha
    assert one.times[0].reaction == other.times[0].reaction
    assert one.epsilon * one.lambda1 == pytest.approx(other.epsilon * other.lambda1, rel=1e-13)


def test_the_first_instant_has_no_reaction_but_a_contact() -> None:
    row = predict(PIPE, 0.0).times[0]
    assert row.reaction is None
    assert (row.half_contact_length, row.impulse) == (0.0, 0.0)


def test_an_expansion_that_has_broken_down_returns_nothing() -> None:
    found = predict(Impact(1.0, 1.0, 50.0, 0.35, 3.5, acceleration=-700.0), [1e-5, 0.1])
    early, late = found.times
    assert early.valid and early.reaction is not None
    assert not late.valid
    assert late.half_contact_length is late.reaction is late.impulse is None
    assert "does not hold there" in found.summary()


@pytest.mark.parametrize(("ratio", "share"), [(0.1, 1.005), (0.3, 0.995)])
def test_a_damped_contact_ends_where_its_own_length_is_the_beam_s(ratio: float, share: float) -> None:
    # at this time without damping: `share` of the beam. At κ/ν = 0.1 damping makes it 1.2 % shorter, at 0.3 longer
    impact = Impact.whole_beam(ratio, relative_damping=1e-2)
    time = (share * impact.half_length / predict(impact).lambda0) ** 2 / impact.wave_constant
    bare, row = (predict(each, time).times[0] for each in (impact.replace(damping=0.0), impact))
    assert (bare.half_contact_length is None, row.half_contact_length is None) == (share > 1.0, share < 1.0)
    assert (row.reaction is None, row.impulse is None) == (share < 1.0, share < 1.0)
    assert row.half_contact_length is None or row.half_contact_length < impact.half_length


@dataclass(frozen=True)
class Pipe:
    area: float = 3.4e-3
    section_modulus: float = 9.2e-5
    yield_stress: float | None = None
    shear_stiffness: float | None = None


@pytest.mark.parametrize(
    ("impact", "section", "limited_by"),
    [
        (PIPE, None, validity.ENDS),
        (PIPE.replace(acceleration=20.0), None, validity.FIRST_ORDER),
        (PIPE.replace(axial_force=2e6), None, validity.TENSION),
        (PIPE.replace(length=1e5, velocity=300.0), None, validity.SLOPE),
        (PIPE.replace(length=4.0, curvature=0.1), Pipe(shear_stiffness=2e7), validity.SHEAR),
        (PIPE, Pipe(yield_stress=1e8), validity.SECTION),
    ],
)
def test_what_ends_it_is_one_thing_and_rows_never_contradict_it(
    impact: Impact, section: Pipe | None, limited_by: str
) -> None:
    until = predict(impact, section=section).valid_until
    times = [0.0, 1e-6, 0.5 * until, until, until * (1.0 + 1e-9) + 1e-300, 2.0 * until, 50.0]
    found = predict(impact, times, section=section)
    assert found.limited_by == limited_by
    assert [row.valid for row in found.times] == [found.valid_from <= t <= until and until > 0.0 for t in times]
    holds = f"until {until:.3g} s" if until else "does not hold at any time"
    assert holds in found.summary()


def test_what_the_theory_leaves_out_before_it_holds_is_said_in_the_row_and_in_words() -> None:
    section = Pipe(shear_stiffness=2e8)
    begins, until = predict(PIPE, section=section).valid_from, predict(PIPE, section=section).valid_until
    shear_time = math.sqrt(PIPE.bending_stiffness * PIPE.mass_per_length) / 2e8
    assert begins == pytest.approx(10.0 * shear_time, rel=1e-12)
    found = predict(PIPE, [0.9 * begins, 1.1 * begins, 1.1 * until], section=section)
    assert found.valid_after == validity.SHEAR
    assert [row.spoiled_by for row in found.times] == [validity.SHEAR, None, validity.ENDS]
    assert f"from {begins:.3g} s (before, the beam shears" in found.summary()
    lines = found.summary().splitlines()
    assert [line.split("  ")[-1] for line in lines if line.startswith(" " * 6)][1:] == [
        "no: shear", "yes", f"no: {validity.ENDS}",
    ]  # fmt: skip
    early = Impact.whole_beam(0.1, relative_damping=1e-3)
    assert predict(early).valid_after == validity.DAMPING
    assert predict(early, 0.5 * predict(early).valid_from).times[0].spoiled_by == validity.DAMPING
    assert (predict(PIPE).valid_from, predict(PIPE).valid_after) == (0.0, None)


def test_epsilon_does_not_matter_to_validity() -> None:
    # the same beam, slower and less curved: κ/ν is the same, ε is 100 times larger
    slow = PIPE.replace(velocity=0.2, curvature=PIPE.curvature / 10.0)
    assert predict(slow).epsilon == pytest.approx(100.0 * predict(PIPE).epsilon)
    assert predict(slow).valid_until == pytest.approx(predict(PIPE).valid_until, rel=1e-12)


def test_limit_from_the_ends_is_the_measured_one_and_falls_with_the_square_of_the_front() -> None:
    table = json.loads(validity.DATA.read_text(encoding="utf-8"))
    for ratio, arrival in zip(table["kappa_over_nu"], table["arrival"], strict=True):
        bare, _ = validity.ends_errors(ratio, np.array([arrival]), 1e-3)
        assert abs(bare[1, 0]) == pytest.approx(table["tolerance"], rel=0.1)
        until = predict(Impact.whole_beam(ratio, relative_damping=1e-3)).valid_until
        assert 0.6 * arrival < until < arrival
        assert predict(Impact.whole_beam(ratio)).valid_until < until
    last = validity.ends_errors(table["kappa_over_nu"][-1], np.array([0.03]), 1e-3)
    assert validity.ends_errors(50.0, np.array([0.03]), 1e-3) == pytest.approx(last, rel=1e-12)
    assert predict(Impact.whole_beam(1e-4)).valid_until == pytest.approx(
        100.0 * predict(Impact.whole_beam(1e-6)).valid_until, rel=1e-3
    )


def test_what_comes_from_the_ends_is_that_of_the_undamped_beam_unless_damping_is_given() -> None:
    time = np.geomspace(1e-3, 0.1, 9)
    bare, damped = (validity.ends_errors(0.5, time, damping) for damping in (0.0, 0.1))
    assert np.any(bare != 0.0) and np.any(bare != damped)
    assert np.array_equal(validity.ends_errors(0.5, time), bare)


def test_of_tension_and_loads_the_larger_is_named() -> None:
    for axial, named in ((1e2, validity.FIRST_ORDER), (1e6, validity.TENSION)):
        impact = Impact.dimensionless(0.5, epsilon_alpha=1e4, epsilon_axial=axial, length=1e6)
        assert predict(impact).limited_by == named


@pytest.mark.parametrize("load", ["acceleration", "fourth_derivative", "curvature_rate", "axial_force"])
def test_a_subnormal_load_is_none_where_one_point_is_about_to_spread(load: str) -> None:
    impact = Impact.whole_beam(1.0 - 1.2e-16)
    until = predict(impact).valid_until
    for size in (5e-324, 1e-316, 1e-308):
        assert predict(impact.replace(**{load: size})).valid_until == until


def test_a_quartic_bow_sends_waves_from_its_ends() -> None:
    # the faster, the larger q₀; loads at the ends are what the free motion would need
    bare = predict(Impact.whole_beam(0.5, relative_damping=1e-3)).valid_until
    found = [
        predict(
            Impact.whole_beam(0.5, relative_damping=1e-3).replace(fourth_derivative=q, acceleration=-q)
        ).valid_until
        for q in (0.1, 0.2, 0.4)
    ]
    assert bare > found[0] > found[1] > found[2] > 0.1 * bare


@pytest.mark.parametrize("damping", [1e-4, 1e-3, 3e-3])
def test_one_point_holds_within_two_per_cent_of_the_stopped_beam_until_the_limit_and_not_twice_as_long(
    damping: float,
) -> None:
    impact, beam = Impact.whole_beam(2.0, relative_damping=damping), StoppedBeam(damping)
    until = predict(impact).valid_until
    times = until * np.linspace(0.01, 1.0, 400)
    force = np.array([row.reaction for row in predict(impact, times).times]) / beam.reaction(times) - 1.0
    impulse = np.array([row.impulse for row in predict(impact, times).times]) / beam.impulse(times) - 1.0
    assert max(np.max(np.abs(force)), np.max(np.abs(impulse))) < 0.02
    later = until * np.linspace(1.0, 2.0, 400)
    late = np.array([row.reaction for row in predict(impact, later).times]) / beam.reaction(later) - 1.0
    assert np.max(np.abs(late)) > 0.02


def test_the_first_instant_is_finite_and_only_a_contact_too_flat_is_warned_of_its_damping() -> None:
    assert predict(Impact.whole_beam(1e-3)).warnings == ()
    assert "damping" in " ".join(predict(Impact.whole_beam(1e-3, relative_damping=1e-3)).warnings)
    for ratio in (0.5, 2.0):
        (start,) = predict(Impact.whole_beam(ratio, relative_damping=1e-3), 0.0).times
        assert (start.half_contact_length, start.impulse, start.reaction) == (0.0, 0.0, None)
        assert predict(Impact.whole_beam(ratio, relative_damping=1e-3)).warnings == ()


def test_a_damped_zone_starts_as_one_point() -> None:
    # the wall takes the curvature κ/ν out of the point after η erf⁻¹(κ/ν)²; until then nothing tells it from a point
    impact, age = Impact.whole_beam(0.5, relative_damping=1e-3), float(erfinv(0.5)) ** 2
    early, late, later = predict(impact, [0.99e-3 * age, 1.5e-3 * age, 2e-2]).times
    point = predict(Impact.whole_beam(2.0, relative_damping=1e-3), early.time).times[0]
    assert early.half_contact_length == 0.0 and early.valid
    assert (early.reaction, early.impulse) == pytest.approx((point.reaction, point.impulse), rel=1e-12)
    bare = predict(Impact.whole_beam(0.5), [late.time, later.time]).times
    assert 0.0 < late.half_contact_length < 0.8 * bare[0].half_contact_length
    assert later.half_contact_length == pytest.approx(bare[1].half_contact_length, rel=0.01)
    assert later.reaction == pytest.approx(bare[1].reaction, rel=0.01)


def test_what_the_first_instants_took_stays_in_the_impulse_of_a_flat_contact() -> None:
    for ratio, least, most in ((0.8, 1.0, 1.05), (0.1, 1.2, 1.35), (0.02, 1.4, 1.5)):
        damped, bare = (
            predict(Impact.whole_beam(ratio, relative_damping=eta), 0.005).times[0] for eta in (1e-3, 0.0)
        )
        assert least < damped.impulse / bare.impulse < most


def test_so_flat_a_damped_contact_that_nobody_measured_is_said_to_hold_at_no_time() -> None:
    found = predict(Impact.whole_beam(1e-3, relative_damping=1e-3), 0.01)
    assert (found.valid_from, found.valid_until, found.limited_by) == (0.0, 0.0, validity.DAMPING)
    assert "was not measured" in found.summary()
    assert predict(Impact.whole_beam(1e-3)).valid_until > 0.0


def test_a_damping_that_rules_until_the_waves_are_back_is_why_nothing_holds() -> None:
    found = predict(Impact.whole_beam(0.1, relative_damping=3.0), [1e-6])
    assert (found.valid_until, found.limited_by) == (0.0, validity.DAMPING)
    assert found.times[0].spoiled_by == validity.DAMPING  # and not waves, which take 0.01 T*
    # with a hundredth of it they are
    assert predict(Impact.whole_beam(0.1, relative_damping=0.03)).limited_by == validity.ENDS


def test_a_zone_shorter_than_was_measured_holds_as_the_point_that_it_is_at_first() -> None:
    found = predict(Impact.whole_beam(0.99, relative_damping=1e-3))
    assert found.valid_until == pytest.approx(1e-3 * float(erfinv(0.99)) ** 2, rel=1e-12)
    assert found.limited_by == validity.DAMPING
    assert predict(Impact.whole_beam(0.99)).limited_by == validity.ENDS
    assert predict(Impact.whole_beam(0.9, relative_damping=1e-3)).limited_by == validity.ENDS
    # loads move the front of a short zone far: x = 0.2 at 0.01 T*, of which a short zone's start takes its share
    loaded = predict(Impact.whole_beam(0.94, relative_damping=1e-3).replace(curvature_rate=-0.9))
    assert loaded.limited_by == validity.FIRST_ORDER


def test_one_point_spreads_once_the_loads_have_taken_its_curvature() -> None:
    # gap's curvature κ − ν − (χ + α)τ; four per cent beyond zero its length may still be left out
    impact = Impact.dimensionless(1.02, epsilon_alpha=20.0, epsilon_chi=10.0, length=4.0)
    assert predict(impact).valid_until == pytest.approx(0.06 / 30.0, rel=1e-9)
    assert predict(impact).limited_by == validity.FIRST_ORDER
    assert predict(impact.replace(acceleration=-20.0)).limited_by == validity.ENDS


@pytest.mark.parametrize("ratio", [1e-7, 0.02, 0.3, 0.9, 0.999, 2.0])
@pytest.mark.parametrize("loads", [(1, 0, 0, 0), (-3, 1, 2, 0), (0, 0, -1, 1), (1, 1, 1, -2)])
def test_ten_times_the_load_ends_validity_ten_times_earlier(ratio: float, loads: tuple[float, ...]) -> None:
    alpha, psi, chi, axial = loads

    def until(size: float) -> float:
        impact = Impact.dimensionless(
            ratio,
            epsilon_alpha=size * alpha,
            epsilon_psi=size * psi,
            epsilon_chi=size * chi,
            epsilon_axial=size * axial,
            length=1e12,
        )
        return predict(impact).valid_until

    if ratio >= 1.0 and axial == 0.0 and alpha + chi < 0.0:
        assert until(1e6) == until(0.0)  # one point is a linear problem until it spreads
    else:
        assert until(1e6) == pytest.approx(10.0 * until(1e7), rel=1e-6)
        assert until(1e6) < until(0.0)


def test_bending_moment_and_stress() -> None:
    # κ/ν = 0.31: m = 0.712 ahead of the zone; a third of the bow is a set of stress beforehand
    plain = predict(PIPE, [0.0, 0.1])
    unit = PIPE.velocity * math.sqrt(PIPE.bending_stiffness * PIPE.mass_per_length)
    moments = peak_moment(plain.kappa_over_nu)
    assert plain.peak_moment == pytest.approx(unit * moments.ahead, rel=1e-13)
    assert plain.times[1].peak_moment == plain.peak_moment and plain.peak_stress is None
    root = math.sqrt(math.sqrt(PIPE.bending_stiffness / PIPE.mass_per_length) * 0.1)
    assert plain.times[1].peak_moment_place == pytest.approx(moments.place * root, rel=1e-13)
    # bent to K from straight: the wall bends it back in the zone, further ahead of it
    bent = predict(PIPE.replace(natural_curvature=0.0))
    assert bent.peak_moment == pytest.approx(unit * moments.ahead + 4.0e6 / 600.0, rel=1e-13)
    section = Pipe(yield_stress=4e8)
    pulled = predict(PIPE.replace(axial_force=1e5), section=section)
    assert pulled.peak_stress == pytest.approx(pulled.peak_moment / 9.2e-5 + 1e5 / 3.4e-3, rel=1e-13)
    assert pulled.yields is False
    assert "below the yield stress" in pulled.summary()


def test_tension_and_a_curved_wall_act_through_the_groups() -> None:
    # a straight beam on a bulging wall is the bent beam on a flat one
    straight = predict(PIPE.replace(curvature=0.0, wall_curvature=-PIPE.curvature), [0.1]).times[0]
    assert straight.half_contact_length == pytest.approx(predict(PIPE, [0.1]).times[0].half_contact_length, rel=1e-14)
    # free flight under tension: the zone rests on a flat wall without reaction
    force = 1e5
    flight = PIPE.replace(axial_force=force, acceleration=-force * PIPE.curvature / PIPE.mass_per_length)
    found = predict(flight, [0.05])
    assert (found.regime, found.times[0].contact_force_per_length) == ("continuous", 0.0)
    n_tau = force * 0.05 / math.sqrt(PIPE.bending_stiffness * PIPE.mass_per_length)
    bare = predict(PIPE, [0.05])
    change = found.times[0].half_contact_length / bare.times[0].half_contact_length - 1.0
    assert change == pytest.approx(found.lambda_axial * n_tau / bare.lambda0, rel=1e-10)
    # held still by the load p = NK the zone bears it
    held = predict(PIPE.replace(axial_force=force), [0.05]).times[0]
    assert held.contact_force_per_length == pytest.approx(force * PIPE.curvature, rel=1e-13)
    assert "Euler load" in predict(PIPE.replace(axial_force=-100.0)).summary()


def test_one_point_with_damping_is_the_stopped_beam_until_its_ends_are_felt() -> None:
    impact = Impact.whole_beam(2.0, relative_damping=1e-3)
    beam, row = StoppedBeam(1e-3), predict(impact, [3e-3]).times[0]
    assert row.impulse == pytest.approx(float(beam.impulse(3e-3)), rel=1e-8)
    assert row.reaction == pytest.approx(float(beam.reaction(3e-3)), rel=1e-6)
    assert row.peak_moment == pytest.approx(float(beam.midspan_moment(3e-3)), rel=1e-7)
    assert predict(impact).damping_matters_until == pytest.approx(6.25e-3)


@pytest.mark.parametrize("acceleration", [0.0, 5.0, -5.0])
@pytest.mark.parametrize("curvature", [1e-4, 1.0])
def test_dictionary_is_strict_json(acceleration: float, curvature: float) -> None:
    impact = PIPE.replace(acceleration=acceleration, curvature=curvature)
    text = json.dumps(predict(impact, np.linspace(0.0, 5.0, 4)).to_dict(), allow_nan=False)
    restored = json.loads(text)
    assert restored["regime"] in ("discrete", "continuous", "detached")
    assert len(restored["times"]) == 4
    assert restored["times"][0]["reaction"] is None


def test_refusals_say_why() -> None:
    with pytest.raises(ValueError, match="lambda0 is infinite"):
        predict(PIPE.replace(curvature=0.0))
    for name, value in (("rotation", 0.1), ("first_touch", 1.0)):
        with pytest.raises(ValueError, match=f"{name} must be 0"):
            predict(PIPE.replace(**{name: value}))
    for bad, why in ((-1.0, "not be negative"), (math.nan, "finite"), (math.inf, "finite"), (1e300, "not exceed")):
        with pytest.raises(ValueError, match=f"times must .*{why}"):
            predict(PIPE, [0.1, bad])


@given(st.floats(), st.floats(-1e3, 1e3))
def test_any_time_has_a_finite_prediction_or_a_refusal(time: float, acceleration: float) -> None:
    impact = PIPE.replace(acceleration=acceleration)
    try:
        found = predict(impact, [time])
    except ValueError as error:
        assert "times" in str(error) or "acceleration" in str(error)
        return
    json.dumps(found.to_dict(), allow_nan=False)
