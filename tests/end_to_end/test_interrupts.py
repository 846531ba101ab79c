"""Ctrl-C ends every command that takes long, soon and without a traceback; a second one at once."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

LONG = """
bbsd: 1
name: long
environment:
  robots: 4
  steps: 1000000
  state: {x: robot}
  dynamics:
    x: sin(x + step) + sum(x[r] for r in team) / 4
behaviors:
  go:
    inputs: {low: x < 3}
    actions: {set: {x: x + 1}}
    rules: [otherwise: set]
structure: [go]
reward: {r: x}
"""
COMMANDS = [
    "evaluate {} --episodes 4000",
    "worth {}",
    "compare {} {}",
    "report {} -o page.html",
    "why {} --step 999999",
]


def begun(command: str, tmp_path: Path) -> subprocess.Popen[str]:
    """A command that has been at work for some seconds: it compiles, or runs episodes."""
    spec = tmp_path / "long.yaml"
    spec.write_text(LONG)
    running = subprocess.Popen(
        [sys.executable, "-m", "bbsd", *command.replace("{}", str(spec)).split()],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),  # noqa: PLW1509
    )
    time.sleep(3)
    assert running.poll() is None
    return running


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_an_interrupt_ends_a_command(command: str, tmp_path: Path) -> None:
    with begun(command, tmp_path) as running:
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=60)
    assert (running.returncode, out, err) == (130, "", "bbsd: interrupted, without a result\n")
    assert {path.name for path in tmp_path.iterdir()} == {"long.yaml"}


@pytest.mark.slow
def test_a_second_interrupt_ends_it_at_once(tmp_path: Path) -> None:
    with begun(COMMANDS[0], tmp_path) as running:
        for _ in range(2):
            running.send_signal(signal.SIGINT)
            time.sleep(0.05)
        running.communicate(timeout=60)
    assert running.returncode in (130, -signal.SIGINT)
