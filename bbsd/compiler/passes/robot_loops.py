"""An episode whose robots do all alike, written for one robot in a loop over robots.

Compile time then does not grow with the number of robots. The operations and their order are the same, so is every
bit of what comes out.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.compiler.passes.families import CircularError, Families
from bbsd.compiler.passes.robot_graph import RobotGraph
from bbsd.expression.node_data import Slot

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Variable
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.episode import Episode

MOST_ROBOTS_WRITTEN_OUT = 3
"""Robots up to this number are written one after the other, which runs faster."""


def loop_over_robots(meaning: Meaning, most_written_out: int = MOST_ROBOTS_WRITTEN_OUT) -> Meaning:
    """The same meaning with one node for what each robot computes, where there are many robots.

    In what comes back every robot's slots, choices and reward have the index 0, and stand for all robots.
    """
    robots = meaning.spec.environment.robots
    if robots <= most_written_out:
        return meaning
    try:
        return replace(meaning, episode=_episode(meaning.episode, robots))
    except CircularError:
        return meaning


def _episode(episode: Episode, robots: int) -> Episode:
    # What is known before the decision must not be read from a family of values that depend on it, even if one robot's
    # value happens to be the same.
    new, alike = RobotGraph(robots), frozenset(_held_alike(episode))
    beginning, deciding, families = (Families(new, alike) for _ in range(3))
    beginning.know(_by_variable(episode.start).values())
    for group in (episode.acted, episode.after, episode.definitions):
        families.know(_by_variable(group).values())
    after = _rolled(episode.after, families)
    return replace(
        episode,
        modules=tuple(_module(each, deciding) for each in episode.modules),
        start=_rolled(episode.start, beginning),
        after=after,
        acted=_met(episode.acted, families),
        definitions=_met(episode.definitions, families),
        choices=(families.each(episode.choices),),
        reward={term: (families.each(nodes),) for term, nodes in episode.reward.items()},
        expects={name: (families.each(nodes),) for name, nodes in episode.expects.items()},
        ends=None if episode.ends is None else families.team(episode.ends),
    )


def _held_alike(episode: Episode) -> Iterable[Variable]:
    """Names and places whose value is the same for all robots at every moment."""
    start = _by_variable(episode.start)
    for variable, nodes in _by_variable(episode.after).items():
        if all(len({node.number for node in values}) == 1 for values in (nodes, start[variable])):
            yield variable


def _by_variable(slots: Mapping[Slot, Node]) -> dict[Variable, list[Node]]:
    """Return the robots' nodes of each variable; the world's are left out."""
    nodes: dict[Variable, list[Node]] = {}
    for slot, node in slots.items():
        if slot.robot is not None:
            nodes.setdefault(slot.variable, []).append(node)
    return nodes


def _rolled(slots: Mapping[Slot, Node], families: Families) -> dict[Slot, Node]:
    by_variable = _by_variable(slots)
    return {
        slot: families.team(node) if slot.robot is None else families.each(by_variable[slot.variable])
        for slot, node in slots.items()
        if not slot.robot
    }


def _met(slots: Mapping[Slot, Node], families: Families) -> dict[Slot, Node]:
    """Of values that only lend their names to others, those that others need."""
    found = {
        Slot(name, 0, place): families.known(nodes) for (name, place), nodes in _by_variable(slots).items()
    }
    return {slot: node for slot, node in found.items() if node is not None}


def _module(module: Module, families: Families) -> Module:
    cells: Sequence[Sequence[Node]] = list(zip(*module.cells, strict=True))
    return replace(
        module,
        cells=(tuple(families.each(nodes) for nodes in cells),),
        excited=(families.each(module.excited),),
    )
