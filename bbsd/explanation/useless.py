"""What a design could do without: behaviors never or hardly in control, rules never used, inputs that never matter."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.rules import sizes_of
from bbsd.explanation.conditions import join_words
from bbsd.explanation.words import Useless
from bbsd.expression.scope import Findings
from bbsd.language.meaning.tables.rules import table_of_rules
from bbsd.language.models import Otherwise

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.architecture.visits import Visits
    from bbsd.explanation.cells import Cares
    from bbsd.explanation.words import LayerInWords
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.models import Rule

HARDLY = 0.001
"""The share of all steps below which a behavior is hardly in control."""
MOST_RULES = 250
"""Rules of a behavior that are looked at: each must have a number of its own in a table of bytes."""


def useless_of(
    meaning: Meaning,
    architecture: Architecture,
    cares: Sequence[Cares],
    layers: Sequence[LayerInWords],
    visits: Visits | None,
) -> Iterator[Useless]:
    """Yield what is useless, layer by layer from the highest down.

    Args:
        meaning: of the spec.
        architecture: tables and structure.
        cares: what matters of each behavior, in the spec's order.
        layers: in words, highest first.
        visits: None where they are not known.
    """
    for layer in layers:
        behavior = int(architecture.structure[layer.layer - 1])
        table, module = architecture.tables[behavior], meaning.episode.modules[behavior]
        found = _useless_behavior(layer, table, visits, behavior)
        if found is not None:
            yield found
        if found is None or found.why.startswith("hardly"):
            yield from _useless_rules(meaning, module, cares[behavior], visits, behavior)
            yield from _useless_inputs(module, table, cares[behavior], visits)


def _useless_behavior(
    layer: LayerInWords, table: NDArray[np.uint8], visits: Visits | None, behavior: int
) -> Useless | None:
    def useless(why: str, *, is_certain: bool) -> Useless:
        return Useless("behavior", layer.behavior, "", why, is_certain)

    if not table.any():
        return useless("it has no action in any cell, and can be removed", is_certain=True)
    if layer.cells == 0:
        by = f": {join_words(layer.overruled_by, 'or')} above always does" if layer.overruled_by else ""
        return useless(f"never controls{by}; it can be removed", is_certain=True)
    if visits is None:
        return None
    share, watched = visits.share(behavior), _watched(visits)
    if share == 0:
        return useless(f"never controlled in {watched}", is_certain=False)
    if share < HARDLY:
        return useless(
            f"hardly ever controlled: {100 * share:.2g} % of the steps of {watched}", is_certain=False
        )
    return None


def _watched(visits: Visits) -> str:
    return "1 episode" if visits.episodes == 1 else f"{visits.episodes:,} episodes"


def _useless_rules(
    meaning: Meaning, module: Module, cares: Cares, visits: Visits | None, behavior: int
) -> Iterator[Useless]:
    """Yield the rules of the file that never decide anything; the last one, for all that is left, is no such rule."""
    rules = meaning.spec.behaviors[module.name].rules or ()
    if len(rules) > MOST_RULES:
        return
    first = _first_rule(rules, module)
    for index, rule in enumerate(rules):
        if isinstance(rule, Otherwise):
            continue
        cells = first == index
        what, number = f"rule {index + 1}: {_rule_text(rule)}", index + 1
        if not (cells & cares.by_tables).any():
            why = "never decides anything, and can be removed"
            yield Useless("rule", module.name, what, why, is_certain=True, number=number)
        elif visits is not None and not visits.asked[behavior][cells].any() and visits.asked[behavior].any():
            why = f"not used in {_watched(visits)}"
            yield Useless("rule", module.name, what, why, is_certain=False, number=number)


def _first_rule(rules: Sequence[Rule], module: Module) -> NDArray[np.int64]:
    """Return the number of the first rule that matches each cell, (n_cells,)."""
    names = [f"rule {index}" for index in range(len(rules))]
    numbered = [
        rule.model_copy(update={"otherwise" if isinstance(rule, Otherwise) else "do": name})
        for rule, name in zip(rules, names, strict=True)
    ]
    table = table_of_rules(numbered, module.inputs, names, (), Findings())
    return np.frombuffer(table.given, np.uint8).astype(np.int64) - 1


def _rule_text(rule: Rule) -> str:
    if isinstance(rule, Otherwise):
        return f"otherwise {rule.otherwise}"
    conditions = [
        f"{name} is {join_words([str(cell) for cell in cells], 'or')}" for name, cells in rule.when.items()
    ]
    return f"{rule.do} where {' and '.join(conditions)}" if conditions else rule.do


def _useless_inputs(
    module: Module, table: NDArray[np.uint8], cares: Cares, visits: Visits | None
) -> Iterator[Useless]:
    sizes = sizes_of(module.inputs)
    needed = depends_on(table, cares.by_tables, sizes)
    yield from _inputs(module, table, cares.by_tables, [not each for each in needed], None)
    if visits is not None:
        seen = depends_on(table, cares.counts, sizes)
        idle = [always and not now for always, now in zip(needed, seen, strict=True)]
        yield from _inputs(module, table, cares.counts, idle, visits)


def _inputs(
    module: Module,
    table: NDArray[np.uint8],
    counts: NDArray[np.bool_],
    idle: Sequence[bool],
    visits: Visits | None,
) -> Iterator[Useless]:
    """Yield inputs that do not matter: all in one, or each by itself where not all of them could go together."""
    axes = tuple(axis for axis, is_idle in enumerate(idle) if is_idle)
    names = [name for name, is_idle in zip(module.inputs, idle, strict=True) if is_idle]
    if not axes:
        return
    together = not _differ(table, counts, sizes_of(module.inputs), axes)
    for group in [names] if together else [[name] for name in names]:
        many = len(group) > 1
        if visits is not None:
            why = f"did not matter in {_watched(visits)}"
        else:
            alone = "" if together else ", if the others stay"
            why = f"never matter{'' if many else 's'}, and can be removed{alone}"
        yield Useless("input", module.name, join_words(group, "and"), why, visits is None)


def depends_on(table: NDArray[np.integer], counts: NDArray[np.bool_], sizes: Sequence[int]) -> list[bool]:
    """Return for each input whether decisions in cells that count, both (n_cells,), differ along it.

    Inputs that do not matter one by one may matter together: of two that are always alike, one is needed.
    """
    return [_differ(table, counts, sizes, (axis,)) for axis in range(len(sizes))]


def _differ(
    table: NDArray[np.integer], counts: NDArray[np.bool_], sizes: Sequence[int], axes: tuple[int, ...]
) -> bool:
    """Return whether decisions in cells that count differ along some inputs, all others being the same."""
    highest = np.where(counts, table, 0).reshape(tuple(sizes))
    lowest = np.where(counts, table, 255).reshape(tuple(sizes))
    return bool((highest.max(axes) > lowest.min(axes)).any())
