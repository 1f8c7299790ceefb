"""The examples in the docstrings of the ten names that people start with."""

import doctest
from pathlib import Path

import pytest

from bent_beam import Impact, ImpactHistory, load_case
from bent_beam.measure.estimators import leading_order
from comparison.matching import match
from hermite_fe import HermiteFE
from self_similar_fe import SelfSimilarFE
from theory import contact_parameters, peak_moment, predict

LONG = pytest.param(HermiteFE, marks=pytest.mark.verify)
NAMES = (Impact, ImpactHistory, load_case, match, LONG, leading_order, SelfSimilarFE, contact_parameters)


@pytest.mark.parametrize("name", (*NAMES, peak_moment, predict), ids=lambda name: name.__name__)
def test_the_example_of_a_name_gives_what_it_shows(name, monkeypatch):
    monkeypatch.chdir(Path(__file__).resolve().parents[2])
    found = doctest.DocTestFinder(recurse=False).find(name, name.__name__, globs={})
    assert found and found[0].examples
    assert doctest.DocTestRunner().run(found[0]).failed == 0
