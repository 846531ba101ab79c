"""Other tools' words for what is good or bad, where a spec has reward terms, which are all maximized."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from bbsd.expression.syntax.mistakes import KEY, ExpressionError, Mistake
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Unary
from bbsd.language.field_types import scalar_text

if TYPE_CHECKING:
    from bbsd.expression.scope import Path
    from bbsd.expression.syntax.tree import Expr

SMALL: Final = frozenset(
    (
        "minimize",
        "minimise",
        "minimum",
        "cost",
        "costs",
        "cost_function",
        "penalty",
        "penalties",
        "loss",
        "error",
        "punishment",
    )
)
"""Keys of what should be small."""
LARGE: Final = frozenset(
    (
        "maximize",
        "maximise",
        "maximum",
        "objective",
        "objectives",
        "fitness",
        "goal",
        "goals",
        "utility",
        "score",
        "target",
        "returns",
    )
)
"""Keys of what should be large."""
MAX_REPEATED = 60
"""Characters of an expression that an advice repeats."""


def is_goal(path: Path) -> bool:
    """Return whether a key stands where no reward term can, and is a word for what is good or bad."""
    return path[:-1] in ((), ("design",), ("environment",)) and path[-1:] != () and path[-1] in SMALL | LARGE


def is_block_of_costs(path: Path) -> bool:
    """Return whether a reward term has the name of a block of costs, as `minimize` with terms below it."""
    return len(path) == 2 and path[0] == "reward" and path[1] in SMALL | LARGE


def goal_mistake(path: Path, value: object) -> Mistake:
    """Return the mistake of a word for what is good or bad, with the reward term to write."""
    key = str(path[-1])
    message = f'there is no key "{key}": everything is maximized, by what the terms under reward add up to'
    return Mistake("BB138", message, KEY, _advice(key, value))


def _advice(key: str, value: object) -> str:
    text, what = _single_term(value)
    tree = _tree(text)
    if key in SMALL:
        term = (
            f"{what or 'cost'}: {render(Unary('-', tree, tree.span))}"
            if tree
            else "a term like distance: -abs(x)"
        )
        return f"what should be small is a negative term; under reward, write {term}"
    if tree:
        return f"under reward, write {what or 'gain'}: {text}"
    return "write each term under reward, what should be small with a minus, such as distance: -abs(x)"


def _tree(text: str) -> Expr | None:
    try:
        return parse(text)
    except ExpressionError:
        return None


def _single_term(value: object) -> tuple[str, str]:
    """Return the one expression that a value is, and its name if it has one; nothing where it is more or too long."""
    match value:
        case str() if value.strip() in SMALL | LARGE:
            return "", ""
        case {**terms} if len(terms) == 1:
            ((name, term),) = terms.items()
            return _single_term(term)[0] if not isinstance(term, dict) else "", str(name)
        case str() | int() | float() if (text := scalar_text(value)) and len(text) <= MAX_REPEATED:
            return text if not isinstance(value, bool) else "", ""
    return "", ""
