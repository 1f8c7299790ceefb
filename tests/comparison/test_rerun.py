"""``bentbeam rerun``: a stored run again, compared variable by variable."""

import pytest

from bent_beam import Impact, ImpactHistory
from comparison.compare import rerun_history
from self_similar_fe import SelfSimilarFE


def test_times_and_places_that_have_moved_are_a_difference():
    dataset = SelfSimilarFE(refine=0.5).simulate(Impact.dimensionless(0.5), end_time=0.1, save=8).dataset
    assert rerun_history(ImpactHistory.of(dataset))["identical"]
    for moved in ("time", "x", "contact_x"):
        found = rerun_history(ImpactHistory.of(dataset.assign_coords({moved: 1.5 * dataset[moved]})))
        assert not found["identical"] and found["largest_difference"] == {moved: pytest.approx(1.0 / 3.0)}
