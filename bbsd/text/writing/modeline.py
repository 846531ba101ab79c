"""The comment by which an editor finds a spec's schema."""

from __future__ import annotations

import re
from itertools import takewhile

MODELINE = re.compile(r"\s*#\s*yaml-language-server\s*:.*?\$schema=(?P<schema>\S+)")
ANYWHERE = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:|[/\\~]|none$")
"""The beginnings of schemas that are the same from every folder: a URL, a drive, an absolute path, no schema."""


def without_relative_modeline(text: str) -> str:
    """Return a text without the comments at its head that name a schema by a relative path.

    From another folder the path leads elsewhere or nowhere. It is not adapted, since the text would then depend on the
    folder that it is written into.
    """
    lines = text.split("\n")
    head = list(takewhile(lambda line: not line.strip() or line.lstrip().startswith("#"), lines))
    return "\n".join([*(line for line in head if not _is_relative(line)), *lines[len(head) :]])


def _is_relative(line: str) -> bool:
    match = MODELINE.match(line)
    return match is not None and ANYWHERE.match(match["schema"]) is None
