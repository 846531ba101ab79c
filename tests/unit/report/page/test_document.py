"""The document of a page: whole, safe, small, and the same each time."""

import json
import re
from base64 import b64encode
from hashlib import sha256
from html.parser import HTMLParser
from importlib.resources import files

import pytest

import bbsd
from bbsd.report.page import document, page_text
from bbsd.report.page.content import page_plain
from bbsd.report.page.document import json_in_html

SPEC = """\
bbsd: 1
name: sneaky
summary: "</script><script>alert(1)</script><!-- \\u2028 <b>bold</b> & more"
environment:
  steps: 40
  state: {x: "uniform(0, 1)", v: 0}
  dynamics: {x: x + v}
  sensors:
    far: x > 2
behaviors:
  go: {actions: {ahead: {v: 0.1}}, rules: [{otherwise: ahead}]}
  stop:
    inputs: [far]
    actions: {halt: {v: 0}}
    rules:
      - {when: {far: true}, do: halt}
      - otherwise: no action
structure: [stop, go]
reward: {near: 1 if x < 2 else 0}
"""


class _Elements(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.elements, self.texts, self.inside = [], {}, None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        self.texts.setdefault(tag, []).append("")
        self.inside = tag

    def handle_endtag(self, tag):
        self.inside = None

    def handle_data(self, data):
        if self.inside:
            self.texts[self.inside][-1] += data


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "sneaky.yaml"
    path.write_text(SPEC, encoding="utf-8")
    return bbsd.page(path, episodes=20)


def test_the_policy_allows_what_is_in_the_page_and_nothing_else(page):
    parsed = _Elements(page_text(page))
    (policy,) = [given["content"] for tag, given in parsed.elements if given.get("http-equiv")]
    scripts = [
        text
        for (tag, given), text in zip(
            [each for each in parsed.elements if each[0] == "script"], parsed.texts["script"], strict=True
        )
        if "type" not in given
    ]
    hashes = [
        f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"
        for text in (*scripts, *parsed.texts["style"])
    ]
    assert re.findall(r"'sha256-[^']+'", policy) == hashes
    assert len(hashes) == 4
    assert policy.startswith("default-src 'none'; ")
    assert "unsafe" not in policy


def test_nothing_is_fetched_and_nothing_is_styled_or_run_by_attributes(page):
    for _, given in _Elements(page_text(page)).elements:
        assert not {"src", "style"} & {*given}
        assert not any(name.startswith("on") for name in given)
        assert given.get("href", "#").startswith(("#", "data:,"))


def test_what_a_user_wrote_is_data_and_no_markup(page):
    text = page_text(page)
    parsed = _Elements(text)
    assert [tag for tag, _ in parsed.elements].count("script") == 3
    assert "b" not in parsed.texts
    data = json.loads(parsed.texts["script"][0])
    assert data["summary"].startswith("</script><script>alert(1)</script><!-- ")


def test_json_in_html_has_no_markup_and_nothing_that_hides():
    text = json_in_html({"a": "</script> <!-- & \u2028 \u2029 é \ud800", "b": ["two\nlines", "\u202e"]})
    assert json.loads(text) == {
        "a": r"</script> <!-- & \u2028 \u2029 é \ud800",
        "b": ["two\nlines", r"\u202e"],
    }
    assert not re.search("[<>&\u2028\u2029]", text)
    assert text.isascii()


def test_the_same_page_has_the_same_bytes(page, tmp_path):
    path = tmp_path / page.name
    path.write_text(SPEC, encoding="utf-8")
    assert page_text(bbsd.page(path, episodes=20)) == page_text(page)


def test_long_replays_are_cut_until_the_page_is_small(page, monkeypatch):
    whole = page_text(page)
    monkeypatch.setattr(document, "MOST_BYTES", len(whole) - 500)
    cut = page_text(page)
    assert len(cut) <= len(whole) - 500
    shown = json.loads(_Elements(cut).texts["script"][0])
    assert 1 < shown["episodes"][0]["shown"] < 40
    assert len(shown["notes"]) == 1
    assert not json.loads(_Elements(whole).texts["script"][0])["notes"]


def test_the_charts_library_is_the_one_that_was_vendored():
    folder = files("bbsd.report.page") / document.UPLOT
    digests = {
        "uPlot.iife.min.js": "19c8d4c6ad88929a79f4ae49d6f7161566dfd0ba3d15cc495e974f787eb78f1f",
        "uPlot.min.css": "df630c6a8d6f8eeaff264b50f73ce5b114f646ffd9a0bb74f049b0a00135fa04",
    }
    for name, digest in digests.items():
        assert sha256((folder / name).read_bytes()).hexdigest() == digest
    assert "uPlot (v1.6.32)" in (folder / "uPlot.iife.min.js").read_text(encoding="utf-8")
    assert "MIT License" in (folder / "LICENSE").read_text(encoding="utf-8")


def test_rules_of_cells_are_those_of_the_explanation(page):
    plain = page_plain(page, 40)
    stop = plain["behaviors"][1]
    assert [rule["decision"] for rule in stop["rules"]] == ["halt", "no action"]
    assert stop["rule_of_cell"] == [1, 0]
    assert stop["decisions"] == [0, 1]
    assert plain["inputs"] == [{"name": "far", "meaning": "x > 2", "users": [[1, 0]]}]
    assert plain["commands"] == ["v"]
    assert sum(stop["visits"]) == pytest.approx(1)


def test_values_begin_with_the_start(page):
    plain = page_plain(page, 40)
    names = {value["text"]: value["column"] for value in plain["episodes"][0]["values"]}
    assert 0 <= (names["x"].get("v") or names["x"]["r"])[0] <= 1
    assert names["far"]["r"][0] is False
    assert sum(names["far"]["r"][1::2]) == 41
    assert names["v"]["r"][:2] == [0, 1]
