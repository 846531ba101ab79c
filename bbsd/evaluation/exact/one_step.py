"""The meaning of a single step from a given state, with everything that chance may do in it.

An episode of such a meaning has one step. It begins with values that are read from a list of states behind the
constants, and draws are digits of the episode's number instead. What is stored after the step is reported as if it were
reward. So a step is computed by the compiler of all other episodes, and read in no other way.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import reduce
from math import prod
from typing import TYPE_CHECKING

import numpy as np

from bbsd.compiler.columns import Columns
from bbsd.compiler.passes.outputs import with_slots_read
from bbsd.compiler.tabulated import OUTCOME, STATE
from bbsd.evaluation.exact.enumeration import NotEnumerable, values_of_draw
from bbsd.expression.graph import Level, Node, needed, replace_leaves
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import HIDDEN, Slot
from bbsd.language.meaning.partitions import MAX_CELLS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.environments.tables import TransitionTable
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.episode.episode import Episode

STEP = Slot(f"{HIDDEN}steps_before")
"""Where a state keeps the steps that were taken before it, if anything depends on them."""
STATES = 1024
"""The states that a list has room for."""
MOST_CHANCES = 1_000
"""Combinations of values that are drawn in one step, at most."""


@dataclass(frozen=True, slots=True)
class OneStep:
    """The meaning of one step: an episode for each state, in it for each choice, and in it for each chance.

    Behind the reward's terms it reports the probability of the chance, 1 where the episode is over, and what is stored
    in each slot then.
    """

    meaning: Meaning
    slots: tuple[Slot, ...]
    """What a state consists of: all that decisions, expectations, reward and the end depend on, now and later."""
    n_choices: int
    n_chances: int
    first: int
    """Where in the constants the list of states stands, slot by slot, `STATES` numbers for each."""


def one_step_of(meaning: Meaning, table: TransitionTable, *, decided: bool) -> OneStep:
    """Return one step of a meaning by a table, decided by a design, or with every choice in turn.

    Raises NotEnumerable where a draw has too many values, or endlessly many.
    """
    episode = meaning.episode if decided else _undecided(meaning)
    outputs = [node for nodes in episode.reward.values() for node in nodes]
    outputs += [node for module in episode.modules for node in module.nodes]
    outputs += [node for nodes in episode.expects.values() for node in nodes]
    outputs += [] if episode.ends is None else [episode.ends]
    nodes = needed([*with_slots_read(outputs, episode), episode.after[STATE]])
    read = {STATE, *(node.slot for node in nodes if node.operation == "slot")}
    steps = [STEP] if any(node.operation == "step" for node in nodes) else []
    slots = (*(slot for slot in episode.after if slot in read), *steps)
    draws = [node for node in nodes if node.operation == "draw"]
    n_choices = 1 if decided else 1 + sum(len(module.actions) for module in episode.modules)
    return _Writer(replace(meaning, episode=episode), table, slots).one_step(draws, n_choices)


def _undecided(meaning: Meaning) -> Episode:
    """Return the episode with behaviors that perceive nothing, since not they decide."""
    graph = meaning.graph
    literals = {Kind.TRUTH: graph.truth(value=False), Kind.CELL: graph.cell(0)}
    modules = tuple(module.with_nodes(lambda node: literals[node.kind]) for module in meaning.episode.modules)
    return replace(meaning.episode, modules=modules, expects={})


class _Writer:
    """Writes the nodes of one step into a graph."""

    def __init__(self, meaning: Meaning, table: TransitionTable, slots: tuple[Slot, ...]) -> None:
        self._meaning, self._table, self._slots = meaning, table, slots
        self._graph = meaning.graph.fork()
        self._graph.bounded = False
        self._columns = Columns(self._graph, meaning.constants)
        self._number = self._graph.leaf("start", None, Kind.NUMBER, Level.LANE)
        self._stride = 1
        self._choice: Node | None = None
        self._drawn: dict[int, Node] = {}
        """What stands for each draw, by its number."""

    def one_step(self, draws: Sequence[Node], n_choices: int) -> OneStep:
        """Return the step in which these draws take all values."""
        graph, meaning = self._graph, self._meaning
        counts = [self._n_values(draw) for draw in draws]
        if prod(counts) > MOST_CHANCES:
            raise NotEnumerable(
                f"{prod(counts)} combinations of values are drawn in a step; at most {MOST_CHANCES} are tried"
            )
        digits = [self._digit(count) for count in counts]
        self._choice = self._digit(n_choices) if n_choices > 1 else None
        state = graph.apply("floor_divide", self._number, graph.number(self._stride))
        chances = [self._drawn_as(draw, digit) for draw, digit in zip(draws, digits, strict=True)]
        probability = reduce(lambda one, other: graph.apply("*", one, other), chances, graph.number(1))
        episode = self._meaning.episode
        after = {slot: self._after(slot) for slot in self._slots}
        over = graph.truth(value=False) if episode.ends is None else self._new(episode.ends)
        reported = {
            "probability": probability,
            "over": self._as_number(over),
            **{f"then_{place}": self._as_number(node) for place, node in enumerate(after.values())},
        }
        episode = replace(
            episode,
            modules=tuple(module.with_nodes(self._new) for module in episode.modules),
            acted={},
            after=after,
            definitions={},
            reward={
                **{term: tuple(map(self._new, nodes)) for term, nodes in episode.reward.items()},
                **{f"{HIDDEN}{name}": (node,) for name, node in reported.items()},
            },
            ends=None,
            expects={name: tuple(map(self._new, nodes)) for name, nodes in episode.expects.items()},
            picture=None,
        )
        first = len(self._columns.constants.scalars)
        start = {slot: self._beginning(node.kind, state) for slot, node in after.items()}
        environment = meaning.spec.environment.model_copy(update={"steps": 1})
        written = replace(
            meaning,
            spec=meaning.spec.model_copy(update={"environment": environment}),
            graph=graph,
            constants=self._columns.constants,
            episode=replace(episode, start=start),
        )
        return OneStep(written, self._slots, n_choices, prod(counts), first)

    def _digit(self, count: int) -> Node:
        """Return the next digit of the episode's number, a whole number below `count`."""
        shifted = self._graph.apply("floor_divide", self._number, self._graph.number(self._stride))
        self._stride *= count
        return self._graph.apply("modulo", shifted, self._graph.number(count))

    def _n_values(self, draw: Node) -> int:
        if draw.draw.word == OUTCOME:
            return self._table.n_outcomes
        return len(values_of_draw(draw, self._meaning.constants)[1])

    def _drawn_as(self, draw: Node, digit: Node) -> Node:
        """Let a digit choose the value of a draw, and return how likely that value is."""
        graph = self._graph
        if draw.draw.word == OUTCOME:
            cumulative, probabilities = self._table.cumulative, self._table.probabilities
            at = graph.apply("+", self._first_outcome(), digit)
            # The least number that chooses an outcome is the cumulative probability of those before it.
            least = np.concatenate([np.zeros_like(cumulative[..., :1]), cumulative[..., :-1]], axis=2)
            self._drawn[draw.number] = self._columns.read(least, at)
            return self._columns.read(probabilities, at)
        first, probabilities_of_values = values_of_draw(draw, self._meaning.constants)
        value = graph.apply("+", digit, graph.number(first))
        self._drawn[draw.number] = (
            graph.apply(">", value, graph.number(0)) if draw.kind is Kind.TRUTH else value
        )
        return self._columns.read(np.array(probabilities_of_values), digit)

    def _first_outcome(self) -> Node:
        """Return where in the table the outcomes stand of what is done in the present state."""
        graph, table, outside = self._graph, self._table, self._meaning.spec.environment.outside
        name = outside.actions[0] if outside else ""
        action = self._new(self._meaning.episode.acted[Slot(name, 0)])
        state = graph.leaf("slot", STATE, Kind.NUMBER, Level.LANE)
        row = graph.apply("+", graph.apply("*", state, graph.number(table.n_actions)), action)
        return graph.apply("*", row, graph.number(table.n_outcomes))

    def _new(self, node: Node) -> Node:
        """Return a node of the step with digits in place of draws, and of choices where no design decides."""
        graph = self._graph

        def leaf(each: Node, operands: list[Node]) -> Node:
            match each.operation:
                case "draw":
                    return self._drawn[each.number]
                case "choice" if self._choice is not None:
                    return self._choice
                case "step":
                    return graph.apply("+", self._steps_before, graph.number(1))
            return graph.copy(each, operands)

        return replace_leaves(node, graph, leaf)

    @property
    def _steps_before(self) -> Node:
        return self._graph.leaf("slot", STEP, Kind.NUMBER, Level.LANE)

    def _after(self, slot: Slot) -> Node:
        if slot == STEP:
            return self._graph.apply("+", self._steps_before, self._graph.number(1))
        return self._new(self._meaning.episode.after[slot])

    def _beginning(self, kind: Kind, state: Node) -> Node:
        """Return the next value of the list of states."""
        graph, value = self._graph, self._columns.reader(np.zeros(STATES))(state)
        match kind:
            case Kind.TRUTH:
                return graph.apply("!=", value, graph.number(0))
            case Kind.CELL:
                return graph.apply("clamp_index", value, graph.cell(MAX_CELLS))
        return value

    def _as_number(self, node: Node) -> Node:
        graph = self._graph
        match node.kind:
            case Kind.TRUTH:
                return graph.apply("select", node, graph.number(1), graph.number(0))
            case Kind.CELL:
                return graph.apply("+", graph.number(0), node)
        return node
