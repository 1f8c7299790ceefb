"""The report in headless Chromium, on a screen and a phone."""

from typing import Any

import pytest

from tests.chromium import ask, assert_quiet, beyond_the_edge, chromium, needs_chromium, opened  # noqa: F401

pytestmark = needs_chromium
LABELS = ("theory", "Hermite", "Exudyn")


@pytest.fixture(scope="module")
def address(written: Any) -> str:
    return str(written.file.as_uri())


@pytest.fixture(scope="module")
def browser(chromium: Any, address: str) -> Any:  # noqa: F811
    return opened(chromium, address, 390)


@pytest.mark.parametrize("width", [1400, 390])
def test_everything_is_drawn_without_errors_or_requests_and_nothing_overflows(
    browser: Any, address: str, width: int
) -> None:
    opened(browser, address, width)
    assert beyond_the_edge(browser, "section, header, p, h2, .plot, table") == []
    cut = "[...document.querySelectorAll('.scroll > table')].filter(e => e.offsetParent)"
    assert ask(browser, f"{cut}.filter(e => e.scrollWidth > e.parentElement.clientWidth + 1).map(e => e.id)") == []
    empty = "[...document.querySelectorAll('.plot')].filter(e => !e.querySelector('svg.main-svg'))"
    assert ask(browser, f"{empty}.map(e => e.id || e.dataset.plot)") == []
    assert ask(browser, "document.querySelectorAll('.plot').length") >= 10
    drawings = "['.whisker', '.drawings'].map(name => document.querySelector(name).checkVisibility())"
    assert len(set(ask(browser, drawings))) == 1  # explained where they are shown
    assert_quiet(browser)


def test_switches_hide_and_show_one_method(browser: Any) -> None:
    def visible() -> list[int]:
        traces = "[...document.querySelectorAll('[data-plot]')].flatMap(e => e.data || [])"
        count = "traces.filter(t => t.meta.label === label && t.visible !== false).length"
        return list(ask(browser, f"(traces => arguments[0].map(label => {count}))({traces})", LABELS))

    before = visible()
    for i, label in enumerate(LABELS):
        switch = "document.querySelector(`input[data-label='${arguments[0]}']`).click()"
        browser.execute_script(switch, label)
        assert visible() == [0 if j == i else n for j, n in enumerate(before)]
        browser.execute_script(switch, label)
    assert visible() == before and min(before) > 0


def move(browser: Any, place: int) -> None:
    script = "const s = document.getElementById('time'); s.value = arguments[0]; s.dispatchEvent(new Event('input'))"
    browser.execute_script(script, place)


def front(browser: Any) -> float:
    return float(ask(browser, "document.getElementById('beam').data[0].x[1]"))


def test_slider_moves_the_contact_front_and_other_impacts_can_be_chosen(browser: Any) -> None:
    last = int(ask(browser, "Number(document.getElementById('time').max)"))
    fronts, instants = [], []
    for place in (0, last // 2, last):
        move(browser, place)
        fronts.append(front(browser))
        instants.append(ask(browser, "document.getElementById('instant').textContent"))
    assert fronts[0] < fronts[1] < fronts[2] and len(set(instants)) == 3
    assert fronts[2] == pytest.approx(0.3222, rel=0.01)  # λ₀√0.1 at κ/ν = 0.5
    assert "half contact length" in ask(browser, "document.getElementById('readout').textContent")
    found = {}
    for index in (0, 1, 2):  # without acceleration, into the wall, away from it
        browser.execute_script(f"document.querySelectorAll('input[name=impact]')[{index}].click()")
        found[index] = front(browser)
        assert ask(browser, "document.querySelector('[data-map]').data[0].z.length") > 30
    assert found[2] < found[0] < found[1]
    lines = ask(browser, "document.getElementById('beam').data.map(t => t.name)")
    assert {"Theory", "Self-similar", "Hermite"} <= set(lines)  # side by side, on one timeline


def test_paper_shows_still_pictures_instead_of_plots_and_warnings_are_seen_on_a_phone(browser: Any) -> None:
    assert ask(browser, "[...document.querySelectorAll('td.path a')].map(e => e.offsetParent !== null)") == [True]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        assert ask(browser, "[...document.querySelectorAll('.plot')].every(e => e.offsetParent === null)")
        still = "[...document.querySelectorAll('.still')].every(e => getComputedStyle(e).display !== 'none')"
        assert ask(browser, still)
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
