"""`bbsd compile`."""

import bbsd
from bbsd.cli.options import Lanes, Overrides, SpecFile
from bbsd.cli.terminal.output import show


def compile_(spec: SpecFile, lanes: Lanes = 40, overrides: Overrides = None) -> None:
    """Print the kernel that a spec is compiled to, as Python source."""
    show(bbsd.compile(spec, lanes=lanes, set=overrides or ()))
