"""Automatic design of behavior-based agents from a declarative spec.

A spec is a design with holes: what it gives is kept, what it leaves open is designed, and what comes back is the same
spec with the holes filled. The functions are the commands of the command line: `load`, `check`, `compile`, `design`,
`evaluate`, `explain`, `why`, `tidy`, `worth`, `compare`, `export`, `spaces`, `page` for `bbsd report`,
`runs_in` for `bbsd runs`, `faults` for `evaluate --fault`, and `trace` for one episode; an `Agent` is a design in a
program of one's own, `env` a spec's world for other libraries.
`bbsd.api` documents them.
"""

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bbsd.api import (
        Agent,
        check,
        compare,
        compile,  # noqa: A004 - the verb
        design,
        env,
        evaluate,
        explain,
        export,
        faults,
        load,
        page,
        runs_in,
        spaces,
        tidy,
        trace,
        watch,
        why,
        worth,
    )

from bbsd.version import __version__

__all__ = [
    "Agent",
    "__version__",
    "check",
    "compare",
    "compile",
    "design",
    "env",
    "evaluate",
    "explain",
    "export",
    "faults",
    "load",
    "page",
    "runs_in",
    "spaces",
    "tidy",
    "trace",
    "watch",
    "why",
    "worth",
]


if not TYPE_CHECKING:  # so that type checkers find a misspelled name, and the types of the others

    def __getattr__(name: str) -> object:
        """Return a function of `bbsd.api`, which is imported only then: numba alone takes an eighth of a second."""
        if name not in __all__:
            raise AttributeError(f"module 'bbsd' has no attribute {name!r}")
        from bbsd import api

        notebook = sys.modules.get("IPython")
        if notebook is not None and (shell := notebook.get_ipython()) is not None:
            load_ipython_extension(shell)
        return getattr(api, name)


def __dir__() -> list[str]:
    """Return all names, those too that are not imported yet, so that a Python prompt completes them."""
    return sorted({*globals(), *__all__})


def load_ipython_extension(shell: Any) -> None:  # noqa: ANN401 - IPython is optional
    """Let a notebook show results as tables: when a function is first used in one, or by `%load_ext bbsd`."""
    from bbsd.report.notebook import register

    register(shell)
