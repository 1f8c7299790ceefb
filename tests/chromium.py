"""Headless Chromium (Debian's chromium and chromium-driver) for the tests of web pages."""

import json
import shutil
from collections.abc import Iterator
from typing import Any

import pytest
from processes import until

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
DRIVER = shutil.which("chromedriver")
needs_chromium = pytest.mark.skipif(CHROMIUM is None or DRIVER is None, reason="Chromium or its driver is missing")
FLAGS = ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-extensions")


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """The driver, which logs the console and what is asked of the network."""
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


def opened(driver: Any, address: str, width: int = 1400) -> Any:
    """The driver with the page at ``address``, all of it, on a screen or a phone."""
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    driver.get("about:blank")
    driver.get(address)  # on a busy machine it may come back with the blank page still there
    whole = "document.readyState == 'complete' && location.protocol != 'about:'"
    until(lambda: ask(driver, whole), 60.0)
    return driver


def ask(browser: Any, script: str, *arguments: Any) -> Any:
    return browser.execute_script(f"return {script}", *arguments)


def disquiet(browser: Any) -> list[str]:
    """Errors on the console since last asked, and what was asked of the network."""
    errors = [entry["message"] for entry in browser.get_log("browser") if entry["level"] == "SEVERE"]
    messages = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
    return errors + [url for url in asked if not url.startswith(("file:", "data:", "blob:", "about:"))]


def assert_quiet(browser: Any) -> None:
    assert disquiet(browser) == []
    assert ask(browser, "performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length") == 0


def beyond_the_edge(browser: Any, selector: str) -> list[str]:
    """What is seen and reaches over the right edge of the window."""
    assert ask(browser, "document.documentElement.scrollWidth <= window.innerWidth")
    seen = f"[...document.querySelectorAll('{selector}')].filter(e => e.offsetParent || e.ownerSVGElement)"
    wide = ".filter(e => e.getBoundingClientRect().right > window.innerWidth + 1 && !e.closest('pre'))"
    return list(ask(browser, f"{seen}{wide}.map(e => e.tagName + '#' + e.id)"))
