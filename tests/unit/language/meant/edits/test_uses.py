import re

import pytest

from bbsd.language.meant.edits.uses import uses
from bbsd.text import Source, read

TEXT = """\
speed: 1
other:
  - speed + top_speed
  - "speed"
  - {speed: speed.x, b: [speed]}
"""


@pytest.mark.parametrize(
    ("word", "lines"),
    [(r"\bspeed\b", [1, 3, 5, 5, 5]), (r"(?<!\w)speed(?![\w.])", [1, 3, 5, 5]), ("none", [1, 5])],
)
def test_a_name_stands_as_keys_and_as_words_of_plain_texts(word: str, lines: list[int]) -> None:
    document = read(Source("names.yaml", TEXT))
    assert document.root is not None
    found = [*uses(document.root, "speed", re.compile(word))]
    assert {TEXT[start:end] for start, end in found} == {"speed"}
    assert [document.source.line_number(start) for start, _ in found] == lines
