"""`python -m benchmarks`: measures everything in alternation and writes docs/benchmarks.md; 1 where the guard fails."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from benchmarks import growth, guard, large, mobile, prices, processes, rollout, together, whole
from benchmarks.page import asked_section, machine
from benchmarks.timing import on_one_core

SECTIONS = {
    "rollout": rollout,
    "mobile": mobile,
    "whole": whole,
    "guard": guard,
    "large": large,
    "growth": growth,
    "processes": processes,
    "together": together,
    "prices": prices,
}
PAGE = Path(__file__).parents[1] / "docs" / "benchmarks.md"

HEAD = """# Benchmarks

Written by `make bench`. Every ratio is of times taken in alternation in one run, on one core but where several are
spoken of; absolute times are this machine's. What is measured, and how, is in `benchmarks/`; a part alone is measured
by `make bench PART=rollout`.
"""


def main() -> int:
    """Measure, write, and fail where vectorization was lost."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Measure bbsd.")
    parser.add_argument(
        "--quick", action="store_true", help="small sizes, few rounds; prints and writes no file"
    )
    parser.add_argument("--python", help="whose processes are measured; this one if not given")
    parser.add_argument(
        "parts", nargs="*", metavar="PART", help=f"print only these, of {', '.join(SECTIONS)}"
    )
    arguments = parser.parse_args()
    if unknown := set(arguments.parts) - set(SECTIONS):
        parser.error(f"there is no part {', '.join(sorted(unknown))}; there are {', '.join(SECTIONS)}")
    if arguments.python:
        os.environ[processes.PYTHON_VARIABLE] = str(Path(arguments.python).absolute())
    on_one_core()
    parts, asked = [HEAD, machine()], []
    for name in arguments.parts or SECTIONS:
        print(f"{name} ...", file=sys.stderr)
        text, bounds = SECTIONS[name].section(quick=arguments.quick)
        parts.append(text)
        asked += bounds
    page = "\n\n".join([*parts[:2], asked_section(asked), *parts[2:]]) + "\n"
    if arguments.quick or arguments.parts:
        print(page)
    else:
        PAGE.write_text(page, encoding="utf-8")
    lost = [each.what for each in asked if each.what.startswith("guard") and not each.met]
    print("\n".join(lost), file=sys.stderr)
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
