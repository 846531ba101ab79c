"""Commands as a shell sees them, in this process or in one of their own."""

import os
import subprocess
import sys
from contextlib import chdir, contextmanager, redirect_stderr, redirect_stdout
from io import BytesIO, TextIOWrapper
from unittest.mock import patch

import pytest

from bbsd.cli import main

TERMINAL = ("COLUMNS", "FORCE_COLOR", "NO_COLOR", "TERM")


def bbsd(*words, cwd=".", encoding="utf-8"):
    """Run a command in this process and give its code, standard output and standard error."""
    out, err = (TextIOWrapper(BytesIO(), encoding=encoding, write_through=True) for _ in range(2))
    environment = {key: value for key, value in os.environ.items() if key not in TERMINAL}
    with (
        chdir(cwd),
        patch.object(sys, "argv", ["bbsd", *map(str, words)]),
        patch.dict(os.environ, environment, clear=True),
        redirect_stdout(out),
        redirect_stderr(err),
        pytest.raises(SystemExit) as left,
    ):
        main()
    texts = [stream.buffer.getvalue().decode() for stream in (out, err)]
    assert "\x1b" not in texts[0] + texts[1]
    return left.value.code or 0, *texts


@contextmanager
def process(*words, cwd="."):
    """Run a command in a process of its own."""
    command = [sys.executable, "-m", "bbsd", *map(str, words)]
    with subprocess.Popen(
        command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as running:
        yield running


def written(folder):
    """What a design wrote that the same spec and seed write again: the contents of two files."""
    return [(folder / name).read_bytes() for name in ("architecture.yaml", "metrics.jsonl")]
