"""`bbsd config`."""

from bbsd.cli.options import Overrides, SpecFile
from bbsd.cli.terminal.output import show


def config(spec: SpecFile, overrides: Overrides = None) -> None:
    """Print a spec with all defaults filled in.

    Comments say where each value comes from: a line of a file, a default, or --set.
    """
    from bbsd.language.loading import load
    from bbsd.report.configuration import configuration_text
    from bbsd.text import Source

    show(configuration_text(load(Source.read(spec), overrides=overrides or ())))
