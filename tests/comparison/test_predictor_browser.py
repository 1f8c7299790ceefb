"""The predictor in headless Chromium: the same numbers as `theory`, by keyboard, on a phone, from a link."""

from __future__ import annotations

import dataclasses
import json
import shutil
import time
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.cases import case_from_tables, load_case
from comparison.command_line.app import run
from comparison.predictor import write_page
from theory import SelfSimilarWave, contact_parameters, predict
from theory.fields import ImpactFields
from theory.moment import peak_moment

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
DRIVER = shutil.which("chromedriver")
pytestmark = pytest.mark.skipif(CHROMIUM is None or DRIVER is None, reason="Chromium and its driver are not installed")

CASES = 10_000
SAME = 1e-9
FLAGS = ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-extensions")


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> str:
    return write_page(tmp_path_factory.mktemp("predictor") / "predictor.html").as_uri()


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service

    options = Options()
    options.binary_location = str(CHROMIUM)
    for flag in FLAGS:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(DRIVER))
    yield driver
    driver.quit()


def opened(driver: Any, address: str, width: int = 1400, fragment: str = "") -> Any:
    driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600},
    )
    driver.get("about:blank")
    driver.get(address + fragment)
    return driver


@pytest.fixture
def browser(chromium: Any, address: str) -> Any:
    return opened(chromium, address)


def ask(browser: Any, script: str, *arguments: Any) -> Any:
    return browser.execute_script(f"return {script}", *arguments)


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


def random_groups(seed: int) -> dict[str, np.ndarray]:
    """κ/ν over eight decades, most of it where contact spreads, and loads of every sign, with and without."""
    rng = np.random.default_rng(seed)
    ratio = np.where(rng.random(CASES) < 0.8, 1.0 - rng.random(CASES), 10.0 ** rng.uniform(-6.0, 2.0, CASES))
    groups = {"ratio": ratio}
    for name in ("alpha", "psi", "chi", "n"):
        size = 10.0 ** rng.uniform(-3.0, 2.0, CASES) * rng.choice([-1.0, 1.0], CASES)
        groups[name] = np.where(rng.random(CASES) < 0.3, 0.0, size)
    return groups


def test_contact_is_that_of_python_on_random_problems(browser: Any) -> None:
    groups = random_groups(20)
    found = ask(
        browser,
        "arguments[0].map(g => { const c = Theory.contact(...g), m = Theory.peakMoment(c);"
        " return [c.regime, c.lambda0, c.r0, c.lambda1, c.r1, c.lambdaN, c.rN, c.uniform, m.moment, m.at]; })",
        np.column_stack(list(groups.values())).tolist(),
    )
    ratio, alpha, psi, chi, n = groups.values()
    exact = contact_parameters(ratio, alpha, psi, chi, axial=n)
    peak = peak_moment(ratio)
    assert [row[0] for row in found] == exact.regime.tolist()
    assert set(exact.regime) == {"continuous", "detached", "discrete"}
    numbers = np.array([row[1:] for row in found], dtype=float)
    one, none = np.ones(CASES), np.zeros(CASES)
    # λ₁ and r₁ may be small differences of what α, ψ, χ and tension contribute: the measure is the largest of these
    share = [
        contact_parameters(ratio, abs(alpha) * one, 0.0),
        contact_parameters(ratio, 0.0, abs(psi) * one),
        contact_parameters(ratio, 0.0, 0.0, abs(chi) * one),
        contact_parameters(ratio, abs(n) * ratio, axial=abs(n)),
    ]
    pull = [contact_parameters(ratio, none, axial=abs(n))]
    parts = share + pull
    scale = {
        "lambda1": np.max([np.abs(p.lambda1) for p in parts], axis=0),
        "r1": np.max([np.abs(p.r1) for p in parts], axis=0),
        "uniform": np.abs(alpha) + np.abs(n * ratio) + np.abs(psi),
    }
    wanted = {
        "lambda0": exact.lambda0,
        "r0": exact.r0,
        "lambda1": exact.lambda1,
        "r1": exact.r1,
        "lambdaN": exact.lambda_axial,
        "rN": exact.r_axial,
        "uniform": exact.uniform_reaction,
        "moment": peak.largest,
        "place": peak.place_of_largest,
    }
    for column, (name, value) in enumerate(wanted.items()):
        size = scale.get(name, np.abs(value))
        error = np.abs(numbers[:, column] - value)
        assert np.all(error <= SAME * size + 1e-300), (name, np.nanmax(error / np.where(size > 0.0, size, 1.0)))


