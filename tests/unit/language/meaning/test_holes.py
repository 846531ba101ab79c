from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.language.meaning.holes import holes_of
from bbsd.language.meaning.tables.symbols import SYMBOLS
from tests.unit.language.specs import meaning_of

INPUTS = "inputs: {reached: height >= 3, pace: 'values(floor(speed), 0, 2)', near: height > 2}"


def blocks(part: str) -> list[dict[str, list[str]]]:
    """Return the blocks of open cells of the small spec's one behavior."""
    (cells,) = holes_of(meaning_of(part)).cells
    return [*cells.where()]


def test_all_cells_are_one_block_that_names_no_input() -> None:
    assert blocks("") == [{}]


def test_cells_that_are_open_alike_are_one_block() -> None:
    rules = "rules: [{when: {reached: true}, do: halt}, {when: {pace: 1}, do: no action}]"
    assert blocks(f"behaviors: {{stop: {{{INPUTS}, {rules}}}}}") == [
        {"reached": ["false"], "pace": ["0", "2"]}
    ]


@given(st.text("?1.", min_size=12, max_size=12).filter(lambda table: "?" in table))
def test_the_blocks_are_all_open_cells_each_once(table: str) -> None:
    meaning = meaning_of(f'behaviors: {{stop: {{{INPUTS}, table: "{table}"}}}}')
    (module,) = meaning.episode.modules
    (cells,) = holes_of(meaning).cells
    labels = [*product(*module.inputs.values())]
    named = [
        cell
        for block in cells.where()
        for cell in product(*(block.get(name, all_of) for name, all_of in module.inputs.items()))
    ]
    still_open = [
        cell for cell, value in zip(labels, module.table.given, strict=True) if SYMBOLS[value] == "?"
    ]
    assert sorted(named) == sorted(still_open)
    assert (cells.count, cells.of) == (len(still_open), 12)


MORE = "behaviors: {go: {actions: {move: {speed: 1}}}, wait: {actions: {rest: {speed: 0}}}}"


@pytest.mark.parametrize(
    ("structure", "layers", "candidates", "behaviors"),
    [
        ("null", (1, 2, 3), ("stop", "go", "wait"), ["stop", "go", "wait"]),
        ("[open, go, open]", (1, 3), ("stop", "wait"), ["stop", "go", "wait"]),
        ("[go, open]", (2,), ("stop", "wait"), ["stop", "go", "wait"]),
        ("[wait, go]", (), (), ["go", "wait"]),
    ],
)
def test_layers_are_counted_from_the_top(structure, layers, candidates, behaviors) -> None:
    holes = holes_of(meaning_of(f"{MORE}\nstructure: {structure}"))
    assert (holes.layers, holes.candidates) == (layers, candidates)
    assert [each.module.name for each in holes.cells] == behaviors
