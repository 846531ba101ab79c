"""Where a design is from: its text with the designed lines marked, and how to repeat it."""

from __future__ import annotations

import shlex
from difflib import SequenceMatcher
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bbsd.errors import escape
from bbsd.report.wording.endings import ending_lines
from bbsd.version import REVISION, __version__

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.api.paging import Page
    from bbsd.report.plain import Plain

DESIGNED_BLOCKS = ("behaviors", "structure")
MOST_CHARACTERS = 200_000
"""Characters of a spec's text that are shown."""


def spec_plain(page: Page) -> dict[str, Plain]:
    """Return the lines of a design's text, each with whether it was designed; that is known of runs only."""
    text = page.loaded.lineage.flat.source.text
    lines = text[:MOST_CHARACTERS].splitlines()
    given = page.run.spec.lineage.flat.source.text.splitlines() if page.run else lines
    marks = designed_lines(given, lines)
    return {
        "lines": [[escape(line.expandtabs(4)), mark] for line, mark in zip(lines, marks, strict=True)],
        "is_run": page.run is not None,
        "is_cut": len(text) > MOST_CHARACTERS,
    }


def designed_lines(given: Sequence[str], designed: Sequence[str]) -> list[bool]:
    """Return for each line of a designed text whether it fills a hole: it is new, in a block that is designed."""
    new = [False] * len(designed)
    for kind, _, _, first, last in SequenceMatcher(None, given, designed, autojunk=False).get_opcodes():
        if kind != "equal":
            new[first:last] = [True] * (last - first)
    block = ""
    for index, line in enumerate(designed):
        if line[:1].strip() and not line.startswith("#"):
            block = line.partition(":")[0]
        new[index] &= block in DESIGNED_BLOCKS and bool(line.strip())
    return new


def repeat_plain(page: Page) -> dict[str, Plain]:
    """Return the commands that give this design and this page again, and what they were made with."""
    facts = [
        ("bbsd", f"{__version__}, revision {REVISION}"),
        ("seed of the episodes", str(page.seed)),
        ("episodes", f"{page.evaluation.episodes:,}"),
    ]
    for document in page.loaded.lineage.documents:
        digest = sha256(document.source.text.encode("utf-8", "surrogatepass")).hexdigest()
        facts.append((f"SHA-256 of {Path(document.source.file).name}", digest))
    commands = [_report_command(page)]
    if page.run:
        commands.insert(0, _design_command(page.run.content))
        facts += [
            ("seed of the design", str(page.run.content.get("seed", ""))),
            *(("search", line) for line in _early(page.run.content)),
            *(("start", file) for file in _starts(page.run.content)),
            *((name, str(text)) for name, text in page.run.content.get("versions", {}).items()),
            *(
                (f"digest of the spec's {block}", str(text))
                for block, text in page.run.content.get("spec", {}).items()
            ),
        ]
    asked = ["bbsd", "why", page.name, *(["--seed", str(page.seed)] if page.seed else []), *_overrides(page)]
    return {
        "ask": escape(shlex.join(asked)),
        "commands": [escape(command) for command in commands],
        "facts": [[escape(name), escape(value)] for name, value in facts],
    }


def _early(content: dict[str, Any]) -> list[str]:
    """Return why runs ended early, in words."""
    result, runs = content.get("result"), content.get("runs")
    ended = result.get("ended") if isinstance(result, dict) else None
    return ending_lines(ended, runs if isinstance(runs, int) else 1) if isinstance(ended, list) else []


def _starts(content: dict[str, Any]) -> list[str]:
    """Return the names of the files of known designs that the search began with."""
    starts = content.get("starts", [])
    return [str(each["file"]) for each in starts if isinstance(each, dict) and "file" in each]


def _report_command(page: Page) -> str:
    words = [
        "bbsd",
        "report",
        page.name,
        *([page.other] if page.other else []),
        "-o",
        "page.html",
        "--seed",
        str(page.seed),
    ]
    words += ["--episodes", str(page.evaluation.episodes)]
    words += [word for text in page.wanted_faults for word in ("--fault", text)]
    return shlex.join([*words, *_overrides(page)])


def _overrides(page: Page) -> list[str]:
    return [word for override in page.overrides for word in ("--set", override)]


def _design_command(content: dict[str, Any]) -> str:
    words = ["bbsd", "design", "spec.yaml", "--seed", str(content.get("seed", 0))]
    words += ["--runs", str(content["runs"])] if content.get("runs", 1) != 1 else []
    words += [word for file in _starts(content) for word in ("--start", file)]
    overrides = content.get("set", [])
    for override in overrides if isinstance(overrides, list) else []:
        words += ["--set", str(override)]
    return shlex.join(words)
