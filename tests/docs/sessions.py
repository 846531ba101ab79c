"""Documents whose examples are run: the files they show are written, their edits made, their commands run.

A fence ```` ```yaml NAME ````, or ```` ```python NAME ```` or ```` ```c NAME ````, is a file of that name,
```` ```diff NAME ```` an edit of one, and ```` ```console ```` holds commands after `$ ` with what they print below.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

FENCE = re.compile(r"^```(?P<kind>\w+)(?: (?P<name>\S+))?\n(?P<body>.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"^\$ (.+)\n((?:(?!\$ ).*\n)*)", re.MULTILINE)
VARYING = re.compile(
    r"(\d+ min )?\d+(\.\d+)? s(, after .* of compiling)?$|\d{4}-\d\d-\d\d \d\d:\d\d$", re.MULTILINE
)


def replayed(text: str, folder: Path) -> str:
    """Return the document with what its commands print now, in a folder that becomes what it says."""
    return FENCE.sub(lambda fence: _fence(fence, folder), text)


def _fence(fence: re.Match[str], folder: Path) -> str:
    name, body = fence["name"], fence["body"]
    if fence["kind"] in ("yaml", "python", "c") and name:
        (folder / name).write_text(body, encoding="utf-8")
    elif fence["kind"] == "diff":
        _edit(folder / name, body)
    elif fence["kind"] == "console":
        now = COMMAND.sub(lambda command: _command(command[1], command[2], folder), body)
        return fence[0].replace(body, now)
    return fence[0]


def _edit(path: Path, diff: str) -> None:
    """Replace the lines of a diff that begin with a blank or - by those that begin with a blank or +."""
    lines = diff.splitlines(keepends=True)
    old = "".join(line[1:] for line in lines if line[0] in " -")
    new = "".join(line[1:] for line in lines if line[0] in " +")
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{path.name} does not have these lines once:\n{old}"
    path.write_text(text.replace(old, new), encoding="utf-8")


def _command(command: str, shown: str, folder: Path) -> str:
    printed = _printed(command, folder)
    return f"$ {command}\n{shown if agree(shown, printed) else printed}"


def _printed(command: str, folder: Path) -> str:
    """What a command prints on a terminal of 80 columns, both streams together, without color."""
    shell = (
        f'bbsd() {{ "{sys.executable}" -m bbsd "$@"; }}; python() {{ "{sys.executable}" "$@"; }}; {command}'
    )
    surroundings = {**os.environ, "COLUMNS": "80", "NO_COLOR": "1", "PYTHONUTF8": "1"}
    done = subprocess.run(
        ["bash", "-c", shell],
        cwd=folder,
        env=surroundings,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=300,
        check=False,
    )
    text = "\n".join(line.rstrip() for line in done.stdout.decode().strip("\n").splitlines())
    return f"{text}\n" if text else ""


def agree(shown: str, printed: str) -> bool:
    """Whether a document shows what is printed; ... on a line stands for any lines; durations and times may differ."""
    parts = [
        re.escape(VARYING.sub("0 s", part)) for part in re.split(r"^\.\.\.\n", shown, flags=re.MULTILINE)
    ]
    return re.fullmatch("(?:.*\n)*".join(parts), VARYING.sub("0 s", printed)) is not None
