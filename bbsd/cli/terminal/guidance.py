"""Command lines that are not understood: what is probably meant, and the command as it should be."""

from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, cast

import typer
from typer.core import TyperGroup

from bbsd.cli.terminal.late import LateCommands
from bbsd.errors import inert, nearest

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.cli.terminal.late import Listed

MEANT = {
    "run": "design",
    "train": "design",
    "learn": "design",
    "optimize": "design",
    "optimise": "design",
    "search": "design",
    "solve": "design",
    "start": "design",
    "test": "evaluate",
    "simulate": "evaluate",
    "eval": "evaluate",
    "measure": "evaluate",
    "validate": "check",
    "lint": "check",
    "fix": "check --fix",
    "format": "fmt",
    "init": "new",
    "create": "new",
    "show": "explain",
    "plot": "report",
}
"""What commands are called elsewhere, and here."""
NO_INTEGER = "Input should be a valid integer"
NO_CHOICE = r"(?:Value error, )?'(?P<given>.*)' is not one of (?P<choices>'.*')\.?$"
EXTRA = r"Got unexpected extra argument(?:s|\(s\))? \((?P<words>=.*)\)$"
WORDS = "bbsd.words"
NotUnderstood = cast("type[Exception]", typer.BadParameter.__mro__[1])
"""Typer's error of a command line, which it does not export."""


class Commands(TyperGroup):
    """The commands; a command line that is not understood is answered by the one that is probably meant."""

    listed: ClassVar[Mapping[str, Listed]] = {}

    def __init__(self, **settings: Any) -> None:  # noqa: ANN401 - Typer's own types
        super().__init__(**settings)
        self.commands = cast("Any", LateCommands(self.listed))

    def list_commands(self, ctx: Any) -> list[str]:  # noqa: ANN401, ARG002 - Typer's own types
        """Return the names of the commands, in the order of the list."""
        return [*self.listed]

    def format_commands(self, ctx: Any, formatter: Any) -> None:  # noqa: ANN401, ARG002 - Typer's own types
        """Write the list of commands as Typer does, but from their sentences, without importing them."""
        width = formatter.width - 6 - max(map(len, self.listed))
        with formatter.section("Commands"):
            formatter.write_dl([(name, each.short_help(width)) for name, each in self.listed.items()])

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:  # noqa: ANN401 - Typer's own types
        """Return the command of a command line; raise Typer's usage error with what is probably meant."""
        if args and args[0] not in self.commands and not args[0].startswith("-"):
            ctx.fail(self._meant(args))
        ctx.meta[WORDS] = [*args]
        return super().resolve_command(ctx, args)

    def invoke(self, ctx: Any) -> Any:  # noqa: ANN401 - Typer's own types
        """Run the command; usage errors get the command line that is probably meant."""
        try:
            return super().invoke(ctx)
        except NotUnderstood as error:
            _explain(error, ctx.meta.get(WORDS, []), self.commands)
            raise

    def _meant(self, args: Sequence[str]) -> str:
        """Return what is wrong with a command line that begins with no command."""
        word = args[0]
        if meant := MEANT.get(word.lower()):
            also = " or evaluate" if meant == "design" else ""
            return f'there is no command "{word}"; {meant}{also} is meant: {_command(meant, *args[1:])}'
        if Path(word).suffix in (".yaml", ".yml") or Path(word).exists():
            commands = f"{_command('check', *args)} or {_command('design', *args)}"
            return f"a command is missing before {shown(word)}: write {commands}"
        near = nearest(word, self.commands)
        hint = f"; did you mean {_command(near, *args[1:])}?" if near else ""
        return f'there is no command "{shown(word)}"{hint}'


def _command(*words: str) -> str:
    """Return a command line as it is to be written."""
    first, *others = words
    return shown(f"bbsd {first} {shlex.join(others)}".strip())


def shown(text: str) -> str:
    """Return a text that a user gave so that it steers nothing."""
    return inert(text.replace("\n", " "), begins_line=False)


def _explain(error: Any, words: list[str], commands: Any) -> None:  # noqa: ANN401 - Typer's own types
    """Say in an error's message what is probably meant."""
    option = getattr(error, "option_name", None)
    message = str(error.message)
    if option is not None and (option in words or any(word.startswith(f"{option}=") for word in words)):
        error.message = _unknown_option(option, _apart(option, words), commands)
        error.possibilities = None
    elif match := re.search(EXTRA, message):
        error.message = _spaces(match["words"].split(), words)
    elif NO_INTEGER in message:
        error.message = "it must be a whole number"
    elif match := re.search(NO_CHOICE, message):
        choices = [choice.strip("' ") for choice in match["choices"].split(",")]
        given = match["given"]
        near = next((each for each in choices if given.startswith(each)), "") or nearest(given, choices)
        changed = [near if word == given else word for word in words]
        hint = f"; did you mean {_command(*changed)}?" if near else ""
        error.message = f'"{shown(given)}" is none of {", ".join(choices)}{hint}'


