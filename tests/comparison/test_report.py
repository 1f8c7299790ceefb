"""The report's page: it stands alone, escapes what it shows, and says what the rows say."""

from __future__ import annotations

import json
import re
import shutil
import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from comparison.figures.force_map import force_map, spread
from comparison.match import questions
from comparison.methods import methods_from_file
from comparison.report import page as report_module
from comparison.report import studies, work
from comparison.report.impacts import END, FRAMES, SHOWN, frames, kept_instants, theory_of
from comparison.report.noise import noise_methods
from comparison.report.page import page, span_of, write_report
from comparison.report.plots import plots
from comparison.report.rows import (
    convergence_rows,
    first_order_rows,
    leading_rows,
    report_questions,
    table_row,
    tolerance,
)
from comparison.report.studies import (
    STORED,
    StudyNote,
    case_of,
    known_studies,
    store_studies,
    stored_studies,
)
from comparison.report.text import acceleration_rows, edge_answer, headline, noise_answer, percent, powers, speed_answer
from comparison.report.work import KAPPA, LISTS, MEASUREMENTS, stored_measurements
from comparison.store import RunStore

sys.path.insert(0, str(Path(__file__).parent))
from report_fixtures import NASTY, content, impacts, lost, noise, row, rows

LABELS = ("Hermite", "Self-similar", "Exudyn")
VOID = {"meta", "link", "br", "img", "input", "line", "circle", "rect", "path"}


