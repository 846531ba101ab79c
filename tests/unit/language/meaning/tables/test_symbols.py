import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.expression.scope import Findings
from bbsd.expression.syntax.tree import Span
from bbsd.language.meaning.behaviors import MAX_ACTIONS
from bbsd.language.meaning.tables.symbols import SYMBOLS, filled_text, table_of_text, text_of_table
from bbsd.language.meaning.tables.table import NO_ACTION, OPEN_CELL
from bbsd.text import Source, read
from bbsd.text.writing.writer import write
from tests.unit.language.specs import check, codes, meaning_of, source

INPUTS = {"near": ("false", "true"), "pace": ("0", "1", "2")}
ACTIONS = ("halt", "push")
LISTS = st.lists(st.sampled_from([NO_ACTION, 1, 2, OPEN_CELL]), min_size=6, max_size=6)


def given_by(text: str) -> list[int]:
    findings = Findings()
    found = table_of_text(text, INPUTS, ACTIONS, ("table",), findings)
    assert not findings.mistakes
    return [*found.given]


def mistakes(text: str, *, is_known: bool = True) -> list[tuple[str, Span, str]]:
    findings = Findings()
    found = table_of_text(text, INPUTS, ACTIONS, ("table",), findings, is_known=is_known)
    assert [*found.given] == [OPEN_CELL] * 6
    return [(mistake.message, mistake.span, mistake.advice) for _, mistake in findings.mistakes]


def test_a_character_stands_for_each_cell_the_last_input_fastest() -> None:
    assert given_by(".12 0?1") == [0, 1, 2, 0, OPEN_CELL, 1]


def test_there_is_a_character_for_each_of_the_most_actions() -> None:
    assert [cell for cell in range(MAX_ACTIONS + 1) if cell not in SYMBOLS] == []
    assert len(set(SYMBOLS.values())) == len(SYMBOLS) == MAX_ACTIONS + 2
    assert [SYMBOLS[cell] for cell in (1, 9, 10, 35, 36, 61)] == ["1", "9", "a", "z", "A", "Z"]


def test_all_characters_survive_a_file() -> None:
    cells = [*SYMBOLS]
    inputs, actions = {"all": tuple(map(str, cells))}, tuple(f"a{number}" for number in range(MAX_ACTIONS))
    table = read(Source("spec.yaml", write({"table": text_of_table(cells, inputs)}))).data["table"]
    findings = Findings()
    assert [*table_of_text(str(table), inputs, actions, (), findings).given] == cells
    assert not findings.mistakes


@given(LISTS)
def test_a_text_is_read_as_the_table_it_was_made_of(cells: list[int]) -> None:
    assert given_by(text_of_table(cells, INPUTS)) == cells


@pytest.mark.parametrize(("rows", "row", "width"), [(50, 40, 80), (20, 90, 90), (3, 100, 90)])
def test_lines_are_of_whole_rows_where_they_fit(rows: int, row: int, width: int) -> None:
    inputs = {"first": ("x",) * rows, "last": ("x",) * row}
    assert len(text_of_table([0] * (rows * row), inputs).splitlines()[0]) == width


@given(LISTS, LISTS, st.lists(st.sampled_from(["", " ", "\n"]), min_size=6, max_size=6))
def test_only_what_is_open_is_filled(cells: list[int], design: list[int], blanks: list[str]) -> None:
    text = "".join(blank + SYMBOLS[cell] for blank, cell in zip(blanks, cells, strict=True))
    filled = filled_text(text, design)
    assert [symbol for symbol in filled if symbol.isspace()] == [blank for blank in blanks if blank]
    assert given_by(filled) == [
        new if old == OPEN_CELL else old for old, new in zip(cells, design, strict=True)
    ]


def test_a_zero_that_was_written_stays_one() -> None:
    assert filled_text("0.\n?1", [0, 0, 2, 1]) == "0.\n21"


def test_too_few_cells_are_told_at_the_end() -> None:
    [(message, span, advice)] = mistakes("..1\n..\n")
    assert message == "this table has 5 cells, and its inputs make 6 (2 of near x 3 of pace)"
    assert (span, advice) == (Span(5, 1), "the last input changes fastest")


def test_a_line_unlike_the_others_is_the_one_that_is_wrong() -> None:
    [(_, span, advice)] = mistakes("...\n..\n...\n")
    assert (span, advice) == (Span(4, 2), "this line has 2, others have 3")


def test_characters_that_stand_for_nothing_are_told_once_each() -> None:
    reports = mistakes("!.!\n.3-")
    assert [(message, span) for message, span, _ in reports] == [
        ('"!" stands for nothing in a table', Span(0, 1)),
        ('"3" stands for action 3, and there are 2', Span(5, 1)),
        ('"-" stands for nothing in a table', Span(6, 1)),
    ]


def test_of_inputs_and_actions_that_are_not_known_nothing_is_said() -> None:
    assert mistakes("..9", is_known=False) == []
    assert len(mistakes("..!", is_known=False)) == 1


def test_a_spec_may_give_a_table_instead_of_rules() -> None:
    (module,) = meaning_of("behaviors: {stop: {table: '.1'}}").episode.modules
    assert [*module.table.given] == [0, 1]


@pytest.mark.parametrize("written", ["01", "0", "1.1", "0x1f", "1e5", "true"])
def test_what_yaml_reads_as_a_number_is_not_taken_for_another_table(written: str) -> None:
    text = source().text.replace("    inputs:", f"    table: {written}\n    inputs:")
    [diagnosis] = check(Source("spec.yaml", text))
    assert (diagnosis.code, diagnosis.advice) == ("BB022", "put it in quotes")


def test_rules_and_a_table_exclude_each_other() -> None:
    assert codes("behaviors: {stop: {table: '.1', rules: [otherwise: halt]}}") == ["BB047"]


TWO = """
bbsd: 1
name: two
environment: {{steps: 5, state: {{x: 0}}}}
behaviors:
  walk: {{inputs: {{at: "{at}"}}, actions: {{right: {{x: x + 1}}}}, table: "11x1"}}
  stay: {{actions: {{hold: {{x: x}}}}, table: 01}}
reward: {{near: x}}
"""


@pytest.mark.parametrize(
    ("at", "found"), [("values(x, 0, 9)", ["BB046", "BB046", "BB022"]), ("[1, 2]", ["BB051", "BB022"])]
)
def test_a_table_is_told_of_beside_mistakes_elsewhere_but_not_of_what_follows_from_them(at, found):
    assert [diagnosis.code for diagnosis in check(Source("two.yaml", TWO.format(at=at)))] == found
