"""Several short loops over lanes do what one long loop does."""

import pytest

from bbsd.compiler.details import Detail
from bbsd.compiler.writing.blocks import Assignment, Block, Comment
from bbsd.compiler.writing.loop_fission import LONGEST_LOOP, split_loop
from bbsd.compiler.writing.precedence import COMPARISON, Text, call, name_text
from bbsd.compiler.writing.rollout_function import RolloutFunction
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from tests.unit.problems import RICH, problem_of


@pytest.fixture
def function():
    problem = problem_of(RICH)
    return RolloutFunction(problem.meaning, problem.tables, 4, Detail.CREDIT)


ACT = Comment("Act, and so on.", starts_phase=True)


def text(source, *uses):
    return Text(source, COMPARISON, frozenset(uses))


def definition(name, value, kind=Kind.NUMBER):
    return Assignment(name, value, kind, is_definition=True)


def block_of(statements):
    return Block(Level.LANE, statements=list(statements))


START = definition("n0", text("x[lane]"))


def chain(first, last):
    return [
        definition(f"n{number}", text(f"n{number - 1} + 1.0", f"n{number - 1}"))
        for number in range(first, last + 1)
    ]


def store(source, *uses):
    return Assignment("x[lane]", text(source, *uses))


def test_a_short_block_is_one_loop(function):
    block = block_of([START, *chain(1, 5), store("n5", "n5")])
    assert split_loop(block, function) == [block.lines]
    assert function.memory.numbers == []


def test_what_one_loop_computes_and_another_needs_is_kept(function):
    block = block_of([START, *chain(1, 15), ACT, store("n15 + n3", "n15", "n3")])
    first, second = split_loop(block, function)
    assert first == [*block.lines[:16], "n3_kept[lane] = n3", "n15_kept[lane] = n15"]
    assert second == [
        "n3 = n3_kept[lane]",
        "n15 = n15_kept[lane]",
        "# Act, and so on.",
        "x[lane] = n15 + n3",
    ]
    assert function.memory.numbers == ["n3_kept", "n15_kept"]


def test_an_expensive_function_has_a_loop_of_its_own(function):
    angle = definition("angle", call("atan", [name_text("n15")]))
    block = block_of([START, *chain(1, 15), angle, store("angle", "angle")])
    assert [[line for line in part if "kept" not in line][-1] for part in split_loop(block, function)] == [
        "n15 = n14 + 1.0",
        "angle = atan(n15)",
        "x[lane] = angle",
    ]


def test_truths_cross_as_numbers_and_cells_as_integers(function):
    definitions = [
        definition("holds", text("x[lane] > 0.0"), Kind.TRUTH),
        definition("cell", text("int(holds)", "holds"), Kind.CELL),
        definition("n0", text("1.0")),
    ]
    last = store("select(holds, n15, y[cell])", "holds", "n15", "cell")
    block = block_of([*definitions, *chain(1, 15), ACT, last])
    first, second = split_loop(block, function)
    assert "holds_kept[lane] = select(holds, 1.0, 0.0)" in first
    assert "holds = holds_kept[lane] != 0.0" in second
    assert "cell = cell_kept[lane]" in second
    assert function.memory.integers == ["cell_kept"]


def test_a_very_long_block_is_cut_anywhere(function):
    block = block_of([START, *chain(1, 3 * LONGEST_LOOP)])
    parts = split_loop(block, function)
    assert len(parts) > 2
    assert [line for part in parts for line in part if "kept" not in line] == block.lines


def test_all_parts_together_compute_what_the_block_does(function):
    block = block_of([START, *chain(1, 150), store("n150 - n7", "n150", "n7")])
    names = {"x": [float(lane) for lane in range(4)]}
    parts = split_loop(block, function)
    kept = {name: [0.0] * 4 for name in function.memory.numbers}
    for part in parts:
        for lane in range(4):
            exec("\n".join(part), {}, {**names, **kept, "lane": lane})
    assert names["x"] == [143.0] * 4


def test_what_other_blocks_computed_is_read_where_it_is_needed(function):
    last = store("n0_elsewhere + n15", "n0_elsewhere", "n15")
    block = block_of([START, *chain(1, 15), ACT, last])
    block.read = {"n0_elsewhere": "n0_elsewhere_kept[lane]", "never": "never_kept[lane]"}
    first, second = split_loop(block, function)
    assert not any("elsewhere" in line for line in first)
    assert second[:2] == ["n0_elsewhere = n0_elsewhere_kept[lane]", "n15 = n15_kept[lane]"]
    assert not any("never" in line for line in (*first, *second))


def test_what_other_blocks_need_is_kept_once(function):
    block = block_of([START, *chain(1, 15), ACT, store("n15 + n3", "n15", "n3")])
    block.kept = {"n3": function.keep("n3_for_all"), "n9": function.keep("n9_for_all")}
    first, second = split_loop(block, function)
    assert first[-3:] == ["n3_for_all[lane] = n3", "n9_for_all[lane] = n9", "n15_kept[lane] = n15"]
    assert second[:2] == ["n3 = n3_for_all[lane]", "n15 = n15_kept[lane]"]


def test_a_loop_reads_at_most_two_other_robots(function):
    block = block_of(
        definition(f"n{number}", text(f"x[seen_{seen} + lane]", f"seen_{seen}"))
        for number, seen in enumerate((1, 2, 1, 3, 2, 4))
    )
    block.robots_seen = {f"seen_{number}" for number in (1, 2, 3, 4)}
    parts = split_loop(block, function)
    assert [[line.split("[")[1][:6] for line in part] for part in parts] == [
        ["seen_1", "seen_2", "seen_1"],
        ["seen_3", "seen_2"],
        ["seen_4"],
    ]


@pytest.mark.parametrize(
    "before", [[], [Comment("Reward: what each robot earned goes to what controlled it.")]]
)
def test_no_loop_is_without_work(function, before):
    seen = {"seen_1", "seen_2", "seen_3"}
    many = definition("n0", text("x[seen_1 + lane] + x[seen_2 + lane] + x[seen_3 + lane]", *seen))
    block = block_of([*before, many, store("n0", "n0")])
    block.robots_seen = seen
    parts = split_loop(block, function)
    assert parts[0][: len(before) + 1] == [statement.line for statement in (*before, many)]


def test_only_what_a_statement_uses_crosses_and_not_what_a_comment_mentions(function):
    before = [definition("reward", text("x[lane]")), *chain(1, 15)]
    block = block_of([START, *before, ACT, Comment("The reward."), store("n15", "n15")])
    split_loop(block, function)
    assert function.memory.numbers == ["n15_kept"]
