"""How well the mistakes of newcomers are told: each against what was written down before any message was looked at."""

import re
from dataclasses import dataclass
from pathlib import Path

from tests.end_to_end.commands import bbsd

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "tests" / "specs" / "newcomers"
SOURCE_LINE = re.compile(r"^ *\d+ \|.*$|^ +\| *\^+ *$", re.MULTILINE)
HEAD = re.compile(
    r"^(?P<file>[^:\n]+):(?P<line>\d+):(?P<column>\d+): (?:error|warning)\[BB\d+\]: ", re.MULTILINE
)


@dataclass(frozen=True)
class Told:
    """What was said of one mistake: as a whole, and without the echo of its line and the names of files."""

    said: str
    lines: tuple[int, ...]
    """The line of each diagnosis, in order."""


def told_of(item: dict[str, object], folder: Path) -> Told:
    """Run the command of an item, or check its file, and return what is said."""
    command = item.get("command")
    words = str(command).split()[1:] if command else ["check", str(item["file"])]
    _, out, err = bbsd(*words, cwd=folder if command else FOLDER)
    text = f"{out}\n{err}"
    lines = tuple(int(match["line"]) for match in HEAD.finditer(text))
    said = HEAD.sub("", SOURCE_LINE.sub("", text))
    if not command:
        said = said.replace(str(item["file"]), "")
    return Told(said, lines)


def names_cause(item: dict[str, object], told: Told) -> bool:
    """Return whether of every list of alternatives one is said."""
    said = told.said.lower()
    return all(any(str(name).lower() in said for name in names) for names in item["names"])


def is_at_line(item: dict[str, object], told: Told) -> bool:
    """Return whether there is one diagnosis, and it is at the line."""
    wanted = item.get("line")
    return "command" in item or (len(told.lines) == 1 and wanted in (None, told.lines[0]))


def shows_right(item: dict[str, object], told: Told) -> bool:
    """Return whether the line as it should be is shown; blanks do not count."""
    forms = [item.get("right"), *item.get("also", [])]
    said = "".join(told.said.split())
    return item.get("right") is None or any("".join(str(form).split()) in said for form in forms)