class Reader(HTMLParser):
    """Tags, attributes and visible text of a page; raises on tags that do not close in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.attributes: list[tuple[str, str, str]] = []
        self.text: list[str] = []
        self.tags: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += [(tag, name, value or "") for name, value in attrs]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += [(tag, name, value or "") for name, value in attrs]

    def handle_endtag(self, tag: str) -> None:
        if tag not in VOID:
            assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-3:]}"
            self.open.pop()

    def handle_data(self, data: str) -> None:
        if not {"script", "style"} & set(self.open):
            self.text.append(data)


def read(text: str) -> Reader:
    reader = Reader()
    reader.feed(text)
    reader.close()
    return reader


@pytest.fixture(scope="module")
def plain() -> str:
    return page(content())


def test_page_parses_and_its_links_lead_somewhere(plain: str) -> None:
    reader = read(plain)
    assert reader.open == []
    ids = [value for _, name, value in reader.attributes if name == "id"]
    assert len(ids) == len(set(ids))
    for _, name, value in reader.attributes:
        if name == "href" and value.startswith("#"):
            assert value[1:] in ids, value


def test_page_refers_to_nothing_outside_itself(plain: str) -> None:
    for tag, name, value in read(plain).attributes:
        if name in ("src", "href", "srcset", "action", "poster", "data"):
            assert value.startswith(("#", "data:")), (tag, name, value[:80])
    style = plain[plain.index("<style>") : plain.index("</style>")]
    assert "@import" not in style and "url(" not in style


def test_strings_from_files_are_escaped() -> None:
    text = page(content(nasty=True))
    assert NASTY not in text
    reader = read(text)  # markup let through would unbalance the tags or add scripts
    assert reader.tags.count("script") == read(page(content())).tags.count("script")
    assert sum(NASTY in part for part in ["".join(reader.text)]) == 1


def test_page_shows_every_row_and_the_failure(plain: str) -> None:
    text = re.sub(r"[ \n]+", " ", "".join(read(plain).text))
    for r in [*leading_rows(rows()), *first_order_rows(rows())]:
        for c in r.cells:
            assert c.value_text in text and c.error_text in text
    assert "Exudyn, κ/ν = 0.3, (α, ψ, χ, N) = (1, 0, 0, 0): an ordinary warning" in text
    assert "1 row failed" in text


def test_page_without_any_row_is_still_a_page() -> None:
    empty = report_module.Content(rows=[lost("hermite", 0.5, "no reason")])
    reader = read(page(empty))
    assert reader.open == []
    assert "No row could be computed (1 failed)." in "".join(reader.text)


@pytest.mark.verify
def test_report_is_written_when_rows_fail(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[tuple[int, int]] = []

    def match(asked, *, store, jobs, scheduler, progress):  # type: ignore[no-untyped-def]
        progress(1, len(asked))
        return [*rows(), lost("exudyn", 0.5, "the solver gave up")]

    monkeypatch.setattr(report_module, "match", match)
    monkeypatch.setattr(report_module, "show_all", lambda *_, **__: (list(impacts()), []))
    monkeypatch.setattr(report_module, "compare_noise", lambda **_: (noise(), []))
    found = write_report(tmp_path, store=RunStore(None), jobs=1, progress=lambda a, b: seen.append((a, b)))
    assert set(found) >= {"page", "files", "headline", "failures", "rows"}
    assert all(Path(f).stat().st_size > 0 for f in found["files"])
    assert found["failures"][0]["reason"] == "the solver gave up"
    assert "1 row failed" in found["headline"]
    text = (tmp_path / "index.html").read_text()
    assert "the solver gave up" in text
    pictures = [value for tag, name, value in read(text).attributes if tag == "img" and name == "src"]
    # matching and work-precision, three impacts, maps, acceleration, noise; the stored studies
    assert len(pictures) == 9 + sum(n.picture.exists() for n in [*stored_studies(), *stored_measurements()])
    assert seen[-1][0] == seen[-1][1]


def test_questions_ask_every_method_the_same() -> None:
    asked = report_questions()
    each = {label: {(q.kappa_over_nu, q.first, q.refine) for q in asked if q.method.label == label} for label in LABELS}
    assert each["Hermite"] == each["Exudyn"] == each["Self-similar"]
    assert (1 / 1600, None, 1.0) in each["Hermite"] and (0.5, (4, 0, 0, 0), 1.0) in each["Hermite"]


@pytest.mark.parametrize(("off", "grade"), [(2e-4, "good"), (8e-4, "fair"), (2e-3, "poor"), (2e-2, "bad")])
def test_grade_is_error_against_tolerance(off: float, grade: str) -> None:
    cells = table_row(row("hermite", 0.25, None, off)).cells
    assert [c.grade for c in cells] == [grade, grade]
    assert all(c.covered for c in cells)
    assert cells[0].error_text.startswith("+") and cells[1].error_text.startswith("−")
    assert cells[0].error == pytest.approx(off) and cells[1].error == pytest.approx(-off)


def test_tolerances_are_those_of_the_project() -> None:
    assert tolerance("r0", 0.5) == 0.001
    assert tolerance("r1", 0.5) == 0.01 and tolerance("r1", 0.1) == 0.03


def test_value_is_written_with_the_digits_its_error_bar_leaves() -> None:
    cell = table_row(row("hermite", 0.5, (4, 0, 0), 2e-3)).cells[0]
    assert cell.value_text == "5.676 ±\u00a00.023"
    assert cell.error_text == "+0.20 %"
    assert table_row(row("hermite", 1 / 1600)).ratio_text == "1/1600"


def test_percent_never_flatters() -> None:
    assert percent(0.00121) == "0.13 %"
    assert percent(-0.03) == "3.0 %"
    assert percent(0.0) == "0 %"


def test_headline_and_speed_come_from_the_rows() -> None:
    leading, first = leading_rows(rows()), first_order_rows(rows())
    text = headline(leading, first, 0)
    assert "Hermite within 20 %" in text and "Exudyn within 2.5 %" in text and "failed" not in text
    assert "Hermite 0.5 s, Exudyn 5 s (medians of 4 rows)" in speed_answer(leading, first)
    assert "cannot be compared" in speed_answer(leading[:1], [])


def test_plots_tag_every_trace_with_its_method() -> None:
    drawn = plots(leading_rows(rows()), first_order_rows(rows()), convergence_rows(rows()))
    assert set(drawn) == {"lambda0", "r0", "leading-error", "lambda1", "r1", "first-error", "seconds", "convergence"}
    for plot in drawn.values():
        assert plot["data"] and all(t["meta"]["label"] in ("theory", "Hermite", "Exudyn") for t in plot["data"])


# --- the shown impacts --------------------------------------------------------------------------------------


def shown(name: str, label: str) -> dict[str, Any]:
    return dict(next(i.data for i in impacts() if (i.shown.name, i.label) == (name, label)))


@pytest.mark.parametrize(("label", "off", "lift"), [("Self-similar", 5e-3, 1e-6), ("Hermite", 2e-2, 2e-2)])
def test_shown_impact_without_acceleration_is_the_leading_order(label: str, off: float, lift: float) -> None:
    data, theory = shown("plain", label), theory_of(SHOWN[0])
    for what in ("front", "reaction"):
        assert np.allclose(data[what][10:], theory[what][10:], rtol=off)
    assert max(data["lift"]) < lift


@pytest.mark.parametrize("shown_impact", SHOWN[:2], ids=lambda s: s.name)
def test_theory_and_simulation_have_the_same_shape_on_the_timeline(shown_impact: Any) -> None:
    theory, data = theory_of(shown_impact), shown(shown_impact.name, "Self-similar")
    gap, exact = np.array(data["gap"], float), np.array(theory["gap"])
    assert gap.shape == exact.shape == (FRAMES, len(theory["x"]))
    assert np.allclose(gap[10:], exact[10:], rtol=3e-3, atol=3e-3)


def test_pressed_zone_carries_the_uniform_reaction_of_theory_up_to_the_front() -> None:
    edge = 0.12  # of the front: four of Hermite's elements, over which its concentrated force is spread
    for label in ("Self-similar", "Hermite"):
        data = shown("pressed", label)
        assert data["pressure"][-1] == pytest.approx(SHOWN[1].pressure, rel=0.02)
        x, force = np.array(data["map"]["x"]), np.array(data["map"]["force"])[-5:].mean(axis=0)
        inside = x < (1.0 - edge) * data["front"][-6]
        assert np.allclose(force[inside], SHOWN[1].pressure, rtol=0.2), label
    assert "Self-similar" in edge_answer(impacts()) and "of the zone's length" in edge_answer(impacts())


def test_released_zone_lifts_off_and_the_table_says_so() -> None:
    assert 1e-3 < max(shown("released", "Self-similar")["lift"]) < 2e-2
    rows = acceleration_rows(impacts())
    assert len(rows) == 4  # two impacts with acceleration, two methods
    assert rows[0].uniform == "1 (theory: 1)" and rows[0].zone.startswith("+") and rows[0].reaction.startswith("+")
    assert rows[-1].uniform == "0" and rows[-1].zone.startswith("−") and rows[-1].gap.endswith("lifts off")


def test_energies_of_a_run_balance_and_the_resting_wall_does_no_work() -> None:
    energy = {name: np.array(values) for name, values in shown("plain", "Hermite")["energy"].items()}
    assert not energy["work_of_loads"].any()
    total = sum(energy.values())
    assert np.abs(total).max() < 2e-3 * np.abs(energy["kinetic_energy"]).max()


def test_noise_is_measured_against_theory() -> None:
    found = noise()
    assert found.scatter(found.before) == pytest.approx(0.1, rel=0.3)
    assert found.scatter(found.after) < 0.02
    assert "settings of the thesis" in noise_answer(found)


def test_map_holds_the_whole_impulse_of_one_side() -> None:
    from self_similar_fe.mesh import ExpandingMesh
    from self_similar_fe.run import simulate_expanding

    history = simulate_expanding(SHOWN[1].impact, ExpandingMesh(decades=2.0), end_time=0.1, save=60)
    kept = kept_instants(history.time, 10)
    edges = np.linspace(0.0, 1.0, 41)
    gathered = (force_map(history, kept, edges) * np.diff(edges)).sum(axis=1) * np.diff(history.time[kept])
    expected = np.diff(history.array("impulse").sum(axis=1)[kept])
    assert np.allclose(gathered, expected, rtol=1e-9)


def test_spread_keeps_the_sum() -> None:
    places, amounts = np.array([0.0, 0.1, 0.4, 0.5]), np.array([1.0, 2.0, 0.5, 4.0])
    bins = spread(places, amounts, np.linspace(0.0, 0.6, 7))
    assert bins.sum() == pytest.approx(amounts.sum())
    assert bins[-1] == pytest.approx(0.0, abs=1e-12)


def test_frames_are_even_in_root_time() -> None:
    steps = np.diff(np.sqrt(frames()))
    assert steps.max() == pytest.approx(steps.min())
    assert frames()[-1] == pytest.approx(END) and frames().size == FRAMES


def test_numbers_in_the_page_data_are_finite(plain: str) -> None:
    inside = re.search(r'<script type="application/json" id="data">(.*?)</script>', plain, re.S)
    assert inside is not None
    assert "NaN" not in inside[1] and "Infinity" not in inside[1]


# --- studies ------------------------------------------------------------------------------------------------


def test_stored_studies_are_those_that_there_are_with_date_and_picture() -> None:
    notes = stored_studies()
    assert [n.name for n in notes] == list(known_studies())
    assert all(n.date and n.conclusion and not n.failed for n in notes)
    assert all(n.picture.exists() for n in notes)


def test_a_study_measured_again_leaves_the_others_as_they_are(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    before = {note.name: note for note in stored_studies()}
    shutil.copy(studies.STORED / "studies.json", tmp_path)
    monkeypatch.setattr(studies, "STORED", tmp_path)
    monkeypatch.setattr(studies, "versions", lambda: json.loads((tmp_path / "studies.json").read_text())["versions"])
    monkeypatch.setattr(studies, "_note", lambda name, title: StudyNote(name, title, "New.", date="2030-01-01"))
    store_studies(["mesh"])
    after = {note.name: note for note in stored_studies()}
    assert list(after) == list(before)
    assert (after.pop("mesh").conclusion, before.pop("mesh").name) == ("New.", "mesh")
    assert after == before
    with pytest.raises(ValueError, match="no study is called meshes"):
        store_studies(["meshes"])
    monkeypatch.setattr(studies, "versions", lambda: {"numpy": "0"})
    with pytest.raises(ValueError, match="run all studies again"):
        store_studies(["mesh"])


def test_dates_of_studies_are_one_day_or_a_span() -> None:
    assert span_of([]) == ""
    assert span_of(["2026-01-02", "2026-01-02"]) == "on 2026-01-02"
    assert span_of(["2026-01-03", "2026-01-02"]) == "from 2026-01-02 to 2026-01-03"


def test_stored_work_and_precision_holds_every_method_of_its_list() -> None:
    """Both codes on one sheet, leading and first order; what has no number says why."""
    assert [m.name for m in stored_measurements()] == [m.name for m in MEASUREMENTS]
    for measurement in MEASUREMENTS:
        document = json.loads((STORED / f"{measurement.name}.json").read_text())
        methods = methods_from_file(LISTS / measurement.methods)
        asked = questions(methods, [KAPPA], measurement.firsts, measurement.refines)
        assert [(r["label"], r["refine"], r["alpha"]) for r in document["rows"]] == [
            (q.method.label, q.refine, q.first[0] if q.first else 0.0) for q in asked
        ]
        assert {method.path for method in methods} >= {"hermite", "exudyn"}
        for kept in document["rows"]:
            numbers = [kept[name]["value"] for name in (("lambda1", "r1") if kept["alpha"] else ("lambda0", "r0"))]
            assert (None in numbers) == bool(kept["reason"]), kept["label"]


def test_a_measurement_that_does_not_exist_is_named_with_those_that_do(monkeypatch: pytest.MonkeyPatch) -> None:
    stored = []
    monkeypatch.setattr(work, "store_measurement", lambda measurement, jobs: stored.append(measurement.name))
    with pytest.raises(SystemExit, match=r"work-precison is not a measurement.*work-precision-first-order"):
        work.main(["work-precision", "work-precison"])
    assert stored == []
    work.main(["work-precision"])
    assert stored == ["work-precision"]


def test_powers_of_ten_are_written_as_such() -> None:
    assert powers("off by 7.0e−4 % and 1.2e-09 V₀t, the 3e5th") == "off by 7.0·10⁻⁴ % and 1.2·10⁻⁹ V₀t, the 3e5th"


def test_studies_of_the_report_have_cases() -> None:
    assert case_of("mesh").impact.kappa_over_nu == pytest.approx(0.5)
    assert case_of("first-order-case").impact.epsilon_alpha == pytest.approx(16.3, rel=1e-2)


def test_before_and_after_are_runs_of_one_path_with_two_settings() -> None:
    before, after = noise_methods()
    assert before.path == after.path and before.label != after.label
    assert before.refuses(SHOWN[0].impact) is None
    assert before.mesh is not None and after.mesh is None  # type: ignore[attr-defined]
