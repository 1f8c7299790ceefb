"""The page makes numbers with bars of its runs by the rules of ``bounce`` (comparison/test_numbers_of_runs.py)."""

import math
import re
from typing import Any

import numpy as np
import pytest
from markdown_tables import RAISED
from page_scripts import evaluated

from bent_beam.measure.numbers import FACTOR, Number


def test_a_force_that_still_rises_when_the_page_gives_up_is_no_largest() -> None:
    """As in ``bounce`` (comparison/test_bounce.py): a wall that would not throw the beam off in 100 T*."""
    largest = """given.map((k) => {
        const p = {...Beam.problem(Beam.impact(Beam.START), 0.01), load: 0, wall: {k, c: 0}};
        const run = Solver.simulate(p, {elements: 8, steps: 40}), found = Answer.numbers(p, {base: run}), runs = {};
        for (const name in Answer.runs(p)) runs[name] = run;
        const { force, moment } = Answer.numbers(p, runs);
        return [found.force.value, force.value, moment.value]; })"""
    soft, softer = evaluated(largest, [0.05, 1e-4])
    assert soft[0] == soft[1] == pytest.approx(2.0 * math.sqrt(0.05), rel=0.05) and None not in soft
    assert softer[0] > 0.0 and softer[1] is None  # while other runs are missing, a first number has no bar


def numbers_of(runs: list[Any]) -> list[dict[str, Any]]:
    """The page's numbers from the readings of a run and of its companions, of which the last stands for those that
    follow; each gives only what differs from ``read``."""
    read = {"restitution": 0.5, "impulse": 3, "lastContact": 0.6, "begin": 0.5, "apart": 0.1, "returns": [], "late": {},
            "force": 0, "moment": 2, "place": 0, "time": 0.3, "frames": [{"t": 0.2, "force": [0, 0]}], "steps": 1000,
            "course": [2, 2]}  # fmt: skip
    expression = """given.map((read) => {
        const p = {...Beam.problem(Beam.impact(Beam.START), 0.01), ...read[0].problem}, runs = {};
        Object.keys(Answer.runs(p)).forEach((name, i) => { runs[name] = read[Math.min(i, read.length - 1)]; });
        return {...Answer.numbers(p, runs), names: Object.keys(runs)}; })"""
    return list(evaluated(expression, [[read | one for one in every] for every in runs]))


def test_a_flat_beam_s_rebound_and_a_push_on_one_sheared_point_are_as_unsure_as_in_bounce() -> None:
    """A push of 4 on one node of two elements: flat over 4/κ_sGA(κ − M), and never wider than an element."""
    other = {"restitution": 0.5 + 1e-9, "impulse": 3 + 1e-9, "moment": 2 + 1e-9}
    beams = [{"kappa": kappa, "shear": shear} for kappa, shear in ((0.5, 4e6), (0.02, 4e6), (3, 400), (3, 1), (3, 0))]
    beams.append({"kappa": 0.5, "shear": 4e6, "wall": {"k": 1e4, "c": 0}})
    frames = [{"t": t, "force": force} for t, force in ((0.2, [9, 9, 9]), (0.4, [8, 0, 0]), (0.6, [9, 9, 9]))]
    given = [{"frames": frames, "problem": {"before": 0, "wall": None} | beam} for beam in beams]
    found = numbers_of([(one, other) for one in given])
    bars = [[one[name]["bar"] for name in ("restitution", "impulse", "moment")] for one in found]
    shares, spread = [4e-4, 1e-2, 1e-4, 1e-4, 1e-4, 1e-4], [0.25, 0.25, 0.005, 0.25, 0.0, 0.0]
    expected = [[1.5 * share, 3.0 * share, max(lost, 2e-4)] for share, lost in zip(shares, spread)]
    assert [bar for one in bars for bar in one] == pytest.approx([bar for one in expected for bar in one], rel=1e-4)


