"""`python -m benchmarks`: measures all parts and writes docs/benchmarks.md; fails where vectorization was lost."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from benchmarks import processes
from benchmarks.parts import (
    agents,
    growth,
    large_designs,
    lifting_rollout,
    mobile_rollout,
    parallel,
    prices,
    stepped_by_tables,
    vectorization,
    whole_designs,
    whole_processes,
)
from benchmarks.report import goals_section, machine
from benchmarks.timing import pin_to_one_core

IN_ORDER = (
    lifting_rollout,
    mobile_rollout,
    whole_designs,
    vectorization,
    large_designs,
    growth,
    stepped_by_tables,
    whole_processes,
    parallel,
    prices,
    agents,
)
PARTS = {part.__name__.rpartition(".")[2]: part for part in IN_ORDER}
PAGE = Path(__file__).parents[1] / "docs" / "benchmarks.md"

HEAD = """# Benchmarks

Written by `make bench`. Each ratio compares times that were taken in alternation in one run, on one core unless a
section says otherwise; absolute times are those of this machine. The code is in `benchmarks/`;
`make bench PART=lifting_rollout` measures one part and prints it."""


def main() -> int:
    """Measure, write the page, and return 1 where a goal that is required was missed."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Measure how fast bbsd is.")
    parser.add_argument(
        "--quick", action="store_true", help="take small sizes and few rounds; print, and write no file"
    )
    parser.add_argument("--python", help="measure the processes of this Python instead of the running one")
    parser.add_argument(
        "parts", nargs="*", metavar="PART", help=f"measure and print only these parts: {', '.join(PARTS)}"
    )
    arguments = parser.parse_args()
    if unknown := set(arguments.parts) - set(PARTS):
        parser.error(f"there is no part {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}")
    if arguments.python:
        os.environ[processes.PYTHON_VARIABLE] = str(Path(arguments.python).absolute())
    pin_to_one_core()
    conditions, sections = machine(), []
    for name in arguments.parts or PARTS:
        print(f"{name} ...", file=sys.stderr)
        sections.append(PARTS[name].section(quick=arguments.quick))
    goals = [goal for section in sections for goal in section.goals]
    page = (
        "\n\n".join([HEAD, conditions, *(part.text() for part in (goals_section(goals), *sections))]) + "\n"
    )
    if arguments.quick or arguments.parts:
        print(page)
    else:
        PAGE.write_text(page, encoding="utf-8")
    missed = [goal.name for goal in goals if goal.required and not goal.met]
    print("\n".join(missed), file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
