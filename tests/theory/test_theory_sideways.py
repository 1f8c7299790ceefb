"""A turning beam slides or sticks: the law of the contacts, the impulses along the wall."""

import numpy as np
import pytest
from twins import EXACT, in_units

from bent_beam.impact import Impact
from theory import ImpactFields, contact_parameters, predict
from theory.sideways import sideways

PIPE = Impact(1.224e6, 29.02, 90.0, 0.002, 2.0)


def test_a_fast_surface_slides_for_ever_and_a_slow_one_sticks_at_once() -> None:
    fast, slow = sideways(PIPE, 1.0, 0.3, 0.01, radius=0.0635), sideways(PIPE, 0.5, 0.3, 0.01, radius=0.0635)
    normal = predict(PIPE, 0.01).times[0]
    assert (fast.motion, fast.ratio, fast.sticks_at) == ("slides", 0.3, None)
    assert (slow.motion, slow.ratio, slow.sticks_at) == ("sticks", 0.25, 0.0)
    assert fast.times[0].push == pytest.approx(0.3 * normal.reaction)
    assert fast.times[0].push_impulse == pytest.approx(0.3 * normal.impulse)
    assert slow.times[0].torque_impulse == pytest.approx(0.0635 * 0.25 * normal.impulse)
    # a stuck contact needs less than friction can give
    assert slow.times[0].push < 0.3 * normal.reaction
    assert sideways(PIPE, 1.0, 0.3, 0.01).times[0].torque_impulse is None
    assert sideways(PIPE.replace(acceleration=-1.0), 1.0, 0.3).sticks_at is None  # it slows down


@pytest.mark.parametrize(("alpha", "chi"), [(1.0, 0.0), (0.5, 1.0), (2.0, -1.0), (-1.0, 2.0)])
def test_contacts_reach_the_surface_when_it_is_said_that_they_stick(alpha: float, chi: float) -> None:
    # z_t = μ_f η_t at the loaded contacts, from the fields themselves
    friction, speed = 0.4, 0.42
    impact = Impact.dimensionless(0.5, epsilon_alpha=alpha, epsilon_chi=chi)
    found = sideways(impact, speed, friction)
    shorter = sideways(in_units(impact, EXACT), speed * EXACT["m"] / EXACT["s"], friction)
    assert shorter.sticks_at == pytest.approx(found.sticks_at * EXACT["s"])
    assert found.motion == "slides"
    parameters = contact_parameters(0.5, alpha, 0.0, chi)
    fields = ImpactFields(parameters, epsilon=1.0)
    front = parameters.lambda0 * np.sqrt(found.sticks_at)
    places = [front, 0.0] if alpha >= 0.0 else [front]
    fastest = max(float(fields.slow_motion(x, found.sticks_at).velocity) for x in places)
    assert friction * fastest == pytest.approx(speed, rel=1e-12)
    rows = sideways(impact, speed, friction, [0.5 * found.sticks_at, 1.5 * found.sticks_at]).times
    assert not rows[1].valid
