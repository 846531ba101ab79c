"""Behaviors and structures that Hypothesis makes up."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product
from math import prod
from typing import Any

from hypothesis import strategies as st

from tests.interpreter.made_up_expressions import Draw, Reach, a_list, a_row, index, number, truth, whole
from tests.interpreter.made_up_partitions import Partition, partition

TELLING = (
    "before(x) != x",
    "before(level) < level",
    "before(flag) == flag",
    "before(warm) != warm",
    "y == before(y)",
    "sum(eyes) > sum(before(eyes))",
    "before(bins)[1] != bins[1]",
    "before(marks[0][1])",
)

Cells = dict[str, dict[str, frozenset[int]]]
"""For each input what its labels mean."""


@dataclass(frozen=True)
class Senses:
    """What behaviors may use, and the cells of the sensors that are partitions."""

    reach: Reach
    cells: Cells


def behavior(draw: Draw, senses: Senses) -> dict[str, Any]:
    """A behavior as plain data."""
    inputs, cells = some_inputs(draw, senses)
    actions = {f"a{k}": assignments(draw, senses.reach) for k in range(draw(st.integers(1, 3)))}
    block = {"inputs": inputs, "actions": actions}
    if draw(st.booleans()):
        block["excited"] = truth(draw, senses.reach)
    if draw(st.booleans()):
        block["expects"] = expectation(draw, senses.reach)
    match draw(st.sampled_from(["rules", "rules", "table", None])):
        case "rules":
            block["rules"] = rules(draw, cells, [*actions, "no action", "open"])
        case "table":
            block["table"] = table(draw, cells, len(actions))
    return block


def table(draw: Draw, cells: Cells, n_actions: int) -> str:
    """A character for each cell, with white space wherever it may be."""
    size = prod(len(frozenset().union(*labels.values())) for labels in cells.values())
    symbol = st.sampled_from(["?", ".", "0", *map(str, range(1, n_actions + 1))])
    blank = st.sampled_from(["", "", "\n", "  "])
    return "".join(draw(blank) + draw(symbol) for _ in range(size)) + draw(blank)


def expectation(draw: Draw, reach: Reach) -> str:
    """What a behavior expects: anything, or what tells the moments of a step apart."""
    made_up = truth(draw, replace(reach, before=True))
    return draw(st.sampled_from([made_up, *TELLING]))


def some_inputs(draw: Draw, senses: Senses) -> tuple[Any, Cells]:
    """Sensors that are listed, or partitions of its own; and the labels of their cells."""
    if draw(st.booleans()):
        names = draw(st.lists(st.sampled_from(sorted(senses.cells)), unique=True, max_size=2))
        return names, {name: senses.cells[name] for name in names}
    names = ("seen", "heard")[: draw(st.integers(0, 2))]
    own: dict[str, Partition] = {name: partition(draw, senses.reach) for name in names}
    return {name: own[name].data for name in own}, {name: own[name].cells for name in own}


def assignments(draw: Draw, reach: Reach) -> dict[str, str]:
    """What an action sets."""
    reach = replace(reach, draws=True)
    ways = {"x": number, "y": number, "place": whole, "flag": truth}
    chosen = draw(st.lists(st.sampled_from(sorted(ways)), unique=True, min_size=1, max_size=3))
    return {name: ways[name](draw, reach, 2) for name in chosen} | of_lists(draw, reach)


def of_lists(draw: Draw, reach: Reach) -> dict[str, str]:
    """What an action sets of lists: all of one, a row, or elements, of which the later one may be the same."""
    found = dict[str, str]()
    match draw(st.sampled_from(["none", "all", "one", "two"])):
        case "all":
            found["bins"] = a_list(draw, reach, 3)
        case "one" | "two" as how_many:
            for _ in range(1 + (how_many == "two")):
                found[f"bins[{index(draw, reach, 2, 3)}]"] = number(draw, reach, 2)
    match draw(st.sampled_from(["none", "all", "row", "one"])):
        case "all":
            found["marks"] = a_list(draw, reach, 2, 2)
        case "row":
            found[f"marks[{index(draw, reach, 2, 2)}]"] = a_row(draw, reach, 2)
        case "one":
            found[f"marks[{index(draw, reach, 2, 2)}][{index(draw, reach, 2, 2)}]"] = truth(draw, reach, 2)
    return found


def rules(draw: Draw, cells: Cells, decisions: list[str]) -> list[dict[str, Any]]:
    """Rules for some of the cells; none that has nothing left to decide."""
    decision = st.sampled_from(decisions)
    left = set(product(*(frozenset().union(*labels.values()) for labels in cells.values())))
    found: list[dict[str, Any]] = []
    for _ in range(draw(st.integers(0, 3)) if cells else 0):
        when = some_cells(draw, cells)
        matched = {cell for cell in left if matches(cell, when, cells)}
        if matched:
            found.append({"when": when, "do": draw(decision)})
            left -= matched
    if left and (not found or draw(st.booleans())):
        found.append({"otherwise": draw(decision)})
    return found


def some_cells(draw: Draw, cells: Cells) -> dict[str, list[str]]:
    """Cells of one input or more."""
    names = draw(st.lists(st.sampled_from(sorted(cells)), unique=True, min_size=1))
    labels = {name: st.sampled_from(sorted(cells[name])) for name in names}
    return {name: draw(st.lists(labels[name], unique=True, min_size=1, max_size=2)) for name in names}


def matches(cell: tuple[int, ...], when: dict[str, list[str]], cells: Cells) -> bool:
    at = dict(zip(cells, cell, strict=True))
    return all(any(at[name] in cells[name][label] for label in labels) for name, labels in when.items())


def structure(draw: Draw, behaviors: list[str]) -> dict[str, Any]:
    """Some open layers, or layers that are given or open, as many as there are behaviors or fewer."""
    if draw(st.booleans()):
        return {"design": {"layers": draw(st.integers(1, len(behaviors)))}}
    layers = draw(st.permutations(behaviors))[: draw(st.integers(1, len(behaviors)))]
    return {"structure": [draw(st.sampled_from([layer, layer, "open"])) for layer in layers]}
