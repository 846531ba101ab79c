"""A real browser without a window, and pages on designs to look at in it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

import bbsd
from bbsd.report.page import page_text

ROOT = Path(__file__).parents[2]
FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
    "--disable-background-networking", "--disable-component-update",
)  # fmt: skip
REQUIRED = "BBSD_REQUIRE_BROWSER"
"""Set by whoever knows that there is a browser: without one, tests then fail instead of being skipped."""
DESIGNS = {"lifting": "object_lifting_hand", "pursuit": "pursuit_hand", "mobile": "mobile_robot_hand"}
SNEAKY = "</script><script>window.ran = 1</script><img src=x onerror='window.ran = 1'><!-- {{ }} ${x} `"
SMALL_RUN = (
    "design.method=paper", "design.coevolution.generations=4", "design.coevolution.population=4",
    "design.coevolution.agents=4", "design.learning.episodes=4", "design.learning.last=4",
)  # fmt: skip


@pytest.fixture(scope="session")
def browser(tmp_path_factory):
    """Chromium under its driver."""
    if not (shutil.which("chromium") and shutil.which("chromedriver")):
        reason = "no chromium and chromedriver: apt-get install chromium chromium-driver"
        if os.environ.get(REQUIRED):
            pytest.fail(f"{REQUIRED} is set, but there is {reason}")
        pytest.skip(reason)
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for flag in (*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('browser')}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
    yield driver
    driver.quit()


def spec(name):
    return ROOT / "specs" / f"{DESIGNS[name]}.yaml"


def run_page(folder):
    """Return the page on the design of a small run, beside the hand-made one: the page that has most on it."""
    task = ROOT / "specs" / "object_lifting.yaml"
    designed = bbsd.design(task, seed=1, runs=2, out=folder / "small-run", set=SMALL_RUN)
    return bbsd.page(designed.folder, spec("lifting"), episodes=20)


def sneaky_page(folder):
    """Return a page on a spec whose texts try to be markup and to run."""
    for name in ("grid_world.yaml", "grid_world_hand.yaml"):
        shutil.copy(ROOT / "specs" / name, folder)
    summary, path = SNEAKY.replace("'", "''"), folder / "sneaky.yaml"
    path.write_text(f"# {SNEAKY}\nextends: grid_world_hand.yaml\nsummary: '{summary}'\n", encoding="utf-8")
    return bbsd.page(path, episodes=5)


@pytest.fixture(scope="session")
def made(tmp_path_factory):
    """Return what a page on a design shows, and the page's file, by the design's short name."""
    folder, kept = tmp_path_factory.mktemp("pages"), {}
    special = {"run": lambda: run_page(folder), "sneaky": lambda: sneaky_page(folder)}

    def make(name):
        if name not in kept:
            page = special[name]() if name in special else bbsd.page(spec(name), episodes=20)
            path = folder / f"{name}.html"
            path.write_text(page_text(page), encoding="utf-8")
            kept[name] = page, path
        return kept[name]

    return make


@pytest.fixture
def opened(browser, made):
    """Open the page on a design in a theme and at a width, with an empty log, and return what it shows."""

    def open_page(name, theme="light", width=1280, place=""):
        page, path = made(name)
        browser.execute_cdp_cmd(
            "Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]}
        )
        browser.execute_cdp_cmd(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600},
        )
        browser.get("about:blank")
        for log in ("browser", "performance"):
            browser.get_log(log)
        browser.get(path.as_uri() + place)
        return page

    return open_page
