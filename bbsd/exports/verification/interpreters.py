"""An exported Python module, run by this Python and by MicroPython."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.exports.verification.tools import folder_of, found, read_numbers, run_in, write_cells

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bbsd.exports.exported import Exported, Files

DRIVER = """
import struct
import sys

sys.path.insert(0, ".")
command = __import__("exported").command
n, width = int(sys.argv[1]), int(sys.argv[2])
with open("cells", "rb") as cells, open("numbers", "wb") as numbers:
    for _ in range(n):
        numbers.write(struct.pack("<I", command(*struct.unpack("<%dI" % width, cells.read(4 * width)))))
"""


def run_cpython(_: Exported, files: Files, cells: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return what the module answers in joint cells, run by this Python in a process of its own."""
    return _run([sys.executable, "-I", "-S"], files, cells)


def run_micropython(_: Exported, files: Files, cells: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return what the module answers in joint cells, run by MicroPython. Raises ToolMissing where it is not there."""
    return _run([str(found("micropython"))], files, cells)


def _run(interpreter: list[str], files: Files, cells: NDArray[np.int64]) -> NDArray[np.int64]:
    (text,) = files.values()
    with folder_of({"exported.py": text, "driver.py": DRIVER}) as folder:
        write_cells(folder / "cells", cells)
        run_in(folder, *interpreter, Path("driver.py"), *map(str, cells.shape))
        return read_numbers(folder / "numbers", len(cells))
