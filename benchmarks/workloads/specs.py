"""The shipped specs, and the key of all random streams of the benchmarks."""

from pathlib import Path

from bbsd.kernel.streams import name_word

SPECS = Path(__file__).parents[2] / "specs"
KEY = name_word("benchmarks")
