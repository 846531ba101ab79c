"""`python -m bbsd` is `bbsd`."""

import os
import sys
from pathlib import Path

from bbsd.cli import main


def forget_current_folder() -> None:
    """Take away the current folder, which `python -m` has put first of what is searched for modules.

    A stranger's spec may lie there beside a stranger's modules. It stays where bbsd itself is imported from it.
    """
    own = str(Path(__file__).parents[1])
    if not sys.flags.safe_path and sys.path and os.path.realpath(sys.path[0]) != os.path.realpath(own):
        del sys.path[0]


if __name__ == "__main__":
    forget_current_folder()
    main()
