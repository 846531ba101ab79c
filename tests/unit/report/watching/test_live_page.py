import re
from base64 import b64encode
from hashlib import sha256
from html.parser import HTMLParser
from pathlib import Path

import pytest

from bbsd.report.watching.live_page import live_page
from bbsd.runs.storage.watching import Watched, WatchedRun
from tests.unit.report.watching.test_events import GENERATION, SEARCH

NASTY = "<script>alert(1)</script>\x1b\"'&"


def watched(*runs, folder="runs/x", state="running", budget=400):
    return Watched(Path(folder), state, len(runs), budget, tuple(runs), {})


SEVERAL = watched(WatchedRun(1, "", tuple(SEARCH)), WatchedRun(2, "", tuple(SEARCH[:1])))


class Reader(HTMLParser):
    def __init__(self, page):
        super().__init__()
        self.tags, self.text = [], ""
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.text += data

    def of(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]


def test_a_page_shows_all_runs():
    page = Reader(live_page(SEVERAL))
    assert [float(each["value"]) for each in page.of("progress")] == [1.0, 0.5]
    assert "answer -2.2500 in 44 new episodes" in page.text
    assert [each["points"].count(",") for each in page.of("polyline")[:2]] == [2, 1]
    assert len({each["stroke-dasharray"] for each in page.of("polyline")}) == 2


def test_generations_are_shown_too():
    page = Reader(live_page(watched(WatchedRun(1, "", (GENERATION, {**GENERATION, "generation": 4}))), 10))
    assert "generation 4/10" in page.text
    assert float(page.of("progress")[0]["value"]) == 0.4


def test_a_run_that_has_not_begun_has_a_page():
    assert "has not begun" in Reader(live_page(watched(state="waiting"))).text


def test_names_are_never_more_than_texts():
    line = {**SEARCH[0], "structure": [NASTY]}
    page = live_page(watched(WatchedRun(1, NASTY, (line, line)), folder=f"runs/{NASTY}"))
    assert len(Reader(page).of("script")) == 1
    assert "\x1b" not in page


def test_only_its_own_script_and_style_may_run():
    page = live_page(SEVERAL)
    policy = Reader(page).of("meta")[1]["content"]
    assert policy.startswith("default-src 'none'; ")
    for tag in ("script", "style"):
        (content,) = re.findall(rf"<{tag}>(.*?)</{tag}>", page, re.DOTALL)
        assert f"{tag}-src 'sha256-{b64encode(sha256(content.encode()).digest()).decode()}'" in policy
    assert "style=" not in page


def test_the_same_look_gives_the_same_bytes_and_a_change_another_mark():
    mark = re.compile(r'data-watched="(\w+)"')
    assert live_page(SEVERAL) == live_page(SEVERAL)
    other = watched(WatchedRun(1, "", tuple(SEARCH)))
    assert mark.search(live_page(SEVERAL))[1] != mark.search(live_page(other))[1]


@pytest.mark.parametrize("mean", [0.0, 1e-9, -1e12])
def test_a_constant_curve_is_drawn(mean):
    lines = tuple({**line, "mean": mean} for line in SEARCH)
    assert "nan" not in live_page(watched(WatchedRun(1, "", lines)))
