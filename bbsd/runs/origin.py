"""What a command is made of, as plain data, so that a worker anywhere makes the same command."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bbsd.compiler import Problem, compile_meaning
from bbsd.environments.opening import opened_again
from bbsd.language.loading import load
from bbsd.text import Source

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.environments.opening import Opened
    from bbsd.language.loading import Loaded
    from bbsd.runs.beginnings import Beginning


@dataclass(frozen=True, slots=True)
class Origin:
    """The spec of a command, in which nothing refers to a file, and what was laid over it."""

    file: str
    """The name of the spec's file, for messages."""
    text: str
    """Its text, together with all that it extends."""
    overrides: tuple[str, ...]
    seed: int
    """The seed of its constants."""
    opened: Opened | None = None
    """The spec's environment, where that is one that is stepped in Python."""
    rival: str = ""
    """The method, where the command is a rival's."""
    budgets: tuple[int, ...] = ()
    """The budgets of the design itself, where the command is a rival's."""
    beginnings: tuple[Beginning, ...] = ()
    """The known designs that it begins with."""

    def plain(self, problem: Problem) -> dict[str, Any]:
        """Return all that a problem is made of as plain data, from which `remade` makes it again.

        Raises NotPortable where its environment is a class that no other process can import.
        """
        return {
            "file": self.file,
            "text": self.text,
            "overrides": list(self.overrides),
            "seed": self.seed,
            "lanes": problem.lanes,
            "compiled": problem.compiled,
            "jobs": problem.jobs,
            "environment": None
            if self.opened is None
            else {"recipe": self.opened.recipe.plain(), "identity": self.opened.plain()},
        }


def origin_of(loaded: Loaded, opened: Opened | None = None, beginnings: Sequence[Beginning] = ()) -> Origin:
    """Return what commands of a loaded spec, and of its environment where it has one, are made of."""
    text = loaded.lineage.flat.source.text
    return Origin(
        loaded.source.file, text, loaded.overrides, loaded.meaning.seed, opened, beginnings=tuple(beginnings)
    )


def remade(plain: Mapping[str, Any]) -> tuple[Loaded, Problem]:
    """Return a spec and its problem, made again in another process of what `Origin.plain` returned.

    An environment is opened by the consent that was given where the command was given, and has to be the same one.
    """
    source = Source(plain["file"], plain["text"])
    loaded = load(source, seed=plain["seed"], overrides=plain["overrides"])
    environment = plain["environment"]
    opened = None if environment is None else opened_again(environment["recipe"], environment["identity"])
    problem = compile_meaning(
        loaded.meaning,
        lanes=plain["lanes"],
        compiled=plain["compiled"],
        jobs=plain["jobs"],
        stepper=None if opened is None else opened.stepper,
        table=None if opened is None else opened.table,
    )
    return loaded, problem
