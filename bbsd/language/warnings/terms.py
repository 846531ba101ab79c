"""Terms of the reward that are always the same, since a condition in them never holds, or always does."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

from bbsd.expression.graph import needed
from bbsd.expression.operations import COMPARISONS
from bbsd.expression.syntax.mistakes import WHOLE, Mistake, Rewriting
from bbsd.expression.syntax.text import number_text, render
from bbsd.expression.syntax.tree import Comparison, Conditional, parts

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.expression.graph import Node
    from bbsd.expression.syntax.tree import Expr
    from bbsd.language.meaning import Meaning
    from bbsd.language.validation import LocatedMistake
    from bbsd.language.warnings.bounds import Bounds
    from bbsd.language.warnings.proving import Prover

ORDER = ("<", ">")


def settled_terms(meaning: Meaning, prover: Prover) -> Iterator[LocatedMistake]:
    """Yield a warning for each term of the reward whose condition is decided by the bounds of what it compares."""
    for term, nodes in meaning.episode.reward.items():
        tree = meaning.spec.reward[term].tree
        conditionals = [*_conditionals(tree)]
        if len(conditionals) != 1 or any(node.literal for node in nodes):
            continue
        low, high = prover.bounds.of(nodes[0])
        if low != high or not isfinite(low) or any(prover.bounds.of(node) != (low, high) for node in nodes):
            continue
        condition = conditionals[0].condition
        decided = {holds for node in nodes for holds in _decided(node, prover.bounds)}
        if len(decided) != 1:
            continue
        why, correction = _why(condition, nodes, prover.bounds)
        holds = "always holds" if decided == {True} else "never holds"
        message = f"{term} is always {number_text(low)}: {render(condition)} {holds}{why}"
        advice = "" if correction is None else f"write {correction.text}, or leave the term out"
        path = ("reward", term)
        yield path, Mistake("BB212", message, condition.span if correction else WHOLE, advice, correction)


def _conditionals(tree: Expr) -> Iterator[Conditional]:
    if isinstance(tree, Conditional):
        yield tree
    for part in parts(tree):
        yield from _conditionals(part)


def _decided(node: Node, bounds: Bounds) -> Iterator[bool]:
    """Yield whether they hold for the conditions in a term that are decided."""
    for each in needed([node]):
        if each.operation == "select":
            low, high = bounds.of(each.operands[0])
            if low == high:
                yield bool(low)


def _why(condition: Expr, nodes: tuple[Node, ...], bounds: Bounds) -> tuple[str, Rewriting | None]:
    """Return where the value compared by a condition lies, and the condition that takes in its bound."""
    match condition:
        case Comparison(operators=(sign,), operands=(left, right)) if sign in ORDER:
            pass
        case _:
            return "", None
    compared = {
        each.number: each
        for each in needed(nodes)
        if each.operation in COMPARISONS
        and not bounds.of(each)[1]
        and any(part.literal for part in each.operands)
    }
    if not compared:
        return "", None
    node = next(iter(compared.values()))
    value, number = sorted(node.operands, key=lambda part: part.literal)
    low, high = bounds.of(value)
    bound = bounds.of(number)[0]
    named = left if any(name.isalpha() for name in render(left)) else right
    if bound == low:
        why = f": {render(named)} is never below {number_text(low)}"
    elif bound == high:
        why = f": {render(named)} is never above {number_text(high)}"
    else:
        return "", None
    return why, Rewriting(f"{render(left)} {sign}= {render(right)}", condition.span, is_certain=False)
