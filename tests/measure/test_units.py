"""What is read from a record does not depend on the units in which it is written, whatever the record says."""

from dataclasses import replace

import numpy as np
import pytest
from histories import history_of
from twins import BEAM, BETWEEN, EXACT, LOADED, OF_HIT, OF_INSTANT, SHEARED, SOFT, agree, retold

from bent_beam.measure.balance import balance_of
from bent_beam.measure.instant import instant
from bent_beam.measure.moments import moments, unresolved_at_end
from bent_beam.measure.whole_impact import hits, whole_impact

NODES = ("gap", "velocity", "slope", "angle", "angular_velocity", "impulse", "opposite_impulse")
STILL = (*NODES[:5], "kinetic_energy", "strain_energy", "peak_force_time", "largest_moment", "largest_midspan_moment")
GROWS = (*NODES[5:], "total_impulse", "law_impulse", "peak_force", "peak_penetration", "peak_pressure", "work_of_loads")


@pytest.mark.parametrize("impact", [BEAM, LOADED, SHEARED.replace(axial_force=0.0), BETWEEN.replace(**SOFT)])
def test_a_record_of_any_numbers_says_the_same_in_other_units(impact) -> None:
    """The wall pushes until 0.6 of 4 T*, and rests twice, for 0.05 T* and for 0.001 T*, which does not count."""
    draw, unit, full = np.random.default_rng(5), impact.slow_time_scale, impact.off_centre
    time = unit * np.sort(np.concatenate([np.linspace(0.0, 4.0, 161), [1e-4, 1e-3, 0.301]]))
    x = impact.half_length * np.array([-1.0, -0.62, -0.3, 0.0, 0.17, 0.4, 0.71, 1.0])[0 if full else 3 :]
    rests = (time > 0.6 * unit) | (np.abs(time / unit - 0.21) < 0.02) | (time == 0.301 * unit)
    fields = {}
    for name in (*STILL, *GROWS, "largest_moment_place", "contact_energy"):
        values = draw.uniform(-0.1 if name == "gap" else 0.1, 1.0, (time.size, x.size) if name in NODES else time.size)
        fields[name] = np.cumsum(values.T * ~rests, axis=-1).T if name in GROWS else values
    one = history_of(time, x, impact=impact, symmetry="full" if full else "half", **fields)
    if impact is LOADED:  # whose ends carry the forces of the free motion
        one = replace(one, attrs={**one.attrs, "settings": '{"ends": "following"}'})
    both, times = (one, retold(one, EXACT)), (0.5 * unit, 0.5 * unit * EXACT["s"])
    agree(*(balance_of(each) for each in both))
    agree(*(moments(each, uniform=True) for each in both))
    few = replace(moments(one), front=np.array([0.3]))  # not yet three elements, in l*
    assert unresolved_at_end(both[0], few) == pytest.approx(unresolved_at_end(both[1], few), rel=1e-9) != 0.0
    agree(*(instant(each, at, first_spread=True) for each, at in zip(both, times)), OF_INSTANT)
    agree(*(whole_impact(each) for each in both), {"supplied": "J"})
    assert len(whole_impact(one).contacts) == 2
    for hit, its in zip(*map(hits, both), strict=True):
        agree(hit, its, OF_HIT)
