"""Estimators on synthetic histories of the theory's own laws: they find what was put in, within bars."""

import dataclasses
import json
from functools import cache

import numpy as np
import pytest
from histories import history_of

from bent_beam import Impact, ImpactHistory
from bent_beam.measure.estimators import first_order, leading_order
from bent_beam.measure.moments import Moments, first_front, moments
from bent_beam.measure.numbers import FACTOR, Number
from theory import contact_parameters

SIDE = np.sqrt(2.0 / np.pi)  # F√τ of r₀ = 1


@cache
def synthetic(kappa, first=(0.0, 0.0, 0.0), epsilon=0.0):
    """A half-beam history with both concentrated reactions and the uniform one on a fixed mesh."""
    exact, loads = contact_parameters(kappa, *first), ("epsilon_alpha", "epsilon_psi", "epsilon_chi")
    fine, saved = np.linspace(1e-3, np.sqrt(0.1), 8001) ** 2, np.linspace(228, 8000, 200).astype(int)
    x = np.linspace(0.0, 1.2 * exact.lambda0 * np.sqrt(0.1) + 0.2, 400)
    front = np.sqrt(fine) * (exact.lambda0 + epsilon * exact.lambda1 * fine)
    force = SIDE * (exact.r0 + epsilon * exact.r1 * fine) / np.sqrt(fine)
    force[0] *= 2.0  # the mean since the first touch
    # shared by the two nodes around the front, as a finite element solution does
    shared = np.maximum(1.0 - np.abs(x - front[:, None]) / x[1], 0.0)
    own = np.where(x > 0.0, x[1], 0.5 * x[1])
    pressed = (x <= front[:, None]) * own
    pressed += (front - pressed.sum(axis=1))[:, None] * shared
    rates = force[:, None] * shared + epsilon * max(first[0] + first[1], 0.0) * pressed
    impulse = (rates * np.diff(fine, prepend=0.0)[:, None]).cumsum(axis=0)[saved]
    impact = Impact.dimensionless(kappa, **{name: epsilon * value for name, value in zip(loads, first)})
    return history_of(fine[saved], x, impact=impact, impulse=impulse, total_impulse=2.0 * impulse.sum(axis=1))


def pressed(uniform=True, first=(1.0, 0.5, 0.0), epsilons=(0.1,)):
    """A base, its leading order, and runs at ``epsilons`` with ``first``."""
    base = moments(synthetic(0.5))
    return base, leading_order(base), [(e, moments(synthetic(0.5, first, e), uniform=uniform)) for e in epsilons]


@pytest.mark.parametrize("kappa", [0.05, 0.3, 0.8])
def test_leading_order_is_recovered_and_is_the_same_whenever_the_run_ends(kappa):
    exact, reduced = contact_parameters(kappa), moments(synthetic(kappa))
    scaled = {"tau": 1e-6 * reduced.tau, "impulse": 1e-3 * reduced.impulse, "moment": 1e-6 * reduced.moment}
    found, early = leading_order(reduced), leading_order(dataclasses.replace(reduced, **scaled))
    assert (early.r0.known, early.lambda0.known) == pytest.approx((found.r0.known, found.lambda0.known), rel=1e-9)
    assert found.r0.value == pytest.approx(exact.r0, rel=2e-3)
    assert found.lambda0.value == pytest.approx(exact.lambda0, rel=4e-3)
    assert np.median((reduced.front / np.sqrt(reduced.tau))[20:]) == pytest.approx(exact.lambda0, rel=2e-3)


@pytest.mark.parametrize("lift", [0.01, 0.2])
def test_a_zone_thrown_off_the_wall_may_have_been_pushed_that_much_too_hard(lift):
    """A reaction that fits, and whose companion is as far off: the lift alone tells that the front was not resolved."""
    tau = np.geomspace(0.01, 1.0, 100)
    zero = np.zeros(100)
    reduced = Moments(tau, 4.0 * SIDE * np.sqrt(tau), SIDE * tau, zero, zero, np.full(100, lift))  # r₀ = 2, λ₀ = ½
    found = leading_order(reduced, companions=[reduced])
    assert found.lift == lift and found.window == (tau[50], 1.0)
    assert found.r0.parts["lift"] == pytest.approx(min(lift / 0.1, 1.0) * lift * found.r0.value, rel=6e-3)
    assert found.lambda0.parts["lift"] == pytest.approx(0.5 * min(lift / 0.1, 1.0) * lift * found.lambda0.value)
    short = leading_order(dataclasses.replace(reduced, moment=0.05 * SIDE * tau)).lambda0
    assert short.known < 0.06 and short.parts["least"] == pytest.approx(1e-5)  # 10⁻⁴ of 0.1 at least
    others = [dataclasses.replace(reduced, impulse=more * reduced.impulse) for more in (1.01, 0.97)]
    assert leading_order(reduced, companions=others).r0.parts["mesh_and_step"] == pytest.approx(FACTOR * 0.03 * 2.0)