def random_impacts(count: int, seed: int) -> list[Impact]:
    """Beams from wire to girder, every regime, first-order corrections of up to half the leading order."""
    rng = np.random.default_rng(seed)
    impacts = []
    for _ in range(count):
        stiffness, mass, velocity = 10.0 ** rng.uniform((-2.0, -2.0, -1.0), (8.0, 3.0, 1.0))
        scale = np.sqrt(stiffness / mass) / velocity
        ratio = 1.0 - rng.random() if rng.random() < 0.8 else 10.0 ** rng.uniform(-4.0, 2.0)
        impact = Impact(stiffness, mass, 10.0 ** rng.uniform(0.0, 2.0) * scale, ratio / scale, velocity)
        loads = rng.normal(size=4) * (rng.random(4) < 0.7)
        impacts.append(
            impact.replace(
                acceleration=loads[0] * velocity / impact.time_scale,
                fourth_derivative=loads[1] / scale**3,
                curvature_rate=loads[2] * velocity / scale**2,
                axial_force=loads[3] * mass * velocity**2,
                damping=(rng.random() < 0.5) * 10.0 ** rng.uniform(-6.0, -1.0) * impact.slow_time_scale,
                wall_curvature=(rng.random() < 0.3) * rng.uniform(-2.0, 0.9) * impact.curvature,
                natural_curvature=rng.choice([1.0, 0.0, rng.normal()]) * impact.curvature,
            )
        )
    return impacts


#: What the page calls a problem's numbers, and what `Impact` calls them.
NAMES = {
    "stiffness": "bending_stiffness",
    "mass": "mass_per_length",
    "length": "length",
    "curvature": "curvature",
    "velocity": "velocity",
    "acceleration": "acceleration",
    "curvatureRate": "curvature_rate",
    "fourthDerivative": "fourth_derivative",
    "tension": "axial_force",
    "damping": "damping",
    "wallCurvature": "wall_curvature",
    "naturalCurvature": "natural_curvature",
}


#: What ends the theory's validity, as the page and as `theory.validity` call it.
ENDINGS = {
    "ends": "waves back from the ends",
    "loads": "first-order correction",
    "tension": "tension",
    "slope": "slope",
    "damping": "damping",
    "touch": "lifted middle back on the wall",
}


