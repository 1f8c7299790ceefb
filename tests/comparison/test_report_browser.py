"""The report in headless Chromium (Debian's chromium and chromium-driver), on a screen and a phone."""

from __future__ import annotations

import json
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from comparison.report.page import page

sys.path.insert(0, str(Path(__file__).parent))
from report_fixtures import content

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
DRIVER = shutil.which("chromedriver")
pytestmark = pytest.mark.skipif(CHROMIUM is None or DRIVER is None, reason="Chromium and its driver are not installed")

WIDTHS = (pytest.param(1400, marks=pytest.mark.verify), 390)


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("report") / "index.html"
    target.write_text(page(content()), encoding="utf-8")
    return target


@pytest.fixture(scope="module", params=WIDTHS)
def browser(request: pytest.FixtureRequest, file: Path) -> Iterator[Any]:
    """The page, loaded at one width."""
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service

    options = Options()
    options.binary_location = str(CHROMIUM)
    for flag in (
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-dev-shm-usage",
        "--disable-extensions",
    ):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(DRIVER))
    driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": request.param, "height": 900, "deviceScaleFactor": 1, "mobile": request.param < 600},
    )
    driver.get(file.as_uri())
    yield driver
    driver.quit()


def ask(browser: Any, script: str) -> Any:
    return browser.execute_script(f"return {script}")


def test_loads_without_console_errors_and_without_requests(browser: Any) -> None:
    assert [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"] == []
    asked = []
    for entry in browser.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            asked.append(message["params"]["request"]["url"])
    outside = [url for url in asked if not url.startswith(("file:", "data:", "blob:", "about:"))]
    assert outside == []
    assert sum(url.startswith("file:") for url in asked) <= 1
    assert (
        ask(
            browser,
            "performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length",
        )
        == 0
    )


def test_nothing_overflows(browser: Any) -> None:
    assert ask(browser, "document.documentElement.scrollWidth <= window.innerWidth")
    wide = ask(
        browser,
        "[...document.querySelectorAll('section, header, p, h2, .plot, .cards article, table')]"
        ".filter(e => e.offsetParent)"
        ".filter(e => e.getBoundingClientRect().right > window.innerWidth + 1)"
        ".map(e => e.tagName + '.' + e.className + '#' + e.id)",
    )
    assert wide == []
    cut = ask(
        browser,
        "[...document.querySelectorAll('.scroll > table')].filter(e => e.offsetParent)"
        ".filter(e => e.scrollWidth > e.parentElement.clientWidth + 1).map(e => e.id)",
    )
    assert cut == []


def test_every_plot_is_drawn(browser: Any) -> None:
    places = ask(
        browser,
        "[...document.querySelectorAll('.plot')].filter(e => !e.querySelector('svg.main-svg'))"
        ".map(e => e.id || e.dataset.plot)",
    )
    assert places == []
    assert ask(browser, "document.querySelectorAll('.plot').length") >= 14


LABELS = ("theory", "Hermite", "Exudyn")


def visible_traces(browser: Any, label: str) -> int:
    return int(
        ask(
            browser,
            "[...document.querySelectorAll('[data-plot]')].flatMap(e => e.data || [])"
            f".filter(t => t.meta.label === '{label}' && t.visible !== false).length",
        )
    )


def switch(browser: Any, label: str) -> None:
    browser.execute_script("document.querySelector(`input[data-label='${arguments[0]}']`).click()", label)


@pytest.mark.parametrize("label", LABELS)
def test_switches_hide_and_show_a_method(browser: Any, label: str) -> None:
    before = visible_traces(browser, label)
    others = {other: visible_traces(browser, other) for other in LABELS if other != label}
    assert before > 0
    switch(browser, label)
    assert visible_traces(browser, label) == 0
    assert {other: visible_traces(browser, other) for other in others} == others
    switch(browser, label)
    assert visible_traces(browser, label) == before


def test_warnings_are_seen_at_every_width(browser: Any) -> None:
    assert ask(browser, "[...document.querySelectorAll('td.path a')].every(e => e.offsetParent !== null)")
    assert ask(browser, "document.querySelectorAll('td.path a').length") > 0


def test_small_drawings_are_explained_where_they_are_shown(browser: Any) -> None:
    shown = ask(browser, "document.querySelector('.whisker').checkVisibility()")
    assert ask(browser, "document.querySelector('.drawings').checkVisibility()") == shown


def move(browser: Any, place: int) -> None:
    browser.execute_script(
        "const s = document.getElementById('time'); s.value = arguments[0];s.dispatchEvent(new Event('input'))",
        place,
    )


def front(browser: Any) -> float:
    return float(ask(browser, "document.getElementById('beam').data[0].x[1]"))


def test_slider_moves_the_contact_front(browser: Any) -> None:
    last = int(ask(browser, "Number(document.getElementById('time').max)"))
    fronts, instants = [], []
    for place in (0, last // 2, last):
        move(browser, place)
        fronts.append(front(browser))
        instants.append(ask(browser, "document.getElementById('instant').textContent"))
    assert fronts[0] < fronts[1] < fronts[2]
    assert fronts[2] == pytest.approx(0.3222, rel=0.01)  # λ₀√0.1 at κ/ν = 0.5
    assert len(set(instants)) == 3
    assert "half contact length" in ask(browser, "document.getElementById('readout').textContent")


def test_other_impacts_can_be_chosen(browser: Any) -> None:
    move(browser, 49)
    found = {}
    for index in (0, 1, 2):
        browser.execute_script(f"document.querySelectorAll('input[name=impact]')[{index}].click()")
        found[index] = front(browser)
        assert ask(browser, "document.querySelector('[data-map]').data[0].z.length") > 30
    assert found[2] < found[0] < found[1]
    lines = ask(browser, "document.getElementById('beam').data.map(t => t.name)")
    assert {"Theory", "Self-similar", "Hermite"} <= set(lines)  # side by side, on one timeline
    browser.execute_script("document.querySelectorAll('input[name=impact]')[0].click()")


def test_play_runs_and_stops(browser: Any) -> None:
    import time

    move(browser, 0)
    browser.execute_script("document.getElementById('play').click()")
    time.sleep(0.8)
    browser.execute_script("document.getElementById('play').click()")
    reached = int(ask(browser, "Number(document.getElementById('time').value)"))
    assert reached > 0
    time.sleep(0.3)
    assert int(ask(browser, "Number(document.getElementById('time').value)")) == reached


def test_paper_shows_still_pictures_instead_of_plots(browser: Any) -> None:
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        assert ask(browser, "[...document.querySelectorAll('.plot')].every(e => e.offsetParent === null)")
        assert ask(
            browser,
            "[...document.querySelectorAll('.still')].every(e => getComputedStyle(e).display !== 'none')",
        )
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})


def test_nothing_went_wrong_on_the_way(browser: Any) -> None:
    assert [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"] == []