def test_eight_instants_with_contact_are_the_least():
    tau = np.geomspace(0.2, 1.0, 8)
    few = Moments(tau, 2.0 * SIDE * np.sqrt(tau), SIDE * tau, *np.zeros((3, 8)))
    assert leading_order(few).r0.value == pytest.approx(1.0)
    with pytest.raises(ValueError, match="at least 8 instants"):
        leading_order(dataclasses.replace(few, impulse=few.impulse * (tau > 0.2)))


def test_a_companion_that_says_the_same_leaves_what_one_run_tells():
    run = moments(synthetic(0.3))
    other = dataclasses.replace(run, impulse=1.01 * run.impulse, moment=1.02 * run.moment)
    same, apart = (leading_order(run, companions=[one]) for one in (run, other))
    for name in ("lambda0", "r0"):
        known = getattr(same, name)
        alone = getattr(leading_order(run, unresolved=0.01), name)
        drift = alone.parts["drift"]
        assert known.parts["drift"] == pytest.approx(FACTOR / 4.0 * drift)  # alone it has to tell of the mesh, too
        assert alone.parts["least"] == pytest.approx(1e-4 * known.value)
        assert alone.parts["element"] == pytest.approx(0.01 / np.sqrt(0.1) * (name == "lambda0"))
        assert known.bar <= drift + sum(known.parts[part] for part in ("least", "element", "lift"))
        assert known.bar < getattr(apart, name).bar


def test_a_run_that_drifts_within_its_window_has_a_bar_for_it():
    """A hump of the impulse that a fit over the last decade smooths; a step near its end, which half of it tells."""
    smooth = moments(synthetic(0.3))
    hump = 1.0 + 0.05 * np.exp(-(np.log(smooth.tau / 0.018) ** 2) / 0.2)
    uneven = dataclasses.replace(smooth, impulse=smooth.impulse * hump)
    steady, drifting = (leading_order(one).r0 for one in (smooth, uneven))
    assert abs(drifting.value - contact_parameters(0.3).r0) <= drifting.bar and drifting.parts["drift"] > 0.1
    assert drifting.parts["drift"] > 20.0 * steady.parts["drift"]
    late = dataclasses.replace(smooth, impulse=np.where(smooth.tau > 0.07, 1.02, 1.0) * smooth.impulse)
    found, half = (leading_order(late, window=window).r0 for window in (10.0, 10.0**0.5))
    assert found.parts["drift"] == pytest.approx(4.0 * abs(half.value - steady.value), rel=0.02)
    for phase in np.linspace(0.0, 5.76, 12):  # a swing that one part of the window hides, another shows
        swing = 1.0 + 0.01 * np.cos(2.0 * np.pi * np.log10(smooth.tau) + phase)
        swung = leading_order(dataclasses.replace(smooth, impulse=smooth.impulse * swing)).r0
        assert swung.parts["drift"] > 4.0 * 0.038 * swung.value


@pytest.mark.parametrize("first", [(4.0, 0.0, 0.0), (1.0, 1.0, 1.0), (-1.0, -1.0, 0.0), (0.0, 0.0, 1.0)])
def test_first_order_is_recovered_with_and_without_uniform_reaction(first):
    exact, (base, leading, runs) = contact_parameters(0.5, *first), pressed(first=first, epsilons=(0.05, 0.1))
    found = first_order(runs, base, leading)
    assert found.r1.value == pytest.approx(exact.r1, abs=0.01 * max(abs(exact.r1), 1.0))
    assert found.lambda1.value == pytest.approx(exact.lambda1, abs=0.02 * max(abs(exact.lambda1), 1.0))
    assert found.uniform_reaction == pytest.approx(max(first[0] + first[1], 0.0), abs=0.02)
    assert found.r1.parts["least"] == pytest.approx(2e-3 * max(abs(found.r1.known), abs(found.lambda1.known)))
    late = base.tau[base.tau >= 0.1 / 8.0]
    assert found.window == (late[0], late[-1]) and found.epsilons == (0.05, 0.1)
    assert found.r1.parts["leading_order"] == 0.0
    of_lambda0, of_r0 = abs(found.r1.known) * leading.lambda0.spread, abs(found.lambda1.known) * leading.r0.spread
    assert found.lambda1.parts["leading_order"] == pytest.approx((of_lambda0 + of_r0) / leading.r0.known)
    assert abs(found.lambda1.value - exact.lambda1) <= found.lambda1.bar + 0.02 * max(abs(exact.lambda1), 1.0)


