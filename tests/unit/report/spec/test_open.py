from __future__ import annotations

import pytest

from bbsd.report.spec.open import open_line, open_list, open_plain
from tests.unit.language.specs import meaning_of

MORE = "go: {actions: {move: {speed: 1}}}, wait: {actions: {rest: {speed: 0}}}"
RULES = "rules: [{when: {reached: true, near: true}, do: halt}]"
STOP = f"stop: {{inputs: {{reached: height >= 3, near: height > 2}}, {RULES}}}"
ALL = "all cells of stop, go and wait"


@pytest.mark.parametrize(
    ("part", "expected"),
    [
        ("", "all cells of stop"),
        ("behaviors: {stop: {rules: [{otherwise: halt}]}}", ""),
        (f"behaviors: {{{MORE}}}", f"{ALL}; the structure (3 layers)"),
        (
            f"behaviors: {{{MORE}}}\ndesign: {{layers: 2}}",
            f"{ALL}; the structure (2 layers for 3 behaviors)",
        ),
        (
            f"behaviors: {{{MORE}}}\nstructure: [open, go, open]",
            f"{ALL}; layers 1 and 3 of 3 from the top, for stop or wait",
        ),
        (f"behaviors: {{{MORE}}}\nstructure: [go]", "all cells of go"),
        (f"behaviors: {{{STOP}}}", "3 of 4 cells of stop (reached false; reached true, near false)"),
    ],
)
def test_what_is_open_is_told_in_a_line(part: str, expected: str) -> None:
    assert open_line(meaning_of(part)) == expected


def test_what_is_long_is_cut_in_the_line_and_whole_in_the_list() -> None:
    inputs = "inputs: {reached: null, a: 'values(floor(speed), 0, 19)', b: height > 2}"
    part = f'behaviors: {{stop: {{{inputs}, table: "{"?.1?" * 10}"}}}}'
    even, odd = "a 0, 2, 4, 6, 8, 10, 12, 14, ... (10)", "a 1, 3, 5, 7, 9, 11, 13, 15, ... (10)"
    assert open_line(meaning_of(part)) == f"20 of 40 cells of stop ({even}, b false; {odd}, b true)"
    assert "  a 0 or 2 or 4 or 6 or 8 or 10 or 12 or 14 or 16 or 18, b false\n" in open_list(meaning_of(part))


def test_many_behaviors_are_cut_too() -> None:
    names = [f"b{number}" for number in range(12)]
    many = ", ".join(f"{name}: {{actions: {{move: {{speed: 1}}}}}}" for name in names)
    line = open_line(meaning_of(f"behaviors: {{{many}}}\nstructure: [stop, {', '.join(names)}]"))
    assert line == "all cells of stop, b0, b1, b2, b3, b4, b5, b6, ... (13)"


def test_programs_get_blocks_as_rules_would_name_them() -> None:
    plain = open_plain(meaning_of(f"behaviors: {{{STOP}}}"))
    assert plain["cells"] == [
        {
            "behavior": "stop",
            "open": 3,
            "of": 4,
            "where": [{"reached": ["false"]}, {"reached": ["true"], "near": ["false"]}],
        }
    ]
    assert (plain["layers"], plain["of_layers"], plain["candidates"]) == ([], 1, [])


def test_a_name_that_steers_a_terminal_is_shown() -> None:
    inputs = r'inputs: {a: {"x\e[2J": height > 2, y: otherwise}}'
    part = f"behaviors: {{stop: {{{inputs}, rules: [{{when: {{a: y}}, do: halt}}]}}}}"
    assert "\x1b" not in open_line(meaning_of(part)) + open_list(meaning_of(part))
