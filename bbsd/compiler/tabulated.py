"""An environment by its table of transitions: what is stepped in Python becomes nodes that read the table.

The environment's state is kept in a slot of its own; what follows is read from constants, and drawn from the episode's
key. So a spec of such an environment is compiled like one whose world is its own.
"""

from __future__ import annotations

from dataclasses import replace
from math import prod
from typing import TYPE_CHECKING

import numpy as np

from bbsd.compiler.columns import Columns
from bbsd.expression.graph import Graph, Level, Node, replace_leaves, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import HIDDEN, Slot
from bbsd.kernel.streams import name_word
from bbsd.language.outside import EARNED, ENDED

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from bbsd.environments.tables import TransitionTable
    from bbsd.language.meaning import Meaning
    from bbsd.language.models import Spec
    from bbsd.language.outside import Outside

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64 | np.bool_]
    Reader = Callable[[Node], Node]

STATE = Slot(f"{HIDDEN}state_of_table")
"""Where an episode keeps the state of the table."""
START, OUTCOME = name_word("the first state of a table"), name_word("the outcome of a table")
"""The streams of what is drawn."""


class NotTabulated(Exception):
    """A spec that cannot be stepped by a table of transitions; the message says why."""


def tabulated(meaning: Meaning, table: TransitionTable) -> Meaning:
    """Return a meaning in which the environment steps by a table; nothing in it is stepped in Python.

    Raises NotTabulated where the spec cannot be stepped by the table.
    """
    outside = require_tabulable(meaning, table)
    graph = meaning.graph.fork()
    graph.bounded = False
    return _Table(meaning, table, outside, graph).tabulated()


def require_tabulable(meaning: Meaning, table: TransitionTable) -> Outside:
    """Return what a spec says of its environment; raise NotTabulated where that and a table do not go together."""
    environment = meaning.spec.environment
    outside = environment.outside
    if outside is None or environment.robots > 1:
        raise NotTabulated("a table of transitions is of one robot's environment")
    if len(outside.actions) != 1:
        raise NotTabulated("a table of transitions takes one action")
    if prod(sizes_of(outside, table)) != table.n_states:
        raise NotTabulated(f"the spec's observation has not the {table.n_states} states of the table")
    values = _possible_values(meaning, Slot(outside.actions[0], 0))
    if values is None or not values <= set(range(table.n_actions)):
        raise NotTabulated(
            f"{outside.actions[0]} might be something else than a whole number from 0 to {table.n_actions - 1}"
        )
    return outside


def sizes_of(outside: Outside, table: TransitionTable) -> list[int]:
    """Return how many values each field of an observation has, the most significant digit first."""
    if len(outside.fields) == 1 and outside.fields[0].size is None:
        return [table.n_states]
    return [field.size or 0 for field in outside.fields]


def _possible_values(meaning: Meaning, slot: Slot) -> set[float] | None:
    """Return the values that a slot may have, as far as they stand in the spec; None where they do not."""
    episode, values, waiting = meaning.episode, set[float](), list[Node]()
    waiting += [episode.start[slot], episode.acted[slot], episode.after[slot]]
    while waiting:
        node = waiting.pop()
        match node.operation:
            case "select":
                waiting += node.operands[1:]
            case "slot" if node.slot == slot:
                pass
            case _:
                value = value_of(node) if node.literal else meaning.constants.static(node)
                if value is None:
                    return None
                values.add(float(value))
    return values


def _shortened(spec: Spec, most_steps: int | None) -> Spec:
    """Return a spec whose episodes have the environment's own limit of steps, where that is the lower one."""
    if most_steps is None or most_steps >= spec.environment.steps:
        return spec
    environment = spec.environment.model_copy(update={"steps": most_steps})
    return spec.model_copy(update={"environment": environment})


