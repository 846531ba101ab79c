"""Sums over an episode: returns and credit; for an evaluation also terms, control, steps and unusual values."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby
from typing import TYPE_CHECKING

from bbsd.compiler.details import Detail, checked_slots, traced_definitions
from bbsd.compiler.writing.precedence import ATOM, sum_of, times
from bbsd.compiler.writing.rollout_function import OWN
from bbsd.expression.graph import value_of

if TYPE_CHECKING:
    from bbsd.compiler.writing.arbitration import Arbitration
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.compiler.writing.rollout_function import RolloutFunction
    from bbsd.compiler.writing.schedule import Closing
    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot

MOST_NESTED = 3
"""Sums of a line."""
DETAILED = ("terms", "control", "steps_taken", "not_finite", "expectations_met")


@dataclass
class Totals:
    """Writes the sums over an episode."""

    function: RolloutFunction
    arbitration: Arbitration
    earned: dict[tuple[str, int], str] = field(default_factory=dict)
    """What each term gave each robot in a step, where it has a name."""

    @cached_property
    def total(self) -> str:
        """The array of the return."""
        return self.function.keep("total")

    @cached_property
    def credit(self) -> list[str]:
        """The arrays of each behavior's credit, the last one nobody's."""
        return [self.function.keep(f"credit_{name}") for name in self._who]

    @property
    def _who(self) -> list[str]:
        return [*(shape.name for shape in self.function.shapes), "nobody"]

    @cached_property
    def details(self) -> dict[str, list[str]]:
        """Arrays of what a detailed rollout adds up, by the argument that they are written to."""
        function = self.function
        if function.detail is Detail.CREDIT:
            return {}
        return {
            "terms": [function.keep(f"sum_{term}") for term in function.episode.reward],
            "control": [function.keep(f"steps_{name}") for name in self._who],
            "steps_taken": [function.keep("steps_taken_")],
            "expectations_met": [function.keep(f"met_{name}") for name in function.episode.expects],
        }

    @cached_property
    def not_finite(self) -> dict[Slot, str]:
        """The arrays that count the steps in which a slot's value was not finite."""
        function = self.function
        if function.detail is Detail.CREDIT:
            return {}
        return {slot: self._count_of(slot) for slot in checked_slots(function.episode)}

    def _count_of(self, slot: Slot) -> str:
        wanted = f"not_finite_{slot.text(self.function.robots)}"
        return self.function.keep(wanted, level=self.function.episode.after[slot].level)

    def start(self) -> list[list[str]]:
        """All sums at 0: the team's, and each robot's."""
        details = [name for names in self.details.values() for name in names]
        names = [self.total, *self.credit, *details, *self.not_finite.values()]
        return [
            [f"{self.function.at(name)} = 0.0" for name in names if self.function.is_own(name) is own]
            for own in (False, True)
        ]

    def add(self, emitter: Emitter, end: Closing) -> None:
        """Add a step's reinforcement: what each robot earned goes to what controlled it."""
        lines, earned = end.each.lines, self._earned_by_robot(emitter, end)
        end.team.lines.append(f"{self.total}[lane] = {self.total}[lane] + {self._team(earned, end)}")
        for index, name in enumerate(self.credit):
            for first in range(0, len(earned), MOST_NESTED):
                kept = f"{name}[lane]"
                for robot, each in [*enumerate(earned)][first : first + MOST_NESTED]:
                    controls = self._controls(index, robot, emitter, end)
                    kept = self.function.call_of("add_where", kept, controls, each)
                lines.append(f"{name}[lane] = {kept}")

    def add_uncertain(self, uncertain: str, emitter: Emitter, end: Closing) -> None:
        """Note that something was not certain, of a robot or of the team."""
        for own in (False, True):
            block = end.knowing(own=own)
            truths = [node for node in self.function.proven if (node.level in OWN) is own]
            for first in range(0, len(truths), MOST_NESTED):
                each = [emitter.value(node, block) for node in truths[first : first + MOST_NESTED]]
                proven = each[0] if len(each) == 1 else " & ".join(f"({text})" for text in each)
                more = self.function.while_running("1.0", f"{uncertain}[lane]")
                now = self.function.call_of("select", proven, f"{uncertain}[lane]", more)
                block.lines.append(f"{uncertain}[lane] = {now}")

    def _team(self, earned: list[str], end: Closing) -> str:
        """What the team earned: its robots' sum, the first one's first."""
        if self.function.looped:
            together = self.function.keep("team_earned")
            more = self.function.call_of("select", "robot == 0", earned[0], f"{together}[lane] + {earned[0]}")
            end.each.lines.append(f"{together}[lane] = {more}")
            return f"{together}[lane]"
        return earned[0] if len(earned) == 1 else f"({' + '.join(earned)})"

    def _controls(self, index: int, robot: int, emitter: Emitter, end: Closing) -> str:
        """Whether a behavior controls a robot, where a step is reckoned up."""
        emitter.value(self.function.episode.choices[robot], end.each)
        return self.arbitration.controls(index, robot)

    def _earned_by_robot(self, emitter: Emitter, end: Closing) -> list[str]:
        """The names of what the robots earned; the mean over robots is taken once, at the end of the episode."""
        function = self.function
        names = [function.namer(function.robots_name("earned", robot)) for robot in range(function.robots)]
        for robot, name in enumerate(names):
            earned = self._sum_of_terms(robot, emitter, end)
            end.each.lines.append(f"{name} = {function.while_running(earned)}")
        return names

    def _sum_of_terms(self, robot: int, emitter: Emitter, end: Closing) -> str:
        """What a robot earned: its terms, the first one's first.

        Where only credit is asked for, terms that are mostly 0 are added where they are not. That may leave a -0.0
        where 0.0 was; added to sums that begin with 0.0 it is the same.
        """
        function, so_far, nested = self.function, "", 0
        for term, nodes in function.episode.reward.items():
            node, wanted = nodes[robot], f"reward_{function.robots_name(term, robot)}"
            if so_far and function.detail is Detail.CREDIT and _is_sometimes(node):
                if nested == MOST_NESTED:
                    name, nested = function.namer.numbered("so_far"), 0
                    end.each.assign(name, so_far)
                    so_far = name
                condition, value, _ = (emitter.value(operand, end.each) for operand in node.operands)
                so_far, nested = function.call_of("add_where", so_far, condition, value), nested + 1
            else:
                self.earned[term, robot] = emitter.named(node, wanted, end.each)
                so_far = f"{so_far} + {self.earned[term, robot]}" if so_far else self.earned[term, robot]
        return so_far

    def _per_robot(self, text: str) -> str:
        robots = self.function.team
        return text if robots == 1 else self.function.call_of("divide", text, str(float(robots)))

    def add_details(self, emitter: Emitter, end: Closing) -> None:
        """Add what an evaluation reports: terms, steps of control, steps taken, values that are not finite."""
        function, lines = self.function, end.each.lines
        robots, step = (
            range(function.robots),
            "1.0" if function.running is None else f"{function.running}[lane]",
        )
        for term, name in zip(function.episode.reward, self.details["terms"], strict=True):
            parts = [function.while_running(self.earned[term, robot]) for robot in robots]
            lines.append(_added(name, parts))
        for index, name in enumerate(self.details["control"]):
            controls = [self._controls(index, robot, emitter, end) for robot in robots]
            lines.append(_added(name, [self._if(each, step) for each in controls]))
        for slot, name in self.not_finite.items():
            block = end.knowing(own=function.is_own(name))
            finite = function.call_of("is_finite", emitter.value(function.episode.after[slot], block))
            more = function.call_of("select", finite, "0.0", step)
            block.lines.append(f"{function.at(name)} = {function.at(name)} + {more}")
        end.team.lines.append(_added(self.details["steps_taken"][0], [step]))
        for name, (index, nodes) in zip(self.details["expectations_met"], self._expected, strict=True):
            met = [self._if(emitter.value(node, end.each), step) for node in nodes]
            controls = [self._controls(index, robot, emitter, end) for robot in robots]
            lines.append(
                _added(name, [self._if(each, text) for each, text in zip(controls, met, strict=True)])
            )

    @property
    def _expected(self) -> list[tuple[int, tuple[Node, ...]]]:
        """The behaviors that expect something, and what, robot by robot."""
        names = [shape.name for shape in self.function.shapes]
        return [(names.index(behavior), nodes) for behavior, nodes in self.function.episode.expects.items()]

    def _if(self, condition: str, text: str) -> str:
        return self.function.call_of("select", condition, text, "0.0")

    def record(self, emitter: Emitter, end: Closing) -> None:
        """Note everything of a step in its row of the record."""
        function = self.function
        columns = [
            *(emitter.value(node, end.team) for node in function.episode.after.values()),
            *(emitter.value(node, end.team) for node in traced_definitions(function.episode).values()),
            *function.actions,
            *self._expectations(emitter, end),
            *(
                self.earned[term, robot]
                for term in function.episode.reward
                for robot in range(function.robots)
            ),
        ]
        end.team.lines += [f"record[step - 1, {column}] = {text}" for column, text in enumerate(columns)]

    def _expectations(self, emitter: Emitter, end: Closing) -> list[str]:
        """For each robot 2 where what the controlling one expects holds, 1 where not, 0 where it expects nothing."""
        if not self._expected:
            return []
        return [
            " + ".join(
                self._if(
                    self.arbitration.controls(index, robot),
                    self.function.call_of("select", emitter.value(nodes[robot], end.team), "2.0", "1.0"),
                )
                for index, nodes in self._expected
            )
            for robot in range(self.function.robots)
        ]

    def finish(self) -> list[str]:
        """Loops that write the sums to where the caller reads them."""
        lines = [f"returns[base + lane] = {self._per_robot(f'{self.total}[lane]')}"]
        lines += [
            f"credit[{index}, base + lane] = {self._per_robot(f'{name}[lane]')}"
            for index, name in enumerate(self.credit)
        ]
        for argument, names in self.details.items():
            for index, name in enumerate(names):
                place = "base + lane" if argument == "steps_taken" else f"{index}, base + lane"
                kept = f"{name}[lane]"
                lines.append(
                    f"{argument}[{place}] = {self._per_robot(kept) if argument == 'terms' else kept}"
                )
        own = list[str]()
        for name, row in self._not_finite_rows():
            into = own if self.function.is_own(name) else lines
            into.append(f"not_finite[{row}, base + lane] = {self.function.at(name)}")
        return [*self.function.lane_loop(lines), *(self.function.robot_loop([], [own]) if own else [])]

    def _not_finite_rows(self) -> list[tuple[str, str]]:
        """The arrays that count values that are not finite, each with its row among the places of an evaluation.

        Without loops over robots they are in order. With them an array is for all robots, whose rows follow one
        another, each robot's with those of all its elements.
        """
        function, found, first = self.function, list[tuple[str, str]](), 0
        for _, group in groupby(self.not_finite.items(), lambda entry: entry[0][:2]):
            arrays = list(group)
            robots = function.team if function.looped and arrays[0][0][1] is not None else 1
            for element, (_, name) in enumerate(arrays):
                if function.is_own(name):
                    row = sum_of([(str(first + element), ATOM), times(len(arrays), ("robot", ATOM))])
                    found.append((name, row[0]))
                else:
                    found += [(name, str(first + element + k * len(arrays))) for k in range(robots)]
            first += robots * len(arrays)
        return found


def _is_sometimes(node: Node) -> bool:
    """Whether a term is 0 but where a condition holds."""
    return node.operation == "select" and node.operands[2].literal and value_of(node.operands[2]) == 0.0


def _added(name: str, parts: list[str]) -> str:
    return f"{name}[lane] = {' + '.join([f'{name}[lane]', *parts])}"
