import pytest

from bbsd.text import Source, read
from bbsd.text.nodes import Scalar, Sequence
from bbsd.text.offsets import source_offsets

WRITTEN = {
    "plain": "a: one two\n",
    "plain over lines": "a: one two\n  three   \n\n\n    four (\n  five)  # six\n",
    "plain below its key": "a:\n    one\n    two\n",
    "single quotes": "a: 'it''s\n  two'' lines'\n",
    "double quotes": 'a: "one \\"two\\" \\\n   three\n\n  \\x41\\u00e9\\U0001F642 four"\n',
    "literal": "a: |  # header\n    one\n      two\n\n    three\n",
    "literal with its indentation": "a: |2-\n   one\n  two\n",
    "folded": "a: >-\n\n  one two\n  three\n\n    four\n  five\n",
    "anchored": "a: &here\n  one two\n",
    "anchored and quoted": "a: &here 'one two'\n",
    "windows": "a: one\r\n  two\r\nb: 1\r\n",
    "in brackets": "a: [ one\n  two ]\n",
}
SPELLED = {'"': '\\"', "'": "''", "A": "\\x41", "é": "\\u00e9", "🙂": "\\U0001F642"}


def scalar_in(text: str) -> Scalar:
    document = read(Source("s", text))
    assert document.diagnoses == ()
    assert document.root
    node = document.root.entries["a"].value
    if isinstance(node, Sequence):
        node = node.items[0]
    assert isinstance(node, Scalar)
    return node


@pytest.mark.parametrize("text", WRITTEN.values(), ids=WRITTEN)
def test_every_visible_character_is_found_where_it_is_written(text: str) -> None:
    scalar = scalar_in(text)
    offsets = source_offsets(text, scalar)
    for character, offset in zip(scalar.text, offsets, strict=False):
        if not character.isspace():
            written = text[offset:].startswith(character) or text[offset:].startswith(SPELLED[character])
            assert written, (character, text[offset:])


@pytest.mark.parametrize("text", WRITTEN.values(), ids=WRITTEN)
def test_offsets_grow_and_stay_inside_the_scalar(text: str) -> None:
    scalar = scalar_in(text)
    offsets = source_offsets(text, scalar)
    assert len(offsets) == len(scalar.text) + 1
    assert offsets == sorted(offsets)
    assert scalar.start <= offsets[0]
    assert offsets[-1] <= scalar.end


def test_the_end_of_a_plain_value_is_behind_its_last_character() -> None:
    assert source_offsets("a: one  # two\n", scalar_in("a: one  # two\n"))[-1] == 6


def test_the_end_of_a_quoted_value_is_its_closing_quote() -> None:
    assert source_offsets("a: 'one'\n", scalar_in("a: 'one'\n"))[-1] == 7
