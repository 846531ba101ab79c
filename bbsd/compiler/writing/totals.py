"""Sums over an episode: returns and credit; for an evaluation also terms, control, steps and values not finite."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate, groupby
from typing import TYPE_CHECKING

from bbsd.compiler.details import IN_DETAIL, Detail, checked_slots, traced_definitions, traced_slots
from bbsd.compiler.writing.deciding import deciding_numbers
from bbsd.compiler.writing.loop_fission import once_loops
from bbsd.compiler.writing.looping import FIRST_ROBOT
from bbsd.compiler.writing.precedence import Text, infix, join, name_text, sum_of, times
from bbsd.compiler.writing.rollout_function import ONE, OWN, ZERO, length_of
from bbsd.expression.graph import value_of
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.compiler.writing.arbitration import Arbitration
    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.compiler.writing.lists import Lists
    from bbsd.compiler.writing.practice import Practice
    from bbsd.compiler.writing.rollout_function import RolloutFunction
    from bbsd.compiler.writing.schedule import Closing
    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot

MOST_ADDED = 3
"""Conditional sums in one expression, so that lines can be read."""
MOST_TERMS = 30
"""Terms of a reward in one expression, so that the loop that adds them up need not read them all."""
DETAILED = ("terms", "control", "steps_taken", "not_finite", "expectations_met")
"""The arguments that a detailed rollout has besides, in their order."""


@dataclass
class Totals:
    """The statements that add up an episode."""

    function: RolloutFunction
    arbitration: Arbitration
    practice: Practice | None = None
    counted: str | None = None
    """The array of the steps that a step counts, where loops behind others need it."""
    earned: dict[tuple[str, int], Text] = field(default_factory=dict)
    """What each term gave each robot in a step, where it has a name."""

    @cached_property
    def total(self) -> str:
        """The array of the return."""
        return self.function.keep("total")

    @cached_property
    def credit(self) -> list[str]:
        """The arrays of each behavior's credit, the last one nobody's; practice gives credit in its own way."""
        if self.function.detail in (Detail.PRACTICE, Detail.WORLD):
            return []
        return [self.function.keep(f"credit_{name}") for name in self._controllers]

    @property
    def _controllers(self) -> list[str]:
        return [*(shape.name for shape in self.function.shapes), "nobody"]

    @cached_property
    def details(self) -> dict[str, list[str]]:
        """Arrays of what a detailed rollout adds up, by the argument that they are written to."""
        function = self.function
        if function.detail in (Detail.CREDIT, Detail.WORLD):
            return {}
        if function.detail is Detail.PRACTICE:
            return {"steps_taken": [function.keep("steps_taken_")]}
        return {
            "terms": [function.keep(f"sum_{term}") for term in function.episode.reward],
            "control": [function.keep(f"steps_{name}") for name in self._controllers],
            "steps_taken": [function.keep("steps_taken_")],
            "expectations_met": [function.keep(f"met_{name}") for name in function.episode.expects],
        }

    @cached_property
    def not_finite(self) -> dict[Slot, str]:
        """The arrays that count the steps in which a slot's value was not finite."""
        function = self.function
        if function.detail not in IN_DETAIL:
            return {}
        return {slot: self._count_of(slot) for slot in checked_slots(function.episode)}

    @cached_property
    def deciding(self) -> list[Node]:
        """The numbers besides slots that decide a cell or an index, where it is counted whether they are finite."""
        function = self.function
        if function.detail not in IN_DETAIL:
            return []
        return deciding_numbers(function.episode, function.outputs)

    @cached_property
    def undecided(self) -> list[str]:
        """The array that counts the steps in which one of those was not finite, if there are any."""
        return [self.function.keep("undecided")] if self.deciding else []

    def _count_of(self, slot: Slot) -> str:
        name, node = f"not_finite_{slot.text(self.function.robots)}", self.function.episode.after[slot]
        return self.function.keep(name, level=node.level, length=length_of(node))

    def _length(self, slot: Slot) -> int:
        return length_of(self.function.episode.after[slot])

    def start(self, team: Block, robot: Block, lists: Lists) -> None:
        """Store 0 in all sums: the team's, and each robot's in another block."""
        details = [array for arrays in self.details.values() for array in arrays]
        for array in [self.total, *self.credit, *details, *self.not_finite.values(), *self.undecided]:
            block = robot if self.function.is_own(array) else team
            if (length := self.function.memory.length_of(array)) > 1:
                lists.fill(array, length, ZERO)
            else:
                block.store(self.function.at(array), ZERO)

    def add(self, emitter: Emitter, end: Closing) -> None:
        """Add a step's reinforcement: what each robot earned goes to what controlled it."""
        function, earned = self.function, self._earned_by_robot(emitter, end)
        if self.practice is not None:
            self.practice.record_gains(earned, end)
        if function.detail is Detail.WORLD:
            for robot, text in enumerate(earned):
                end.each.store(f"earned[{robot}, lane]", text)
        self._add(end.team, self.total, [self._earned_by_team(earned, end)])
        for index, array in enumerate(self.credit):
            for first in range(0, len(earned), MOST_ADDED):
                credit = function.read(array)
                for robot, text in [*enumerate(earned)][first : first + MOST_ADDED]:
                    controls = self._controls(index, robot, emitter, end)
                    credit = function.call_of("add_where", credit, controls, text)
                end.each.store(function.at(array), credit)

    def add_uncertain(self, array: str, emitter: Emitter, end: Closing) -> None:
        """Record where something that is to be proven does not hold, of a robot or of the team."""
        function, uncertain = self.function, self.function.read(array)
        for own in (False, True):
            block = end.knowing(own=own)
            truths = [node for node in function.to_prove if (node.level in OWN) is own]
            for first in range(0, len(truths), MOST_ADDED):
                texts = [emitter.text(node, block) for node in truths[first : first + MOST_ADDED]]
                otherwise = function.while_running(ONE, uncertain)
                block.store(
                    function.at(array),
                    function.call_of("select", join("&", texts), uncertain, otherwise),
                )

    def _earned_by_team(self, earned: list[Text], end: Closing) -> Text:
        """Return what the team earned: its robots' sum, the first one's first."""
        function = self.function
        if function.looped:
            array = function.keep("team_earned")
            more = infix("+", function.read(array), earned[0])
            end.each.store(function.at(array), function.call_of("select", FIRST_ROBOT, earned[0], more))
            return function.read(array)
        return join("+", earned)

    def _controls(self, index: int, robot: int, emitter: Emitter, end: Closing) -> Text:
        """Return whether a behavior controls a robot, where a step's sums are added."""
        emitter.text(self.function.episode.choices[robot], end.each)
        return self.arbitration.controls(index, robot)

    def _earned_by_robot(self, emitter: Emitter, end: Closing) -> list[Text]:
        """Return what each robot earned; the mean over robots is taken once, at the end of the episode."""
        function = self.function
        names = [function.namer(function.robots_name("earned", robot)) for robot in range(function.robots)]
        return [
            end.each.define(name, function.while_running(self._sum_of_terms(robot, emitter, end)))
            for robot, name in enumerate(names)
        ]

    def _sum_of_terms(self, robot: int, emitter: Emitter, end: Closing) -> Text:
        """Return what a robot earned: its terms, the first one's first.

        Where only credit is asked for, terms that are mostly 0 are added where they are not. That may leave a -0.0
        where 0.0 was; added to sums that begin with 0.0 it is the same.
        """
        function, total, nested = self.function, None, 0
        for number, (term, nodes) in enumerate(function.episode.reward.items()):
            node = nodes[robot]
            if total is not None and number % MOST_TERMS == 0:
                total, nested = end.each.define(function.namer.numbered("so_far"), total), 0
            if total is not None and function.detail not in IN_DETAIL and _is_conditional(node):
                if nested == MOST_ADDED:
                    total, nested = end.each.define(function.namer.numbered("so_far"), total), 0
                condition, value, _ = (emitter.text(operand, end.each) for operand in node.operands)
                total, nested = function.call_of("add_where", total, condition, value), nested + 1
            else:
                name = f"reward_{function.robots_name(term, robot)}"
                earned = self.earned[term, robot] = emitter.repeatable(node, end.each, name)
                total = earned if total is None else infix("+", total, earned)
        return ZERO if total is None else total

    def _per_robot(self, text: Text) -> Text:
        robots = self.function.team
        return text if robots == 1 else self.function.call_of("divide", text, Text(str(float(robots))))

    def _add(self, block: Block, array: str, texts: Iterable[Text]) -> None:
        """Add values to a sum."""
        function = self.function
        block.store(function.at(array), join("+", [function.read(array), *texts]))

    def add_details(self, emitter: Emitter, end: Closing, lists: Lists) -> None:
        """Add what an evaluation reports: terms, steps of control, steps taken, values that are not finite."""
        function, robots, step = self.function, range(self.function.robots), self._step
        for term, array in zip(function.episode.reward, self.details["terms"], strict=True):
            self._add(end.each, array, [function.while_running(self.earned[term, robot]) for robot in robots])
        for index, array in enumerate(self.details["control"]):
            controls = [self._controls(index, robot, emitter, end) for robot in robots]
            self._add(end.each, array, [self._if(condition, step) for condition in controls])
        for slot, array in self.not_finite.items():
            block = end.knowing(own=function.is_own(array))
            if self._length(slot) > 1:
                lists.count(array, slot, self._step_kept(end))
                continue
            finite = function.call_of("is_finite", emitter.text(function.episode.after[slot], block))
            self._add(block, array, [function.call_of("select", finite, ZERO, step)])
        for array in self.undecided:
            self._add_undecided(array, emitter, end)
        self.add_step(end)
        for array, (index, nodes) in zip(self.details["expectations_met"], self._expected, strict=True):
            met = [self._if(emitter.text(node, end.each), step) for node in nodes]
            controls = [self._controls(index, robot, emitter, end) for robot in robots]
            self._add(end.each, array, map(self._if, controls, met))

    def _add_undecided(self, array: str, emitter: Emitter, end: Closing) -> None:
        """Count a step in which a number that decides something is not finite, of the team or of any robot."""
        function, of_team = self.function, self._decided(emitter, end, own=False)
        of_robots = self._decided(emitter, end, own=True)
        if function.looped and of_robots is not None:
            so_far = function.keep("robots_undecided")
            before = function.call_of("select", FIRST_ROBOT, ZERO, function.read(so_far))
            end.each.store(function.at(so_far), function.call_of("select", of_robots, before, ONE))
            of_robots = infix("==", function.read(so_far), ZERO)
        decided = join("&", [text for text in (of_team, of_robots) if text is not None])
        self._add(end.team, array, [function.call_of("select", decided, ZERO, self._step)])

    def _decided(self, emitter: Emitter, end: Closing, *, own: bool) -> Text | None:
        """Return whether all numbers that decide something, the team's or a robot's own, are finite; None: none do."""
        function, block, known = self.function, end.knowing(own=own), None
        nodes = [node for node in self.deciding if (node.level in OWN) is own]
        for first in range(0, len(nodes), MOST_ADDED):
            texts = [emitter.text(node, block) for node in nodes[first : first + MOST_ADDED]]
            finite = [function.call_of("is_finite", text) for text in texts]
            joined = join("&", finite if known is None else [known, *finite])
            known = block.define(function.namer.numbered("decided"), joined, Kind.TRUTH)
        return known

    @property
    def _step(self) -> Text:
        """The number of steps that a step counts: none once the lane's episode is over."""
        function = self.function
        return ONE if function.running is None else function.read(function.running)

    def _step_kept(self, end: Closing) -> Text:
        """Return the number of steps that a step counts, for loops behind what ends the episode."""
        if self.function.running is None:
            return ONE
        if self.counted is None:
            self.counted = self.function.keep("counted")
            end.team.store(self.function.at(self.counted), self._step)
        return self.function.read(self.counted)

    def add_step(self, end: Closing) -> None:
        """Count the step."""
        self._add(end.team, self.details["steps_taken"][0], [self._step])

    @property
    def _expected(self) -> list[tuple[int, tuple[Node, ...]]]:
        """The behaviors that expect something, and what they expect, robot by robot."""
        names = [shape.name for shape in self.function.shapes]
        return [(names.index(behavior), nodes) for behavior, nodes in self.function.episode.expects.items()]

    def _if(self, condition: Text, text: Text) -> Text:
        return self.function.call_of("select", condition, text, ZERO)

    def record(self, emitter: Emitter, end: Closing) -> None:
        """Write everything of a step into its row of the record."""
        function, episode = self.function, self.function.episode
        columns = [
            *(emitter.text(node, end.team) for node in traced_slots(episode).values()),
            *(emitter.text(node, end.team) for node in traced_definitions(episode).values()),
            *map(name_text, function.actions),
            *self._expectations(emitter, end),
            *(self.earned[term, robot] for term in episode.reward for robot in range(function.robots)),
        ]
        for column, text in enumerate(columns):
            end.team.store(f"record[step - 1, {column}]", text)

    def _expectations(self, emitter: Emitter, end: Closing) -> list[Text]:
        """Return for each robot 2 where its controlling behavior's expectation is met, 1 where not, 0 where none is."""
        if not self._expected:
            return []

        def outcome(index: int, node: Node, robot: int) -> Text:
            met = self.function.call_of("select", emitter.text(node, end.team), Text("2.0"), ONE)
            return self._if(self.arbitration.controls(index, robot), met)

        return [
            join("+", [outcome(index, nodes[robot], robot) for index, nodes in self._expected])
            for robot in range(self.function.robots)
        ]

    def finish(self, lists: Lists) -> list[str]:
        """Return loops that write the sums to where the caller reads them."""
        function = self.function
        lines = [f"returns[base + lane] = {self._per_robot(function.read(self.total)).source}"]
        lines += [
            f"credit[{index}, base + lane] = {self._per_robot(function.read(array)).source}"
            for index, array in enumerate(self.credit)
        ]
        for argument, arrays in self.details.items():
            for index, array in enumerate(arrays):
                row = "" if argument == "steps_taken" else f"{index}, "
                total = function.read(array)
                value = self._per_robot(total) if argument == "terms" else total
                lines.append(f"{argument}[{row}base + lane] = {value.source}")
        own_lines = list[str]()
        for array, first, length, of_robots in self._not_finite_rows():
            if length > 1:
                lists.take(array, first, length, of_robots=of_robots)
                continue
            into = own_lines if of_robots else lines
            into.append(f"not_finite[{first.source}, base + lane] = {function.at(array)}")
        loops = [*once_loops(lines, function), *(function.robot_loop([], [own_lines]) if own_lines else [])]
        return [*loops, *lists.written()]

    def _not_finite_rows(self) -> list[tuple[str, Text, int, bool]]:
        """Return the arrays that count values that are not finite, with rows, lengths, and whether each robot has one.

        Without loops over robots they are in order. With them an array is for all robots, whose rows follow one
        another, each robot's with those of all its elements.
        """
        function, rows, first = self.function, list[tuple[str, Text, int, bool]](), 0
        for _, group in groupby(self.not_finite.items(), lambda entry: entry[0][:2]):
            arrays = list(group)
            robots = function.team if function.looped and arrays[0][0][1] is not None else 1
            lengths = [self._length(slot) for slot, _ in arrays]
            for (_, array), length, before in zip(
                arrays, lengths, accumulate(lengths, initial=0), strict=False
            ):
                row = Text(str(first + before))
                if robots > 1:
                    row = sum_of([row, times(sum(lengths), Text("robot"))])
                rows.append((array, row, length, robots > 1))
            first += robots * sum(lengths)
        return [*rows, *((array, Text(str(first)), 1, False) for array in self.undecided)]


def _is_conditional(node: Node) -> bool:
    """Return whether a term is 0 but where a condition holds."""
    return node.operation == "select" and node.operands[2].literal and value_of(node.operands[2]) == 0.0
