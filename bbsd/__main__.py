"""`python -m bbsd` is `bbsd`."""

import os
import sys


def run() -> None:
    """Run the command line, without the current folder in what is searched for modules.

    `python -m` has put it there, first of all, and a stranger's spec may lie there beside a stranger's modules. It
    stays where bbsd itself is imported from it.
    """
    own = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))  # noqa: PTH120 - pathlib is not imported yet
    if not sys.flags.safe_path and sys.path and os.path.realpath(sys.path[0]) != own:
        del sys.path[0]
    from bbsd.cli import main

    main()


if __name__ == "__main__":
    run()
