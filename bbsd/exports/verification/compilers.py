"""An exported C header, compiled by gcc with all warnings as errors, and run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.exports.verification.tools import folder_of, found, read_numbers, run_in, write_cells

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from bbsd.exports.exported import Exported, Files

STRICT = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-Wconversion")

DRIVER = """
#include "{header}"
#include <stdio.h>
#include <stdlib.h>

static inline uint32_t number_in(const unsigned char *bytes)
{{
    return (uint32_t)bytes[0] | ((uint32_t)bytes[1] << 8) | ((uint32_t)bytes[2] << 16) | ((uint32_t)bytes[3] << 24);
}}

int main(void)
{{
    unsigned char row[{width}];
    FILE *cells = fopen("cells", "rb");
    FILE *numbers = fopen("numbers", "wb");
    unsigned long left;
    if (cells == NULL || numbers == NULL) {{
        return 1;
    }}
    for (left = {n}UL; left > 0UL; left--) {{
        unsigned char out[4];
        uint32_t number;
        if (fread(row, 1, {used}, cells) != {used}) {{
            return 1;
        }}
        number = (uint32_t){prefix}_command({arguments});
        out[0] = (unsigned char)(number & 255U);
        out[1] = (unsigned char)((number >> 8) & 255U);
        out[2] = (unsigned char)((number >> 16) & 255U);
        out[3] = (unsigned char)(number >> 24);
        if (fwrite(out, 1, 4, numbers) != 4) {{
            return 1;
        }}
    }}
    return fclose(numbers) == 0 && fclose(cells) == 0 ? 0 : 1;
}}
"""


def run_gcc(_: Exported, files: Files, cells: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return what the header answers in joint cells, compiled by gcc. Raises ToolMissing, ToolFailed."""
    return compiled_answers(files, cells, "gcc", (*STRICT, "-O1"))


def compiled_answers(
    files: Files, cells: NDArray[np.int64], compiler: str, flags: Sequence[str]
) -> NDArray[np.int64]:
    """Return what a header answers in joint cells (n, n_dimensions), compiled by a compiler with some flags."""
    header = next(iter(files))
    n, width = cells.shape
    driver = DRIVER.format(
        header=header,
        prefix=header.removesuffix(".h"),
        n=n,
        width=max(1, 4 * width),
        used=4 * width,
        arguments=", ".join(f"(unsigned)number_in(row + {4 * place})" for place in range(width)),
    )
    program = found(compiler)
    with folder_of({**files, "driver.c": driver}) as folder:
        write_cells(folder / "cells", cells)
        run_in(folder, program, *flags, "-o", "driver", "driver.c")
        run_in(folder, folder / "driver")
        return read_numbers(folder / "numbers", n)
