"""The built site in a browser: formulas are drawn, nothing is asked of the web, nothing overflows (make verify)."""

import importlib.util
import io
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from chromium import ask, disquiet, needs_chromium, opened
from here import ROOT
from PIL import Image

BUILDERS = ("mkdocs", "quickjax", "mkdocs_jupyter", "mkdocstrings")
NOT_PROSE = "pre, code, .highlight, .formula, script, style, .clipboard-copy-txt, .zeroclipboard-container"
PROSE = f"""(() => {{ const body = document.querySelector('.md-content').cloneNode(true);
 body.querySelectorAll('{NOT_PROSE}').forEach(e => e.remove()); return body.textContent; }})()"""
EMPHASISED = "[...document.querySelectorAll('.md-content em')].map(e => e.textContent)"
LATEX = re.compile(r"\$[^$\n]*\\[a-z]+|\\(?:frac|tfrac|lambda|varepsilon|sqrt|kappa)\b")
LACKING = any(importlib.util.find_spec(name) is None for name in BUILDERS)
pytestmark = [pytest.mark.verify, needs_chromium, pytest.mark.skipif(LACKING, reason="pip install '.[docs]' builds it")]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("site")
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "NO_MKDOCS_2_WARNING": "1"}
    command = [sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "--site-dir", str(target)]
    subprocess.run(command, check=True, cwd=ROOT, env=environment, timeout=600)
    return target


@pytest.mark.parametrize("width", [1400, 390])
def test_every_page_keeps_to_its_width_and_to_itself_and_shows_no_markup(chromium: Any, site: Path, width: int) -> None:
    """No LaTeX; and two stars of a sentence (t*, T*) would become emphasis of what stands between them."""
    pages = [page for page in sorted(site.rglob("*.html")) if page.name != "404.html"]  # the latter is for a server
    assert len(pages) > 15
    wrong = []
    for page in pages:
        browser, name = opened(chromium, page.as_uri(), width), str(page.relative_to(site))
        if not ask(browser, "document.documentElement.scrollWidth <= window.innerWidth"):
            wrong.append((name, "too wide"))
        wrong += [(name, what) for what in disquiet(browser)]
        if page.name != "predictor.html":
            wrong += [(name, found[0]) for found in LATEX.finditer(ask(browser, PROSE))]
            emphasised = ask(browser, EMPHASISED)
            wrong += [(name, em) for em in emphasised if not re.fullmatch(r"[\w(].*[\w.?!):]", em, re.DOTALL)]
    assert wrong == []


@pytest.mark.parametrize("width", [1400, 390])
@pytest.mark.parametrize(("page", "least"), [("theory.html", 190), ("tutorial.html", 15)])
def test_formulas_are_drawn(chromium: Any, site: Path, page: str, least: int, width: int) -> None:
    """Each has a size, and the screenshot of a formula holds its ink."""
    browser = opened(chromium, (site / page).as_uri(), width)
    shape = "e => [e.getBoundingClientRect().width, e.getBoundingClientRect().height,"
    shape += " e.querySelectorAll('use, path, rect').length, e.getAttribute('aria-label')]"
    sizes = ask(browser, f"[...document.querySelectorAll('svg.formula')].map({shape})")
    assert len(sizes) >= least
    assert [s for s in sizes if not (s[0] > 3 and s[1] > 3 and s[2] > 0 and s[3])] == []
    formulas = browser.find_elements("css selector", "svg.formula")
    for formula in (formulas[0], formulas[len(formulas) // 2], formulas[-1]):
        ask(browser, "arguments[0].scrollIntoView({block: 'center'})", formula)
        histogram = Image.open(io.BytesIO(formula.screenshot_as_png)).convert("L").histogram()
        ink = sum(histogram[:128]) / sum(histogram)
        assert 0.02 < ink < 0.6, (formula.get_attribute("aria-label"), ink)
