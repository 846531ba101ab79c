"""Commands of which only name and first sentence are known until one is used: importing all takes longer than most."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple

import typer
from typer.core import TyperCommand

if TYPE_CHECKING:
    from collections.abc import Iterator


class Listed(NamedTuple):
    """A command in the list: where its function is, as `module:function`, and the first sentence of its help.

    An interrupt stops it, but for one that handles interrupts itself.
    """

    home: str
    sentence: str
    handles_interrupts: bool = False

    def short_help(self, width: int) -> str:
        """Return the sentence, cut off where it is longer than a width in characters."""
        return TyperCommand(None, help=self.sentence).get_short_help_str(width)

    def command(self, name: str) -> Any:  # noqa: ANN401 - Typer's own type
        """Import the function and make a command of it."""
        from bbsd.cli.terminal.interrupts import stoppable

        module, _, function = self.home.partition(":")
        callback = getattr(import_module(module), function)
        single = typer.Typer(add_completion=False, rich_markup_mode=None)
        single.command(name)(callback if self.handles_interrupts else stoppable(callback))
        return typer.main.get_command(single)


class LateCommands(Mapping[str, Any]):
    """Commands by name; each is imported when it is first asked for."""

    def __init__(self, listed: Mapping[str, Listed]) -> None:
        self._listed = listed
        self._made: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:  # noqa: ANN401 - Typer's own type
        if name not in self._made:
            self._made[name] = self._listed[name].command(name)
        return self._made[name]

    def __contains__(self, name: object) -> bool:
        return name in self._listed

    def __iter__(self) -> Iterator[str]:
        return iter(self._listed)

    def __len__(self) -> int:
        return len(self._listed)
