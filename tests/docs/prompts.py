"""Examples at Python's prompt: a fence ```` ```pycon ```` holds statements after >>> with what they print below.

All fences of a document are one session.
"""

import ast
import contextlib
import io
import re
from pathlib import Path
from typing import Any

from tests.docs.sessions import agree

FENCE = re.compile(r"^```pycon\n(?P<body>.*?)^```$", re.MULTILINE | re.DOTALL)
EXAMPLE = re.compile(
    r"^>>> (?P<first>.*)\n(?P<more>(?:\.\.\. .*\n)*)(?P<shown>(?:(?!>>> ).*\n)*)", re.MULTILINE
)


def replayed(text: str, folder: Path) -> str:
    """Return the document with what its statements print now, run in a folder."""
    names: dict[str, Any] = {"__name__": "__main__"}
    with contextlib.chdir(folder):
        return FENCE.sub(lambda fence: f"```pycon\n{_session(fence['body'], names)}```", text)


def _session(body: str, names: dict[str, Any]) -> str:
    return EXAMPLE.sub(lambda example: _example(example, names), body)


def _example(example: re.Match[str], names: dict[str, Any]) -> str:
    printed = _printed(
        "\n".join([example["first"], *example["more"].replace("... ", "").splitlines()]), names
    )
    shown = example["shown"] if agree(example["shown"], printed) else printed
    return f">>> {example['first']}\n{example['more']}{shown}"


def _printed(source: str, names: dict[str, Any]) -> str:
    """What a statement prints at the prompt: its value if it has one, the last line of its error if it fails."""
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        try:
            exec(compile(ast.Interactive(ast.parse(source).body), "<prompt>", "single"), names)
        except Exception as error:  # noqa: BLE001 - as a prompt
            output.write(f"{type(error).__name__}: {error}\n")
    return "".join(f"{line.rstrip()}\n" for line in output.getvalue().splitlines())
