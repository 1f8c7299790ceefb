"""The predictor in headless Chromium: what it says, by keyboard, on a phone, from a link."""

import time
from pathlib import Path
from typing import Any

import pytest

from bent_beam.cases import load_case
from bent_beam_programs.predictor.page import write_page
from tests.chromium import ask, assert_quiet, beyond_the_edge, chromium, needs_chromium, opened  # noqa: F401
from theory import contact_parameters

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> str:
    return write_page(tmp_path_factory.mktemp("predictor") / "predictor.html").as_uri()


@pytest.fixture
def browser(chromium: Any, address: str) -> Any:  # noqa: F811
    return opened(chromium, address)


def type_into(browser: Any, name: str, text: str) -> None:
    """As somebody types it: the field is emptied, then filled."""
    field = browser.find_element("id", f"in-{name}")
    field.clear()
    field.send_keys(text)


def choose(browser: Any, name: str, value: str) -> None:
    from selenium.webdriver.support.ui import Select

    Select(browser.find_element("id", f"in-{name}")).select_by_value(value)


def shown(browser: Any, name: str) -> str:
    return str(ask(browser, f"document.getElementById('{name}').textContent"))


@pytest.mark.parametrize("width", [390, 1400])
def test_loads_without_errors_or_requests_and_nothing_overflows(chromium: Any, address: str, width: int) -> None:  # noqa: F811
    browser = opened(chromium, address, width)
    assert_quiet(browser)
    assert beyond_the_edge(browser, "#predictor *") == []
    small = "[...document.querySelectorAll('#predictor input, #predictor select, #predictor button')]"
    small += ".filter(e => e.offsetParent && e.getBoundingClientRect().height < 30).map(e => e.id)"
    assert ask(browser, small) == []


def test_what_is_typed_decides_the_verdict_and_mistakes_are_named_beside_their_field(browser: Any) -> None:
    assert shown(browser, "verdict") == "Contact spreads."
    type_into(browser, "dogleg", "90")
    assert shown(browser, "verdict") == "Contact stays one point."
    type_into(browser, "dogleg", "3.4")
    type_into(browser, "load", "-30")
    assert shown(browser, "verdict") == "Contact spreads as two points."
    type_into(browser, "inner_diameter", "130")
    assert "smaller" in shown(browser, "wrong-inner_diameter")
    assert not ask(browser, "document.getElementById('answer').offsetParent")
    type_into(browser, "inner_diameter", "ten")
    assert "number" in shown(browser, "wrong-inner_diameter")
    type_into(browser, "inner_diameter", "108.6")
    assert ask(browser, "document.getElementById('answer').offsetParent !== null")


def test_every_stress_says_its_range_and_the_whole_impact_is_left_to_a_simulation(browser: Any) -> None:
    """The first instants of the drill pipe bear 99 MPa, its whole impact four times as much."""
    assert "first instants, until" in shown(browser, "peak") and "whole impact: simulate it" in shown(browser, "peak")
    assert shown(browser, "yields") == shown(browser, "damped") == ""
    type_into(browser, "yield_stress", "90")
    assert "exceeds the yield stress" in shown(browser, "yields")
    type_into(browser, "load", "20")
    assert "whole impact: simulate it" in shown(browser, "peak") and "below" not in shown(browser, "answer")
    type_into(browser, "damping_ratio", "1")
    assert "Without damping" in shown(browser, "holds") and "bentbeam predict" in shown(browser, "damped")
    type_into(browser, "length", "2")  # shear matters until waves are back: no model of ours is advised
    assert "not known" in shown(browser, "peak") and "simulate it" not in shown(browser, "answer")


def test_keyboard_alone_reaches_and_moves_everything(browser: Any) -> None:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    reached: list[str] = []
    while len(reached) < 40 and reached[-1:] != ["predict-time"]:
        ActionChains(browser).send_keys(Keys.TAB).perform()
        reached.append(ask(browser, "document.activeElement.id || document.activeElement.tagName"))
    assert {"in-units", "in-section", "in-outer_diameter", "in-bow", "in-velocity", "in-tension"} <= set(reached)
    shape = "document.querySelector('#shape .beam').getAttribute('d')"
    before = shown(browser, "predict-instant"), ask(browser, shape)
    ActionChains(browser).send_keys(Keys.HOME).send_keys(*[Keys.ARROW_RIGHT] * 10).perform()
    after = shown(browser, "predict-instant"), ask(browser, shape)
    assert after[0] != before[0] and after[1] != before[1]


def test_a_link_carries_the_inputs_and_units_are_a_matter_of_display(chromium: Any, address: str) -> None:  # noqa: F811
    browser = opened(chromium, address)
    before = shown(browser, "case")
    choose(browser, "units", "oilfield")
    assert ask(browser, "document.getElementById('in-outer_diameter').value") == "5"
    assert shown(browser, "case") == before
    type_into(browser, "dogleg", "4")
    type_into(browser, "velocity", "5.5")
    wanted = {name: shown(browser, name) for name in ("verdict", "holds", "values", "case")}
    again = opened(chromium, ask(browser, "location.href"))
    assert {name: shown(again, name) for name in wanted} == wanted
    assert ask(again, "document.getElementById('in-dogleg').value") == "4"
    strange = opened(chromium, address + "#velocity=abc&units=cubits&nonsense=1&length=")
    assert shown(strange, "verdict") == "Contact spreads."


def test_saved_case_is_the_beam_of_the_page(chromium: Any, address: str, tmp_path: Path) -> None:  # noqa: F811
    """As a newcomer does it: type, save, hand the file to the library."""
    browser = opened(chromium, address)
    browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    type_into(browser, "velocity", "5")
    type_into(browser, "tension", "20")
    browser.find_element("id", "save").click()
    file, waited = tmp_path / "impact.toml", 0
    while not file.exists() and (waited := waited + 1) < 100:
        time.sleep(0.05)
    impact = load_case(file).impact
    lambda0 = contact_parameters(impact.kappa_over_nu).lambda0
    assert impact.velocity == 5.0 and impact.axial_force == 20e3
    assert f"λ₀ = {lambda0:.6g}" in shown(browser, "groups")
