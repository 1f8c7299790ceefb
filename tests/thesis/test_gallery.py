"""The gallery: every number of the thesis is there, known points of the curves are in the CSV files."""

import csv
import dataclasses
import functools
import io
from typing import Any

import numpy as np
import pytest
from here import ROOT

from bent_beam_programs.thesis import gallery
from bent_beam_programs.thesis.gallery import ITEMS, draw_all, listing
from bent_beam_programs.thesis.gallery.drawing import REACTION, run_figure
from bent_beam_programs.thesis.gallery.runs import Series
from bent_beam_programs.thesis.sheet import Sheet, order
from bent_beam_programs.thesis.studies.panels import contact_length
from hermite_fe import HermiteFE
from self_similar_fe import SelfSimilarFE
from theory import contact_parameters, kernel

LAST = {"fig-2": 18, "fig-3": 36, "fig-A": 3, "table-3": 4}  # of the thesis's figures and tables
PAIRS = ("fig-2.7", "fig-2.12", "fig-2.16")  # drawn as a and b
OTHERS = "filter uniform fine conditioning signorini coupling masses a0-17"
QUICK = "fig-2.1 fig-2.4 fig-2.5 fig-2.6 fig-3.1 fig-3.22 table-3.2 table-3.4".split()  # without POINTS
OURS = (HermiteFE().label, SelfSimilarFE().label)
SLOW = pytest.mark.verify


@functools.cache
def sheet_of(name: str) -> Sheet:
    """An item's data and numbers; its picture, which takes longest, is not written."""
    sheet = Sheet()
    ITEMS[name].draw(sheet)
    return sheet


@functools.cache
def cells(name: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(sheet_of(name).csv())))


def curve(name: str, series: str, panel: str = "") -> tuple[np.ndarray, np.ndarray]:
    chosen = [r for r in cells(name) if r["series"] == series and r["panel"] == panel]
    assert chosen, f"{name}: no curve {series!r} in panel {panel!r}"
    return np.array([float(r["x"]) for r in chosen]), np.array([float(r["y"]) for r in chosen])


def number(name: str, what: str) -> float:
    return float(sheet_of(name).numbers[what] or np.nan)


def follows(found: Any, exact: Any, begin: float, end: float = np.inf, within: float = 2e-2) -> None:
    """One curve is another between two places."""
    x, y = found
    shown = (x > begin) & (x < end)
    np.testing.assert_allclose(y[shown], np.interp(x[shown], *exact), rtol=within)


def test_every_figure_and_table_is_listed_in_the_order_of_the_thesis_and_in_the_guide() -> None:
    printed = {f"{chapter}.{n}" for chapter, last in LAST.items() for n in range(1, last + 1)} - {*PAIRS}
    printed |= {f"{pair}{letter}" for pair in PAIRS for letter in "ab"}
    assert printed | {"table-numbers", *(f"extra-{name}" for name in OTHERS.split())} == set(ITEMS)
    assert [e["id"] for e in listing()] == sorted(ITEMS, key=order)
    guide = (ROOT / "docs/gallery.md").read_text()
    assert all(f"| {entry['id']} | {entry['title']} |" in guide for entry in listing())


def test_pictures_and_data_are_written_anew_for_a_missing_file_other_sources_or_caption(tmp_path, monkeypatch):
    def entries(*names: str) -> dict[str, dict[str, Any]]:
        found, failures = draw_all(names, tmp_path)
        assert failures == []
        return {e["id"]: e for e in found}

    monkeypatch.setattr(gallery, "digest_of", lambda packages, settings: str(settings))
    first = entries("fig-2.12a", "table-3.2")
    picture, data, table = (tmp_path / file for file in ("fig-2.12a.png", "fig-2.12a.csv", "table-3.2.csv"))
    assert first["fig-2.12a"]["files"] == [str(picture), str(data)]
    assert picture.stat().st_size > 3000 and table.read_text() == sheet_of("table-3.2").csv()
    index = (tmp_path / "index.md").read_text()
    assert "## table-3.2" in index and "| r₁ for (0, 2, 0) at κ/ν = 0.5 | −1.672 |" in index
    stamp = picture.stat().st_mtime_ns
    table.unlink()
    assert entries(*first)["fig-2.12a"] == first["fig-2.12a"]
    assert picture.stat().st_mtime_ns == stamp and table.is_file()
    monkeypatch.setitem(gallery.ITEMS, "table-3.2", dataclasses.replace(ITEMS["table-3.2"], caption="Another."))
    assert entries("table-3.2")["table-3.2"]["caption"] == "Another."
    monkeypatch.setattr(gallery, "digest_of", lambda packages, settings: "of tomorrow")
    entries("fig-2.12a")
    assert picture.stat().st_mtime_ns > stamp


