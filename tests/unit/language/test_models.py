import pytest
from pydantic import ValidationError

from bbsd.language.base import Part
from bbsd.language.field_types import Expression, signature
from bbsd.language.models import Behavior, Environment, Otherwise, Spec, When
from bbsd.text import read
from tests.unit.language.specs import codes, source


def spec(part: str = "") -> Spec:
    return Spec.model_validate(read(source(part)).data)


def test_a_spec_cannot_be_changed() -> None:
    with pytest.raises(ValidationError):
        spec().name = "another"


def test_a_spec_read_from_itself_is_the_same() -> None:
    one = spec("constants: {a: [1, [2, x]]}\nstructure: [stop]")
    assert Spec.model_validate(one) == one
    assert spec() == spec()


def test_numbers_truths_and_texts_are_expressions() -> None:
    found = spec("constants: {a: 3, b: 0.5, c: a + b}\nenvironment: {state: {lit: true}}")
    assert [found.constants[name].text for name in "abc"] == ["3", "0.5", "a + b"]
    assert found.environment.state["lit"].text == "true"


def test_expressions_are_the_same_when_their_text_is() -> None:
    one, other = spec().reward["near"], spec().reward["near"]
    assert isinstance(one, Expression)
    assert one == other
    assert hash(one) == hash(other)
    assert one != one.text


def test_whole_numbers_may_be_written_with_a_point() -> None:
    assert Environment.model_validate({"steps": 300.0}).steps == 300
    assert isinstance(Environment.model_validate({"steps": 300.0}).steps, int)


def test_cells_are_labels_however_yaml_reads_them() -> None:
    rule = When.model_validate({"when": {"a": True, "b": 5, "c": ["below  2", 2.50]}, "do": "no   action"})
    assert rule.when == {"a": ["true"], "b": ["5"], "c": ["below 2", "2.5"]}
    assert rule.do == "no action"


def test_rules_are_of_two_kinds() -> None:
    behavior = Behavior.model_validate(
        {"actions": {"a": None}, "rules": [{"when": {}, "do": "a"}, {"otherwise": "open"}]}
    )
    assert behavior.rules is not None
    assert [type(rule) for rule in behavior.rules] == [When, Otherwise]
    assert behavior.actions == {"a": {}}


def test_inputs_are_a_list_or_a_mapping() -> None:
    assert spec("behaviors: {stop: {inputs: [tilted]}}").behaviors["stop"].inputs == ["tilted"]
    assert list(spec().behaviors["stop"].inputs) == ["reached"]


@pytest.mark.parametrize("block", ["constants", "structure", "design"])
def test_nothing_under_a_block_is_an_empty_block(block: str) -> None:
    text = source().text + f"{block}:\n"
    assert Spec.model_validate(read(type(source())("spec", text)).data) == spec()


def test_nothing_under_a_value_is_a_mistake() -> None:
    for part in ("environment: {robots: }", "reward: {near: }"):
        text = (
            source().text.replace("robots: 3", "robots:")
            if "robots" in part
            else source().text.replace("near: 1 if abs(height - 3) < 1 else 0", "near:")
        )
        with pytest.raises(ValidationError):
            Spec.model_validate(read(type(source())("spec", text)).data)


def test_free_keys_are_ignored_at_every_level() -> None:
    part = """
x-a: 1
environment: {x-a: 1, state: {x-a: 1}, sensors: {x-a: 1}}
behaviors: {x-a: 1, stop: {x-a: 1, actions: {x-a: 1, halt: {x-a: 1}}, inputs: {x-a: 1}}}
reward: {x-a: 1}
design: {x-a: 1, culture: {x-a: 1}}
"""
    assert codes(part) == []
    assert spec(part) == spec()


def test_every_key_is_described() -> None:
    waiting: list[type[Part]] = list(Part.__subclasses__())
    assert len(waiting) > 8
    for part in waiting:
        for name, field in part.model_fields.items():
            assert field.description, f"{part.__name__}.{name}"
            assert field.description.endswith("."), f"{part.__name__}.{name}"


@pytest.mark.parametrize(
    ("key", "names"),
    [("far", ("far",)), ("far(a)", ("far", "a")), (" far ( a , b ) ", ("far", "a", "b")),
     ("far()", ("far",)), ("far(a", ()),
     ("a b", ()), ("f(a)(b)", ())],
)  # fmt: skip
def test_signatures(key: str, names: tuple[str, ...]) -> None:
    assert signature(key) == names
