"""Faults of behaviors, sensors and robots: how they are written, and the meaning of a spec under one.

A fault changes what a spec means before it is compiled, or the tables of a design; kernels know nothing of it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, TypeAlias

from bbsd.errors import UsageError, did_you_mean, escape
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.scope import Findings
from bbsd.language.meaning.episode.elaborating import elaborate_episode
from bbsd.language.meaning.episode.perceiving import SensorFault
from bbsd.language.meaning.naming.definitions import read_definitions
from bbsd.language.meaning.naming.names import Names

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.expression.graph import Graph, Node
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.models import Spec

Part: TypeAlias = Literal["behavior", "sensor", "robot"]
KINDS: dict[Part, tuple[str, ...]] = {
    "behavior": ("silent", "stuck", "random"),
    "sensor": ("noise", "frozen", "lost"),
    "robot": ("dead",),
}
"""The kinds of faults that each part of a design can have."""
LATE = ("stuck", "frozen")
"""Kinds that begin in the middle of an episode if no step is said: what lasts must have come to something."""
ALL = "all"
"""Stands for every behavior silent, one after the other."""
FORM = re.compile(
    r"(?P<part>\w+)=(?P<name>[^:]+):(?P<kind>\w+)(?:\((?P<size>[^()]*)\))?(?:@(?P<since>[^@]*))?"
)


class NoSuchFault(UsageError):
    """A fault that is not understood, or of something that the spec does not have."""

    advice = (
        "write behavior=NAME:silent (stuck, random), sensor=NAME:noise(SD) (frozen, lost), robot=N:dead, "
        "each with @STEP where it is not from the start; or all"
    )


@dataclass(frozen=True, slots=True)
class Fault:
    """One fault: of which part, of what kind, and from the decision of which step on, counted from 1.

    A `silent` behavior has No Action; a `stuck` one wants for ever what it wanted in the step `since`; a `random` one
    has a random table. Of a sensor of all robots, `noise` adds a normal draw of standard deviation `size`, `frozen`
    keeps the value of the step `since`, `lost` is 0, false or the first cell. A `dead` robot is controlled by nobody.
    """

    part: Part
    name: str
    """Of the behavior or sensor; of a robot its number."""
    kind: str
    since: int = 1
    size: float = 0.0

    @property
    def text(self) -> str:
        """The fault as it is written."""
        short = f"{self.size:g}"
        size = f"({short if float(short) == self.size else self.size})" if self.kind == "noise" else ""
        since = f"@{self.since}" if self.since > 1 or self.kind in LATE else ""
        return f"{self.part}={self.name}:{self.kind}{size}{since}"


def read_faults(texts: Iterable[str], meaning: Meaning) -> list[Fault]:
    """Return the faults that texts name, each once; `all` stands for every behavior silent.

    Raises:
        NoSuchFault: a text is not understood, or names what the spec does not have.
    """
    faults = dict[Fault, None]()
    for text in texts:
        if text == ALL:
            faults |= dict.fromkeys(
                Fault("behavior", name, "silent") for name in _highest_first(meaning.spec)
            )
        else:
            faults[read_fault(text, meaning)] = None
    return list(faults)


def _highest_first(spec: Spec) -> list[str]:
    """Return the behaviors, those of the structure first, as far as it is given."""
    names = [*(spec.structure or ()), *spec.behaviors]
    return list(dict.fromkeys(name for name in names if name in spec.behaviors))


def read_fault(text: str, meaning: Meaning) -> Fault:
    """Return the fault that a text names, such as `sensor=tilt:frozen@100`.

    Raises:
        NoSuchFault: it is not understood, or names what the spec does not have.
    """
    match = FORM.fullmatch("".join(text.split()))
    if match is None:
        raise _mistake(text, "this is not PART=NAME:KIND")
    known_part = _known(text, match["part"], KINDS, "part")
    (part,) = (each for each in KINDS if each == known_part)
    name = _known(text, match["name"], _names_of(part, meaning.spec), part)
    kind = _known(text, match["kind"], KINDS[part], f"fault of a {part}")
    since = _since(text, match["since"], kind, meaning.spec.environment.steps)
    size = _size(text, match["size"], kind)
    if kind == "random" and since > 1:
        raise _mistake(text, "a random table is there from the start, without @")
    if kind == "noise" and not _is_number(name, meaning):
        raise _mistake(text, f"{name} is no number, so that noise cannot be added")
    return Fault(part, name, kind, since, size)


def _mistake(text: str, what: str) -> NoSuchFault:
    return NoSuchFault(f"--fault {escape(text)}: {what}")


def _known(text: str, word: str, known: Iterable[str], what: str) -> str:
    names = list(known)
    if word not in names:
        hint = did_you_mean(word, names) or f"; known: {', '.join(names) or 'none'}"
        raise _mistake(text, f'"{escape(word)}" is not a {what}{hint}')
    return word


def _names_of(part: str, spec: Spec) -> Sequence[str]:
    match part:
        case "behavior":
            return list(spec.behaviors)
        case "sensor":
            return list(spec.environment.sensors)
    return [str(robot) for robot in range(spec.environment.robots)]


def _since(text: str, written: str | None, kind: str, steps: int) -> int:
    if written is None:
        return max(1, steps // 2) if kind in LATE else 1
    if not (written.isdecimal() and 1 <= int(written) <= steps):
        raise _mistake(text, f"@{escape(written)} is not one of the steps 1 to {steps}")
    return int(written)


def _size(text: str, written: str | None, kind: str) -> float:
    if (written is not None) != (kind == "noise"):
        wanted = "needs its standard deviation, as in noise(0.5)" if kind == "noise" else "has no (...)"
        raise _mistake(text, f"{kind} {wanted}")
    try:
        size = float(written or 0.0)
    except ValueError:
        size = -1.0
    if not 0.0 <= size < float("inf"):
        raise _mistake(text, f"({escape(written or '')}) is no standard deviation")
    return size


def _is_number(sensor: str, meaning: Meaning) -> bool:
    kinds = {node.kind for slot, node in meaning.episode.after.items() if slot.name == sensor}
    return kinds == {Kind.NUMBER} and not meaning.episode.labels(sensor)


def faulty_meaning(meaning: Meaning, fault: Fault) -> Meaning:
    """Return the meaning of a spec under a fault; the random streams of all else stay as they are.

    Raises:
        ValueError: the fault is of a behavior's table, which a spec's meaning does not have.
    """
    graph = meaning.graph.fork()
    graph.bounded = False
    forked = replace(meaning, graph=graph)
    match fault.kind:
        case "noise" | "frozen" | "lost":
            return _with_sensor(forked, SensorFault(fault.name, fault.kind, fault.since, fault.size))
        case "stuck":
            return _with_stuck(forked, fault)
        case "silent":
            return _with_modules(
                forked, [_silent(m, fault, graph) if m.name == fault.name else m for m in _modules(meaning)]
            )
        case "dead":
            return _with_modules(forked, [_dead(m, fault, graph) for m in _modules(meaning)])
    raise ValueError(f"{fault.text} is no change of a spec's meaning")


def _modules(meaning: Meaning) -> tuple[Module, ...]:
    return meaning.episode.modules


def _with_modules(meaning: Meaning, modules: Sequence[Module]) -> Meaning:
    return replace(meaning, episode=replace(meaning.episode, modules=tuple(modules)))


def _with_sensor(meaning: Meaning, fault: SensorFault) -> Meaning:
    """Return the meaning elaborated anew, with a sensor that behaviors perceive wrongly."""
    findings = Findings()
    definitions = read_definitions(meaning.spec.environment.definitions, findings)
    names = Names(meaning.spec, meaning.graph, findings, meaning.constants, definitions, {})
    episode = elaborate_episode(names, fault)
    if episode is None:
        raise ValueError(f"a spec of {meaning.spec.name} that has mistakes")
    return replace(meaning, episode=episode)


def _is_early(fault: Fault, graph: Graph) -> Node:
    """Return whether a step is before the fault."""
    if fault.since == 1:
        return graph.truth(value=False)
    step = graph.leaf("step", None, Kind.NUMBER, Level.STEP)
    return graph.apply("<", step, graph.number(fault.since))


def _silent(module: Module, fault: Fault, graph: Graph) -> Module:
    is_early = _is_early(fault, graph)
    return replace(module, excited=tuple(graph.apply("&", node, is_early) for node in module.excited))


def _dead(module: Module, fault: Fault, graph: Graph) -> Module:
    is_early = _is_early(fault, graph)
    return replace(
        module,
        excited=tuple(
            graph.apply("&", node, is_early) if str(robot) == fault.name else node
            for robot, node in enumerate(module.excited)
        ),
    )


def _with_stuck(meaning: Meaning, fault: Fault) -> Meaning:
    """Return the meaning with a behavior that perceives the same, and is as excited, as in the step of its fault."""
    graph, episode = meaning.graph, meaning.episode
    (module,) = (each for each in episode.modules if each.name == fault.name)
    step = graph.leaf("step", None, Kind.NUMBER, Level.STEP)
    is_late = graph.apply(">", step, graph.number(fault.since))
    kept: dict[Slot, Node] = {}

    def lasting(node: Node, name: str, robot: int) -> Node:
        if node.literal:
            return node
        slot = Slot(_free_name(f"{fault.name}_{name}_before", meaning), robot)
        kept[slot] = graph.apply("select", is_late, graph.leaf("slot", slot, node.kind, Level.LANE), node)
        return kept[slot]

    stuck = replace(
        module,
        cells=tuple(
            tuple(lasting(node, name, robot) for node, name in zip(nodes, module.inputs, strict=True))
            for robot, nodes in enumerate(module.cells)
        ),
        excited=tuple(lasting(node, "excited", robot) for robot, node in enumerate(module.excited)),
    )
    starts = {slot: _nothing(node, graph) for slot, node in kept.items()}
    return replace(
        meaning,
        episode=replace(
            episode,
            modules=tuple(stuck if each is module else each for each in episode.modules),
            start={**episode.start, **starts},
            after={**episode.after, **kept},
        ),
    )


def _nothing(node: Node, graph: Graph) -> Node:
    return graph.truth(value=False) if node.kind is Kind.TRUTH else graph.cell(0)


def _free_name(name: str, meaning: Meaning) -> str:
    taken = {slot.name for slot in meaning.episode.after}
    while name in taken:
        name += "_"
    return name