def test_maxima_that_agree_by_chance_have_a_bar_for_what_is_about_them() -> None:
    """Two companions have the same largest moment and fall off more steeply; a third has it at another time."""

    def course(slope: float, steps: int, length: int) -> dict[str, Any]:
        return {"steps": steps, "course": [2.0 - slope * abs(k / steps - 0.3) for k in range(length)]}

    companions = [course(60.0, 500, length) | {"time": time} for time, length in ((0.3, 500), (0.7, 500), (0.3, 151))]
    found = numbers_of([(course(10.0, 1000, 1000), companion) for companion in companions])
    alike, elsewhere, ended = (one["moment"]["bar"] for one in found)  # the last at its largest
    changes = 50.0 * np.array([0.002, 0.001, 0.0, 0.001, 0.002])  # one step of the companions' lies between two
    assert alike == pytest.approx(2.0 * FACTOR * math.sqrt(np.mean(changes**2)), rel=0.1)
    assert ended == pytest.approx(2.0 * FACTOR * math.sqrt(np.mean(changes[:3] ** 2)), rel=0.1)
    assert elsewhere < 0.1 * alike < ended


def test_the_last_part_of_a_contact_may_be_none_on_the_page_too() -> None:
    """It begins at 0.5 T*, 0.1 T* after the part before it, and gives half of 0.18 or of 0.22 μℓV₀."""
    both = ({"earlier": 3.0 - push} for push in (0.18, 0.22))
    wide, narrow = numbers_of([(given, given | {"restitution": 0.52}) for given in both])
    assert wide["restitution"]["bar"] == pytest.approx(2.0 * FACTOR * 0.02)
    assert wide["lastContact"]["bar"] - narrow["lastContact"]["bar"] == pytest.approx(0.2)


def test_laws_that_agree_by_chance_are_compared_on_half_of_the_elements_on_the_page_too() -> None:
    """The larger of two changes counts, of the restitution and not of the moment."""
    rigid = {"problem": {"wall": None, "kappa": 1, "before": 0, "shear": 0}}
    changes = [[0.0, -0.02, law, 0.04] for law in (0.01, 0.07)]
    runs = [[rigid | {"restitution": 0.5 + d, "moment": 2.0 + d} for d in every] for every in changes]
    for law, laws, found in zip((0.01, 0.07), (0.06, 0.07), numbers_of(runs), strict=True):
        assert found["names"] == ["base", "half", "law", "lawOfHalf"]
        bars = [found[name]["bar"] for name in ("restitution", "moment")]
        assert bars == pytest.approx([FACTOR * (0.02 + laws), FACTOR * (0.02 + law)])
    (point,) = numbers_of([({"problem": {"kappa": 2}},)])
    assert point["names"] == ["base", "half", "law"]


def test_a_value_is_rounded_to_the_first_digit_of_its_bar_as_python_writes_it() -> None:
    rng = np.random.default_rng(8)
    values = rng.choice([-1.0, 1.0], 300) * 10.0 ** rng.uniform(-7.0, 9.0, 300)
    pairs = [(408.3, 48.0), (0.97, 0.096), (3.0, 20.0), (2.0, 0.0), (12.94, 53.0), (1018.0, 9051.0),
        (0.996, 2.0), (9.97, 20.0), (99.7, 300.0), (0.32, 2e4)]  # fmt: skip
    pairs += zip(values.tolist(), (abs(values) * 10.0 ** rng.uniform(-5.0, 2.0, 300)).tolist(), strict=True)
    written = evaluated("given.map(([value, error]) => Draw.bar(value, error))", pairs)
    power = re.compile(r"·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)")
    plain = [power.sub(lambda m: f"e{int(m[1].translate(RAISED)):+03d}", text).replace("−", "-") for text in written]
    two_digits = ["13 ± 50", "1000 ± 9000", "1.0 ± 2", "10 ± 20", "100 ± 300"]
    assert plain[4:9] == two_digits  # a value within its bar keeps two digits
    assert plain == [str(Number(*pair)) if pair[1] else "2 ± 0" for pair in pairs]
