import json
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bbsd.text import Data, DataPath, Document, Source, read
from bbsd.text.writing.patch import DELETE, Deletion, replace_blocks
from bbsd.text.writing.writer import write

SPEC = """\
# A designer's file.
bbsd: 1
name: lifting   # the robots

environment:
    steps: 300  # long enough
    state: {speed: 0, height: uniform}

# What they can do.
behaviors:
  push:
    inputs: [place]
    # pushes always
    actions: {push: {speed: 5}}
    # no rules yet

  stop:   # at the goal
    actions:
      stop:
        speed: 0  # at once
    rules:    # by hand
      # the goal first
      - when: {reached: true}
        do: stop  # now
      - otherwise: no action
  # the end of behaviors

reward:
  level: 1 if a
    else 2
"""
RULES: Data = [{"when": {"place": "lowest"}, "do": "push"}, {"otherwise": "no action"}]


def document(text: str) -> Document:
    return read(Source("spec.yaml", text))


def patched(changes: dict[DataPath, Data | Deletion], after: str | None = None, text: str = SPEC) -> str:
    return replace_blocks(document(text), changes, after)


def test_rules_are_added_below_what_a_behavior_has() -> None:
    rules = "    rules:\n      - when: {place: lowest}\n        do: push\n      - otherwise: no action\n"
    before = "    # no rules yet\n"
    assert patched({("behaviors", "push", "rules"): RULES}) == SPEC.replace(before, before + rules)


def test_a_structure_is_added_after_a_given_key() -> None:
    before = "  # the end of behaviors\n"
    added = "\nstructure: [stop, push]\n"
    text = patched({("structure",): ["stop", "push"]}, after="behaviors")
    assert text == SPEC.replace(before, before + added)


def test_a_new_key_goes_to_the_end() -> None:
    assert patched({("design",): {"sharing": "value"}}) == SPEC + "\ndesign:\n  sharing: value\n"
    assert patched({("reward", "speed"): -1}) == SPEC + "  speed: -1\n"


def test_a_new_key_is_indented_like_its_neighbors() -> None:
    before = "    state: {speed: 0, height: uniform}\n"
    assert patched({("environment", "robots"): 3}) == SPEC.replace(before, before + "    robots: 3\n")


def test_a_block_is_replaced_and_the_comment_of_its_key_stays() -> None:
    old = SPEC[SPEC.index("      - when: {reached") : SPEC.index("  # the end")]
    new = "      - when: {place: lowest}\n        do: push\n      - otherwise: no action\n"
    assert patched({("behaviors", "stop", "rules"): RULES}) == SPEC.replace(old, new)


def test_a_value_is_replaced_before_its_comment() -> None:
    assert patched({("environment", "steps"): 50}) == SPEC.replace("300 ", "50 ")
    assert patched({("behaviors", "stop", "rules", 0, "do"): "open"}) == SPEC.replace(
        "do: stop ", "do: open "
    )


def test_a_value_over_lines_is_replaced() -> None:
    assert patched({("reward", "level"): "b"}) == SPEC.replace("1 if a\n    else 2", "b")


def test_a_single_value_becomes_a_block() -> None:
    changed = patched({("environment", "steps"): {"a": 1}})
    assert changed == SPEC.replace(
        "    steps: 300  # long enough\n", "    steps:  # long enough\n      a: 1\n"
    )


def test_a_block_becomes_a_single_value() -> None:
    old = SPEC[SPEC.index("  stop:   # at") : SPEC.index("  # the end")]
    assert patched({("behaviors", "stop"): "gone"}) == SPEC.replace(old, "  stop: gone   # at the goal\n")


def test_a_value_in_braces_stays_in_braces() -> None:
    assert patched({("environment", "state", "speed"): 1.5}) == SPEC.replace("speed: 0,", "speed: 1.5,")
    added = patched({("environment", "state", "turn"): [1, 2]})
    assert added == SPEC.replace("height: uniform}", "height: uniform, turn: [1, 2]}")


def test_what_does_not_fit_braces_is_written_as_a_block() -> None:
    changed = patched({("behaviors", "push", "actions", "push", "rules"): RULES})
    assert "    actions:\n      push:\n        speed: 5\n        rules:\n          - when:" in changed
    assert "    # pushes always\n" in changed


def test_an_entry_is_deleted_with_its_lines() -> None:
    assert patched({("environment", "steps"): DELETE}) == SPEC.replace("    steps: 300  # long enough\n", "")
    assert patched({("bbsd",): DELETE}) == SPEC.replace("bbsd: 1\n", "")


def test_a_block_is_deleted_with_one_of_the_blank_lines_around_it() -> None:
    old = SPEC[SPEC.index("environment:") : SPEC.index("# What they")]
    assert patched({("environment",): DELETE}) == SPEC.replace(old, "")


def test_a_mapping_that_loses_its_last_key_is_empty() -> None:
    assert patched({("reward", "level"): DELETE}).endswith("\nreward: {}\n")


def test_an_item_is_replaced_or_deleted() -> None:
    assert patched({("behaviors", "push", "inputs", 0): "a, b"}) == SPEC.replace("[place]", "['a, b']")
    before = "      - when: {reached: true}\n        do: stop  # now\n"
    assert patched({("behaviors", "stop", "rules", 0): DELETE}) == SPEC.replace(before, "")


def test_several_changes_are_made_in_order() -> None:
    text = patched({("design",): {}, ("design", "sharing"): "value", ("name",): "x"})
    assert text == SPEC.replace("name: lifting ", "name: x ") + "\ndesign: {sharing: value}\n"