def predictions_agree(browser: Any, impacts: list[Impact], seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows = []
    for impact in impacts:
        groups = (impact.epsilon_alpha, impact.epsilon_psi, impact.epsilon_chi, impact.epsilon_axial)
        rate = max(*(abs(group) for group in groups), 1e-3)
        rows.append((10.0 ** rng.uniform(-4.0, -1.0) / rate * impact.time_scale, impact))
    found = ask(
        browser,
        "arguments[1].map(([t, ...v]) => { const b = {area: 2, modulus: 0.5};"
        " arguments[0].forEach((name, i) => { b[name] = v[i]; });"
        " const p = Beam.solve(b), r = Beam.at(p, t);"
        " return [p.contact.regime, p.ends, p.validFrom, p.validUntil, r]; })",
        list(NAMES),
        [[t, *(getattr(i, name) for name in NAMES.values())] for t, i in rows],
    )
    compared = same_ending = 0
    for (t, impact), (regime, ends, begins, until, page) in zip(rows, found, strict=True):
        exact = predict(impact, t)
        row = exact.times[0]
        assert regime == exact.regime
        assert begins == pytest.approx(exact.valid_from, rel=SAME)
        assert until == pytest.approx(exact.valid_until, rel=SAME)
        same_ending += ENDINGS[ends] == exact.limited_by  # of two that are alike either may be named
        assert page["moment"] == pytest.approx(row.peak_moment, rel=SAME)
        assert page["stress"] == pytest.approx(row.peak_moment / 0.5 + abs(impact.axial_force) / 2.0, rel=SAME)
        if row.half_contact_length is None:
            continue  # beyond the expansion: the page stops before
        compared += 1
        # relative to what the numbers are made of: leading order and first order may cancel
        reach = np.sqrt(impact.wave_constant * t) * max(exact.lambda0, 1.0)
        push = impact.mass_per_length * impact.velocity * np.sqrt(impact.wave_constant) * exact.r0
        assert page["halfLength"] == pytest.approx(row.half_contact_length, rel=SAME, abs=SAME * reach)
        assert page["reaction"] == pytest.approx(row.reaction, rel=SAME, abs=SAME * push / np.sqrt(t))
        assert page["impulse"] == pytest.approx(row.impulse, rel=SAME, abs=SAME * push * np.sqrt(t))
        terms = impact.mass_per_length * abs(impact.acceleration) + impact.bending_stiffness * abs(
            impact.fourth_derivative
        )
        terms += abs(impact.axial_force) * impact.curvature
        assert page["uniform"] == pytest.approx(row.contact_force_per_length, rel=SAME, abs=SAME * terms)
    assert compared > 0.5 * len(impacts)
    assert same_ending >= 0.999 * len(impacts)


def test_prediction_is_that_of_python(browser: Any) -> None:
    predictions_agree(browser, random_impacts(100, 21), 22)


@pytest.mark.verify
def test_prediction_is_that_of_python_on_ten_thousand_problems(browser: Any) -> None:
    predictions_agree(browser, random_impacts(CASES, 23), 24)


@pytest.mark.verify
@pytest.mark.parametrize("ratio", [0.03, 0.1, 0.5, 0.9, 1.0, 3.0])
def test_shape_is_the_wave_of_python(browser: Any, ratio: float) -> None:
    x = np.linspace(0.0, 30.0, 61)
    found = ask(
        browser,
        "arguments[1].map(x => Theory.beamAt(Theory.shape(Theory.contact(arguments[0])), x, 0))",
        ratio,
        x.tolist(),
    )
    wave = SelfSimilarWave(contact_parameters(ratio))
    gap = np.where(x < wave.parameters.lambda0, 0.0, wave.gap(x)) if ratio < 1.0 else wave.gap(x)
    assert -np.array(found)[:, 0] == pytest.approx(gap, rel=1e-9, abs=1e-9)
    assert np.array(found)[:, 1] == pytest.approx(wave.curvature(x), rel=1e-9, abs=1e-9)


@pytest.mark.verify
@pytest.mark.parametrize(
    "groups",
    [
        (0.5, 1.0, 1.0, 0.0, 0.0),
        (0.5, -1.0, -1.0, 0.5, 0.0),
        (0.15, 2.0, -1.0, 1.0, 0.0),
        (0.15, -1.0, 0.3, 0.0, 0.0),
        (2.0, 1.0, 0.0, 0.0, 0.0),
        (0.5, -0.5, 0.0, 0.0, 1.0),
        (0.5, -1.5, 0.3, 0.0, 1.0),
        (0.15, 1.0, 0.5, -0.5, -1.0),
        (2.0, 0.0, 0.0, 0.0, 1.0),
    ],
)
def test_first_order_shape_is_the_convolution_but_for_the_second_order(browser: Any, groups: tuple[float, ...]) -> None:
    """The closed form of the page against the integrals of `theory.fields`, which carry a part of O(ε²)."""
    parameters = contact_parameters(*groups[:4], axial=groups[4])
    x = np.array([0.3, 0.8, 1.5, 2.5, 4.0]) * max(parameters.lambda0, 1.0)
    errors = []
    for tau in (0.02, 0.01):
        found = ask(
            browser,
            "arguments[1].map(x => Theory.beamAt(Theory.shape(Theory.contact(...arguments[0])), x, arguments[2])[0])",
            groups,
            x.tolist(),
            tau,
        )
        exact = ImpactFields(parameters, epsilon=1.0).beam(x * np.sqrt(tau), tau).deflection / tau
        errors.append(np.max(np.abs(np.array(found) - exact)))
    assert errors[1] < 2e-3
    assert errors[1] < 0.3 * errors[0] + 1e-12  # one point: the two agree to rounding


def test_loads_without_console_errors_and_without_requests(browser: Any) -> None:
    assert [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"] == []
    asked = [
        message["params"]["request"]["url"]
        for message in (json.loads(entry["message"])["message"] for entry in browser.get_log("performance"))
        if message["method"] == "Network.requestWillBeSent"
    ]
    assert [url for url in asked if not url.startswith(("file:", "data:", "blob:", "about:"))] == []
    loaded = ask(browser, "performance.getEntriesByType('resource').map(e => e.name)")
    assert [name for name in loaded if not name.startswith(("data:", "blob:"))] == []


@pytest.mark.verify
@pytest.mark.parametrize("width", [390, 1400])
def test_nothing_overflows(chromium: Any, address: str, width: int) -> None:
    browser = opened(chromium, address, width)
    assert ask(browser, "document.documentElement.scrollWidth <= window.innerWidth")
    wide = ask(
        browser,
        "[...document.querySelectorAll('#predictor *')].filter(e => e.offsetParent || e.ownerSVGElement)"
        ".filter(e => e.getBoundingClientRect().right > window.innerWidth + 1 && !e.closest('pre'))"
        ".map(e => e.tagName + '#' + e.id)",
    )
    assert wide == []
    small = ask(
        browser,
        "[...document.querySelectorAll('#predictor input, #predictor select, #predictor button')]"
        ".filter(e => e.offsetParent && e.getBoundingClientRect().height < 30).map(e => e.id)",
    )
    assert small == []


def test_more_curvature_stays_a_point_and_less_spreads(browser: Any) -> None:
    assert shown(browser, "verdict") == "Contact spreads."
    type_into(browser, "dogleg", "90")
    assert shown(browser, "verdict") == "Contact stays one point."
    type_into(browser, "dogleg", "3.4")
    type_into(browser, "load", "-30")
    assert shown(browser, "verdict") == "Contact spreads as two points."


@pytest.mark.verify
def test_keyboard_alone_reaches_and_moves_everything(browser: Any) -> None:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    reached = []
    for _ in range(40):
        ActionChains(browser).send_keys(Keys.TAB).perform()
        reached.append(ask(browser, "document.activeElement.id || document.activeElement.tagName"))
        if reached[-1] == "predict-time":
            break
    assert {"in-units", "in-section", "in-outer_diameter", "in-bow", "in-velocity", "in-tension"} <= set(reached)
    assert reached[-1] == "predict-time"
    before = shown(browser, "predict-instant"), ask(browser, "document.querySelector('#shape .beam').getAttribute('d')")
    ActionChains(browser).send_keys(Keys.HOME).send_keys(*[Keys.ARROW_RIGHT] * 60).perform()
    after = shown(browser, "predict-instant"), ask(browser, "document.querySelector('#shape .beam').getAttribute('d')")
    assert after[0] != before[0] and after[1] != before[1]


@pytest.mark.verify
def test_a_mistake_is_named_beside_its_field(browser: Any) -> None:
    type_into(browser, "inner_diameter", "130")
    assert "smaller" in shown(browser, "wrong-inner_diameter")
    assert not ask(browser, "document.getElementById('answer').offsetParent")
    type_into(browser, "inner_diameter", "ten")
    assert "number" in shown(browser, "wrong-inner_diameter")
    type_into(browser, "inner_diameter", "108.6")
    assert ask(browser, "document.getElementById('answer').offsetParent !== null")


@pytest.mark.verify
def test_a_link_carries_the_inputs(chromium: Any, address: str) -> None:
    browser = opened(chromium, address)
    choose(browser, "units", "oilfield")
    choose(browser, "bow", "curvature")
    choose(browser, "bow", "dogleg")
    type_into(browser, "dogleg", "4")
    type_into(browser, "velocity", "5.5")
    wanted = {name: shown(browser, name) for name in ("verdict", "holds", "values", "case")}
    fragment = "#" + ask(browser, "location.hash.slice(1)")
    again = opened(chromium, address, fragment=fragment)
    assert {name: shown(again, name) for name in wanted} == wanted
    assert ask(again, "document.getElementById('in-dogleg').value") == "4"
    strange = opened(chromium, address, fragment="#velocity=abc&units=cubits&nonsense=1&length=")
    assert shown(strange, "verdict") == "Contact spreads."


@pytest.mark.verify
def test_units_are_a_matter_of_display(browser: Any) -> None:
    before = shown(browser, "case")
    choose(browser, "units", "oilfield")
    assert ask(browser, "document.getElementById('in-outer_diameter').value") == "5"
    assert shown(browser, "case") == before


def random_inputs(count: int, seed: int) -> list[dict[str, Any]]:
    """What somebody might type, in every combination of ways to say it."""
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(count):
        outer, length = 10.0 ** rng.uniform(-3.0, -0.5), 10.0 ** rng.uniform(-0.5, 2.0)
        found.append(
            {
                "section": rng.choice(["pipe", "round_bar", "rectangle"]).item(),
                "bow": rng.choice(["curvature", "sagitta", "dogleg"]).item(),
                "approach": rng.choice(["velocity", "drop"]).item(),
                "outer_diameter": outer,
                "inner_diameter": outer * rng.uniform(0.1, 0.99),
                "diameter": outer,
                "thickness": outer,
                "width": outer * rng.uniform(0.2, 20.0),
                "fluid_density": rng.choice([0.0, 1100.0]).item(),
                "added_mass": rng.choice([0.0, 0.3]).item(),
                "length": length,
                "curvature": 10.0 ** rng.uniform(-4.0, 0.0) / length,
                "sagitta": length * 10.0 ** rng.uniform(-5.0, -1.0),
                "sagitta_length": length * rng.uniform(0.3, 1.0),
                "dogleg": 10.0 ** rng.uniform(-4.0, -1.0),
                "velocity": 10.0 ** rng.uniform(-2.0, 1.0),
                "drop_height": 10.0 ** rng.uniform(-3.0, 1.0),
                "tension": rng.choice([0.0, 1.0, -1.0]).item() * 10.0 ** rng.uniform(0.0, 3.0),
                "load": rng.choice([0.0, 1.0, -1.0]).item() * 10.0 ** rng.uniform(-1.0, 2.0),
                "natural_share": rng.choice([1.0, 0.0, 0.4]).item(),
                "damping_ratio": rng.choice([0.0, 10.0 ** rng.uniform(-4.0, -1.0)]).item(),
                "wall_curvature": rng.choice([0.0, -0.01, 1e-9]).item(),
            }
        )
    return found


def test_case_means_what_the_page_shows(browser: Any) -> None:
    inputs = random_inputs(60, 25)
    found = ask(
        browser,
        "arguments[0].map(given => { const i = {...Beam.START, ...given}, b = Beam.impact(i), p = Beam.solve(b);"
        " const holds = [p.validFrom, p.validUntil, p.shownUntil, p.ends, Beam.at(p, 1).stress];"
        " return [Beam.complaints(i), Case.toml(i, b, p), b, holds]; })",
        inputs,
    )
    for given, (complaints, text, page, (begins, until, shown, ends, stress)) in zip(inputs, found, strict=True):
        if given["sagitta"] >= given["sagitta_length"] / 2.0 and given["bow"] == "sagitta":
            assert complaints
            continue
        assert complaints == []
        case = case_from_tables(tomllib.loads(text))
        impact = case.impact
        mine = {
            "stiffness": impact.bending_stiffness,
            "mass": impact.mass_per_length,
            "length": impact.length,
            "curvature": impact.curvature,
            "velocity": impact.velocity,
            "tension": impact.axial_force,
            "acceleration": impact.acceleration,
            "damping": impact.damping,
            "wallCurvature": impact.wall_curvature,
        }
        for name, value in mine.items():
            assert page[name] == pytest.approx(value, rel=1e-12, abs=1e-12), (name, text)
        assert case.end_time == shown
        assert ("until when the theory holds" in text) == (begins < until)
        assert case.section is not None
        assert page["modulus"] == pytest.approx(case.section.section_modulus, rel=1e-12)
        assert page["area"] == pytest.approx(case.section.area, rel=1e-12)
        assert page["shear"] == pytest.approx(case.section.shear_stiffness, rel=1e-12)
        exact = predict(impact, 1.0, section=dataclasses.replace(case.section, yield_stress=None))
        assert stress == pytest.approx(exact.times[0].peak_stress, rel=SAME)
        assert (ends == "shear") == (exact.limited_by == "shear")
        if ends != "shear":
            assert begins == pytest.approx(exact.valid_from, rel=SAME)
            assert until == pytest.approx(exact.valid_until, rel=SAME)


def test_saved_case_is_predicted_with_the_numbers_of_the_page(
    chromium: Any, address: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As a newcomer does it: type, save, hand the file to the command."""
    browser = opened(chromium, address)
    browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    choose(browser, "units", "oilfield")
    for name, text in (("outer_diameter", "6.625"), ("inner_diameter", "5.965"), ("length", "400"), ("dogleg", "4.2")):
        type_into(browser, name, text)
    type_into(browser, "velocity", "5")
    type_into(browser, "tension", "20")
    browser.find_element("id", "save").click()
    file = tmp_path / "impact.toml"
    for _ in range(100):
        if file.exists():
            break
        time.sleep(0.05)
    moment = 0.004
    page = ask(
        browser,
        "(() => { const given = [...new URLSearchParams(location.hash.slice(1))]"
        ".map(([k, v]) => [k, Number.isNaN(Number(v)) ? v : Number(v)]);"
        " const p = Beam.solve(Beam.impact({...Beam.START, ...Object.fromEntries(given)}));"
        " return {...Beam.at(p, arguments[0]), from: p.validFrom, until: p.validUntil}; })()",
        moment,
    )
    assert run(["predict", str(file), "--time", str(moment), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    row = found["times"][0]
    assert row["valid"] and page["from"] < moment < page["until"]
    named = {
        "halfLength": "half_contact_length",
        "reaction": "reaction",
        "impulse": "impulse",
        "moment": "peak_moment",
        "stress": "peak_stress",
    }
    for here, there in named.items():
        assert page[here] == pytest.approx(row[there], rel=SAME), here


def test_page_starts_with_the_drill_pipe_of_the_cases(browser: Any) -> None:
    shipped = load_case(Path(__file__).parents[2] / "cases" / "drill_pipe.toml").impact
    page = case_from_tables(tomllib.loads(shown(browser, "case"))).impact
    assert (page.kappa_over_nu, page.bending_stiffness, page.length) == pytest.approx(
        (shipped.kappa_over_nu, shipped.bending_stiffness, shipped.length), rel=1e-9
    )


@pytest.mark.verify
def test_a_change_takes_a_blink(browser: Any) -> None:
    """All work of a change, drawing included, stays below what an eye sees: counted in points, not in time."""
    assert ask(browser, "document.querySelectorAll('#predictor svg path').length") < 20
    points = ask(
        browser,
        "[...document.querySelectorAll('#predictor svg path')].map(p => p.getAttribute('d').split('L').length)"
        ".reduce((a, b) => a + b)",
    )
    assert points < 1500
