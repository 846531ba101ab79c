"""The command line. Data goes to standard output, all else to standard error; imports are made late."""

from bbsd.cli.app import main

__all__ = ["main"]
