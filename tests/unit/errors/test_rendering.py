import json

import pytest

from bbsd.errors import Diagnosis, DiagnosisKind, Place, Severity, escape, render_json, render_text
from bbsd.errors.catalog import KINDS

UNEXPECTED = Diagnosis(
    "BB012",
    'unexpected key "modlues"; did you mean "modules"?',
    Place("spec.yaml", 12, 3, 7),
    "advice, when there is one",
)


def caret_line(source_line: str, column: int, length: int = 1) -> str:
    diagnosis = Diagnosis("BB004", "wrong", Place("spec.yaml", 1, column, length))
    return render_text(diagnosis, source_line).split("\n")[2]


def test_a_diagnosis_shows_its_line_a_caret_and_the_advice() -> None:
    assert render_text(UNEXPECTED, "  modlues: {}").split("\n") == [
        'spec.yaml:12:3: error[BB012]: unexpected key "modlues"; did you mean "modules"?',
        "   12 |   modlues: {}",
        "      |   ^^^^^^^",
        "      = advice, when there is one",
    ]


def test_without_a_source_line_only_the_message_is_shown() -> None:
    diagnosis = Diagnosis("BB001", "there is no such file", Place("spec.yaml", 1, 1))
    assert render_text(diagnosis, "") == "spec.yaml: error[BB001]: there is no such file"


def test_tabs_are_shown_as_blanks_and_the_caret_stays_below() -> None:
    assert caret_line("\tx: y", column=2) == "      |     ^"


def test_wide_characters_move_the_caret_by_two_columns() -> None:
    assert caret_line("速度: y", column=5) == "      |       ^"
    assert caret_line("速度: y", column=1, length=2) == "      | ^^^^"


def test_combining_characters_do_not_move_the_caret() -> None:
    assert caret_line("e\u0301: y", column=5) == "      |    ^"


def test_a_place_behind_the_end_of_the_line_is_marked_there() -> None:
    assert caret_line("x:", column=3) == "      |   ^"


def test_control_and_format_characters_are_written_out() -> None:
    hostile = Diagnosis("BB004", "name \x1b[2J\n", Place("\x07.yaml", 1, 2), "\u202e")
    text = render_text(hostile, "\x1bx")
    assert "\x1b" not in text
    assert text.split("\n") == [
        "\\x07.yaml:1:2: error[BB004]: name \\x1b[2J\\n",
        "    1 | \\x1bx",
        "      |     ^",
        "      = \\u202e",
    ]


def test_letters_of_all_scripts_are_left_and_blanks_that_are_none_are_shown() -> None:
    assert escape("a Ä速🙂") == "a Ä速🙂"
    assert escape("a\xa0b\u2003c\u3000") == r"a\xa0b\u2003c\u3000"


def test_a_long_line_is_shown_around_the_place() -> None:
    lines = render_text(Diagnosis("BB004", "wrong", Place("s", 1, 501)), "a" * 500 + "!" + "b" * 500).split(
        "\n"
    )
    assert len(lines[1]) < 200
    assert lines[1][lines[2].index("^")] == "!"
    assert lines[1].count("…") == 2


def test_color_changes_nothing_but_color() -> None:
    colored = render_text(UNEXPECTED, "  modlues: {}", color=True)
    assert "\x1b[1;31merror[BB012]\x1b[0m" in colored
    for style in ("\x1b[1;31m", "\x1b[1;34m", "\x1b[1m", "\x1b[0m"):
        colored = colored.replace(style, "")
    assert colored == render_text(UNEXPECTED, "  modlues: {}")


def test_json_has_the_place_code_message_and_advice() -> None:
    (rendered,) = json.loads(json.dumps(render_json([UNEXPECTED])))
    assert rendered == {
        "file": "spec.yaml",
        "line": 12,
        "column": 3,
        "end_column": 10,
        "code": "BB012",
        "severity": "error",
        "message": 'unexpected key "modlues"; did you mean "modules"?',
        "advice": "advice, when there is one",
    }


@pytest.fixture
def warning(monkeypatch: pytest.MonkeyPatch) -> Diagnosis:
    """Return a diagnosis of a made-up kind, which the catalog does not have."""
    kind = DiagnosisKind("BB101", "odd", "why", "example", "mend", Severity.WARNING)
    monkeypatch.setitem(KINDS, kind.code, kind)
    return Diagnosis(kind.code, "this is odd", Place("spec.yaml", 1, 1, 5))


def test_a_warning_is_shown_as_one(warning: Diagnosis) -> None:
    assert render_text(warning, "steps: 1").split("\n") == [
        "spec.yaml:1:1: warning[BB101]: this is odd",
        "    1 | steps: 1",
        "      | ^^^^^",
    ]
    assert "\x1b[1;33mwarning[BB101]\x1b[0m" in render_text(warning, "steps: 1", color=True)


def test_json_says_that_a_warning_is_one(warning: Diagnosis) -> None:
    (rendered,) = render_json([warning])
    assert rendered["severity"] == "warning"
