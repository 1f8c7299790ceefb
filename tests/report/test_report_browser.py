"""The report in headless Chromium, on a screen and a phone."""

from typing import Any

import pytest
from chromium import ask, assert_quiet, beyond_the_edge, needs_chromium, opened

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def browser(chromium: Any, written: Any) -> Any:
    return opened(chromium, written.file.as_uri(), 390)


@pytest.mark.parametrize("width", [1400, 390])
def test_everything_is_drawn_without_errors_or_requests_and_nothing_overflows_or_is_lost(browser, written, width):
    opened(browser, written.file.as_uri(), width)
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


def test_slider_moves_the_contact_front_and_other_impacts_can_be_chosen(browser: Any) -> None:
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
