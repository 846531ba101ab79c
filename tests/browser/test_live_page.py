"""The page on a run that goes on, in a real browser: it follows the run, and reaches for nothing else."""

from pathlib import Path

import pytest
from selenium.webdriver.support.ui import WebDriverWait

from bbsd.report.watching.live_page import live_page
from bbsd.report.watching.server import serving
from bbsd.runs.storage.watching import Watched, WatchedRun
from tests.browser.test_page import AXE
from tests.unit.report.watching.test_events import SEARCH

pytestmark = pytest.mark.slow


def watched(lines):
    runs = tuple(WatchedRun(run, "", tuple(lines)) for run in (1, 2))
    return Watched(Path("runs/x"), "running", 2, 400, runs, {})


@pytest.fixture
def served(browser, made):
    """Open the page of some lines, which can be changed, and return them; without lines it is the page on a design."""
    whole = made("lifting")[1].read_text(encoding="utf-8")
    lines = [SEARCH[0], {**SEARCH[0], "episodes": 300, "mean": 2.0}]
    with serving(lambda: live_page(watched(lines)) if lines else whole) as address:
        browser.get("about:blank")
        browser.get_log("browser")
        browser.get_log("performance")
        browser.get(address)
        yield lines
        browser.get("about:blank")


def until(browser, condition):
    WebDriverWait(browser, 10, 0.1).until(lambda _: condition())


def text(browser):
    return browser.execute_script("return document.body.innerText")


def test_it_follows_the_run_to_the_whole_page(browser, served):
    assert "300 of 400 episodes" in text(browser)
    browser.execute_script("document.getElementById('numbers').open = true")
    served.append(SEARCH[1])
    until(browser, lambda: "answer -2.2500" in text(browser))
    assert browser.execute_script("return document.getElementById('numbers').open")
    served.clear()
    until(browser, lambda: browser.find_elements("id", "step"))
    assert browser.get_log("browser") == []


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [360, 1280])
def test_nobody_is_left_out_and_nothing_is_too_wide(browser, served, theme, width):
    browser.execute_cdp_cmd(
        "Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]}
    )
    browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600},
    )
    browser.execute_script("document.getElementById('numbers').open = true")
    browser.execute_script(AXE)
    found = browser.execute_async_script("axe.run().then((each) => arguments[0](each))")
    assert [(each["id"], each["nodes"][0]["html"][:120]) for each in found["violations"]] == []
    assert browser.execute_script("return document.documentElement.scrollWidth") <= width
