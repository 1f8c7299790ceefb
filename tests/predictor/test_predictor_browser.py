"""The page in headless Chromium: what it simulates and says, by keyboard, on a phone, from a link, from a case file."""

import math
from pathlib import Path
from typing import Any

import pytest
from chromium import ask, assert_quiet, beyond_the_edge, disquiet, needs_chromium, opened
from processes import until

from bent_beam.cases import load_case
from bent_beam_programs.predictor.page import write_page
from theory import contact_parameters

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> str:
    return write_page(tmp_path_factory.mktemp("predictor") / "predictor.html").as_uri()


@pytest.fixture
def browser(chromium: Any, address: str) -> Any:
    return opened(chromium, address)


def type_into(browser: Any, name: str, text: str) -> None:
    """As somebody types it: the field is emptied, then filled."""
    field = browser.find_element("id", f"in-{name}")
    field.clear()
    field.send_keys(text)


def shown(browser: Any, name: str) -> str:
    return str(ask(browser, f"document.getElementById('{name}').textContent"))


def simulated(browser: Any) -> Any:
    """The browser once every number has its bar."""
    until(lambda: ask(browser, "document.body.dataset.state") == "done", 60.0)
    return browser


@pytest.mark.parametrize("width", [390, 1400])
def test_loads_without_errors_or_requests_and_nothing_overflows_or_covers(chromium, address, width):
    browser = simulated(opened(chromium, address, width))
    assert_quiet(browser)
    assert beyond_the_edge(browser, "#predictor *") == []
    fields = "[...document.querySelectorAll('#predictor input:not([type=file]), #predictor select, #predictor button')]"
    fields += ".filter(e => e.offsetParent)"
    assert ask(browser, f"{fields}.filter(e => e.getBoundingClientRect().height < 30).map(e => e.id)") == []
    above = "(e => { e.scrollIntoView({block: 'end'}); const b = e.getBoundingClientRect();"
    above += " return document.elementFromPoint(b.x + b.width / 2, b.y + b.height / 2) !== e; })"
    assert ask(browser, f"{fields}.filter({above}).map(e => e.id)") == []


def test_what_is_typed_decides_and_mistakes_are_named_beside_their_field(browser: Any) -> None:
    assert "a zone" in shown(browser, "verdict")
    type_into(browser, "load", "-30")
    assert "two points" in shown(browser, "verdict")
    type_into(browser, "sagitta", "90")
    assert "one point" in shown(browser, "verdict")
    type_into(browser, "inner_diameter", "130")
    assert "smaller" in shown(browser, "wrong-inner_diameter")
    assert not ask(browser, "document.getElementById('answer').offsetParent")
    type_into(browser, "inner_diameter", "ten")
    assert "number" in shown(browser, "wrong-inner_diameter")
    type_into(browser, "inner_diameter", "44")
    assert ask(browser, "document.getElementById('answer').offsetParent !== null")


def test_a_mistake_takes_no_button_away(chromium: Any, address: str) -> None:
    """A case that is saved then is that of before; of a link with a mistake there is none."""
    browser = opened(chromium, address + "#velocity=2")
    before = shown(browser, "case")
    type_into(browser, "density", "0")
    buttons = ("save", "copy", "reset")
    assert all(browser.find_element("id", name).is_displayed() for name in buttons)
    assert ask(browser, "document.querySelector('[for=open]').offsetParent !== null")
    assert shown(browser, "case") == before and "before the mistake" in shown(browser, "cannot")
    browser.find_element("id", "reset").click()
    assert ask(browser, "document.getElementById('in-velocity').value") == "1"
    assert ask(browser, "document.getElementById('answer').offsetParent !== null")
    opened(browser, address + "#velocity=0").find_element("id", "save").click()
    assert shown(browser, "note") == "There is no case yet." and disquiet(browser) == []


MOMENT = """(() => { const b = Beam.impact(Beam.START), p = Beam.problem(b, b.damping);
    const solver = new Function(document.querySelector('#simulation').textContent + '; return Solver;')();
    return solver.simulate(p, Answer.runs(p).base).moment; })()"""  # in units of ℓ = EI = μ = V₀ = 1


def marked(browser: Any) -> str:
    """The stress beside the mark of the largest: with the digits that its bar allows."""
    label = str(ask(browser, "document.querySelector('#plot-stress .mark + .name').textContent"))
    return label.split(" MPa at ")[0]


