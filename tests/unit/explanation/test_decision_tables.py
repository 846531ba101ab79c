import re
from itertools import product

import numpy as np
import pytest

from bbsd.explanation import explanation_text, table_text
from bbsd.explanation.decision_tables import SCREEN, decision_table
from tests.unit.explanation.test_layers import FINE, UPPER_NEAR, explained, visits, with_visits

FOUR = """
  steer:
    inputs:
      gap: "cut(x, 0.5, 1, 2)"
      side: "values(floor(x), 0, 2)"
      lit: cos(x) > 0
      pace: "values(floor(2 * x), 0, 3)"
    actions: {go: {x: 1}, turn_left: {x: 2}, turn_right: {x: 3}}
"""
N_CELLS = 4 * 3 * 2 * 4


def test_a_rule_is_a_row():
    lower = explained(UPPER_NEAR, [[0, 0, 2, 0, 1, 1], [0, 0]], [0]).layers[0]
    assert decision_table(lower).lines == [
        "near  pace   decision",
        "----  -----  ---------",
        "yes   not 0  a",
        "-     2      b",
        "-     -      no action",
    ]


@pytest.mark.parametrize("seed", range(5))
def test_a_behavior_of_four_inputs_fits_one_screen(seed):
    table = np.random.default_rng(seed).integers(0, 4, N_CELLS)
    layer = explained(FOUR, [table], [0]).layers[0]
    lines = decision_table(layer).lines
    assert len(lines) <= SCREEN + 4
    assert max(map(len, lines)) <= 80


@pytest.mark.parametrize("seed", range(3))
def test_the_grid_has_every_cell_of_the_table(seed):
    table = np.random.default_rng(seed).integers(0, 4, N_CELLS).reshape(4, 3, 2, 4)
    layer = explained(FOUR, [table.ravel()], [0]).layers[0]
    lines = decision_table(layer).lines
    n_down = lines[0].split().index("a")
    keys = next(index for index, line in enumerate(lines) if line.startswith("columns: "))
    labels = [
        ["below 0.5", "0.5 to 1", "1 to 2", "from 2"],
        ["0", "1", "2"],
        ["false", "true"],
        ["0", "1", "2", "3"],
    ]
    starts = list(product(*labels[:n_down]))
    meanings = dict(part.split(" ", 1) for part in lines[-1].removeprefix("decisions: ").split(", "))
    words = ("no action", "go", "turn_left", "turn_right")
    for start, line, row in zip(starts, lines[2:keys], table.reshape(len(starts), -1), strict=True):
        cells = re.split(r" {2,}", line)
        assert tuple(cells[:n_down]) == start
        assert [meanings[cell] for cell in cells[n_down:]] == [words[number] for number in row]


def test_beyond_three_inputs_the_text_has_a_table():
    table = np.zeros((4, 3, 2, 4), int)
    table[0, 1, 1, 2] = 1
    text = explanation_text(explained(FOUR, [table.ravel()], [0]))
    assert "the first row that fits decides" in text
    assert "below 0.5  1     yes  2     go\n" in text


def test_a_table_says_how_to_read_it():
    table = np.random.default_rng(0).integers(0, 4, N_CELLS)
    assert decision_table(explained(FOUR, [table], [0]).layers[0]).how == "the decision in each cell"
    assert decision_table(explained(UPPER_NEAR, [[1, 0, 2, 0, 1, 1], [0, 0]], [0]).layers[0]).how.startswith(
        "the first"
    )


def test_the_whole_is_one_table():
    text = table_text(explained(UPPER_NEAR, [[0, 1, 2, 1, 1, 1], [0, 1]], [0, 1]))
    assert "command  layer  behavior  where\n" in text
    assert "a            2  upper     near\n" in text
    assert "(none)          nobody    no row above holds\n" in text


def test_the_whole_is_ordered_by_time_where_visits_are_known():
    counted = visits([[5, 0, 70, 0, 0, 0], [5, 20]], [[0, 0, 70, 0, 0, 0], [0, 20]])
    text = table_text(with_visits(UPPER_NEAR, [[0, 1, 2, 1, 1, 1], [0, 1]], [0, 1], counted))
    assert text.index("70.0 %  b") < text.index("20.0 %  a") < text.index(" 0.0 %  a")
    assert "10.0 %  (none)" in text
    assert "pace  decision    asked\n" in text
    assert "(asked: share of time in which" in text
    words = " ".join(text.split())
    assert "In 10 episodes, lower controlled 70.0 % of the time, upper 20.0 % and nobody 10.0 %." in words
    assert "(1 cell was never asked in 10 episodes; there the table says a where pace is 1.)" in " ".join(
        text.split()
    )


def test_cells_of_a_fine_input_are_named_by_their_labels():
    table = np.zeros(100_000, int)
    table[[4, 70_001]] = 1
    fine = FINE.replace("0, 99999", "1, 100000")
    assert "5, 70002  a\n" in table_text(explained(fine, [table, [0, 1]], [0]))
