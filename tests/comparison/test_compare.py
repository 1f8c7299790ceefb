"""Two runs side by side, for a reader."""

import pytest

from comparison.compare import comparison_text


@pytest.mark.parametrize(
    ("mine", "other", "said"),
    [
        ("even", "graded", "'even' | 'graded'"),
        ([*range(9)], [0, 1, 2, 3, 4, 5, 6, 8, 8], "first differ at [7]: 7 | 8"),
        ([*range(9)], [*range(8)], "9 values | 8 values, the same up to [8]"),
        ({"nodes": [*range(9)]}, {"nodes": [*range(8), 9]}, "first differ at ['nodes'][8]: 8 | 9"),
        ("=" * 300 + "a" + "=" * 300, "=" * 300 + "b" + "=" * 300, "first differ at [300]: 'a"),
    ],
)
def test_settings_that_differ_are_not_shown_as_equal(mine, other, said):
    found = {
        "end": {"time": [1.0, 1.0]},
        "largest_difference": {"gap": None},
        "same_impact": True,
        "settings": {"mesh": [mine, other]},
        "versions": {},
    }
    line = comparison_text(found, "a", "b").splitlines()[-1]
    assert line.startswith("mesh: " + said)
    assert len(line) < 500