def test_damping_has_three_states_and_the_page_starts_with_the_tube(chromium: Any, address: str) -> None:
    browser = simulated(opened(chromium, address + "#damping_ratio="))
    curves = "document.querySelectorAll('#plot-stress .curve').length"
    assert ask(browser, curves) == 3 and "0.02 %" in shown(browser, "dampings")
    assert shown(browser, "stress") in shown(browser, "dampings")  # the headline is one of the three
    assert marked(browser) == shown(browser, "stress").split(" ± ")[0]
    browser = simulated(opened(chromium, address + "#damping_ratio=0"))
    assert "band of" in shown(browser, "stress") and "bentbeam bounce" in shown(browser, "warnings")
    browser = simulated(opened(chromium, address))
    assert ask(browser, curves) == 1 and shown(browser, "dampings") == ""
    drawn = ask(browser, "[...document.querySelectorAll('#answer .plots path')].map(e => e.getAttribute('d').length)")
    assert len(drawn) >= 4 and min(drawn) > 60  # stress, force, impulse of the simulation and of the theory
    assert marked(browser) == shown(browser, "stress").split(" ± ")[0]
    value, error = (float(word) for word in shown(browser, "stress").removesuffix(" MPa").split(" ± "))
    tube = load_case("cases/tube.toml")
    unit = tube.impact.velocity * math.sqrt(tube.impact.bending_stiffness * tube.impact.mass_per_length)
    assert abs(value - 1e-6 * ask(browser, MOMENT) * unit / tube.section.section_modulus) <= 0.5 * error


def test_a_slider_changes_the_field_last_touched_and_a_curve_follows(browser: Any, address: str) -> None:
    curve = "document.querySelector('#plot-stress path.curve')?.getAttribute('d')"
    until(lambda: ask(browser, curve), 60.0)
    before = ask(browser, curve)
    browser.find_element("id", "in-length").click()
    ask(browser, "(d => { d.value = 0.5; d.dispatchEvent(new Event('input')); })(document.getElementById('drag'))")
    assert ask(browser, "document.getElementById('in-length').value") == "6"
    until(lambda: ask(browser, curve) != before, 60.0)
    still = opened(browser, f"{address}#velocity=0")  # no field has a value that could be dragged
    still.execute_script("document.getElementById('drag').dispatchEvent(new Event('change'))")
    assert disquiet(still) == []


def test_keyboard_alone_reaches_and_moves_everything(browser: Any) -> None:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    simulated(browser)
    reached: list[str] = []
    while len(reached) < 50 and reached[-1:] != ["time"]:
        ActionChains(browser).send_keys(Keys.TAB).perform()
        reached.append(ask(browser, "document.activeElement.id || document.activeElement.tagName"))
    assert {"in-units", "drag", "in-outer_diameter", "in-bow", "in-velocity", "in-tension", "play"} <= set(reached)
    picture = "document.getElementById('motion').toDataURL()"
    before = shown(browser, "instant"), ask(browser, picture)
    ActionChains(browser).send_keys(*[Keys.PAGE_UP] * 3).perform()
    after = shown(browser, "instant"), ask(browser, picture)
    assert after[0] != before[0] and after[1] != before[1]


def test_a_link_carries_the_case_and_units_are_a_matter_of_display(chromium: Any, address: str) -> None:
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select

    browser = opened(chromium, address)
    before = shown(browser, "case")
    Select(browser.find_element("id", "in-units")).select_by_value("oilfield")
    inches = float(ask(browser, "document.getElementById('in-outer_diameter').value"))
    assert inches == pytest.approx(0.05 / 0.0254, rel=1e-5)
    assert shown(browser, "case") == before
    type_into(browser, "velocity", "5.5")
    browser.find_element("id", "in-damping_ratio").send_keys(Keys.END, Keys.BACKSPACE)  # its 1, so that it is empty
    wanted = {name: shown(browser, name) for name in ("verdict", "holds", "case")}
    again = opened(chromium, ask(browser, "location.href"))
    assert {name: shown(again, name) for name in wanted} == wanted and "damping_ratio" not in wanted["case"]
    assert shown(opened(chromium, address + "#velocity=abc&units=cubits&nonsense=1&length="), "case") == before


def test_a_case_is_saved_and_opened(chromium: Any, address: str, tmp_path: Path) -> None:
    """As a newcomer does it: type, save, hand the file to the library; and open the file of somebody else."""
    browser = opened(chromium, address)
    browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    type_into(browser, "velocity", "5")
    type_into(browser, "tension", "20")
    browser.find_element("id", "save").click()
    saved = tmp_path / "impact.toml"
    until(lambda: saved.exists() and saved.stat().st_size > 0, 60.0)  # it is there before its text
    impact = load_case(saved).impact
    assert impact.velocity == 5.0 and impact.axial_force == 20e3
    for name, place, words in (("drill_pipe", "note", "is read"), ("two_walls", "refused", "is not read")):
        browser.find_element("id", "open").send_keys(str(Path(f"cases/{name}.toml").resolve()))
        until(lambda place=place, words=words: words in shown(browser, place), 60.0)
    lambda0 = contact_parameters(load_case("cases/drill_pipe.toml").impact.kappa_over_nu).lambda0
    assert f"λ₀ = {lambda0:.6g}" in shown(browser, "groups")  # what cannot be read changes nothing
    assert "the form and its numbers are unchanged" in shown(browser, "refused") and shown(browser, "note") == ""
    above = "(([a, b]) => a.bottom <= b.top && a.top >= 0)(['refused', 'answer'].map("
    above += "id => document.getElementById(id).getBoundingClientRect()))"
    assert ask(browser, above)  # and is seen, though the button is at the bottom
    type_into(browser, "velocity", "4")
    assert not browser.find_element("id", "refused").is_displayed()