def _apart(option: str, words: list[str]) -> list[str]:
    """Return a command line with the value of an option as a word of its own, where it stands behind `=`."""
    at = next((at for at, word in enumerate(words) if word.startswith(f"{option}=")), None)
    return words if at is None else [*words[:at], *words[at].split("=", 1), *words[at + 1 :]]


def _unknown_option(option: str, words: list[str], commands: Any) -> str:  # noqa: ANN401 - Typer's own types
    from bbsd.language.keys import blocks_with

    key = option.lstrip("-").replace("-", "_")
    blocks = [block for block in blocks_with(key) if not block.startswith(("a ", "the "))]
    if len(blocks) == 1:
        at = words.index(option)
        value = words[at + 1] if at + 1 < len(words) and not words[at + 1].startswith("-") else "..."
        behind = words[at + 2 :] if value != "..." else words[at + 1 :]
        path = f"{blocks[0]}.{key}"
        command = _command(*words[:at], *behind, "--set", f"{path}={value}")
        return f"there is no option {option}; {key} is set by --set {path}={shown(value)}: {command}"
    command = commands.get(words[0])
    known = [name for parameter in command.params for name in parameter.opts] if command else []
    others = [
        name for name, each in commands.items() if any(option in parameter.opts for parameter in each.params)
    ]
    if (meant := OTHER_OPTIONS.get(option, "")) in known and meant:
        changed = [meant if word == option else word for word in words]
        return f"there is no option {option} of bbsd {words[0]}; it is {meant}: {_command(*changed)}"
    if option == "--set" and words[0] in WITHOUT_SET:
        return f"bbsd {words[0]} reads files as they are, without --set; {_set_elsewhere(words)}"
    if not others and (near := nearest(option, [name for name in known if name.startswith("--")])):
        return f"there is no option {option}; did you mean {near}?"
    where = f"; it is one of bbsd {', bbsd '.join(others[:3])}" if others else ""
    return f"there is no option {shown(option)} of bbsd {words[0]}{where}"


OTHER_OPTIONS = {
    "--episodes": "--budget",
    "--iterations": "--budget",
    "--steps": "--budget",
    "--timesteps": "--budget",
    "--n-episodes": "--episodes",
    "--num-episodes": "--episodes",
    "--output": "--out",
    "--outdir": "--out",
    "--output-dir": "--out",
    "--folder": "--out",
    "--workers": "--jobs",
    "--processes": "--jobs",
    "--threads": "--jobs",
    "--timeout": "--time-limit",
    "--time": "--time-limit",
    "--random-seed": "--seed",
    "--param": "--set",
    "--override": "--set",
    "--figure": "--plot",
}
"""What options are called elsewhere, where a command has none of that name."""
WITHOUT_SET = ("check", "fmt")


def _set_elsewhere(words: list[str]) -> str:
    """Return how a value is set for a command that shows what it leads to."""
    at = words.index("--set")
    given = " ".join(words[at + 1 : at + 2])
    value, others = given, [*words[1:at], *words[at + 2 :]]
    if "=" not in given and others and at + 2 < len(words):
        value = f"{given}={words[at + 2]}"
        others = [*words[1:at], *words[at + 3 :]]
    return f"bbsd config checks a spec with values set: {_command('config', *others, '--set', value)}"


def _spaces(extra: list[str], words: list[str]) -> str:
    """Return what is wrong with `--set PATH = VALUE`."""
    at = words.index("=") if "=" in words else 0
    if not 0 < at < len(words) - 1:
        return f"there is more than the command takes: {shown(' '.join(extra))}"
    joined = [*words[: at - 1], f"{words[at - 1]}={words[at + 1]}", *words[at + 2 :]]
    return f"no spaces stand around the = of --set: {_command(*joined)}"


def with_file(advice: str) -> str:
    """Return an advice in which commands have the file that this command was given."""
    files = [word for word in sys.argv[2:] if Path(word).suffix in (".yaml", ".yml")]
    if len(files) != 1:
        return advice
    file = shlex.quote(shown(files[0]))
    return re.sub(
        r"bbsd (design|evaluate|why)(?=[;, ]|$)(?! [\w.<])", lambda found: f"{found[0]} {file}", advice
    )
