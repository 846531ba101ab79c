import pytest

from bbsd.architecture import given_architecture, spec_changes
from bbsd.compiler import compile_meaning
from bbsd.text import Source, read
from bbsd.text.writing.patch import replace_blocks
from tests.unit.architecture.designs import SHIPPED, meaning_of, random_architecture, shipped, small


def designed(text, seed):
    """A random architecture of a spec, and the file in which the spec's holes are filled with it."""
    meaning = meaning_of(text, seed)
    architecture = random_architecture(meaning, seed)
    document = read(Source("spec.yaml", text))
    return meaning, architecture, replace_blocks(document, spec_changes(meaning, architecture), "behaviors")


def assert_reads_back(meaning, architecture, text):
    again = meaning_of(text, meaning.seed + 1)
    found = given_architecture(compile_meaning(again, compiled=False))
    assert found.structure.tolist() == architecture.structure.tolist()
    assert [table.tolist() for table in found.tables] == [table.tolist() for table in architecture.tables]
    assert again.constants.vector(1) == meaning.constants.vector(1)


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("seed", range(3))
def test_the_designed_file_reads_back_as_the_architecture(name, seed):
    assert_reads_back(*designed(shipped(name), seed))


def test_a_spec_without_holes_is_not_changed():
    meaning = meaning_of(shipped("object_lifting_hand"))
    assert spec_changes(meaning, random_architecture(meaning, 0)) == {}


def test_a_designed_file_differs_from_the_spec_only_in_its_holes():
    text = shipped("object_lifting")
    lines = designed(text, 1)[2].splitlines()
    kept = iter(lines)
    assert all(line in kept for line in text.splitlines())
    assert {line.split(":")[0].strip(" -") for line in lines if line not in text.splitlines()} <= {
        "rules",
        "when",
        "do",
        "otherwise",
        "structure",
    }


HALF_MADE = """
  one:
    inputs: {near: x > 1, pace: "values(floor(x), 0, 2)"}
    actions: {a: {x: 1}, b: {x: 2}}
    rules:
      - when: {near: true}
        do: a
      - when: {pace: [0, 1]}
        do: open
      - otherwise: b
  two: {actions: {a: {x: 2}}, rules: [{otherwise: a}]}
  three: {actions: {a: {x: 3}}}
structure: [two, open, open]
"""


@pytest.mark.parametrize("seed", range(5))
def test_a_half_made_design_keeps_what_it_gives(seed):
    meaning, architecture, text = designed(small(HALF_MADE), seed)
    assert_reads_back(meaning, architecture, text)
    data = read(Source("spec.yaml", text)).data
    rules = data["behaviors"]["one"]["rules"]
    assert rules[0] == {"when": {"near": True}, "do": "a"}
    assert rules[-1] == {"otherwise": "b"}
    assert data["structure"][0] == "two"


def test_the_structure_is_written_from_the_highest_layer_down():
    meaning = meaning_of(small(HALF_MADE))
    architecture = random_architecture(meaning, 0)
    names = [*meaning.spec.behaviors]
    written = spec_changes(meaning, architecture)["structure",]
    assert written == [names[behavior] for behavior in architecture.structure[::-1]]


def test_a_layer_that_only_one_behavior_can_fill_is_written_too():
    meaning = meaning_of(small("  one: {actions: {a: {x: 1}}}\nstructure: [open]"))
    assert spec_changes(meaning, random_architecture(meaning, 0))["structure",] == ["one"]
