"""The command line. Results go to standard output, all else to standard error; heavy modules are imported late."""

import atexit
import gc
import os

__all__ = ["GC_THRESHOLD", "main"]

GC_THRESHOLD = 300_000
"""New objects between two garbage collections; a command's objects live as long as it does, or die at once."""


def main() -> None:
    """Run the command line, with few garbage collections; see `bbsd.cli.app.run`."""
    # Before anything is imported, since that makes most of a short command's objects.
    gc.set_threshold(GC_THRESHOLD)
    # Looking for plugins of pydantic would read what is said of all installed packages, and import strangers.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    atexit.register(gc.freeze)  # Python's last collection would take a tenth of a design's time
    from bbsd.cli.app import run

    run()
