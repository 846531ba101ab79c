"""The command line. Results go to standard output, all else to standard error; heavy modules are imported late."""

from bbsd.cli.app import main

__all__ = ["main"]
