"""What is said does not decide what is done: standard output and error that are full, closed, or without a reader."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

SPEC = Path(__file__).parent / "specs" / "thermostat.yaml"
pytestmark = pytest.mark.skipif(os.name != "posix", reason="by a shell")


def shell(command: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run a line of a shell in which `bbsd` is the command."""
    line = command.replace("bbsd", f"'{sys.executable}' -m bbsd", 1)
    return subprocess.run(["bash", "-c", line], cwd=cwd, capture_output=True, text=True, check=False)


WAYS = {
    "notes on a full disk": ("2>/dev/full", 0),
    "notes closed": ("2>&-", 0),
    "a result on a full disk": (">/dev/full", 1),
    "a result closed": (">&-", 0),
    "both closed": (">&- 2>&-", 0),
    "all closed": ("<&- >&- 2>&-", 0),
    "a reader of notes that leaves": ("2> >(exec true)", 0),
    "a reader of results that leaves": ("> >(exec true)", 0),
}


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
def test_a_design_is_done_whatever_becomes_of_what_it_says(way: str, tmp_path: Path) -> None:
    where, code = WAYS[way]
    done = shell(f"bbsd design '{SPEC}' --out run {where}", tmp_path)
    assert done.returncode == code
    assert "Traceback" not in done.stdout + done.stderr
    assert (tmp_path / "run" / "architecture.yaml").exists()
    for path in (tmp_path / "run").iterdir():  # none has got what was said
        assert b"% interval" not in path.read_bytes()


@pytest.mark.parametrize("command", ["check", "config", "evaluate --fill random --agents 2", "schema"])
def test_a_result_that_cannot_be_written_is_no_success(command: str, tmp_path: Path) -> None:
    spec = "" if command == "schema" else f"'{SPEC}'"
    done = shell(f"bbsd {command} {spec} >/dev/full", tmp_path)
    assert (done.returncode, done.stderr.count("No space left on device")) == (1, 1)
    assert "Traceback" not in done.stderr
