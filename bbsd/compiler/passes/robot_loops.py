"""Rewrites an episode whose robots compute alike for one robot in a loop over robots.

Compile time then does not grow with the number of robots. The operations and their order stay the same, and so does
every bit of the outcome.
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
    from bbsd.language.meaning.episode.episode import Episode

MOST_ROBOTS_WRITTEN_OUT = 3
"""Up to so many robots are written one after the other, which runs faster (decision 18, loops over robots)."""


def loop_over_robots(meaning: Meaning, most_written_out: int = MOST_ROBOTS_WRITTEN_OUT) -> Meaning:
    """Return the same meaning with one node for what every robot computes, where there are many robots.

    In it slots, choices and reward of robot 0 stand for those of all robots. What an environment in Python gives is a
    value of its own for each robot, so such a meaning stays as it is.
    """
    robots = meaning.spec.environment.robots
    if robots <= most_written_out or meaning.episode.outside:
        return meaning
    try:
        return replace(meaning, episode=_loop_over(meaning.episode, robots))
    except CircularError:
        return meaning


def _loop_over(episode: Episode, robots: int) -> Episode:
    # The start, the decision and the step have families of their own: what the decision reads must not become a member
    # of a family that depends on the decision, even if one robot's value happens to be the same.
    robot_graph, alike = RobotGraph(robots), frozenset(_held_alike(episode))
    at_start, deciding, families = (Families(robot_graph, alike) for _ in range(3))
    at_start.register(_by_variable(episode.start).values())
    for group in (episode.acted, episode.after, episode.definitions):
        families.register(_by_variable(group).values())
    after = _make_slots(episode.after, families)
    return replace(
        episode,
        modules=tuple(_make_module(module, deciding) for module in episode.modules),
        start=_make_slots(episode.start, at_start),
        after=after,
        acted=_find_slots(episode.acted, families),
        definitions=_find_slots(episode.definitions, families),
        choices=(families.make_family(episode.choices),),
        reward={term: (families.make_family(nodes),) for term, nodes in episode.reward.items()},
        expects={name: (families.make_family(nodes),) for name, nodes in episode.expects.items()},
        ends=None if episode.ends is None else families.make_team_value(episode.ends),
    )


def _held_alike(episode: Episode) -> Iterable[Variable]:
    """Yield the variables whose value is the same for all robots at every moment."""
    start = _by_variable(episode.start)
    for variable, nodes in _by_variable(episode.after).items():
        if all(len({node.number for node in values}) == 1 for values in (nodes, start[variable])):
            yield variable


def _by_variable(slots: Mapping[Slot, Node]) -> dict[Variable, list[Node]]:
    """Return the robots' nodes of each variable, without the world's."""
    nodes: dict[Variable, list[Node]] = {}
    for slot, node in slots.items():
        if slot.robot is not None:
            nodes.setdefault(slot.variable, []).append(node)
    return nodes


def _make_slots(slots: Mapping[Slot, Node], families: Families) -> dict[Slot, Node]:
    by_variable = _by_variable(slots)
    return {
        slot: families.make_team_value(node)
        if slot.robot is None
        else families.make_family(by_variable[slot.variable])
        for slot, node in slots.items()
        if not slot.robot
    }


def _find_slots(slots: Mapping[Slot, Node], families: Families) -> dict[Slot, Node]:
    """Return those values that others need; apart from that they only give names."""
    nodes = {
        Slot(name, 0, place): families.find_family(family)
        for (name, place), family in _by_variable(slots).items()
    }
    return {slot: node for slot, node in nodes.items() if node is not None}


def _make_module(module: Module, families: Families) -> Module:
    cells: Sequence[Sequence[Node]] = list(zip(*module.cells, strict=True))
    return replace(
        module,
        cells=(tuple(families.make_family(nodes) for nodes in cells),),
        excited=(families.make_family(module.excited),),
    )