class _Table:
    """The nodes of a table of transitions in the graph of a meaning."""

    def __init__(self, meaning: Meaning, table: TransitionTable, outside: Outside, graph: Graph) -> None:
        self._meaning, self._table, self._outside, self._graph = meaning, table, outside, graph
        self._columns = Columns(graph, meaning.constants)

    def tabulated(self) -> Meaning:
        """Return the meaning by the table."""
        table, graph, episode = self._table, self._graph, self._meaning.episode
        first = self._first_state()
        state = graph.leaf("slot", STATE, Kind.NUMBER, Level.LANE)
        action = episode.acted[Slot(self._outside.actions[0], 0)]
        row = self._plus(self._times(state, table.n_actions), action)
        first_outcome = self._times(row, table.n_outcomes)
        at = self._plus(first_outcome, self._chosen(OUTCOME, table.cumulative, first_outcome))
        then = self._columns.read(table.next_states, at)
        ended = graph.apply("!=", self._columns.read(table.ended, at), graph.number(0))
        beginning = self._observed(first)
        given = {
            **self._observed(then),
            Slot(EARNED, 0): self._columns.read(table.rewards, at),
            Slot(ENDED): ended,
        }
        stepped = episode.with_nodes(lambda node: self._replaced(node, given))
        start = {slot: self._replaced(node, beginning) for slot, node in episode.start.items()}
        episode = replace(
            stepped,
            start={**start, STATE: first},
            after={**stepped.after, STATE: then},
            outside=(),
            sent=(),
            fractions=frozenset(),
        )
        return replace(
            self._meaning,
            spec=_shortened(self._meaning.spec, table.most_steps),
            graph=graph,
            constants=self._columns.constants,
            episode=episode,
        )

    def _first_state(self) -> Node:
        states, cumulative = self._table.first_states
        return self._columns.read(states, self._chosen(START, cumulative, None))

    def _chosen(self, word: int, cumulative: Floats, base: Node | None) -> Node:
        """Return the first place whose cumulative probability is greater than a number drawn, by bisection.

        `cumulative` are the probabilities of one distribution, or of many, of which `base` chooses one.
        """
        graph, n_places = self._graph, cumulative.shape[-1]
        place = graph.number(0)
        if n_places == 1:
            return place
        drawn = graph.draw("uniform", word, (graph.number(0), graph.number(1)))
        read = self._columns.reader(cumulative)
        while n_places > 1:
            half = n_places // 2
            beyond = self._plus(place, graph.number(half))
            last = self._plus(place, graph.number(half - 1))
            is_beyond = graph.apply(">=", drawn, read(last if base is None else self._plus(base, last)))
            place = graph.apply("select", is_beyond, beyond, place)
            n_places -= half
        return place

    def _observed(self, state: Node) -> dict[Slot, Node]:
        """Return the fields of the observation of a state: its digits."""
        sizes = sizes_of(self._outside, self._table)
        states, weight = np.arange(self._table.n_states), self._table.n_states
        fields: dict[Slot, Node] = {}
        for field, size in zip(self._outside.fields, sizes, strict=True):
            weight //= size
            if field.is_used:
                whole = weight == 1 and size == len(states)
                digits = states // weight % size
                fields[Slot(field.name, 0)] = state if whole else self._columns.read(digits, state)
        return fields

    def _replaced(self, node: Node, given: Mapping[Slot, Node]) -> Node:
        """Return a node that reads given nodes instead of what the environment gives."""

        def leaf(each: Node, operands: list[Node]) -> Node:
            return given[each.slot] if each.operation == "outside" else self._graph.copy(each, operands)

        return replace_leaves(node, self._graph, leaf)

    def _times(self, node: Node, factor: int) -> Node:
        return node if factor == 1 else self._graph.apply("*", node, self._graph.number(factor))

    def _plus(self, left: Node, right: Node) -> Node:
        literals = [node for node in (left, right) if node.literal and value_of(node) == 0.0]
        if literals:
            return right if left is literals[0] else left
        return self._graph.apply("+", left, right)
