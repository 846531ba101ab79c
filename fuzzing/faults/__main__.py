"""`python -m fuzzing.faults`: faults in whole designs; exit code 1 where one of them cost something."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

from fuzzing.faults.calls import CASES, try_calls
from fuzzing.faults.commands import prepare
from fuzzing.faults.kills import try_kills
from fuzzing.faults.races import try_races
from fuzzing.faults.states import try_states
from fuzzing.faults.system import FAULTS

if TYPE_CHECKING:
    from collections.abc import Iterator

PARTS = ("calls", "kills", "states", "races")


def main() -> int:
    """Try the parts that are wanted, print what was wrong, and return 1 if anything was."""
    parser = argparse.ArgumentParser(prog="python -m fuzzing.faults", description=__doc__)
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"any of {', '.join(PARTS)} (default: all)")
    parser.add_argument("--step", type=int, default=1, help="a fault at each STEP-th call (default: 1)")
    parser.add_argument(
        "--case",
        type=int,
        action="append",
        choices=range(len(CASES)),
        help="only this case of calls; several times",
    )
    parser.add_argument(
        "--fault", action="append", choices=FAULTS, help="only this fault of calls; several times"
    )
    parser.add_argument("--kills", type=int, default=200, help="kills at random instants (default: 200)")
    parser.add_argument(
        "--states", type=int, default=50, help="checkpoints damaged and resumed (default: 50)"
    )
    parser.add_argument("--races", type=int, default=50, help="races of each kind (default: 50)")
    parser.add_argument("--seed", type=int, default=0, help="of what is random (default: 0)")
    options = parser.parse_args()
    if unknown := [part for part in options.parts if part not in PARTS]:
        parser.error(f"{unknown[0]} is none of {', '.join(PARTS)}")
    if not hasattr(os, "fork"):
        parser.error("this system cannot fork processes")
    wrong = 0
    with tempfile.TemporaryDirectory(prefix="bbsd-faults-") as name:
        folder = Path(name)
        spec = prepare(folder)
        cases = CASES if options.case is None else tuple(CASES[case] for case in options.case)
        trials = {
            "calls": lambda: try_calls(spec, folder, options.step, cases, options.fault or FAULTS),
            "kills": lambda: try_kills(spec, folder, options.kills, options.seed),
            "states": lambda: try_states(spec, folder, options.states, options.seed),
            "races": lambda: try_races(spec, folder, options.races),
        }
        for part in options.parts or PARTS:
            wrong += _tried(part, trials[part]())
    return 1 if wrong else 0


def _tried(part: str, trials: Iterator[tuple[str, str]]) -> int:
    """Print what was wrong in a part, and return how often."""
    began, count, wrong = time.monotonic(), 0, 0
    for name, told in trials:
        count += 1
        if told:
            wrong += 1
            print(f"{part}: {name}: {told}", flush=True)
    print(f"{part}: {count} tried, {wrong} wrong, in {time.monotonic() - began:.0f} s", flush=True)
    return wrong


if __name__ == "__main__":
    sys.exit(main())
