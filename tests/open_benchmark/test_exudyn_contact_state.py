"""The reproducer for Exudyn's authors: short, on its own, and it still shows what the page says."""

import re
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs" / "exudyn_contact_state.md"


def source():
    found = re.search(r'^```python title="contact_state.py"\n(.*?)^```', PAGE.read_text(), re.S | re.M)
    assert found
    return found[1]


def test_capturing_steps_use_up_their_repetitions_and_do_not_with_the_fix():
    space = {"__name__": "reproducer"}
    exec(source(), space)
    run = space["run"]
    (steps, before, exhausted, _), (again, after, left, contradictory) = run(False), run(True)
    assert steps == again == 400
    assert exhausted > 20 and left == 0 and contradictory == 0
    assert after < 0.5 * before
