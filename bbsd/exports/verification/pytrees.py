"""An exported tree of py_trees, run by py_trees."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from typing import TYPE_CHECKING

from bbsd.exports.tree import n_nodes
from bbsd.exports.verification.tools import ToolMissing, folder_of, read_numbers, run_in, write_cells

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bbsd.exports.exported import Exported, Files

MOST_VISITS = 5_000_000
"""Visits of nodes in some twenty seconds."""

DRIVER = """
import struct
import sys

sys.path.insert(0, ".")
controller = __import__("exported").Controller()
n, width = int(sys.argv[1]), int(sys.argv[2])
with open("cells", "rb") as cells, open("numbers", "wb") as numbers:
    for _ in range(n):
        number = controller.command(*struct.unpack("<%dI" % width, cells.read(4 * width)))
        if controller.tree.root.status.name != "SUCCESS":
            raise SystemExit("a tick of the tree did not succeed")
        numbers.write(struct.pack("<I", number))
"""


def run_pytrees(exported: Exported, files: Files, cells: NDArray[np.int64]) -> NDArray[np.int64]:  # noqa: ARG001
    """Return which actions the tree takes in joint cells. Raises ToolMissing where py_trees is not installed."""
    if find_spec("py_trees") is None:
        raise ToolMissing("py_trees")
    (text,) = files.values()
    with folder_of({"exported.py": text, "driver.py": DRIVER}) as folder:
        write_cells(folder / "cells", cells)
        run_in(folder, sys.executable, "-I", "driver.py", *map(str, cells.shape))
        return read_numbers(folder / "numbers", len(cells))


def most_cells_of_pytrees(exported: Exported) -> int:
    """Return in how many joint cells the tree can be run in less than a minute."""
    return MOST_VISITS // n_nodes(exported.controller)
