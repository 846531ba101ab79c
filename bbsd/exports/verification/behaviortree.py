"""An exported tree, run by BehaviorTree.CPP 4 through its Python binding, behaviortreepy."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from json import dumps
from typing import TYPE_CHECKING

from bbsd.exports.btcpp import leaves_of
from bbsd.exports.tree import n_nodes
from bbsd.exports.verification.tools import ToolMissing, folder_of, read_numbers, run_in, write_cells

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bbsd.exports.exported import Exported, Files

MOST_VISITS = 100_000_000
"""Visits of nodes in some twenty seconds."""

DRIVER = """
import json
import struct
import sys
import xml.etree.ElementTree as ElementTree

import behaviortreepy

n, width = int(sys.argv[1]), int(sys.argv[2])
with open("names.json", encoding="utf-8") as file:
    names = json.load(file)
text = open("exported.xml", encoding="utf-8").read()
board = behaviortreepy.Blackboard.create()
factory = behaviortreepy.BehaviorTreeFactory()
status = behaviortreepy.NodeStatus
present, taken = [0] * width, [0]


def condition(dimension, cells):
    return lambda node: status.SUCCESS if present[dimension] in cells else status.FAILURE


def action(number):
    def act(node):
        taken[0] = number
        return status.SUCCESS

    return act


def implement_leaves(root):
    # The binding knows no ports: each custom leaf becomes a node of its own, made from what its ports say.
    for index, leaf in enumerate([*root.find("BehaviorTree").iter()]):
        name, unique = leaf.tag, f"{leaf.tag}_leaf{index}"
        if name in names["inputs"]:
            cells = {int(cell) for cell in leaf.get("cells", "1").split(";")}
            factory.register_simple_condition(unique, condition(names["inputs"].index(name), cells))
        elif name in names["actions"]:
            factory.register_simple_action(unique, action(names["actions"].index(name) + 1))
        else:
            continue
        leaf.tag, leaf.attrib = unique, {"name": leaf.get("name", name)}


is_custom = sys.argv[3] == "custom"
if is_custom:
    root = ElementTree.fromstring(text)
    implement_leaves(root)
    text = ElementTree.tostring(root, encoding="unicode")
for name in names["inputs"]:
    board.set_int(name, 0)
tree = factory.create_tree_from_text(text, board)
with open("cells", "rb") as cells, open("numbers", "wb") as numbers:
    for _ in range(n):
        row = struct.unpack("<%dI" % width, cells.read(4 * width))
        for index, (name, cell) in enumerate(zip(names["inputs"], row)):
            if present[index] != cell:
                present[index] = cell
                board.set_int(name, cell)
        taken[0] = 0
        if tree.tick_exactly_once() != status.SUCCESS:
            raise SystemExit("a tick of the tree did not succeed")
        numbers.write(struct.pack("<I", taken[0] if is_custom else board.get_int("action")))
"""


def run_btcpp(exported: Exported, files: Files, cells: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return which actions the tree takes in joint cells. Raises ToolMissing where the binding is not installed."""
    if find_spec("behaviortreepy") is None:
        raise ToolMissing("behaviortreepy")
    (text,) = files.values()
    leaves = leaves_of(exported.controller)
    names = dumps({"inputs": leaves.inputs, "actions": leaves.actions})
    form = "custom" if "<TreeNodesModel>" in text else "script"
    with folder_of({"exported.xml": text, "driver.py": DRIVER, "names.json": names}) as folder:
        write_cells(folder / "cells", cells)
        run_in(folder, sys.executable, "-I", "driver.py", *map(str, cells.shape), form)
        return read_numbers(folder / "numbers", len(cells))


def most_cells_of_btcpp(exported: Exported) -> int:
    """Return in how many joint cells the tree can be run in less than a minute."""
    return MOST_VISITS // n_nodes(exported.controller)
