"""`python -m fuzzing`: tries damaged and heavy specs for as long as wanted.

Every shipped and every test spec is damaged at random, and specs are made up that are as large, deep or involved as
1 MB allows. Stops with exit code 1 at the first spec that breaks a rule (`trial.py`) and keeps its file.
"""

from __future__ import annotations

import argparse
import gc
import random
import sys
import tempfile
import time
from multiprocessing import Pipe, Process
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.cli import GC_THRESHOLD
from fuzzing.damage import damaged
from fuzzing.heavy_specs import heavy_spec
from fuzzing.trial import Watch, peak_megabytes, trial

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

ROOT = Path(__file__).parents[1]
SPECS = (
    *ROOT.glob("specs/**/*.yaml"),
    *ROOT.glob("tests/specs/*/*.yaml"),
    *ROOT.glob("tests/planted/*.yaml"),
)
HEAVY_SHARE, ODD_ENCODING_SHARE = 0.1, 0.02


def fuzzed(specs: list[str], dice: random.Random) -> bytes:
    """Return a damaged or heavy spec, now and then in another encoding than UTF-8."""
    text = heavy_spec(dice) if dice.random() < HEAVY_SHARE else damaged(dice.choice(specs), dice)
    if dice.random() < ODD_ENCODING_SHARE:
        return text.encode(dice.choice(("utf-16", "latin-1", "utf-8-sig")), errors="replace")
    return text.encode("utf-8", errors="surrogatepass")


def send_specs(seed: int, pipe: Connection) -> None:
    """Send a spec whenever the other side asks: in a process of its own, whose memory is not that of the check."""
    dice = random.Random(seed)
    specs = [path.read_text(encoding="utf-8", errors="replace") for path in sorted(SPECS)]
    while pipe.recv():
        pipe.send(fuzzed(specs, dice))


def main() -> int:
    """Try specs until the time is over or one of them breaks a rule; return 1 if one does."""
    parser = argparse.ArgumentParser(prog="python -m fuzzing", description=__doc__)
    parser.add_argument("--seconds", type=float, default=60, help="for how long to try specs (default: 60)")
    parser.add_argument("--seed", type=int, default=0, help="which specs are tried (default: 0)")
    options = parser.parse_args()
    sys.dont_write_bytecode = True
    gc.set_threshold(GC_THRESHOLD)  # as the command does
    pipe, other = Pipe()
    Process(target=send_specs, args=(options.seed, other), daemon=True).start()
    watch = Watch()
    sys.addaudithook(watch)
    folder = Path(tempfile.mkdtemp(prefix="bbsd-fuzz-"))
    path = folder / "fuzzed.yaml"
    began, count, slowest = time.monotonic(), 0, 0.0
    while time.monotonic() - began < options.seconds:
        pipe.send(True)
        path.write_bytes(pipe.recv())
        count += 1
        broken, seconds = trial(path, watch)
        slowest = max(slowest, seconds)
        if broken:
            print(f"after {count} specs of seed {options.seed}: {path}\n{broken}")
            return 1
    path.unlink()
    folder.rmdir()
    print(
        f"{count} specs in {time.monotonic() - began:.0f} s with seed {options.seed}: nothing but diagnoses, at most "
        f"{slowest:.2f} s of the processor each, {peak_megabytes():.0f} MB in all, no file touched but the spec"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
