"""The program of an agent: functions made once, of what one robot must be given and keeps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from bbsd.agent.inputs import complaint
from bbsd.agent.writing import KEY, STEP, Body, decision_lines, outcome_names
from bbsd.expression.nesting import by_name
from bbsd.kernel import functions, streams
from bbsd.kernel.primitives import INFINITY, NAN
from bbsd.language.meaning.tables.labels import Numbers

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence

    from bbsd.agent.inputs import AgentInput
    from bbsd.architecture.controller import Controller
    from bbsd.architecture.needs import RobotNeeds
    from bbsd.expression.node_data import Slot, Variable

Scalar = float | bool | int
Kept = tuple[Scalar, ...]
"""What an agent keeps from one step to the next."""
SetValue: TypeAlias = "float | bool | str | list[SetValue]"
ACT = "Act"


class Act(NamedTuple):
    """What an agent does: an action by its number (0, and no behavior, where nobody controls), and what it sets.

    `sets` has the new values of state by name: of a list all of it, as nested lists; but single elements, as
    `waiting[2]`, where an action can set only these.
    """

    number: int
    """The action's number in the whole design, from 1; 0 where nobody controls."""
    behavior: str | None
    """The behavior in control."""
    action: str | None
    """Its action."""
    sets: dict[str, SetValue]
    """What the action sets, by the state's name."""


@dataclass(frozen=True, slots=True)
class Program:
    """What a program of one robot is written from.

    `values` names, in the functions, the slots that are read; first those of the inputs in their order, then `kept`.
    """

    controller: Controller
    robot: int
    needs: RobotNeeds
    inputs: Mapping[str, AgentInput]
    kept: tuple[Slot, ...]
    start: Kept
    """What is kept before the first step."""
    constants: Sequence[float]
    named: Mapping[str, tuple[str, ...]]
    """The names of values of state, by what has them."""
    lengths: Mapping[str, tuple[int, ...]]
    """The lengths of lists, by the names of what is set or kept; () for a single value."""

    @property
    def values(self) -> dict[Slot, str]:
        """The names of the values that functions read, by slot."""
        given = [slot for each in self.inputs.values() for slot in each.slots]
        names = {slot: f"x{index}" for index, slot in enumerate(given)}
        return names | {slot: f"m{index}" for index, slot in enumerate(self.kept)}

    @property
    def arguments(self) -> str:
        """The arguments that all functions have."""
        return ", ".join([*self.values.values(), STEP, KEY])

    def body(self, used: set[str]) -> Body:
        """Return an empty function."""
        return Body(self.values, self.constants, used)


def plain_functions(
    program: Program, known: Collection[str], not_finite: Callable[[str, float], float]
) -> dict[str, Any]:
    """Return the functions of an agent, by name, as plain Python.

    `run(given, kept, step, key)` returns an Act, what is kept then, and the values of the inputs in order;
    `cells(*values, *kept, step, key)` the index of the present cell of each dimension that is used.

    Args:
        program: What they are written from.
        known: Names that may be given; those that are no inputs are not looked at.
        not_finite: Returns what to use for an input's value that is not finite, or raises.
    """
    used = set[str]()
    lines = [
        f"def decide({program.arguments}):",
        *_decision(program, used),
        *(line for number in (0, *program.needs.sets) for line in _outcome(program, number, used)),
        f"def cells({program.arguments}):",
        *_cells(program, used),
        *_run(program),
    ]
    namespace: dict[str, Any] = {name: _function(name) for name in used}
    namespace |= {"Act": Act, "INFINITY": INFINITY, "NAN": NAN, "CONSTANTS": list(program.constants)}
    namespace |= {f"TABLE_{layer.number}": layer.table for layer in program.controller.layers}
    for index, each in enumerate(program.inputs.values()):
        namespace[f"read_{index}"] = _reader(each, not_finite)
        if _is_looked_up(each):
            stored = float if each.kind == "name" else int
            namespace[f"labels_{index}"] = {label: stored(cell) for cell, label in enumerate(each.cells)}

    def complain(given: Mapping[str, Any]) -> None:
        problem = complaint(program.inputs, known, given)
        if problem is not None:
            raise problem from None

    namespace |= {"complain": complain, "KNOWN": frozenset(known)}
    exec(compile("\n".join(lines), f"<agent of {program.controller.name}>", "exec"), namespace)  # noqa: S102 - own text
    numbers = range(len(program.controller.actions) + 1)
    namespace["OUTCOMES"] = [namespace.get(f"outcome_{number}") for number in numbers]
    return namespace


