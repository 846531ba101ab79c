"""Designs for the tests of exports, and tools that must be there where the environment says so."""

import os
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec

import pytest

import bbsd
from bbsd.architecture import architecture_of
from bbsd.exports.exported import exported_design
from bbsd.exports.verification.tools import ToolMissing, found
from tests.unit.architecture.designs import SPECS, meaning_of, random_architecture, small

MUST_BE_THERE = "BBSD_REQUIRE_TARGETS"
"""With this variable a target that is missing fails its tests instead of skipping them."""

SHIPPED = sorted(
    str(path.relative_to(SPECS).with_suffix(""))
    for path in [
        *SPECS.glob("*_hand.yaml"),
        *SPECS.glob("tasks/*_hand.yaml"),
        *SPECS.glob("everyday/*_hand.yaml"),
    ]
)

ODD_WORDS = r"""
  switch:
    inputs:
      print: {"a-b": x > 3, "a b": x > 2, "-1.5": x > 1, "Größe 中": x > 0, "*/ \"\"\"??/\\": otherwise}
    excited: x > 1
    actions: {int: {x: 1}, double: {x: 2}}
    rules: [{when: {print: a b}, do: double}, {otherwise: int}]
  command:
    inputs: {choice: x > 2, int: "values(floor(x), -2, 3)", switch: "cut(x, -1, 2)",
      layer_2: {u: x > 1, v: otherwise}, command: {u: x > 2, v: otherwise}}
    actions: {none: {x: 0}}
    rules: [{when: {int: -1}, do: none}, {otherwise: no action}]
structure: [switch, command]
"""
"""Words of other languages as names, labels that differ only in signs, that end comments, or in other scripts."""
ODD_NAME = r'"3 \"\"\" ünï */ ??/\\"'


def hand_made(name):
    """A shipped design as what is exported."""
    meaning = bbsd.load(SPECS / f"{name}.yaml").meaning
    return exported_design(meaning, architecture_of(meaning))


def drawn(name, seed):
    """A shipped spec with drawn tables and layers, as what is exported."""
    meaning = bbsd.load(SPECS / f"{name}.yaml").meaning
    return exported_design(meaning, random_architecture(meaning, seed))


def written(behaviors, name="small"):
    """A design of these behaviors as what is exported."""
    meaning = meaning_of(small(behaviors).replace("name: small", f"name: {name}"))
    return exported_design(meaning, architecture_of(meaning))


def answers(run, exported, files, cells):
    """What a runner answers; the test is skipped where its tool is missing, unless it must be there."""
    with there():
        return run(exported, files, cells)


def tool(name):
    """Where a tool is, as `answers`."""
    with there():
        return found(name)


def library(name):
    """A library of another language's, as `answers`."""
    with there():
        if find_spec(name) is None:
            raise ToolMissing(name)
    return import_module(name)


@contextmanager
def there():
    try:
        yield
    except ToolMissing as missing:
        if os.environ.get(MUST_BE_THERE):
            raise
        pytest.skip(f"{missing} is not on this machine")


def require(verified):
    """Skip a test where what was to verify is not there, unless it must be."""
    if verified.missing:
        assert not os.environ.get(MUST_BE_THERE), f"{verified.tool} is missing"
        pytest.skip(f"{verified.tool} is not on this machine")
