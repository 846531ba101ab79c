"""`python -m release.lowest`: prints the lower bounds of all requirements in pyproject.toml as constraints of pip.

So the versions that are promised to be enough are tried. What they need themselves is the newest.
"""

from __future__ import annotations

import re
import sys
import tomllib
from typing import TYPE_CHECKING, Any

from release.commands import ROOT

if TYPE_CHECKING:
    from collections.abc import Mapping

REQUIREMENT = re.compile(r"(?P<name>[\w-]+)(?:\[[\w,-]+\])?(?:>=(?P<version>[\d.]+))?(?:; .*)?")
OWN = "bbsd"


def lowest(project: Mapping[str, Any]) -> tuple[str, ...]:
    """Return a constraint such as `numpy==2.4` for each requirement of a project, and of its extras, in their order.

    Raises:
        ValueError: a requirement is no name with a lower bound, or one has two bounds.
    """
    extras = [each for extra in project["optional-dependencies"].values() for each in extra]
    bounds: dict[str, str] = {}
    for text in (*project["dependencies"], *extras):
        found = REQUIREMENT.fullmatch(text)
        if found is None or (found["version"] is None) != (found["name"] == OWN):
            raise ValueError(f"{text!r} is no name with a lower bound")
        if found["name"] != OWN and bounds.setdefault(found["name"], found["version"]) != found["version"]:
            raise ValueError(f"{found['name']} has two lower bounds")
    return tuple(f"{name}=={version}" for name, version in bounds.items())


def main() -> int:
    """Print the constraints, and return the exit code."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    print("\n".join(lowest(project)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
