"""`bbsd config`."""

from bbsd.cli.options import Overrides, SpecFile
from bbsd.cli.terminal.output import show


def config(spec: SpecFile, overrides: Overrides = None) -> None:
    """Print a spec with all defaults filled in.

    Comments say where each value comes from: a line of a file, a default, or --set.
    """
    from bbsd.api.specs import load
    from bbsd.report.spec.configuration import configuration_text

    show(configuration_text(load(spec, set=overrides or ())))