def test_noise_of_a_run_counts_in_proportion_to_its_epsilon():
    """An error of either run is the same share of what both measure: r₁ is 11.66 for 10.69 at most."""
    base, leading, runs = pressed(first=(4.0, 0.0, 0.0), epsilons=(0.05, 0.1))
    spreads = []
    for disturbed in (0.05, 0.1):
        more = {e: 0.02 * run.tau**1.5 * (e == disturbed) for e, run in runs}
        noisy = [(e, dataclasses.replace(run, impulse=run.impulse + more[e])) for e, run in runs]
        spreads.append(first_order(noisy, base, leading).r1.parts["spread"])
    assert 0.5 < spreads[0] / spreads[1] < 2.0 and 0.01 < min(spreads) and max(spreads) < 1.01 * FACTOR * 0.964


def test_what_the_early_half_of_a_window_adds_is_in_the_bar():
    base, leading, runs = pressed(first=(4.0, 0.0, 0.0), epsilons=(0.05, 0.1))
    early = [(e, dataclasses.replace(r, impulse=r.impulse + 0.02 * r.tau**1.5 * (r.tau < 0.1 / 4.2))) for e, r in runs]
    found, clean = (first_order(some, base, leading).r1 for some in (early, runs))
    assert found.parts["spread"] == pytest.approx(FACTOR * abs(found.known - clean.known), rel=0.01)


def test_a_uniform_reaction_is_taken_out_where_something_presses_the_zone():
    """Whatever the cause: a₀ or tension on a bow. A load that lifts, or one that bends alone, leaves none."""
    pressed, lifted = (synthetic(0.5, (alpha, 0.0, 0.0), 0.1) for alpha in (1.0, -1.0))
    assert moments(pressed).pressure[-50:] == pytest.approx(0.1, rel=0.05)
    exact, tau = contact_parameters(0.5, 1.0), moments(pressed).tau[-50:]
    fronts = np.sqrt(tau) * (exact.lambda0 + 0.1 * exact.lambda1 * tau)
    assert moments(pressed).front[-50:] == pytest.approx(fronts, rel=2e-3)
    bent, both = {"curvature_rate": 0.1}, {"acceleration": -0.05, "axial_force": 0.1}
    runs = ((lifted, {"acceleration": -0.1}), (lifted, bent), (lifted, both), (pressed, {"axial_force": 0.2}))
    for run, loads in runs:
        impact = json.dumps(dataclasses.asdict(Impact.dimensionless(0.5).replace(**loads)))
        pressure = moments(ImpactHistory.of(run.dataset.assign_attrs(impact=impact))).pressure
        assert np.all(pressure == 0.0) if run is lifted else pressure[-50:] == pytest.approx(0.1, rel=0.05)


def test_a_zone_is_lifted_by_the_largest_gap_within_nine_tenths_of_its_front():
    """Off the wall by a tenth of its place and of the time."""
    run = synthetic(0.5, (1.0, 0.5, 0.0), 0.1).dataset
    found = moments(ImpactHistory.of(run.assign(gap=0.1 * run["time"] * run["x"])))
    assert found.lift[-1] == pytest.approx(0.09 * found.front[-1], rel=0.02)


def test_companions_that_differ_and_a_reaction_that_does_not_reach_the_load_widen_the_error_bars():
    """A zone that the start has left open takes up the load late: what is missing is not seen in any spread."""
    base, leading, runs = pressed()
    found = first_order(runs, base, leading)
    other = dataclasses.replace(found, r1=Number(found.r1.value + 0.3, 0.0))
    wider = first_order(runs, base, leading, companions=[other, found])
    assert (wider.r1.value, wider.lambda1) == (found.r1.value, found.lambda1)
    assert wider.r1.bar == pytest.approx(found.r1.bar + FACTOR * 0.3)
    bare = first_order(runs, base, leading, pressure=0.0).r1.parts["uniform_reaction"]  # 1.5 that nothing presses
    assert bare == pytest.approx(2.5 * 1.5 * leading.lambda0.known / SIDE, rel=0.02)
    uneven = [(e, dataclasses.replace(run, pressure=e * (1.5 + 0.3 * np.sin(1e4 * run.tau)))) for e, run in runs]
    lacks = 2.5 * 0.3 / np.sqrt(2.0) * leading.lambda0.known / SIDE
    assert first_order(uneven, base, leading).r1.parts["uniform_reaction"] == pytest.approx(lacks, rel=0.1)
    with pytest.raises(ValueError, match="same times"):
        first_order([(e, dataclasses.replace(run, tau=1.001 * run.tau)) for e, run in runs], base, leading)
    full, open_zone = (first_order(runs, base, leading, pressure=pressure) for pressure in (1.5, 2.0))
    assert open_zone.r1.value == full.r1.value
    assert open_zone.r1.bar > 0.5 and open_zone.lambda1.bar > 0.25 > 5.0 * full.lambda1.bar
    force, front = (one.parts["uniform_reaction"] for one in (open_zone.r1, open_zone.lambda1))
    assert front / force == pytest.approx(0.5 * leading.lambda0.known / leading.r0.known)  # λ₀r₁ + r₀λ₁ is the moment


