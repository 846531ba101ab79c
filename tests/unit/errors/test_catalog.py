import re

import pytest

from bbsd.errors import KINDS, describe


def test_codes_are_unique_and_ordered_as_listed() -> None:
    assert list(KINDS) == sorted(KINDS)
    assert all(re.fullmatch(r"BB\d{3}", code) for code in KINDS)


def test_every_kind_says_all_there_is_to_say() -> None:
    for kind in KINDS.values():
        assert all((kind.title, kind.explanation, kind.example, kind.mend)), kind.code


def test_a_code_is_described_in_either_case() -> None:
    assert describe("bb006") is describe("BB006")
    assert describe("BB006").title == "a key given twice"


def test_an_unknown_code_is_a_key_error() -> None:
    with pytest.raises(KeyError):
        describe("BB999")