WITH_DATA = [name for name in ITEMS if name != "table-numbers"]  # whose rows are those of test_numbers.py


@pytest.mark.parametrize("name", [pytest.param(n, marks=() if n in QUICK else SLOW) for n in WITH_DATA])
def test_every_item_has_data(name: str) -> None:
    assert len(cells(name)) >= (2 if name == "extra-uniform" else 3)  # lengths


def test_unknown_formats_are_refused_and_a_failing_item_leaves_the_others(tmp_path, monkeypatch):
    with pytest.raises(ValueError, match="format"):
        draw_all(["fig-2.3"], tmp_path, formats=("bmp",))
    monkeypatch.setattr(gallery, "digest_of", lambda packages, settings: "")
    monkeypatch.setitem(gallery.ITEMS, "fig-2.3", dataclasses.replace(ITEMS["fig-2.3"], draw=lambda sheet: 1 / 0))
    found, failures = draw_all(["fig-2.3", "fig-2.7a"], tmp_path)
    assert [d["id"] for d in found] == ["fig-2.7a"]
    assert failures == [{"id": "fig-2.3", "reason": "ZeroDivisionError: division by zero"}]


POINTS = [  # figure, panel, series, x, y, tolerance
    ("fig-2.2", "", "numerical", 0.0, 1.0, 1e-9),
    ("fig-2.3", "", "H", 2.0, float(kernel.H(2.0)), 1e-8),
    ("fig-2.7a", "", "φ_κ/φ_ν", 1.01886591389, 0.5, 1e-4),
    ("fig-2.7b", "", "λ_0", 0.5, 1.01886591389, 1e-8),
    ("fig-2.7b", "", "r_0/ν", 0.5, 1.17721208090, 1e-8),
    ("fig-2.10", "", "φ_α", 0.0, 1.0, 1e-9),
    ("fig-2.11", "", "φ_dot κ", 0.0, 1.0, 1e-9),
    ("fig-2.12a", "", "0, 2, 0", 0.5, -1.67228195835, 1e-7),
    ("fig-2.12b", "", "4, 0, 0", 0.5, 5.66465632402, 1e-7),
    ("fig-2.15", "", "φ_q", 0.0, 1.0, 1e-6),
    ("fig-2.16a", "", "−1, −1, 1", 0.3, 5.30283507602, 1e-7),
    ("fig-2.16b", "", "−1, −1, 0", 0.5, -1.77288819407, 1e-7),
    ("fig-3.2", "", "bending moment", 0.5, 0.25, 1e-9),
    ("fig-3.3", "", "Hermite", 2.5, -5e5 * 5.0**3 / 48.0 / 9.345e3 / 500.0, 1e-6),
    ("fig-3.4", "", "bending moment", 1.0, -1.0, 1e-9),
    ("fig-3.5", "", "Hermite", 0.0, -8e5 * 5.0**3 / 3.0 / 9.345e3 / 500.0, 1e-5),
    ("fig-3.6", "a", "theory", 0.0, 0.5, 1e-9),
    ("fig-3.6", "a", "Moreau–Jean", 0.0, 0.5, 1e-9),
    ("fig-A.1", "b", "N2", 0.5, 0.125, 1e-9),
]
RUNS = [  # of fields and of runs
    ("fig-2.9", "a", "beam", 0.0, 0.0, 1e-9),
    ("fig-2.14", "b", "free motion", 0.0, 0.1005, 1e-9),
    ("fig-2.17", "c", "beam", 0.0, 0.0, 2e-3),
    ("fig-3.32", "c", "nodes, lumped", 25.0, -10.0, 0.02),  # ½μΔxV₀²
    ("fig-3.32", "c", "nodes, consistent", 25.0, -5.88, 0.017),
]


@pytest.mark.parametrize("points", [POINTS, pytest.param(RUNS, marks=SLOW)], ids=["curves", "runs"])
def test_known_points_of_the_curves(points: list[tuple[str, str, str, float, float, float]]) -> None:
    for name, panel, series, x, y, within in points:
        places, values = curve(name, series, panel)
        rising = np.argsort(places)
        found = np.interp(x, places[rising], values[rising])
        assert found == pytest.approx(y, rel=within, abs=within), f"{name}, {series}"


ZONES = [("fig-2.8", "abef", "free motion", 1e-8), ("fig-2.13", "ab", "free motion (2.7.41)", 3e-4)]


