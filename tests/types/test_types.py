"""What a type checker tells a user of bbsd: the right types, and the mistakes."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
ROOT = HERE.parents[1]


def complaints(name, folder):
    """Return the lines in which mypy finds a mistake of a program, which is elsewhere than the checkout."""
    (folder / name).write_bytes((HERE / name).read_bytes())
    options = ["--strict", "--follow-imports=silent", "--cache-dir", ROOT / ".cache" / "types"]
    done = subprocess.run(
        [sys.executable, "-m", "mypy", *options, name],
        cwd=folder,
        env={**os.environ, "MYPYPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert not done.stderr
    return {int(line) for line in re.findall(rf"^{name}:(\d+): error", done.stdout, re.MULTILINE)}


@pytest.mark.slow
def test_a_program_has_the_types_that_it_says(tmp_path):
    assert complaints("program.py", tmp_path) == set()


@pytest.mark.slow
def test_every_mistake_of_a_program_is_found(tmp_path):
    lines = (HERE / "mistakes.py").read_text(encoding="utf-8").splitlines()
    marked = {number for number, line in enumerate(lines, 1) if line.endswith("# wrong")}
    assert complaints("mistakes.py", tmp_path) == marked
