"""The best return that a task allows, by dynamic programming: `make optimum`.

The task is read as a Markov decision process of whoever knows the whole state and the steps that are left: no design
can earn more. A design always does the same in a state, so the best policy of that kind among those that are greedy for
some number of steps is given too; where the behaviors' cells tell the state, a design can earn as much. A task must
have one robot, finitely many states, and draws of finitely many values. What is drawn anew in every step, and sensed by
no behavior, is not known before it takes effect.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import bbsd
from bbsd.evaluation.exact.decision_process import DecisionProcess
from bbsd.expression.graph import evaluate, needed
from experiments.designs import spec_path

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from bbsd.evaluation.statistics import Optimum
    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning.meaning import Meaning

TASKS = ("lake", "lake_8x8", "cliff_walking", "taxi", "four_rooms")
MAX_STATES = 20_000
"""About a minute: a state takes some milliseconds."""

State = tuple[Any, ...]
"""A value for each slot that the future depends on."""


class NoFiniteProcess(Exception):
    """A task that is no Markov decision process with finitely many states; the message says why."""


class _UndrawnError(Exception):
    """A draw whose value is not given: the number of its node, and its values with their probabilities."""

    def __init__(self, number: int, values: Sequence[tuple[float, Any]]) -> None:
        super().__init__()
        self.number, self.values = number, values


@dataclass(frozen=True)
class Step:
    """What a step of a task computes, and the slots that the future depends on."""

    constants: Sequence[float]
    reward: tuple[Node, ...]
    ends: tuple[Node, ...]
    excited: tuple[Node, ...]
    """For each action of all behaviors, whether its behavior is excited."""
    start: Mapping[Slot, Node]
    after: Mapping[Slot, Node]
    fresh: frozenset[Slot]
    """Slots that are drawn anew in every step, unknown when it is decided."""
    slots: tuple[Slot, ...]

    def starts(self) -> Iterator[tuple[float, State]]:
        """Yield all states that an episode may begin with, and their probabilities."""
        for probability, values in self.possible([self.start[slot] for slot in self.slots], {}):
            yield probability, tuple(values)

    def choices(self, state: State) -> list[int]:
        """Return what can be done in a state: 0 is no action; the actions of all behaviors are counted from 1."""
        excited = evaluate(self.excited, self._leaf(self._known(state), 0, {}))
        return [0, *(action for action, can in enumerate(excited, start=1) if can)]

    def outcomes(self, state: State, choice: int) -> Iterator[tuple[float, float, State | None]]:
        """Yield probability, reward and next state of all that a choice may lead to; None where the episode ends."""
        n_reward, n_now = len(self.reward), len(self.reward) + len(self.ends)
        nodes = [*self.reward, *self.ends, *(self.after[slot] for slot in self.slots)]
        for probability, values in self.possible(nodes, self._known(state), choice):
            over = any(values[n_reward:n_now])
            yield probability, float(sum(values[:n_reward])), None if over else tuple(values[n_now:])

    def possible(
        self,
        nodes: Sequence[Node],
        known: Mapping[Slot, Any],
        choice: int = 0,
        drawn: Mapping[int, Any] | None = None,
    ) -> Iterator[tuple[float, list[Any]]]:
        """Yield all values that nodes may have together, and their probabilities; `drawn` holds draws by number."""
        drawn = drawn or {}
        try:
            values = evaluate(nodes, self._leaf(known, choice, drawn))
        except _UndrawnError as draw:
            for probability, value in draw.values:
                given = {**drawn, draw.number: value}
                for rest, values in self.possible(nodes, known, choice, given):
                    yield probability * rest, values
        else:
            yield 1.0, values

    def _known(self, state: State) -> dict[Slot, Any]:
        return dict(zip(self.slots, state, strict=True))

    def _leaf(
        self, known: Mapping[Slot, Any], choice: int, drawn: Mapping[int, Any]
    ) -> Callable[[Node, list[Any]], Any]:
        """Return the function that gives the values of leaves; it raises _UndrawnError at a draw that is not given."""

        def value(node: Node, operands: list[Any]) -> Any:  # noqa: ANN401 - a number, a truth or a cell index
            match node.operation:
                case "choice":
                    return choice
                case "constant" | "gather":
                    return node.read(self.constants, operands)
                case "slot" if node.slot not in self.fresh:
                    return known[node.slot]
                case "step":
                    raise NoFiniteProcess("what happens depends on the step")
                case "slot":
                    node = self.start[node.slot]
                    operands = evaluate(node.operands, value)
            if node.number not in drawn:
                raise _UndrawnError(node.number, _values(node.draw.distribution, *operands))
            return drawn[node.number]

        return value


def _values(distribution: str, *arguments: float) -> list[tuple[float, Any]]:
    """Return the values of a distribution with their probabilities."""
    match distribution, arguments:
        case "chance", (probability,):
            return [(1.0 - probability, False), (probability, True)]
        case "integers", (first, last):
            count = int(last - first) + 1
            return [(1.0 / count, first + index) for index in range(count)]
    raise NoFiniteProcess(f"a value is drawn by {distribution}(...)")


def step_of(meaning: Meaning) -> Step:
    """Return what a step of a task computes. Raises NoFiniteProcess where it has several robots."""
    if meaning.spec.environment.robots > 1:
        raise NoFiniteProcess("it has several robots")
    episode = meaning.episode
    reward = tuple(node for nodes in episode.reward.values() for node in nodes)
    ends = () if episode.ends is None else (episode.ends,)
    excited = tuple(module.excited[0] for module in episode.modules for _ in module.actions)
    outputs = (*reward, *ends, *excited)
    fresh = frozenset(_fresh(meaning, outputs))
    return Step(
        meaning.constants.vector(generation=1), reward, ends, excited, episode.start, episode.after, fresh,
        tuple(_slots_behind(outputs, episode.after, fresh)),
    )  # fmt: skip


def _slots_behind(
    outputs: Iterable[Node], after: Mapping[Slot, Node], but: frozenset[Slot] = frozenset()
) -> dict[Slot, None]:
    """Return the slots that nodes depend on, now or in a later step."""
    slots: dict[Slot, None] = {}
    waiting = list(outputs)
    while waiting:
        read = [node.slot for node in needed(waiting) if node.operation == "slot"]
        new = dict.fromkeys(slot for slot in read if slot not in slots and slot not in but)
        slots |= new
        waiting = [after[slot] for slot in new]
    return slots


def _fresh(meaning: Meaning, outputs: Sequence[Node]) -> Iterator[Slot]:
    """Yield the slots that each step draws as the start does, of which nothing else tells before they are read."""
    start, after = meaning.episode.start, meaning.episode.after
    senses = [node for module in meaning.episode.modules for node in module.nodes]
    sensed = {node.slot for node in needed(senses) if node.operation == "slot"}
    slots = _slots_behind(outputs, after)
    for slot in slots:
        first, later = start[slot], after[slot]
        is_drawn = first.operation == later.operation == "draw" and slot not in sensed
        if is_drawn and first.draw.distribution == later.draw.distribution:
            arguments = [
                [meaning.constants.static(node) for node in draw.operands] for draw in (first, later)
            ]
            others = [after[other] for other in {*slots, *sensed} if other != slot]
            if arguments[0] == arguments[1] and None not in arguments[0] and later not in needed(others):
                yield slot


def process_of(step: Step) -> DecisionProcess:
    """Return the process with all states that can be reached. Raises NoFiniteProcess where there are too many."""
    numbers: dict[State, int] = {}
    waiting: list[State] = []

    def number(state: State) -> int:
        if state not in numbers:
            if len(numbers) == MAX_STATES:
                raise NoFiniteProcess(f"it has more than {MAX_STATES} states")
            numbers[state] = len(numbers)
            waiting.append(state)
        return numbers[state]

    starts = [(probability, number(state)) for probability, state in step.starts()]
    first_options: list[int] = []
    outcomes: list[tuple[int, int, float, float]] = []
    n_options = 0
    for state in waiting:  # grows while it is walked through
        first_options.append(n_options)
        for choice in step.choices(state):
            for probability, reward, then in step.outcomes(state, choice):
                next_state = -1 if then is None else number(then)
                outcomes.append((n_options, next_state, probability, reward))
            n_options += 1
    probabilities, states = np.array(starts).T
    options, targets, chances, rewards = np.array(outcomes).T
    return DecisionProcess(
        np.bincount(states.astype(np.int64), probabilities, len(first_options)).astype(np.float64),
        np.array(first_options),
        options.astype(np.int64),
        targets.astype(np.int64),
        chances,
        rewards,
    )


def optimum(path: Path) -> Optimum:
    """Return what can be earned in a task. Raises NoFiniteProcess."""
    meaning = bbsd.load(path).meaning
    return process_of(step_of(meaning)).optimum(meaning.spec.environment.steps)


def line(path: Path) -> tuple[str, bool]:
    """Return what can be earned in a task as text, and whether that is known."""
    try:
        known = optimum(path)
    except NoFiniteProcess as reason:
        return f"{path.stem:<14} no optimum by dynamic programming: {reason}", False
    return f"{path.stem:<14} {known.best:10.4f} {known.fixed:10.4f} {known.n_states:8}", True


def main() -> int:
    """Print the optima of the specs named as arguments, or of the tasks that have one; return 1 if one has none."""
    paths = [Path(name) for name in sys.argv[1:]] or [spec_path(f"tasks/{name}") for name in TASKS]
    print(f"{'':<14} {'at most':>10} {'fixed':>10} {'states':>8}", flush=True)
    found = True
    for path in paths:
        text, known = line(path)
        print(text, flush=True)
        found = found and known
    return 0 if found else 1


if __name__ == "__main__":
    sys.exit(main())
