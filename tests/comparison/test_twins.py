"""A run in other units is the same run, in every number of its record and of what is read from it, on every path."""

import pytest
from twins import EXACT, RUNS, agree, differences, run

from bent_beam.measure.balance import balance_of
from bent_beam.measure.instant import instant
from bent_beam.measure.whole_impact import hits, whole_impact

OF_INSTANT = {"half_contact_length": "m", "element": "m", "reaction": "N", "impulse": "N s", "impulse_around": "N s"}
OF_INSTANT |= {f"peak_{name}": unit for name, unit in zip(("force", "pressure", "penetration"), ("N", "N/m", "m"))}
OF_INSTANT |= {"peak_moment": "N m", "moment_left_out": "N m", "peak_moment_place": "m", "peak_moment_time": "s"}
OF_INSTANT |= {"peak_force_time": "s", "peak_force_place": "m"}
OF_HIT = {"begin": "s", "end": "s", "place": "m", "impulse": "N s", "energy": "J", "lost": "J"}
OF_HIT |= dict.fromkeys(("before", "after"), "m/s")


@pytest.mark.parametrize("kind", RUNS)
def test_every_number_of_a_run_changes_with_its_unit(kind):
    runs = run(kind), run(kind, EXACT)
    found = differences(*runs, EXACT)
    assert {"gap", "impulse", "total_impulse", "kinetic_energy", "strain_energy"} <= found.keys()
    assert max(found.values()) < 1e-9, found
    agree(*(balance_of(one) for one in runs))
    agree(*(instant(one, 0.5 * one.time[-1]) for one in runs), OF_INSTANT)
    if not kind.startswith("expanding"):  # no whole beam
        agree(*(whole_impact(one) for one in runs), {"supplied": "J"})
        for one, other in zip(*map(hits, runs), strict=True):
            agree(one, other, OF_HIT)
