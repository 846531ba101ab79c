"""Commands are listed by name and first sentence, and imported when they are used."""

import inspect
import subprocess
import sys

import pytest
from typer.main import get_command

from bbsd.cli.app import LISTED, app
from bbsd.cli.terminal.late import LateCommands, Listed


@pytest.mark.parametrize("name", LISTED)
def test_a_listed_sentence_is_the_first_of_the_command_s_help(name):
    text = " ".join(inspect.cleandoc(get_command(app).commands[name].help).split())
    assert text == LISTED[name].sentence or text.startswith(f"{LISTED[name].sentence} ")


def test_all_commands_are_found_by_name():
    commands = get_command(app).commands
    assert [command.name for command in commands.values()] == [*LISTED]
    assert "design" in commands
    assert "run" not in commands
    assert len(commands) == len(LISTED)
    with pytest.raises(KeyError):
        commands["run"]


def test_a_command_is_made_once():
    commands = LateCommands({"version": Listed("bbsd.cli.version:version", "Show the version.")})
    assert commands["version"] is commands["version"]


def test_a_long_sentence_is_cut_at_a_word():
    listed = Listed("bbsd.cli.version:version", "Show the version of this installation.")
    assert listed.short_help(20) == "Show the version..."
    assert listed.short_help(80) == listed.sentence


def test_the_list_imports_no_command():
    program = (
        "import sys; from bbsd.cli.app import app; from typer.main import get_command; get_command(app); \
print([name for name in sys.modules if name.startswith('bbsd.cli')])"
    )
    printed = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    ).stdout
    assert "'bbsd.cli.app'" in printed
    assert not any(f"'{each.home.partition(':')[0]}'" in printed for each in LISTED.values())
