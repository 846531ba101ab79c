import re
from importlib import import_module
from pathlib import Path

import pytest

from bbsd.errors import DiagnosisKind, Severity, kinds
from bbsd.errors.catalog import KINDS, describe, in_order_of_codes
from bbsd.errors.kinds import kind

FILES = sorted({*Path(kinds.__file__).parent.glob("*.py")} - {Path(kinds.__file__), Path(kind.__file__)})
MODULES = [import_module(f"bbsd.errors.kinds.{file.stem}") for file in FILES]
LISTED: list[tuple[DiagnosisKind, ...]] = [
    found for module in MODULES for name, found in vars(module).items() if name.endswith("_KINDS")
]


def test_codes_are_unique_and_ordered_by_their_numbers() -> None:
    listed = [each.code for found in LISTED for each in found]
    assert len(LISTED) == len(FILES) > 9
    assert len(KINDS) == len(listed)
    assert list(KINDS) == sorted(listed, key=lambda code: int(code.removeprefix("BB")))
    assert all(re.fullmatch(r"BB\d{3,}", code) for code in KINDS)


def test_there_is_room_beyond_two_and_three_digits() -> None:
    made = [DiagnosisKind(code, "", "", "", "") for code in ("BB1000", "BB099", "BB100", "BB001")]
    assert list(in_order_of_codes(made)) == ["BB001", "BB099", "BB100", "BB1000"]


def test_a_kind_is_a_mistake_unless_it_says_otherwise() -> None:
    assert DiagnosisKind("BB100", "", "", "", "").severity is Severity.MISTAKE


def test_every_kind_has_all_its_texts() -> None:
    for each in KINDS.values():
        assert all((each.title, each.explanation, each.example, each.mend)), each.code


def test_a_code_is_described_in_either_case() -> None:
    assert describe("bb006") is describe("BB006")
    assert describe("BB006").title == "a key given twice"


def test_an_unknown_code_is_a_key_error() -> None:
    with pytest.raises(KeyError):
        describe("BB999")


def test_warnings_are_numbered_from_201_and_nothing_else_is() -> None:
    for each in KINDS.values():
        assert (int(each.code.removeprefix("BB")) > 200) == (each.severity is Severity.WARNING), each.code
