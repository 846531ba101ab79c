"""Commands in the tests' own process."""

import sys
from unittest.mock import patch

import pytest

from bbsd.cli import main


def run(*words):
    """Run a command and return its exit code; what it printed is in capsys."""
    with patch.object(sys, "argv", ["bbsd", *map(str, words)]), pytest.raises(SystemExit) as left:
        main()
    return left.value.code or 0
