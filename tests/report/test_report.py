"""The report's page: it stands alone, escapes what it shows, says what the rows say, and works in a browser."""

import re
from collections import Counter
from dataclasses import replace
from html import unescape
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from chromium import ask, assert_quiet, beyond_the_edge, needs_chromium, opened
from matplotlib.figure import Figure
from report_fixtures import KEPT, METHODS, impacts, lost, pipe, row, rows, studies

from bent_beam.measure.numbers import MISSING
from bent_beam_programs.report import page
from bent_beam_programs.report import rows as tables
from bent_beam_programs.report.impacts import FRAMES, SHOWN, acceleration_rows, energies, theory_of
from bent_beam_programs.report.studies import stored_numbers, stored_studies
from bent_beam_programs.report.whole import TIMES
from bent_beam_programs.report.work import stored_measurements
from comparison.figures import style
from comparison.methods import methods_of
from comparison.predicting import predict_case
from comparison.store import RunStore
from comparison.texts import prediction_text

VOID = {"meta", "link", "br", "img", "input", "line", "circle", "rect", "path"}


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """Of made-up rows, one of which failed, real impacts on coarse meshes, and all that is stored.

    ``found`` is what the writer returned, ``seen`` its progress, ``nasty`` the text that came from files and methods.
    """
    nasty = "<script>alert('x')</script> & \"quotes\" </script>"
    folder, every = tmp_path_factory.mktemp("report"), [*rows(), lost("exudyn", 0.3, nasty)]
    seen: list[tuple[int, int]] = []
    every[0].warnings.append(nasty)
    stored = [*stored_studies(), *stored_studies(studies(folder, nasty))]
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(style.RC, "figure.constrained_layout.use", False)  # layouts take longer than the page
        patch.setattr(Figure, "draw_without_rendering", lambda figure: None)
        patch.setattr(page, "match", lambda asked, *, progress, **_: progress(1, len(asked)) or every)
        patch.setattr(page, "warm_up", lambda methods: None)
        patch.setattr(page, "show_all", lambda *_, **__: (list(impacts()), [nasty]))
        patch.setattr(page, "pipe_prediction", lambda store: pipe())
        patch.setattr(page, "stored_studies", lambda: stored)
        methods = methods_of(tables.PATHS)
        asked, store = tables.report_questions(methods, (0.5, 1.0)), RunStore(None)
        found = page.write_report(folder, methods, asked, store=store, progress=lambda *of: seen.append(of))
    file = folder / "index.html"
    text = file.read_text()
    return SimpleNamespace(found=found, seen=seen, file=file, text=text, nasty=nasty, studies=stored, asked=asked)


def seen(page: str) -> str:
    """The text that a page shows, whose tags must all close."""
    page = re.sub(r"(<(script|style)\b[^>]*>).*?</\2>", r"\1</\2>", page, flags=re.S)
    opened, closed = (Counter(re.findall(f"<{slash}(\\w+)", page)) for slash in ("", "/"))
    assert {tag: count for tag, count in opened.items() if tag not in VOID} == closed
    return unescape(re.sub(r"<[^>]*>", "", page))


@pytest.fixture(scope="module")
def text(written: Any) -> str:
    return seen(written.text)


def test_page_is_at_most_two_megabytes_refers_to_nothing_outside_and_its_links_lead_somewhere(written: Any) -> None:
    assert len(written.text.encode()) <= 2_000_000
    ids = re.findall(r'\sid="([^"]*)"', written.text)
    assert len(ids) == len(set(ids))
    for value in re.findall(r'\s(?:src|href|srcset|action|poster|data)="([^"]*)"', written.text):
        assert value.startswith("data:") or value.removeprefix("#") in ids, value[:80]


def test_page_shows_every_row_the_failure_and_what_is_stored_and_strings_from_files_are_escaped(written, text):
    assert written.nasty not in written.text and written.text.count("<script") == 3  # the page's own
    text = re.sub(r"[ \n]+", " ", text)
    for r in [*tables.leading_rows(rows()), *tables.first_order_rows(rows())]:
        for c in r.cells:
            assert c.value_text in text and c.error_text in text
    assert f"Exudyn0.3(1, 0, 0, 0){written.nasty}" in text
    assert f"Left out: {written.nasty}" in text and f"What could not be shown {written.nasty}" in text
    # matching (two), maps of reaction, acceleration; what is stored
    printed = stored_numbers()
    assert printed is not None and printed["summary"] in text
    stored = len(stored_measurements()) + sum(s["picture"].exists() for s in written.studies) + len(printed["figures"])
    assert written.text.count("<img") == 4 + stored


def test_page_tells_the_story_first(written: Any) -> None:
    order = "problem answer answers thesis believe agreement impact speed printed studies settings".split()
    places = [written.text.index(f'id="{name}"') for name in order]
    assert places == sorted(places)