def _function(name: str) -> Callable[..., Any]:
    home = functions if hasattr(functions, name) else streams
    function: Callable[..., Any] = getattr(home, name)
    return function


def _decision(program: Program, used: set[str]) -> list[str]:
    body = program.body(used)
    decision_lines(program.controller, program.needs, body)
    return body.lines


def _as_set(variable: Variable, text: str, program: Program) -> str:
    """Return the expression of a value that is set, as the program is told it: a number or a truth, or a name."""
    names = program.named.get(variable[0])
    return f"{names!r}[int({text})]" if names else text


def _cells(program: Program, used: set[str]) -> list[str]:
    body = program.body(used)
    names = [body.text(node) for node in program.needs.cells.values()]
    body.say(f"return ({''.join(f'{name}, ' for name in names)})")
    return body.lines


def _outcome(program: Program, number: int, used: set[str]) -> list[str]:
    """Return the function of what happens after an action: the Act, and what is kept."""
    body = program.body(used)
    outcome = outcome_names(program.needs, number, program.kept, body)
    behavior, action = None, None
    if number:
        behavior, action = (
            program.controller.actions[number - 1].behavior,
            program.controller.actions[number - 1].name,
        )
    texts = [_as_set(variable, text, program) for variable, text in outcome.sets.items()]
    named = by_name([*outcome.sets], texts, program.lengths, lambda items: f"[{', '.join(items)}]")
    sets = ", ".join(f"{name!r}: {text}" for name, text in named.items())
    kept = "".join(f"{text}, " for text in outcome.kept)
    body.say(f"return {ACT}({number}, {behavior!r}, {action!r}, {{{sets}}}), ({kept})")
    return [f"def outcome_{number}({program.arguments}):", *body.lines]


def _run(program: Program) -> list[str]:
    """Return the function that reads what is given, decides, and says what comes of it."""
    lines = [f"def run(given, kept, {STEP}, {KEY}):"]
    names, reads, first = [*program.values.values()], list[str](), 0
    for index, each in enumerate(program.inputs.values()):
        own = names[first : first + each.size]
        first += each.size
        lines.append(f"        {_pattern(own, each.shape)} = given[{each.name!r}]")
        for name, called in zip(own, each.called, strict=True):
            reads += _read(index, each, name, called)
    if program.inputs:
        lines.insert(1, "    try:")
        lines += [
            "    except (KeyError, TypeError, ValueError, IndexError):",
            "        complain(given)",
            "        raise",
        ]
    n = len(program.inputs)
    lines += [f"    if len(given) != {n} and not KNOWN.issuperset(given):", "        complain(given)", *reads]
    if program.kept:
        lines.append(f"    {''.join(f'{name}, ' for name in names[first:])}= kept")
    lines += [
        f"    act, kept = OUTCOMES[decide({program.arguments})]({program.arguments})",
        f"    return act, kept, ({''.join(f'{name}, ' for name in names[:first])})",
    ]
    return lines


def _pattern(names: Sequence[str], shape: tuple[int, ...]) -> str:
    """Return the names as they stand in lists of a shape, for an assignment that takes these apart."""
    if not shape:
        return names[0]
    size = len(names) // shape[0]
    parts = [_pattern(names[place * size : (place + 1) * size], shape[1:]) for place in range(shape[0])]
    return f"({''.join(f'{part}, ' for part in parts)})"


def _read(index: int, each: AgentInput, name: str, called: str) -> list[str]:
    """Return what makes sure of a value's kind; most often, it is a comparison or two."""
    match each.kind:
        case "number":
            is_other = f"type({name}) is not float or {name} - {name} != 0.0"
        case "whole number":
            is_other = f"type({name}) is not float or {name} % 1.0 != 0.0"
        case "truth":
            is_other = f"{name} is not True and {name} is not False"
        case "cell" | "name":
            if not _is_looked_up(each):
                return [f"    {name} = read_{index}({name}, {called!r})"]
            looked_up = f"labels_{index}[{name}] if type({name}) is str and {name} in labels_{index}"
            return [f"    {name} = {looked_up} else read_{index}({name}, {called!r})"]
    return [f"    if {is_other}:", f"        {name} = read_{index}({name}, {called!r})"]


def _is_looked_up(each: AgentInput) -> bool:
    return each.kind in ("cell", "name") and not isinstance(each.cells, Numbers)


def _reader(each: AgentInput, not_finite: Callable[[str, float], float]) -> Callable[[object, str], Scalar]:
    def read(value: object, called: str) -> Scalar:
        found = each.read(value, called)
        return not_finite(called, found) if isinstance(found, float) and found - found != 0.0 else found

    return read
