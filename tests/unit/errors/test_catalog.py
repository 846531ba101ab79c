import re
from importlib import import_module
from pathlib import Path

import pytest

import bbsd.errors
from bbsd.errors import KINDS, DiagnosisKind, Severity, describe
from bbsd.errors.catalog import in_order_of_codes

FILES = sorted(Path(bbsd.errors.__file__).parent.glob("*_kinds.py"))
MODULES = [import_module(f"bbsd.errors.{file.stem}") for file in FILES]
LISTED: list[tuple[DiagnosisKind, ...]] = [
    kinds for module in MODULES for name, kinds in vars(module).items() if name.endswith("_KINDS")
]


def test_codes_are_unique_and_ordered_by_their_numbers() -> None:
    listed = [kind.code for kinds in LISTED for kind in kinds]
    assert len(LISTED) == len(FILES)
    assert len(KINDS) == len(listed)
    assert list(KINDS) == sorted(listed, key=lambda code: int(code.removeprefix("BB")))
    assert all(re.fullmatch(r"BB\d{3,}", code) for code in KINDS)


def test_there_is_room_beyond_two_and_three_digits() -> None:
    kinds = [DiagnosisKind(code, "", "", "", "") for code in ("BB1000", "BB099", "BB100", "BB001")]
    assert list(in_order_of_codes(kinds)) == ["BB001", "BB099", "BB100", "BB1000"]


def test_a_kind_is_a_mistake_unless_it_says_otherwise() -> None:
    assert DiagnosisKind("BB100", "", "", "", "").severity is Severity.MISTAKE


def test_every_kind_has_all_its_texts() -> None:
    for kind in KINDS.values():
        assert all((kind.title, kind.explanation, kind.example, kind.mend)), kind.code


def test_a_code_is_described_in_either_case() -> None:
    assert describe("bb006") is describe("BB006")
    assert describe("BB006").title == "a key given twice"


def test_an_unknown_code_is_a_key_error() -> None:
    with pytest.raises(KeyError):
        describe("BB999")


def test_warnings_are_numbered_from_201_and_nothing_else_is() -> None:
    for kind in KINDS.values():
        assert (int(kind.code.removeprefix("BB")) > 200) == (kind.severity is Severity.WARNING), kind.code