def test_missing_mappings_on_a_path_are_added() -> None:
    assert patched({("design", "learning", "rate"): 0.1}).endswith("\ndesign:\n  learning:\n    rate: 0.1\n")
    assert patched({("a", "b"): 1}, text="a:   # nothing yet\n") == "a:   # nothing yet\n  b: 1\n"


def test_a_value_used_elsewhere_by_its_anchor_changes_only_here() -> None:
    text = "a: &x {b: 1}\nc: *x\nd: {e: *x}\n"
    for path in [("a", "b"), ("c", "b"), ("d", "e", "b"), ("a",), ("c",)]:
        before = document(text).data
        after = document(patched({path: 2}, text=text)).data
        assert after == {**before, path[0]: after[path[0]]} != before


@pytest.mark.parametrize(
    "text", ["a: 1", "a: {b: 1}", "{}", "{a: 1}", "--- # x\na: 1\n...\n", "? a\n: 1\n", "'a' : 1\n"]
)
def test_unusual_texts_are_changed_too(text: str) -> None:
    wanted = {**document(text).data, "a": [1], "z": {"y": 0}}
    assert document(patched({("a",): [1], ("z",): {"y": 0}}, text=text)).data == wanted


def test_the_line_breaks_of_the_file_are_used() -> None:
    windows = SPEC.replace("\n", "\r\n")
    changes: dict[DataPath, Data | Deletion] = {
        ("structure",): ["push"],
        ("behaviors", "push", "rules"): RULES,
        ("environment", "steps"): {"a": 1},
        ("bbsd",): DELETE,
    }
    assert patched(changes, "behaviors", windows) == patched(changes, "behaviors").replace("\n", "\r\n")


def test_a_file_without_a_last_line_break_gets_one() -> None:
    assert patched({("b",): 2}, text="a: 1") == "a: 1\nb: 2\n"


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("name", "x"), 1),
        (("nothing",), DELETE),
        (("behaviors", "push", "inputs", 5), "x"),
        (("behaviors", 0), "x"),
        ((), DELETE),
        ((), [1]),
    ],
)
def test_a_path_that_does_not_fit_is_refused(path: DataPath, value: Data | Deletion) -> None:
    with pytest.raises(ValueError, match=r"nothing|no 'nothing'|whole|cannot be written"):
        patched({path: value})


def test_a_text_with_mistakes_is_not_changed() -> None:
    with pytest.raises(ValueError, match="mistakes"):
        patched({("a",): 1}, text="a: 1\na: 2\n")


names = st.sampled_from(["when", "a", "do it", "b: c", "no", "f(x, y)", "rules"])
values = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats(allow_nan=False)
    | names
    | st.text("ab #:\n'", max_size=6)
)
data = st.recursive(
    values,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=4),
    max_leaves=10,
)


def commented(text: str, numbers: list[int]) -> str:
    """Add comments above some lines and at the end of others, where the data stay the same."""
    lines = text.split("\n")
    for count, number in enumerate(numbers):
        index = number % len(lines)
        comment = f"# {count}"
        above = [*lines[:index], " " * (number % 7) + comment, *lines[index:]]
        behind = [*lines[:index], f"{lines[index]} {comment}", *lines[index + 1 :]]
        for changed in (behind, above) if number % 2 else (above, behind):
            again = document("\n".join(changed))
            if not again.diagnoses and again.data == document(text).data:
                lines = changed
                break
    return "\n".join(lines)


def paths_in(value: Data) -> list[DataPath]:
    inner: list[tuple[str | int, Data]] = []
    if isinstance(value, dict):
        inner = [*value.items()]
    elif isinstance(value, list):
        inner = [*enumerate(value)]
    return [path for key, each in inner for path in [(key,), *((key, *rest) for rest in paths_in(each))]]


def with_change(value: Any, path: DataPath, new: Data | Deletion) -> Any:
    changed = json.loads(json.dumps(value))
    target = changed
    for segment in path[:-1]:
        target = target[segment]
    if new is DELETE:
        del target[path[-1]]
    else:
        target[path[-1]] = new
    return changed


@settings(deadline=None)
@given(
    st.dictionaries(names, data, min_size=1, max_size=4),
    st.lists(st.integers(0, 1000), max_size=6),
    st.data(),
)
def test_any_change_of_any_commented_text_reads_as_the_change(
    before: dict[str, Data], numbers: list[int], draw: st.DataObject
) -> None:
    text = commented(write(before), numbers)
    path = draw.draw(st.sampled_from(paths_in(before)))
    if draw.draw(st.booleans()) and isinstance(path[-1], str):
        path = (*path[:-1], draw.draw(names))
    new: Data | Deletion = draw.draw(data)
    is_new = path not in paths_in(before)
    if not is_new and draw.draw(st.booleans()):
        new = DELETE
    after = document(patched({path: new}, text=text)).data
    assert json.dumps(after, sort_keys=True) == json.dumps(with_change(before, path, new), sort_keys=True)


@settings(deadline=None)
@given(
    st.dictionaries(names, data, min_size=2, max_size=4),
    st.lists(st.integers(0, 1000), max_size=6),
    st.data(),
)
def test_the_lines_of_other_top_level_entries_are_untouched(
    before: dict[str, Data], numbers: list[int], draw: st.DataObject
) -> None:
    text = commented(write(before), numbers)
    first, *_, last = before
    lines = text.split("\n")
    start = document(text).place((last,), on_key=True).line - 1
    # An indented comment below a text of several lines would become one of them: then all is written anew.
    new = draw.draw(data.filter(lambda value: "\\n" not in json.dumps(value)))
    assert patched({(last,): new}, text=text).split("\n")[:start] == lines[:start]
    assert patched({(first,): new}, text=text).split("\n")[start - len(lines) :] == lines[start:]
