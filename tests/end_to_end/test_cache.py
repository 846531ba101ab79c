"""A cache is a convenience: whatever happens to its files, commands work, and say the same."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

SPEC = Path(__file__).parents[2] / "specs" / "object_lifting_hand.yaml"
WAYS = {
    "emptied": lambda content: b"",
    "cut": lambda content: content[: len(content) // 2],
    "flipped": lambda content: (
        content[: len(content) // 2]
        + bytes([content[len(content) // 2] ^ 4])
        + content[len(content) // 2 + 1 :]
    ),
}


def evaluated(cache: Path) -> str:
    command = [sys.executable, "-m", "bbsd", "evaluate", str(SPEC), "--episodes", "20"]
    done = subprocess.run(
        command, env={**os.environ, "BBSD_CACHE_DIR": str(cache)}, capture_output=True, text=True, check=True
    )
    assert not done.stderr
    return done.stdout


@pytest.mark.slow
def test_every_file_of_a_cache_may_be_damaged(tmp_path: Path) -> None:
    said = evaluated(tmp_path / "cache")
    n_files = 0
    for way, damage in WAYS.items():
        for path in filter(Path.is_file, (tmp_path / "cache").rglob("*")):
            path.write_bytes(damage(path.read_bytes()))
            n_files += 1
        assert evaluated(tmp_path / "cache") == said, way
    assert n_files > 60
