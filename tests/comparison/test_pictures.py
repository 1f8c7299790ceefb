"""Pictures of a run: nothing is cut off, the number is marked, the wall is below, heights are to the scale stated."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from called import answered, refused
from histories import pushed_until, recorded, rod

from bent_beam.cases import load_case
from bent_beam.history import Variable
from bent_beam.measure.numbers import Number
from comparison import bounce, predict
from comparison.figures import style
from comparison.figures.history import _window, draw_history
from comparison.figures.panels import draw_zone, sheet
from comparison.figures.sweep import sweep_figure


def inside(axis):
    """Whether every curve and surface of an axis is within its limits, what is drawn in shares of it left out."""
    low, high = sorted(axis.get_ylim())
    curves = [line for line in axis.lines if line.get_transform() == axis.transData]
    stairs = [patch.get_data().values for patch in axis.patches if hasattr(patch, "get_data")]
    stairs += [surface.get_datalim(axis.transData).intervaly for surface in axis.collections]
    values = np.concatenate([[low], *(np.asarray(line.get_ydata(), float) for line in curves), *stairs])
    return low <= values.min() and values.max() <= high


def test_a_run_that_failed_in_its_first_step_is_nothing_to_draw(tmp_path) -> None:
    one = recorded(np.zeros(1), np.zeros((1, 5)))
    with pytest.raises(ValueError, match=r"x.partial: one saved instant is nothing to draw"):
        draw_history(one, tmp_path, "x.partial")


@pytest.mark.parametrize("tables", ["", "[wall]\nstiffness = 1e5", "[wall]\nopposite = 0.01\n[run]\nend_time = 0.02"])
def test_nothing_is_cut_off_and_the_largest_values_are_marked_with_their_numbers(tables, tmp_path):
    case = load_case(rod(tmp_path, tables, element=0.1))
    two = case.impact.opposite_wall is not None
    found = predict(case, case.end_time) if two else bounce(case)
    fig = found.plot()
    push, stress, zone, shapes = fig.axes
    assert fig.get_suptitle() == "A rod, path hermite" and all(inside(axis) for axis in fig.axes)
    numbers = found.to_dict()
    known = numbers["times"][-1]["simulation"]["peak_stress"] if two else numbers["peak_stress"]
    (mark,) = [line for line in stress.lines if line.get_marker() == "o"]
    within = 0.05 if two else 1e-9  # of the instants that are saved
    assert mark.get_ydata()[0] == pytest.approx(1e-6 * known["value"], rel=within)
    assert any("largest" in text.get_text() and "±" in text.get_text() for text in stress.texts)
    assert ("largest" in " ".join(text.get_text() for text in push.texts)) == (case.impact.wall_stiffness is not None)
    assert {axis.get_xlim()[0] for axis in (push, stress, zone)} == {0.0}
    said = float(re.fullmatch(r"heights × ([\d.,]+)", shapes.get_title(loc="right"))[1].replace(",", ""))
    box, (left, right), (low, high) = shapes.get_window_extent(), shapes.get_xlim(), shapes.get_ylim()
    drawn = box.height / (high - low) / (box.width / (right - left))
    assert drawn == pytest.approx(said, rel=0.02)
    first = next(line for line in shapes.lines if len(line.get_xdata()) > 2).get_ydata()
    assert np.argmin(first) == pytest.approx(first.size // 2, abs=1)  # its apex is nearest to the wall, which is below


def test_the_picture_of_a_stored_run_ends_soon_after_the_last_push_and_not_with_the_record():
    end, _ = _window(pushed_until(0.5, last=8.0))
    assert 0.5 <= end <= 0.6


@pytest.mark.parametrize("end, rising", [(2.0, False), (1.0, True)])
def test_a_value_that_is_largest_where_the_picture_ends_is_said_to_rise_still(end, rising):
    """Force and moment grow until 1 and fall; only the picture that ends before tells no largest value."""
    time = np.linspace(0.0, 2.0, 41)
    until = np.minimum(time, 1.0)
    peaks = {"peak_force": until, "peak_force_time": until - 0.025, "peak_penetration": until, "peak_pressure": until}
    fig = sheet(pushed_until(2.0, moment=until - 0.5 * (time - until), **peaks), "", end)
    for axis in fig.axes[:2]:
        (words,) = [text.get_text() for text in axis.texts if text.get_text().startswith("largest")]
        assert words.endswith(", still rising") == rising
        (mark,) = [line for line in axis.lines if line.get_marker() == "o"]
        assert not mark.get_clip_on()  # at the end of the axis it is whole


def drawn_zone(given, contact_x):
    """Rectangles (start, lowest, stop, highest), ms and m, of the zone drawn of a half beam with nodes at 0, 0.25 … 1
    that gives impulses ``given`` (times, contacts) at the places ``contact_x``."""
    run, time = recorded(np.arange(float(len(given))), np.zeros((len(given), 5))), ("time", "contact")
    places = {"contact_x": Variable(("contact",), np.array(contact_x), {}), "impulse": Variable(time, given, {})}
    run = replace(run, variables={**run.variables, **places})
    with style.figure() as (_, axis):
        draw_zone(axis, run, float(run.time[-1]))
    return {(*part.vertices.min(axis=0), *part.vertices.max(axis=0)) for part in axis.collections[0].get_paths()}


def mirrored(upper):
    return upper | {(start, -top, stop, -low) for start, low, stop, top in upper}


def test_each_pushing_node_is_drawn_with_half_an_element_to_either_side():
    """First the middle one, then it and the next, then the last one alone."""
    given = np.array([[0.0, 0, 0, 0, 0], [1, 0, 0, 0, 0], [2, 1, 0, 0, 0], [2, 1, 0, 0, 1]])
    found = drawn_zone(given, [0.0, 0.25, 0.5, 0.75, 1.0])
    assert found == mirrored({(0.0, 0.0, 1e3, 0.125), (1e3, 0.0, 2e3, 0.375), (2e3, 0.875, 3e3, 1.0)})


@pytest.mark.parametrize(
    "places, which, zones",
    [
        ([0.125, 0.375, 0.625, 0.875], [0], [(0.0, 0.25)]),  # middles of elements
        ([0.125, 0.375, 0.625, 0.875], [1, 2], [(0.25, 0.75)]),
        ([0.0, 0.5, 1.0], [1, 2], [(0.25, 1.0)]),  # every other node
        ([0.0, 0.125, 0.875, 1.0], [0, 1, 2, 3], [(0.0, 0.25), (0.75, 1.0)]),  # two walls
        ([0.0, 0.125, 0.375, 0.875], [0, 1, 2, 3], [(0.0, 1.0)]),  # ever coarser
        ([0.5], [0], [(0.375, 0.625)]),  # a stop
    ],
)
def test_contact_points_anywhere_are_drawn_up_to_halfway_to_their_neighbours_and_no_gap_is_filled(places, which, zones):
    given = np.zeros((2, len(places)))
    given[1, which] = 1.0
    assert drawn_zone(given, places) == mirrored({(0.0, low, 1e3, high) for low, high in zones})


def map_of(stresses, restitutions):
    """The picture of a sweep over three velocities and three lengths with these numbers, a row each."""
    rows = [
        SimpleNamespace(yield_stress=None, numbers={"peak_stress": stress, "restitution": restitution})
        for stress, restitution in zip(stresses, restitutions, strict=True)
    ]
    vary = {"impact.velocity": [1.0, 2.0, 3.0], "beam.length": [1.0, 2.0, 3.0]}
    units = {"impact.velocity": "m/s", "beam.length": "m"}
    return sweep_figure(SimpleNamespace(vary=vary, rows=rows, units=units, title=""))


STRESSES = [Number(1e7 * (1 + k), 1e5) for k in range(9)]


@pytest.mark.parametrize("bars, finest, coarsest", [([0.01] * 8 + [0.11], 0.04, 0.06), ([0.11] * 9, 0.11, 0.25)])
def test_contours_of_a_sweep_are_no_finer_than_its_median_bar_and_the_bars_are_said(bars, finest, coarsest):
    """One wide row has a ring and leaves the contours of all others."""
    fig = map_of(STRESSES, [Number(0.1 + 0.05 * k, bar) for k, bar in enumerate(bars)])
    stress, restitution, *colour_bars = fig.axes
    assert [axis.get_title() for axis in (stress, restitution)] == ["largest stress  (MPa)", "restitution"]
    assert (stress.get_xlabel(), stress.get_ylabel()) == ("velocity  (m/s)", "length  (m)")
    steps = [np.diff(axis.get_yticks()).min() for axis in colour_bars]
    assert steps[0] <= 15.0 and finest <= steps[1] <= coarsest
    rings = sum(len(line.get_xdata()) for line in restitution.lines if line.get_marker() == "o")
    assert rings == sum(bar > 0.1 * (0.1 + 0.05 * k) for k, bar in enumerate(bars))
    assert all(text.get_clip_on() is False for axis in (stress, restitution) for text in axis.texts)
    said = fig.legends[0].get_title().get_text()
    assert f"± 0.1 MPa (median), at most ± 0.1 MPa; restitution ± {bars[0]} (median), at most ± {bars[-1]}." in said


def test_a_map_says_its_bars_without_powers_of_ten_and_counts_none_that_is_missing():
    stresses = [Number(1e9 * (1 + k), 1.2e8 if k < 2 else None) for k in range(9)]
    said = map_of(stresses, [Number(0.1 + 0.05 * k) for k in range(9)]).legends[0].get_title().get_text()
    assert "largest stress ± 120 MPa (median), at most ± 120 MPa; restitution: no bar." in said


def test_predict_writes_document_and_picture_and_refuses_without_a_simulation(tmp_path):
    file = rod(tmp_path, element=0.1)
    answered("predict", file, "--time", 0.001, "--out", tmp_path / "out")
    assert {one.name for one in (tmp_path / "out").iterdir()} == {"predict.json", "predict.png"}
    assert "nothing" in refused("predict", file, "--theory-only", "--out", tmp_path / "none")
    with pytest.raises(ValueError, match="nothing"):
        predict(file, theory_only=True).plot()


@pytest.mark.parametrize("whole", [False, pytest.param(True, marks=pytest.mark.verify)])
def test_a_picture_has_the_same_bytes_when_it_is_drawn_again(whole, tmp_path, monkeypatch):
    """In each format, a whole sheet in the one that names its parts; without time stamps."""
    for folder, time in ((tmp_path / "a", "0"), (tmp_path / "b", "1")):
        monkeypatch.setenv("SOURCE_DATE_EPOCH", time)  # Matplotlib's clock
        with style.figure() as (fig, axis):
            axis.plot([0.0, 1.0], [0.0, 1.0], **style.HERMITE)
        style.save(fig, folder, "line", ["png", "svg", "pdf"])
        if whole:
            draw_history(pushed_until(0.5), folder, "run", ["svg"])
    files = sorted((tmp_path / "a").iterdir())
    assert len(files) == 3 + whole and all(f.read_bytes() == (tmp_path / "b" / f.name).read_bytes() for f in files)
