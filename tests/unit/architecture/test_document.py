"""Designs as files: whatever is designed can be written, or is refused before."""

import numpy as np
import pytest

from bbsd.architecture import Architecture, designed_text, given_architecture, require_writable
from bbsd.compiler import compile_meaning
from bbsd.errors import SpecError
from bbsd.language.loading import load
from bbsd.text import Source, read
from bbsd.text.source import MAX_BYTES
from tests.unit.architecture.designs import random_architecture, small


def behaviors(n_behaviors, n_actions, inputs):
    actions = ", ".join(f"a{number}: {{x: {number}}}" for number in range(n_actions))
    written = ", ".join(f'i{place}: "values(floor(x), 0, {size - 1})"' for place, size in enumerate(inputs))
    return "\n".join(
        f"  b{number}: {{inputs: {{{written}}}, actions: {{{actions}}}}}" for number in range(n_behaviors)
    )


def loaded(text, *overrides):
    return load(Source("spec.yaml", text), overrides=overrides)


def assert_comes_back(architecture, text):
    assert len(text.encode()) <= MAX_BYTES
    again = given_architecture(compile_meaning(loaded(text).meaning, compiled=False))
    assert again.structure.tolist() == architecture.structure.tolist()
    for table, other in zip(again.tables, architecture.tables, strict=True):
        assert np.array_equal(table, other)


@pytest.mark.slow
@pytest.mark.parametrize("n_actions", [1, 5, 200])
@pytest.mark.parametrize("inputs", [(100_000,), (1000, 100), (10, 10, 10, 10, 10)])
def test_two_large_tables_come_back_from_the_file(n_actions, inputs):
    found = loaded(small(behaviors(2, n_actions, inputs)))
    require_writable(found)
    architecture = random_architecture(found.meaning, 0)
    text = designed_text(found, architecture)
    assert_comes_back(architecture, text)
    assert "rules" not in text


def test_short_rules_stay_rules():
    found = loaded(small(behaviors(2, 2, (10, 10))))
    architecture = random_architecture(found.meaning, 0)
    text = designed_text(found, architecture)
    assert_comes_back(architecture, text)
    assert "table" not in text


def test_a_large_table_with_few_rules_is_written_as_rules():
    found = loaded(small(behaviors(1, 1, (1000, 100))))
    table = np.zeros((1000, 100), np.uint8)
    table[5, 7] = 1
    architecture = Architecture((table.ravel(),), np.array([0]))
    text = designed_text(found, architecture)
    assert "- when: {i0: 5, i1: 7}" in text
    assert_comes_back(architecture, text)


@pytest.mark.slow
def test_many_behaviors_with_many_rules_come_back():
    found = loaded(small(behaviors(60, 1, (20, 20))))
    architecture = random_architecture(found.meaning, 0)
    assert_comes_back(architecture, designed_text(found, architecture))


def test_rules_that_are_given_for_some_cells_go_into_the_table():
    rules = "rules: [{when: {i0: [0, 1]}, do: a0}]"
    found = loaded(small(behaviors(1, 2, (100, 100)).replace("actions:", f"{rules}, actions:")))
    architecture = random_architecture(found.meaning, 0)
    text = designed_text(found, architecture)
    assert "rules" not in text
    assert_comes_back(architecture, text)


TABLE = """
  one:
    inputs: {near: x > 1, pace: "values(floor(x), 0, 2)"}
    actions: {a: {x: 1}, b: {x: 2}}
    table: |
      0?2
      .1?
structure: [one]
"""


def test_a_table_stays_one_as_it_is_written():
    found = loaded(small(TABLE))
    architecture = Architecture((np.array([0, 1, 2, 0, 1, 0], np.uint8),), np.array([0]))
    text = designed_text(found, architecture)
    assert "    table: |\n      012\n      .1.\n" in text
    assert_comes_back(architecture, text)


@pytest.mark.slow
@pytest.mark.parametrize(("size", "n_behaviors"), [(990_000, 1), (300_000, 4)])
def test_what_no_file_can_hold_is_refused_at_its_place(size, n_behaviors):
    with pytest.raises(SpecError) as caught:
        require_writable(loaded(small(behaviors(n_behaviors, 1, (size,)))))
    [diagnosis] = caught.value.diagnoses
    assert diagnosis.code == "BB048"
    assert f"the {size:,} open cells of b{n_behaviors - 1}" in diagnosis.message


def test_what_is_set_is_written_also_what_takes_away_nothing():
    text = small("  one: {actions: {a: {x: 1}}}") + "design:\n  layers: 1   # one\n"
    settings = ("view=null", "design.learning={rate: 0.5}", "design.learning.rate=0.25", "design.layers=null")
    found = loaded(text, *settings)
    written = read(Source("spec.yaml", designed_text(found, random_architecture(found.meaning, 0)))).data
    assert written["design"] == {"learning": {"rate": 0.25}}
