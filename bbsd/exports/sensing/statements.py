"""The functions that start a robot and take a step, as statements."""

from __future__ import annotations

import re
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from bbsd.architecture.needs import BEFORE
from bbsd.exports.c import comment
from bbsd.exports.described import sets_text
from bbsd.exports.sensing.emission import PLAIN, Block
from bbsd.exports.sensing.text import TYPES
from bbsd.expression.graph import Level
from bbsd.expression.node_data import Slot, Variable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from bbsd.architecture.needs import RobotNeeds
    from bbsd.exports.c import Writing
    from bbsd.exports.sensing.program import Program
    from bbsd.exports.sensing.text import Text
    from bbsd.expression.graph import Node

NAME = re.compile(r"(?<![\w>.])[A-Za-z_]\w*")
"""A name that is no member of a struct."""
INDENT = "    "


class Statements(NamedTuple):
    """The statements of both functions, and what they use."""

    start: list[str]
    step: list[str]
    uses_robot: bool
    """Whether it matters which robot of the team it is."""
    steps_use_robot: bool
    """Whether that matters after the start."""
    counts_steps: bool
    """Whether anything depends on the step's number."""


def statements_of(program: Program, writing: Writing) -> Statements:
    """Return the statements that start a robot's memory and that take a step."""
    start, step = _start(program), _step(program, writing)
    in_step = names_in(step)
    uses_robot = "robot" in in_step | names_in(start)
    return Statements(start, step, uses_robot, "robot" in in_step, "step" in in_step)


def names_in(lines: Iterable[str]) -> set[str]:
    """Return the names that statements use, without those in comments."""
    code = (line for line in lines if not line.lstrip().startswith(("/*", "*")))
    return {name for line in code for name in NAME.findall(line)}


def _family(program: Program, slot: Slot, of: Callable[[RobotNeeds, Slot], Node | None]) -> Node:
    """Return the node of all robots for what each keeps in a slot; what one does not keep, stays."""
    needs, graph = program.needs, program.needs.graph
    family: list[Node] = []
    for robot, own in enumerate(needs.robots):
        place = slot if slot.robot is None else slot._replace(robot=robot)
        node = of(own, place)
        family.append(graph.leaf("slot", place, program.kind_of(place), Level.LANE) if node is None else node)
    return program.team.node(family)


def _start(program: Program) -> list[str]:
    """Return what gives the memory its start: state by its starting values, all else is not read in the first step."""
    block = Block(program.namer.inner())
    slots = list(dict.fromkeys(slot._replace(robot=0) for own in program.needs.robots for slot in own.start))
    nodes = [_family(program, slot, lambda own, place: own.start.get(place)) for slot in slots]
    texts = program.emitter.texts(nodes, block)
    stores = [
        f"memory->{program.memory.place(slot, 'robot')} = {text.source};"
        for slot, text in zip(slots, texts, strict=True)
    ]
    return [*block.lines, *stores]


def _step(program: Program, writing: Writing) -> list[str]:
    block = Block(program.namer.inner())
    lines = _decide(program, writing, block)
    lines += _act(program, writing, block)
    return [*lines, *_keep(program, block), "return action;"]


def _decide(program: Program, writing: Writing, block: Block) -> list[str]:
    """Return the statements that compute the cells and the action."""
    axes = [*program.needs.robots[0].cells]
    nodes = [program.team.node(own.cells[axis] for own in program.needs.robots) for axis in axes]
    for axis, node in zip(axes, nodes, strict=True):
        dimension = program.controller.dimensions[axis]
        if node.operation not in PLAIN and node.number not in program.emitter.hints:
            program.emitter.hints[node.number] = writing.parameters[axis]
            program.emitter.comments[writing.parameters[axis]] = f"{dimension.name}: {dimension.text}"
    texts = dict(zip(axes, program.emitter.texts(nodes, block), strict=True))
    arguments = [_as_cell(texts.get(axis)) for axis in range(len(program.controller.dimensions))]
    call = f"{writing.prefix}_command({', '.join(arguments)})"
    return [*block.lines, f"const enum {writing.prefix}_action action = {call};"]


def _as_cell(text: Text | None) -> str:
    """Return an argument of the function that decides; what it does not look at is 0."""
    if text is None:
        return "0U"
    return f"(unsigned){text.source}" if NAME.fullmatch(text.source) else f"(unsigned)({text.source})"


def _act(program: Program, writing: Writing, block: Block) -> list[str]:
    """Return the statements that set what the action sets; what it does not set stays."""
    robots, team = program.needs.robots, program.team
    held = Block(block.namer, [], block.texts)
    nodes = [team.node(own.held[variable] for own in robots) for variable in robots[0].held]
    texts = program.emitter.texts(nodes, held)
    lines = [
        *held.lines,
        *(_set(program, variable, text) for variable, text in zip(robots[0].held, texts, strict=True)),
    ]
    cases = [line for number in robots[0].sets for line in _case(program, writing, block, number)]
    if not cases:
        return lines
    return [*lines, "switch (action) {", *cases, "default:", f"{INDENT}break;", "}"]


def _case(program: Program, writing: Writing, block: Block, number: int) -> list[str]:
    robots, team, inner = program.needs.robots, program.team, block.inner()
    targets = [*robots[0].sets[number]]
    nodes = [team.node(own.sets[number][variable] for own in robots) for variable in targets]
    texts = program.emitter.texts(nodes, inner)
    body = [*inner.lines, *map(partial(_set, program), targets, texts)]
    action = program.controller.actions[number - 1]
    return [
        f"case {writing.actions[number]}: {{",
        *(f"{INDENT}{line}" for line in [*comment(sets_text(action)), *body, "break;"]),
        "}",
    ]


def _set(program: Program, variable: Variable, text: Text) -> str:
    name, place = variable
    return f"outputs->{program.outputs.place(Slot(name, 0, place), 'robot')} = {text.source};"


def _keep(program: Program, block: Block) -> list[str]:
    """Return the statements that write the memory: all is computed before anything is overwritten."""
    inner = Block(block.namer, [], block.texts)
    places = list(_kept_places(program))
    nodes = [node for _, node in places]
    texts = program.emitter.texts(nodes, inner)
    lines, stores = inner.lines, list[str]()
    for (place, node), text in zip(places, texts, strict=True):
        source = text.source
        if _reads_memory(node, text):
            source = inner.namer.numbered("next")
            lines.append(f"const {TYPES[node.kind]} {source} = {text.source};")
        stores.append(f"memory->{place} = {source};")
    return [*lines, *stores]


def _reads_memory(node: Node, text: Text) -> bool:
    return not node.literal and "memory->" in text.source


def _kept_places(program: Program) -> Sequence[tuple[str, Node]]:
    """Return what is kept, as the member with its indices, and the node of what it becomes."""
    places: dict[str, Node] = {}
    kept = [(robot, slot) for robot, own in enumerate(program.needs.robots) for slot in own.next]
    for robot, slot in sorted(kept, key=lambda entry: entry[1].name.startswith(BEFORE)):
        if slot.name in program.memory.of_team and slot.robot is not None:
            family = [program.needs.robots[robot].next[slot]] * len(program.needs.robots)
            places.setdefault(str(program.memory.place(slot, str(slot.robot))), program.team.node(family))
        else:
            node = _family(program, slot, lambda own, place: own.next.get(place))
            places.setdefault(str(program.memory.place(slot, "robot")), node)
    return list(places.items())
