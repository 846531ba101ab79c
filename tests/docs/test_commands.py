"""The commands and options that pages name exist."""

import re
from pathlib import Path

from typer.main import get_command

from bbsd.cli.app import app

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
OTHERS = {"--editable", "--update-golden", "--nworkers", "--nthreads"}
"""Options of pip, of pytest and of Dask."""
TEXT = "\n".join(page.read_text(encoding="utf-8") for page in PAGES)


def test_commands_that_pages_name_exist():
    named = set(re.findall(r"(?:`|\$ )bbsd ([a-z]+)", TEXT))
    assert named <= set(get_command(app).commands)
    assert {"design", "evaluate", "explain"} <= named


def test_options_that_pages_name_exist():
    tool = get_command(app)
    commands = [tool, *tool.commands.values()]
    known = {option for command in commands for each in command.params for option in each.opts} | {"--help"}
    source = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "experiments").rglob("*.py"))
    known |= set(re.findall(r'"(--[a-z][a-z-]+)"', source))
    assert set(re.findall(r"(?<![\w-])--[a-z][a-z-]+", TEXT)) - OTHERS <= known
