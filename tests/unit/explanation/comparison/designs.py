"""Pairs of designs for the tests of comparisons."""

from bbsd.architecture import given_architecture
from bbsd.compiler import compile_meaning
from bbsd.explanation.comparison import Design, compare_designs, earned_by
from bbsd.language.loading import load
from bbsd.text import Source
from tests.unit.architecture.designs import shipped

HAND = shipped("object_lifting_hand")
"""The hand-made controller of object lifting."""

WALK = """
bbsd: 1
name: walk
environment:
  robots: 2
  steps: 6
  state: {x: "integers(0, 3)", y: 0}
  dynamics: {y: "y + integers(0, 1)"}
behaviors:
  back:
    inputs: {far: x > 2}
    actions: {left: {x: x - 1}}
    rules: [{when: {far: true}, do: left}, {otherwise: no action}]
  go: {inputs: {odd: y % 2 == 1}, actions: {right: {x: x + 1}, stay: {x: x}}, rules: [otherwise: right]}
structure: [back, go]
reward: {here: x, late: -y}
"""
"""Two robots that walk to the right and turn back when they are far."""


def edited(text, *changes):
    """A text with some parts replaced, each of which stands in it once."""
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def design_of(text, name="spec.yaml", seed=0):
    """A design as plain Python, from its text."""
    loaded = load(Source(name, text), seed=seed)
    problem = compile_meaning(loaded.meaning, compiled=False, lanes=4)
    return Design(loaded, problem, given_architecture(problem))


def compared_designs(a, b, streams):
    """Two designs compared in episodes."""
    return compare_designs(a, b, streams, (earned_by(a, streams), earned_by(b, streams)))