def test_a_zone_that_should_lift_and_does_not_widens_the_error_bars():
    base, leading, runs = pressed(uniform=False, first=(-1.0, 0.0, 0.0))
    lifted = [(e, dataclasses.replace(run, lift=run.tau)) for e, run in runs]
    pushed = [(e, dataclasses.replace(run, pressure=run.pressure + 0.5 * e)) for e, run in lifted]  # as by springs
    rattling = dataclasses.replace(base, pressure=base.pressure + 0.05)  # by half a load, which is not there with it
    whole = contact_parameters(0.5).lambda0 / SIDE  # of the load
    hits = 2.5 * 3.0 * 0.5 * whole
    stuck = [(runs, base, -1.0, whole), (runs, base, -2.0, 2.0 * whole)]
    for some, at_rest, pressure, lacks in (*stuck, (lifted, base, -1.0, 0.0), (pushed, base, -1.0, hits),
                                           (lifted, rattling, -1.0, hits), (pushed, rattling, -1.0, 0.0),
                                           (runs, rattling, -1.0, hits + whole)):  # fmt: skip
        found = first_order(some, at_rest, leading, pressure=pressure)
        assert found.r1.parts["uniform_reaction"] == pytest.approx(lacks, rel=0.01, abs=0.01 * whole)
    thrown = dataclasses.replace(leading, lift=0.03)
    for pressure, more in ((-1.0, 0.2), (1.0, 0.0), (0.0, 0.0), (None, 0.0)):
        low, high = (first_order(lifted, base, one, pressure=pressure).r1.parts["lift"] for one in (leading, thrown))
        assert high - low == pytest.approx((2.0 * 0.3 * 0.03 + more) * abs(found.r1.known), rel=1e-3)


@pytest.mark.parametrize(("found", "front"), [(1e-18, 0.0), (9e-6, 0.0), (2e-5, 2e-5)])
def test_a_front_within_its_error_bar_is_none(found, front):
    """Round-off of a contact in one point must not set the size of the loads, nor λ₁."""
    assert dataclasses.replace(leading_order(moments(synthetic(0.5))), lambda0=Number(found, 1e-5)).front == front


def test_a_whole_beam_has_the_moments_of_its_half_the_uniform_reaction_too():
    half = synthetic(0.5, (1.0, 0.5, 0.0), 0.1)
    x, impulse = half.positions(0), half.array("impulse")
    mirrored = {"impulse": np.c_[impulse[:, :0:-1], 2.0 * impulse[:, :1], impulse[:, 1:]], "symmetry": "full"}
    total = half.array("total_impulse")
    whole = history_of(half.time, np.r_[-x[:0:-1], x], impact=half.impact, total_impulse=total, **mirrored)
    one, other = moments(half), moments(whole)
    assert other.impulse == pytest.approx(one.impulse, rel=2e-3) and other.moment == pytest.approx(one.moment, rel=2e-3)
    assert other.pressure[20:] == pytest.approx(one.pressure[20:], rel=0.02) and one.pressure[-1] > 0.1


@pytest.mark.parametrize(("first", "epsilon"), [((0.0, 0.0, 0.0), 0.0), ((1.0, 0.5, 0.0), 1.0)])
def test_the_first_front_is_where_the_zone_ends_whatever_the_zone_bears(first, epsilon):
    history, exact = synthetic(0.5, first, epsilon), contact_parameters(0.5, *first)
    for k, error in ((120, 1e-3), (170, 1e-3), (-1, 1e-2)):
        tau = history.time[k]
        front = np.sqrt(tau) * (exact.lambda0 + epsilon * exact.lambda1 * tau)
        assert first_front(history, tau)[0] == pytest.approx(front, rel=error)
    assert first_front(history, tau)[1] == 0.0  # of the last instant nothing after it tells how it differs from √t


def test_two_saved_instants_tell_the_uniform_reaction_between_them():
    run, kept = synthetic(0.5, (1.0, 0.5, 0.0), 0.1), [120, 199]
    impulse, total = run.array("impulse")[kept], run.array("total_impulse")[kept]
    few = history_of(run.time[kept], run.positions(0), impact=run.impact, impulse=impulse, total_impulse=total)
    assert moments(few).pressure[1] == pytest.approx(0.1 * 1.5, rel=0.1)
    assert moments(few).impulse[0] == pytest.approx(impulse[0].sum())  # nothing is known of what was before