@pytest.mark.parametrize(("name", "panels", "series", "within"), [ZONES[0], pytest.param(*ZONES[1], marks=SLOW)])
def test_free_motion_and_fast_layer_agree_in_the_contact_zone(name, panels, series, within):
    for panel in panels:
        a, free = curve(name, series, panel)
        off = np.abs(free - curve(name, "fast layer", panel)[1])
        inside = off[np.abs(a) <= 1.0].max()
        assert inside < within
        assert off[np.abs(a) > 1.2].max() > 10.0 * inside


def test_a_figure_of_runs_has_a_column_a_mass_and_our_methods_on_theory() -> None:
    sheet = Sheet()
    run_figure(sheet, Series(10.0, 0.002, {"own": {}}), (contact_length, *REACTION[:1]))
    curves = {(sheet.panels[id(axis)], series): (x, y) for axis, series, x, y, _ in sheet.curves}
    for panel in "abcd":  # contact length and reaction, lumped and consistent
        exact = curves[panel, "theory"]
        assert (panel, "own") in curves
        for method in OURS:
            follows(curves[panel, method], exact, 0.2 * exact[0][-1])
    assert all(abs(sheet.numbers[f"r₀ error (%), {method}"] or 1.0) < 0.2 for method in OURS)


@SLOW
def test_our_methods_lie_on_the_wall_and_the_thesis_settings_do_not() -> None:
    for panel in "ab":  # lumped, consistent
        drawn = {name: curve("fig-3.10", name, panel) for name in (*OURS, "Δx = 2.5 mm")}
        ours, other, old = (np.abs(y[x < 28.0]).max() for x, y in drawn.values())
        assert max(ours, other) < 0.5 and 100.0 < old < 250.0  # µm


def test_captions_of_the_thesis_runs_name_contact_and_mass() -> None:
    runs = [*range(7, 13), *range(14, 22), *range(23, 29), *range(31, 37)]
    for name in (*(f"fig-3.{n}" for n in runs), "fig-A.2", "fig-A.3", "extra-filter"):
        caption = ITEMS[name].caption
        assert ("node" in caption or "middle" in caption) and ("lumped" in caption or "both masses" in caption), name


def test_the_tables_hold_the_thesis_counts_and_the_theory() -> None:
    counts = {r["e"]: (int(r["thesis"]), int(r["ours"])) for r in cells("table-3.2")}
    assert counts["1.25"] == (120, 120)
    assert all(abs(printed - ours) <= 2 for printed, ours in counts.values())
    sweep = cells("table-3.4")
    assert [r["K (1/m)"] for r in sweep] == ["1/80", "1/40", "1/20", "1/10", "1/5", "1/2", "1", "5", "10"]
    found = contact_parameters(np.array([float(r["κ/ν"]) for r in sweep]))
    np.testing.assert_allclose([float(r["λ₀"]) for r in sweep], found.lambda0, rtol=1e-5)


@SLOW
def test_steps_are_those_of_the_thesis_and_a_square_mesh_shrinks_along_the_zone_and_rests_for_shorter_times() -> None:
    assert [int(r["steps"]) for r in cells("table-3.1")[:5]] == [25, 250, 500, 1000, 2500]
    x, sizes = curve("fig-3.13", "element length", "b")
    assert np.all(np.diff(sizes[x < 0.28]) < 0.0)
    rest = "longest rest of λ_c in the last two fifths (µs), {} zone, lumped"
    assert number("fig-3.15", rest.format('"square"')) < number("fig-3.15", rest.format("uniform"))


@SLOW
def test_matched_runs_discrete_contact_and_the_infinite_beam_follow_theory() -> None:
    x, values = curve("fig-3.29", "Hermite", "a")
    # below κ/ν = 0.009 the mesh over the thin front is even, and its error bar is 1 %
    assert np.all(np.abs(values / contact_parameters(x).lambda0 - 1.0) < np.where(x > 0.009, 1e-3, 1e-2))
    assert number("fig-3.32", "middles close at (s)") == pytest.approx(25.0 * 0.05**2 / 8.0 / 20.0, rel=0.03)
    follows(curve("fig-3.32", "Δx = 5·10⁻⁴ m", "d"), curve("fig-3.32", "theory", "d"), 5.0, within=0.1)
    for name in ("λ₁, a₀ = 700 m/s²", "λ₁, a₀ = −700 m/s²"):
        fit = number("fig-3.34", f"{name}, Self-similar, infinite beam, first 5 %")
        assert fit == pytest.approx(number("fig-3.34", f"{name}, theory"), rel=0.05)
    follows(curve("fig-3.34", "Self-similar, infinite beam", "c"), curve("fig-3.34", "theory", "c"), 0.3, 1.2)
