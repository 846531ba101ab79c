"""How well the mistakes of newcomers are told: each against what was written down before any message was looked at."""

import re
from dataclasses import dataclass
from pathlib import Path

from tests.end_to_end.commands import bbsd

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "tests" / "specs" / "newcomers"
SECOND = FOLDER / "second"
"""A second hundred, of which the messages knew nothing when they were written."""
THIRD = FOLDER / "third"
"""A third set, of sixty, of which they knew nothing either."""
LONG = 12
"""Characters of a word of a command that say all, such as a path."""
SOURCE_LINE = re.compile(r"^ *\d+ \|.*$|^ +\| *\^+ *$", re.MULTILINE)
MARGIN = re.compile(r"^(?:write|maybe|at +\d+| +) \| ", re.MULTILINE)
"""What stands before a corrected line."""
HEAD = re.compile(r"^[^:\n]+:(?P<line>\d+):\d+: (?P<severity>error|warning)\[BB\d+\]: ", re.MULTILINE)


@dataclass(frozen=True)
class Told:
    """What was said of one mistake: as a whole, and without the echo of its line and the names of files."""

    said: str
    mistakes: tuple[int, ...]
    """The line of each mistake, in order."""
    warnings: tuple[int, ...]
    """The line of each warning, in order."""


def told_of(item: dict[str, object], folder: Path, files: Path = FOLDER) -> Told:
    """Run the command of an item in a folder, or check its file among others, and return what is said."""
    command = item.get("command")
    words = str(command).split()[1:] if command else ["check", str(item["file"])]
    _, out, err = bbsd(*words, cwd=folder if command else files)
    text = f"{out}\n{err}"
    heads = [(match["severity"], int(match["line"])) for match in HEAD.finditer(text)]
    mistakes, warnings = (
        tuple(line for severity, line in heads if severity == wanted) for wanted in ("error", "warning")
    )
    said = HEAD.sub("", SOURCE_LINE.sub("", text))
    if not command:
        said = said.replace(str(item["file"]), "")
    return Told(said, mistakes, warnings)


def names_cause(item: dict[str, object], told: Told) -> bool:
    """Return whether of every list of alternatives one is said."""
    said = told.said.lower()
    return all(any(str(name).lower() in said for name in names) for names in item["names"])


def is_at_line(item: dict[str, object], told: Told) -> bool:
    """Return whether there is one mistake, and it is at the line; where there is none, whether a warning is there."""
    wanted = item.get("line")
    if "command" in item or wanted is None:
        return len(told.mistakes) <= 1
    return told.mistakes == (wanted,) or (not told.mistakes and wanted in told.warnings)


def shows_right(item: dict[str, object], told: Told) -> bool:
    """Return whether the line as it should be is shown; blanks do not count.

    Of a command it is enough to show the part that is another.
    """
    right = item.get("right")
    if right is None:
        return True
    said, given = "".join(MARGIN.sub("", told.said).split()), str(item.get("command", "")).split()
    other = [word for word in str(right).split() if word not in given and len(word) >= LONG]
    is_part_said = bool(given) and bool(other) and all(word in said for word in other)
    return is_part_said or "".join(str(right).split()) in said
