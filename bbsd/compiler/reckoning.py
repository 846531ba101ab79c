"""What a rollout adds up: returns, credit by who controlled, and for an evaluation terms, control and odd values."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from bbsd.compiler.frame import Detail
from bbsd.compiler.naming import slot_text
from bbsd.expression.graph import Kind, Level

if TYPE_CHECKING:
    from bbsd.compiler.deciding import Decision
    from bbsd.compiler.emission import Emitter
    from bbsd.compiler.frame import Frame
    from bbsd.spec.meaning import Meaning
    from bbsd.spec.meaning.names import Slot

DETAILED = ("terms", "control", "taken", "odd", "held")


@dataclass
class Reckoning:
    """Writes the sums over an episode."""

    frame: Frame
    decision: Decision

    @cached_property
    def total(self) -> str:
        """The array of the return."""
        return self.frame.keep("total")

    @cached_property
    def credit(self) -> list[str]:
        """The arrays of each behavior's credit, the last one nobody's."""
        return [self.frame.keep(f"credit_{name}") for name in self._who]

    @property
    def _who(self) -> list[str]:
        return [*(shape.name for shape in self.frame.shapes), "nobody"]

    @cached_property
    def details(self) -> dict[str, list[str]]:
        """Arrays of what a detailed rollout adds up, by the argument that they are written to."""
        frame = self.frame
        if frame.detail is Detail.CREDIT:
            return {}
        return {
            "terms": [frame.keep(f"sum_{term}") for term in frame.episode.reward],
            "control": [frame.keep(f"steps_{name}") for name in self._who],
            "odd": [frame.keep(f"odd_{slot_text(slot, frame.robots)}") for slot in odd_slots(frame.meaning)],
            "taken": [frame.keep("taken_")],
            "held": [frame.keep(f"held_{name}") for name in frame.episode.expects],
        }

    def start(self) -> list[str]:
        """All sums at 0."""
        details = [name for names in self.details.values() for name in names]
        return [f"{name}[lane] = 0.0" for name in (self.total, *self.credit, *details)]

    def add(self, emitter: Emitter) -> None:
        """Add a step's reinforcement: what each robot earned goes to what controlled it."""
        lines, earned = emitter.blocks[Level.LANE].lines, self._earned_by_robot(emitter)
        team = earned[0] if len(earned) == 1 else f"({' + '.join(earned)})"
        lines.append(f"{self.total}[lane] = {self.total}[lane] + {team}")
        for index, name in enumerate(self.credit):
            for robot, each in enumerate(earned):
                more = f"{name}[lane] + {each}"
                kept = self.frame.call_of(
                    "select", self.decision.controls(index, robot), more, f"{name}[lane]"
                )
                lines.append(f"{name}[lane] = {kept}")

    def _earned_by_robot(self, emitter: Emitter) -> list[str]:
        """The names of what the robots earned; the mean over robots is taken once, at the end of the episode."""
        frame = self.frame
        self.earned = {
            (term, robot): emitter.named(nodes[robot], f"reward_{frame.robots_name(term, robot)}")
            for robot in range(frame.robots)
            for term, nodes in frame.episode.reward.items()
        }
        names = [frame.namer(frame.robots_name("earned", robot)) for robot in range(frame.robots)]
        for robot, name in enumerate(names):
            earned = " + ".join(self.earned[term, robot] for term in frame.episode.reward)
            emitter.blocks[Level.LANE].lines.append(f"{name} = {frame.while_running(earned)}")
        return names

    def _per_robot(self, text: str) -> str:
        robots = self.frame.robots
        return text if robots == 1 else self.frame.call_of("divide", text, str(float(robots)))

    def _if_controls(self, index: int, robot: int, text: str) -> str:
        return self.frame.call_of("select", self.decision.controls(index, robot), text, "0.0")

    def add_details(self, emitter: Emitter) -> None:
        """Add what an evaluation reports: terms, steps of control, steps taken, values that are not finite."""
        frame, lines = self.frame, emitter.blocks[Level.LANE].lines
        robots, step = range(frame.robots), "1.0" if frame.running is None else f"{frame.running}[lane]"
        for term, name in zip(frame.episode.reward, self.details["terms"], strict=True):
            parts = [frame.while_running(self.earned[term, robot]) for robot in robots]
            lines.append(_added(name, parts))
        for index, name in enumerate(self.details["control"]):
            lines.append(_added(name, [self._if_controls(index, robot, step) for robot in robots]))
        for slot, name in zip(odd_slots(frame.meaning), self.details["odd"], strict=True):
            finite = frame.call_of("is_finite", emitter.value(frame.episode.after[slot]))
            lines.append(_added(name, [frame.call_of("select", finite, "0.0", step)]))
        lines.append(_added(self.details["taken"][0], [step]))
        names = [shape.name for shape in frame.shapes]
        for (behavior, nodes), name in zip(frame.episode.expects.items(), self.details["held"], strict=True):
            index, holds = names.index(behavior), [emitter.value(node) for node in nodes]
            steps = [frame.call_of("select", text, step, "0.0") for text in holds]
            lines.append(_added(name, [self._if_controls(index, robot, steps[robot]) for robot in robots]))

    def record(self, emitter: Emitter) -> None:
        """Note everything of a step in its row of the record."""
        frame = self.frame
        columns = [
            *(emitter.value(node) for node in frame.episode.after.values()),
            *(emitter.value(node) for node in frame.traced_definitions.values()),
            *frame.actions,
            *self._expectations(emitter),
            *(self.earned[term, robot] for term in frame.episode.reward for robot in range(frame.robots)),
        ]
        lines = [f"record[step - 1, {column}] = {text}" for column, text in enumerate(columns)]
        emitter.blocks[Level.LANE].lines += lines

    def _expectations(self, emitter: Emitter) -> list[str]:
        """For each robot 2 where what the controlling one expects holds, 1 where not, 0 where it expects nothing."""
        frame, names = self.frame, [shape.name for shape in self.frame.shapes]
        if not frame.episode.expects:
            return []
        return [
            " + ".join(
                self._if_controls(
                    names.index(behavior),
                    robot,
                    frame.call_of("select", emitter.value(nodes[robot]), "2.0", "1.0"),
                )
                for behavior, nodes in frame.episode.expects.items()
            )
            for robot in range(frame.robots)
        ]

    def finish(self) -> list[str]:
        """Write the sums to where the caller reads them."""
        lines = [f"returns[base + lane] = {self._per_robot(f'{self.total}[lane]')}"]
        lines += [
            f"credit[{index}, base + lane] = {self._per_robot(f'{name}[lane]')}"
            for index, name in enumerate(self.credit)
        ]
        for argument, names in self.details.items():
            for index, name in enumerate(names):
                place = "base + lane" if argument == "taken" else f"{index}, base + lane"
                kept = f"{name}[lane]"
                lines.append(
                    f"{argument}[{place}] = {self._per_robot(kept) if argument == 'terms' else kept}"
                )
        return lines


def odd_slots(meaning: Meaning) -> list[Slot]:
    """The places at which a detailed rollout counts values that are not finite."""
    return [slot for slot, node in meaning.episode.after.items() if node.kind is Kind.NUMBER]


def _added(name: str, parts: list[str]) -> str:
    return f"{name}[lane] = {' + '.join([f'{name}[lane]', *parts])}"