def test_the_pipe_s_numbers_are_those_that_predict_prints(text: str) -> None:
    found = pipe()
    printed = re.sub(r"\s+", " ", prediction_text(predict_case(found["case"], TIMES, store=KEPT).to_dict()))
    for _, _, cells in found["rows"]:
        assert all(cell in printed for cell in cells)
    assert re.sub(r"\s+", " ", found["validity"]) in printed and "The theory holds" in text
    restitution, _, stress = (words.partition(" (band")[0] for words in found["whole"])
    assert restitution in printed and stress.removeprefix("largest stress ").removesuffix(" MPa") in printed
    assert all(f"{value} at {ratio} %" in printed for ratio, value in found["damping"])


def test_report_is_written_when_rows_fail(written: Any, text: str) -> None:
    found = written.found
    assert set(found) == {"page", "files", "headline", "failures", "rows"} and Path(found["page"]) == written.file
    assert all(Path(f).stat().st_size > 0 for f in found["files"])
    assert found["failures"][0]["reason"] == written.nasty
    assert found["headline"] in text and "Rows failed: 1." in found["headline"]
    assert written.seen[-1][0] == written.seen[-1][1]
    assert "Rows failed: 1." in seen(page.render(page.Content(rows=[lost("hermite", 0.5, "no reason")])))


def test_questions_ask_every_method_the_same(written: Any) -> None:
    asked = {label: set() for label in ("Hermite", "Self-similar", "Exudyn")}
    for q in written.asked:
        asked[q.method.label].add((q.kappa_over_nu, q.first, q.refine))
    assert {(1 / 100, None, 1.0), (0.5, (4, 0, 0, 0), 1.0)} <= asked["Hermite"]
    assert asked["Hermite"] == asked["Exudyn"] == asked["Self-similar"]


@pytest.mark.parametrize(("off", "grade"), [(2e-4, "good"), (8e-4, "fair"), (2e-3, "poor"), (2e-2, "bad")])
def test_grade_is_error_against_tolerance(off: float, grade: str) -> None:
    cells = tables.TableRow(row("hermite", 0.25, None, off)).cells
    assert [c.grade for c in cells] == [grade, grade]
    assert [c.error for c in cells] == pytest.approx([off, -off])
    assert cells[0].error_text.startswith("+") and cells[1].error_text.startswith("−")


def test_a_missing_number_leaves_its_columns_in_place() -> None:
    unseen = replace(row("hermite", 0.9, (4.0, 0.0, 0.0), 1e-3), lambda1=MISSING)
    lambda1, r1 = tables.TableRow(unseen).columns
    assert lambda1 is None and r1 is not None and r1.theory_text == f"{unseen.r1.theory:.6g}"


def test_summary_and_headline_come_from_the_rows() -> None:
    leading, first = tables.leading_rows(rows()), tables.first_order_rows(rows())
    found = {(r["order"], r["label"]): r for r in tables.summary(leading, first)}
    thin, thick = "leading order, κ/ν = 1/1600", "leading order, κ/ν = 1/20 to 0.5"
    exudyn, hermite = found["first order", "Exudyn"], found["first order", "Hermite"]
    assert [exudyn[key] for key in ("rows", "numbers", "within", "covered")] == [1, 2, 0, 2]
    assert (exudyn["largest"], hermite["largest"]) == pytest.approx((0.025, 0.2))
    assert (hermite["numbers"], hermite["within"]) == (6, 2)  # one pair lies between the tolerance and twice it
    exudyn = found[thick, "Exudyn"]
    assert (exudyn["rows"], exudyn["seconds"]) == (3, 5.0)  # the coarse row is not among them
    assert found[thin, "Exudyn"]["rows"] == 1
    assert "first order Hermite 20 %, Exudyn 2.5 %" in tables.headline(leading, first, 0)


def shown(name: str, label: str) -> dict[str, Any]:
    return dict(next(i.data for i in impacts() if (i.shown.name, i.label) == (name, label)))


@pytest.mark.parametrize(("label", "off", "lift"), [("Self-similar", 5e-3, 1e-6), ("Hermite", 2e-2, 2e-2)])
def test_shown_impact_without_acceleration_is_the_leading_order(label: str, off: float, lift: float) -> None:
    data, theory = shown("plain", label), theory_of(SHOWN[0])
    for what in ("front", "reaction"):
        assert np.allclose(data[what][10:], theory[what][10:], rtol=off)
    assert max(data["lift"]) < lift
    # the wall's work in the frame of the arriving beam, V₀∫R dt, is what energies and losses add up to
    work = 4.0 * np.array(theory["time"]) * theory["reaction"]
    energy = {name: np.array(values) for name, values in data["energy"].items()}
    assert energy["work_of_loads"][10:] == pytest.approx(work[10:], abs=0.05)
    assert np.abs(sum(energy.values()) - 2.0 * energy["work_of_loads"]).max() < 2e-3 * energy["work_of_loads"].max()


