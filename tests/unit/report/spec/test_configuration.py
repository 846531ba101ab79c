from __future__ import annotations

from textwrap import dedent

import pytest

from bbsd.language.loading import load
from bbsd.report.spec.configuration import configuration_text
from bbsd.text import Source, read

TEXT = dedent("""\
    bbsd: 1
    name: walk
    x-author: me
    environment:
      steps: 5
      state:
        place: 0
      sensors:
        # two lines of one expression
        far: place * place * place
          > 100
    behaviors:
      go:
        actions:
          move:
            place: place + 1
        rules:
          - otherwise: move
    reward:
      distance: place
    """)


@pytest.fixture
def configured():
    def run(*overrides):
        return configuration_text(load(Source("walk.yaml", TEXT), overrides=overrides))

    return run


def origins(text):
    """Return the text and the comment of each commented line."""
    noted = [line.split("  # ") for line in text.splitlines() if "  # " in line]
    return {before.strip(): note for before, note in noted}


def test_each_value_is_noted_with_its_origin(configured):
    found = origins(configured("environment.steps=9", "design.learning.last=2"))
    assert found["name: walk"] == "walk.yaml:2"
    assert found["steps: 9"] == "--set"
    assert found["last: 2"] == "--set"
    assert found["robots: 1"] == "default"
    assert found["rate: 0.1 * 0.99 ** episode"] == "default"


def test_it_reads_as_the_same_spec_with_nothing_left_to_defaults(configured):
    text = configured("environment.steps=9")
    again = load(Source("whole.yaml", text))
    assert again.spec == load(Source("walk.yaml", TEXT), overrides=["environment.steps=9"]).spec
    assert "default" not in set(origins(configuration_text(again)).values())


def test_a_view_is_shown_with_its_origins():
    text = TEXT.replace("behaviors:", "view:\n  at: [place, 0]\n  marks:\n    end: [5, 0]\nbehaviors:")
    found = origins(configuration_text(load(Source("walk.yaml", text), overrides=["view.heading=place / 2"])))
    assert found["at: [place, 0]"] == "walk.yaml:13"
    assert found["end: [5, 0]"] == "walk.yaml:15"
    assert found["heading: place / 2"] == "--set"
    assert not any(line.startswith("area") for line in found)


def test_notes_do_not_end_values_of_several_lines(configured):
    data = read(Source("whole.yaml", configured())).data
    assert data["environment"]["sensors"]["far"] == "place * place * place > 100"
    assert data["behaviors"]["go"]["rules"] == [{"otherwise": "move"}]


def test_free_keys_are_kept_and_empty_defaults_are_not_shown(configured):
    text = configured()
    assert origins(text)["x-author: me"] == "walk.yaml:3"
    assert "summary" not in text
    assert "world" not in text
