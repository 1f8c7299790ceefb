"""The built site in a browser: formulas are drawn, nothing is asked of the web, nothing overflows (make verify)."""

from __future__ import annotations

import importlib.util
import io
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
DRIVER = shutil.which("chromedriver")
BUILDERS = ("mkdocs", "quickjax", "mkdocs_jupyter", "mkdocstrings")
NOT_PROSE = "pre, code, .highlight, .formula, script, style, .clipboard-copy-txt, .zeroclipboard-container"
pytestmark = [
    pytest.mark.verify,
    pytest.mark.skipif(CHROMIUM is None or DRIVER is None, reason="Chromium and its driver are not installed"),
    pytest.mark.skipif(
        any(importlib.util.find_spec(name) is None for name in BUILDERS), reason="pip install '.[docs]' builds the site"
    ),
]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("site")
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "NO_MKDOCS_2_WARNING": "1"}
    command = [sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "--site-dir", str(target)]
    subprocess.run(command, check=True, cwd=ROOT, env=environment, timeout=600)
    return target


@pytest.fixture(scope="module", params=[1400, 390])
def browser(request: pytest.FixtureRequest) -> Iterator[Any]:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service

    options = Options()
    options.binary_location = str(CHROMIUM)
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-extensions"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(DRIVER))
    driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": request.param, "height": 900, "deviceScaleFactor": 1, "mobile": request.param < 600},
    )
    yield driver
    driver.quit()


def ask(browser: Any, script: str, *arguments: Any) -> Any:
    return browser.execute_script(f"return {script}", *arguments)


def test_every_page_keeps_to_its_width_and_to_itself(browser: Any, site: Path) -> None:
    pages = [page for page in sorted(site.rglob("*.html")) if page.name != "404.html"]  # the latter is for a server
    assert len(pages) > 15
    wide, broken = [], []
    for page in pages:
        browser.get(page.as_uri())
        name = str(page.relative_to(site))
        if not ask(browser, "document.documentElement.scrollWidth <= window.innerWidth"):
            wide.append(name)
        broken += [(name, e["message"]) for e in browser.get_log("browser") if e["level"] == "SEVERE"]
    asked = [
        message["params"]["request"]["url"]
        for message in (json.loads(entry["message"])["message"] for entry in browser.get_log("performance"))
        if message["method"] == "Network.requestWillBeSent"
    ]
    assert {url for url in asked if not url.startswith(("file:", "data:", "blob:", "about:"))} == set()
    assert wide == []
    assert broken == []


def prose(site: Path) -> list[Path]:
    """Pages of text: all but the predictor."""
    return [page for page in sorted(site.rglob("*.html")) if page.name != "predictor.html"]


def test_no_page_shows_latex(browser: Any, site: Path) -> None:
    raw = re.compile(r"\$[^$\n]*\\[a-z]+|\\(?:frac|tfrac|lambda|varepsilon|sqrt|kappa)\b")
    found = []
    for page in prose(site):
        browser.get(page.as_uri())
        shown = ask(
            browser,
            "(() => { const body = document.querySelector('.md-content').cloneNode(true);"
            f" body.querySelectorAll('{NOT_PROSE}').forEach(e => e.remove());"
            " return body.textContent; })()",
        )
        found += [(page.name, match[0]) for match in raw.finditer(shown)]
    assert found == []


def test_no_page_loses_an_asterisk(browser: Any, site: Path) -> None:
    """Two stars of a sentence (t*, T*) would become emphasis of what stands between them."""
    eaten = []
    for page in prose(site):
        browser.get(page.as_uri())
        emphasised = ask(browser, "[...document.querySelectorAll('.md-content em')].map(e => e.textContent)")
        eaten += [(page.name, text) for text in emphasised if not re.fullmatch(r"[\w(].*[\w.?!):]", text, re.DOTALL)]
    assert eaten == []


@pytest.mark.parametrize(("page", "least"), [("theory.html", 190), ("tutorial.html", 15)])
def test_formulas_are_drawn(browser: Any, site: Path, page: str, least: int) -> None:
    """Each has a size, and the screenshot of a formula holds its ink."""
    from PIL import Image

    browser.get((site / page).as_uri())
    sizes = ask(
        browser,
        "[...document.querySelectorAll('svg.formula')].map(e => { const r = e.getBoundingClientRect();"
        " return [r.width, r.height, e.querySelectorAll('use, path, rect').length, e.getAttribute('aria-label')]; })",
    )
    assert len(sizes) >= least
    assert [s for s in sizes if not (s[0] > 3 and s[1] > 3 and s[2] > 0 and s[3])] == []
    formulas = browser.find_elements("css selector", "svg.formula")
    for formula in (formulas[0], formulas[len(formulas) // 2], formulas[-1]):
        ask(browser, "arguments[0].scrollIntoView({block: 'center'})", formula)
        picture = Image.open(io.BytesIO(formula.screenshot_as_png)).convert("L")
        histogram = picture.histogram()
        ink = sum(histogram[:128]) / sum(histogram)
        assert 0.02 < ink < 0.6, (formula.get_attribute("aria-label"), ink)


def test_tutorial_has_its_outputs(browser: Any, site: Path) -> None:
    browser.get((site / "tutorial.html").as_uri())
    assert ask(browser, "document.querySelectorAll('.jp-OutputArea-output').length") >= 5
    pictures = ask(
        browser,
        "[...document.querySelectorAll('.jp-OutputArea img')].map(e => e.naturalWidth * (e.src.startsWith('data:')))",
    )
    assert pictures and min(pictures) > 300