def test_in_the_frame_of_an_accelerated_beam_the_wall_alone_does_work() -> None:
    impact = SHOWN[1].impact
    history = METHODS[1].simulate(impact, end_time=0.02 * impact.time_scale, save=200)
    speed, impulse = impact.velocity + impact.acceleration * history.time, history.array("total_impulse")
    work = np.sum(0.5 * (speed[1:] + speed[:-1]) * np.diff(impulse))
    assert energies(history)["work_of_loads"][-1] == pytest.approx(work, rel=1e-3)


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
        x, force = np.array(data["map"]["x"]), np.array(data["map"]["force"])[-5:].mean(axis=0)
        inside = x < (1.0 - edge) * data["front"][-6]
        assert np.allclose(force[inside], SHOWN[1].pressure, rtol=0.2), label


def test_acceleration_into_the_wall_spreads_the_zone_and_one_away_from_it_lifts_the_middle() -> None:
    assert 1e-3 < max(shown("released", "Self-similar")["lift"]) < 2e-2
    table = acceleration_rows(impacts())
    assert len(table) == 4  # two impacts with acceleration, two methods
    for pressed, released in zip(table[:2], table[2:]):
        assert (pressed["uniform"], pressed["theory"], released["theory"]) == ("1.00", "1.00", "0.00")
        assert pressed["zone"].startswith("+") and pressed["reaction"].startswith("+")
        assert released["zone"].startswith("−") and released["reaction"].startswith("−")


@needs_chromium
@pytest.mark.parametrize("width", [1400, 390])
def test_everything_is_drawn_without_errors_or_requests_and_nothing_overflows_or_is_lost(chromium, written, width):
    browser = opened(chromium, written.file.as_uri(), width)
    assert beyond_the_edge(browser, "section, header, p, h2, .plot, table") == []
    cut = "[...document.querySelectorAll('.scroll > table')].filter(e => e.offsetParent)"
    assert ask(browser, f"{cut}.filter(e => e.scrollWidth > e.parentElement.clientWidth + 1).map(e => e.id)") == []
    drawn = "[...document.querySelectorAll('.plot')].map(e => e.querySelectorAll('polyline').length > 1)"
    assert all(ask(browser, drawn)) and len(ask(browser, drawn)) >= 5
    keys = "[...document.querySelectorAll('.plot')].every(e => e.querySelectorAll('.key span').length > 1)"
    assert ask(browser, keys)  # each has its legend
    cells = "[...document.querySelectorAll('#summary-table td, #leading-table td, #pipe-table td')]"
    assert ask(browser, f"{cells}.filter(e => e.offsetParent === null).length") == 0  # no column is lost on a phone
    assert ask(browser, "[...document.querySelectorAll('td.path a')].map(e => e.offsetParent !== null)") == [True]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})  # paper has no controls
    assert ask(browser, "[...document.querySelectorAll('.plot')].every(e => e.offsetParent === null)")
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert_quiet(browser)


def front(browser: Any) -> float:
    """Half contact length as the table reads it."""
    return float(ask(browser, "document.querySelector('#readout tr:nth-child(2) td').textContent"))


@needs_chromium
def test_slider_moves_the_contact_front_and_other_impacts_can_be_chosen(chromium: Any, written: Any) -> None:
    browser = opened(chromium, written.file.as_uri(), 390)
    last = int(ask(browser, "Number(document.getElementById('time').max)"))
    move = "const s = document.getElementById('time'); s.value = arguments[0]; s.dispatchEvent(new Event('input'))"
    fronts, instants = [], []
    for place in (0, last // 2, last):
        browser.execute_script(move, place)
        fronts.append(front(browser))
        instants.append(ask(browser, "document.getElementById('instant').textContent"))
    assert fronts[0] < fronts[1] < fronts[2] and len(set(instants)) == 3
    assert fronts[2] == pytest.approx(0.3222, rel=0.01)  # λ₀√0.1 at κ/ν = 0.5
    found = {}
    for index in (0, 1, 2):  # without acceleration, into the wall, away from it
        browser.execute_script(f"document.querySelectorAll('input[name=impact]')[{index}].click()")
        found[index] = front(browser)
    assert found[2] < found[0] < found[1]
    lines = ask(browser, "[...document.querySelectorAll('#beam .key span')].map(e => e.textContent)")
    assert {"theory", "Self-similar", "Hermite"} <= set(lines)  # side by side, on one timeline
