"""Several short loops over lanes do what one long loop does."""

import pytest

from bbsd.compiler.details import Detail
from bbsd.compiler.writing.blocks import Block
from bbsd.compiler.writing.loop_fission import LONGEST, loops
from bbsd.compiler.writing.rollout_function import RolloutFunction
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from tests.unit.problems import RICH, problem_of


@pytest.fixture
def function():
    problem = problem_of(RICH)
    return RolloutFunction(problem.meaning, problem.tables, 4, Detail.CREDIT)


def block_of(lines):
    """A block of (name, text, kind) and of plain lines."""
    block = Block(Level.LANE)
    for line in lines:
        if isinstance(line, str):
            block.lines.append(line)
        else:
            block.assign(*line)
    return block


def chain(first, last):
    return [(f"n{place}", f"n{place - 1} + 1.0", Kind.NUMBER) for place in range(first, last + 1)]


def test_a_short_block_is_one_loop(function):
    block = block_of([("n0", "x[lane]", Kind.NUMBER), *chain(1, 5), "x[lane] = n5"])
    assert loops(block, function) == [block.lines]
    assert function.memory.numbers == []


def test_what_one_loop_computes_and_another_needs_is_kept(function):
    block = block_of(
        [("n0", "x[lane]", Kind.NUMBER), *chain(1, 15), "# Act, and so on.", "x[lane] = n15 + n3"]
    )
    first, second = loops(block, function)
    assert first == [*block.lines[:16], "n3_kept[lane] = n3", "n15_kept[lane] = n15"]
    assert second == [
        "n3 = n3_kept[lane]",
        "n15 = n15_kept[lane]",
        "# Act, and so on.",
        "x[lane] = n15 + n3",
    ]
    assert function.memory.numbers == ["n3_kept", "n15_kept"]


def test_an_expensive_function_has_a_loop_of_its_own(function):
    block = block_of(
        [
            ("n0", "x[lane]", Kind.NUMBER),
            *chain(1, 15),
            ("angle", "atan(n15)", Kind.NUMBER),
            "x[lane] = angle",
        ]
    )
    assert [[line for line in part if "kept" not in line][-1] for part in loops(block, function)] == [
        "n15 = n14 + 1.0",
        "angle = atan(n15)",
        "x[lane] = angle",
    ]


def test_truths_cross_as_numbers_and_cells_as_integers(function):
    lines = [
        ("holds", "x[lane] > 0.0", Kind.TRUTH),
        ("cell", "int(holds)", Kind.CELL),
        ("n0", "1.0", Kind.NUMBER),
    ]
    block = block_of([*lines, *chain(1, 15), "# Act.", "x[lane] = select(holds, n15, y[cell])"])
    first, second = loops(block, function)
    assert "holds_kept[lane] = select(holds, 1.0, 0.0)" in first
    assert "holds = holds_kept[lane] != 0.0" in second
    assert "cell = cell_kept[lane]" in second
    assert function.memory.integers == ["cell_kept"]


def test_a_very_long_block_is_cut_anywhere(function):
    block = block_of([("n0", "x[lane]", Kind.NUMBER), *chain(1, 3 * LONGEST)])
    parts = loops(block, function)
    assert len(parts) > 2
    assert [line for part in parts for line in part if "kept" not in line] == block.lines


def test_all_parts_together_compute_what_the_block_does(function):
    block = block_of([("n0", "x[lane]", Kind.NUMBER), *chain(1, 150), "x[lane] = n150 - n7"])
    names = {"x": [float(lane) for lane in range(4)]}
    parts = loops(block, function)
    kept = {name: [0.0] * 4 for name in function.memory.numbers}
    for part in parts:
        for lane in range(4):
            exec("\n".join(part), {}, {**names, **kept, "lane": lane})
    assert names["x"] == [143.0] * 4


def test_what_other_blocks_computed_is_read_where_it_is_needed(function):
    block = block_of(
        [("n0", "x[lane]", Kind.NUMBER), *chain(1, 15), "# Act.", "x[lane] = n0_elsewhere + n15"]
    )
    block.read = {"n0_elsewhere": "n0_elsewhere_kept[lane]", "never": "never_kept[lane]"}
    first, second = loops(block, function)
    assert not any("elsewhere" in line for line in first)
    assert second[:2] == ["n0_elsewhere = n0_elsewhere_kept[lane]", "n15 = n15_kept[lane]"]
    assert not any("never" in line for line in (*first, *second))


def test_what_other_blocks_need_is_kept_once(function):
    block = block_of([("n0", "x[lane]", Kind.NUMBER), *chain(1, 15), "# Act.", "x[lane] = n15 + n3"])
    block.kept = {"n3": function.keep("n3_for_all"), "n9": function.keep("n9_for_all")}
    first, second = loops(block, function)
    assert first[-3:] == ["n3_for_all[lane] = n3", "n9_for_all[lane] = n9", "n15_kept[lane] = n15"]
    assert second[:2] == ["n3 = n3_for_all[lane]", "n15 = n15_kept[lane]"]


def test_a_loop_reads_at_most_two_other_robots(function):
    lines = [
        (f"n{place}", f"x[seen_{seen} + lane]", Kind.NUMBER) for place, seen in enumerate((1, 2, 1, 3, 2, 4))
    ]
    parts = loops(block_of(lines), function)
    assert [[line.split("[")[1][:6] for line in part] for part in parts] == [
        ["seen_1", "seen_2", "seen_1"],
        ["seen_3", "seen_2"],
        ["seen_4"],
    ]


@pytest.mark.parametrize("before", [[], ["# Reward: what each robot earned goes to what controlled it."]])
def test_no_loop_is_without_work(function, before):
    many = ("n0", "x[seen_1 + lane] + x[seen_2 + lane] + x[seen_3 + lane]", Kind.NUMBER)
    parts = loops(block_of([*before, many, "x[lane] = n0"]), function)
    assert parts[0][: len(before) + 1] == [*before, f"n0 = {many[1]}"]
