"""State and world that are one of several names: what these names are, and that nothing else has them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import OneOf, Span

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from bbsd.expression.scope import Findings, Names, Path
    from bbsd.language.field_types import Expression
    from bbsd.language.models import Environment


def choices_of(environment: Environment) -> dict[str, tuple[Names, ...]]:
    """Return for each name that a state or a value of the world can be one of, the lists of names that have it."""
    lists = dict.fromkeys(tree.names for _, _, tree in _chosen(environment))
    every = dict.fromkeys(name for names in lists for name in names)
    return {name: tuple(names for names in lists if name in names) for name in every}


def report_names_of_values(
    environment: Environment, namespace: Iterable[tuple[str, Path]], findings: Findings
) -> None:
    """Report names of values that something has for itself: an expression could not tell them apart."""
    others: dict[str, Path] = {}
    for name, path in namespace:
        others.setdefault(name, path)
    for path, expression, tree in _chosen(environment):
        for name in tree.names:
            if name in others:
                block = ".".join(map(str, others[name][:-1]))
                message = (
                    f"{name} is the name of something in {block}, and cannot be a value of {path[-1]} too"
                )
                findings.report(path, "BB025", message, _span_of(name, expression), "rename one of the two")


def _chosen(environment: Environment) -> Iterator[tuple[Path, Expression, OneOf]]:
    """Yield all that is one of several names, with its path."""
    blocks: Mapping[str, Mapping[str, Expression]] = {"world": environment.world, "state": environment.state}
    for block, starts in blocks.items():
        for name, expression in starts.items():
            if isinstance(expression.tree, OneOf):
                yield ("environment", block, name), expression, expression.tree


def _span_of(name: str, expression: Expression) -> Span:
    """Return where a name stands between the brackets."""
    begin = expression.text.index("[")
    found = re.compile(rf"\b{name}\b").search(expression.text, begin)
    return Span(found.start() if found else begin, len(name))
