"""A design as a tree of BehaviorTree.CPP 4, in XML, that Groot2 shows.

With scripts it runs as it is: conditions look at whole numbers on the blackboard, and actions set the entry `action`.
With custom leaves each input and each action is a node of one's own, and a TreeNodesModel lists them for Groot2.
Groups are reactive: at each tick the highest layer is asked first, even while an action of a lower one is running.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple
from xml.sax.saxutils import escape as xml_escape
from xml.sax.saxutils import quoteattr

from bbsd.errors import escape
from bbsd.explanation.lines import wrapped
from bbsd.exports.described import (
    actions_said,
    head_lines,
    input_text,
    inputs_said,
    is_truth,
    number_text,
    numbered_cells,
    sets_text,
)
from bbsd.exports.names import Names, words_of
from bbsd.exports.tree import NOBODY, Act, Condition, Group, nodes_of, silent_said, tree_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.architecture.controller import Controller, Dimension
    from bbsd.exports.exported import Exported, Files, Options
    from bbsd.exports.tree import Node, Tree

RESERVED = frozenset({"root", "name", "ID", "true", "false", "action"})
"""Words that the library keeps for itself, and the entry that actions set."""
ELEMENTS = {"sequence": "ReactiveSequence", "fallback": "ReactiveFallback"}
CELLS = "cells"
"""The port of a condition: the cells in which it succeeds."""
MOST_PARTS = 20
"""Alternatives in one script; its parser has a limit."""


class Leaves(NamedTuple):
    """The identifiers of a tree, of its inputs and of its actions, all different."""

    tree: str
    inputs: tuple[str, ...]
    actions: tuple[str, ...]


def write(exported: Exported, options: Options) -> Files:
    """Return the tree by its file's name."""
    controller, tree = exported.controller, tree_of(exported.controller)
    leaves, is_custom = leaves_of(controller), options.leaves == "custom"
    said = _custom_lines(controller, leaves) if is_custom else _script_lines(controller, leaves)
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        *_comment([*head_lines(controller), *said, *silent_said(tree)]),
        f'<root BTCPP_format="4" main_tree_to_execute={_quoted(leaves.tree)}>',
        f"  <BehaviorTree ID={_quoted(leaves.tree)}>",
        *_element(exported, leaves, tree.root, "    ", is_custom=is_custom),
        "  </BehaviorTree>",
        *(_model(exported, leaves, tree) if is_custom else ()),
        "</root>",
    ]
    return {f"{words_of(controller.name).lower() or 'design'}.xml": "\n".join(lines) + "\n"}


def leaves_of(controller: Controller) -> Leaves:
    """Return the identifiers: names of the design as they are, where an action's is not unique after its behavior's.

    In small letters no node of the library has such a name. Custom leaves are elements by these names: inside reactive
    groups, BehaviorTree.CPP 4.8 refuses the longer form, `<Condition ID="name"/>`.
    """
    names, common = Names(RESERVED), [each.name for each in controller.actions]
    inputs = tuple(_identifier(names, input_text(each), "cell") for each in controller.dimensions)
    actions = tuple(
        _identifier(
            names, each.name if common.count(each.name) == 1 else f"{each.behavior} {each.name}", "act"
        )
        for each in controller.actions
    )
    return Leaves(_identifier(names, controller.name, "tree"), inputs, actions)


def _identifier(names: Names, text: str, kind: str) -> str:
    """Return an identifier that begins with a letter, and not with `true` or `false`, at which scripts would break."""
    words = words_of(text).lower()
    return names.new(
        text if words[:1].isalpha() and not words.startswith(("true", "false")) else f"{kind} {text}",
        lower=True,
    )


def _script_lines(controller: Controller, leaves: Leaves) -> Iterator[str]:
    yield (
        "Before each tick, set these entries of the blackboard to the present cells, whole numbers. Each tick succeeds "
        "and sets the entry action."
    )
    yield from inputs_said(controller, leaves.inputs)
    yield from actions_said(controller)


def _custom_lines(controller: Controller, leaves: Leaves) -> Iterator[str]:
    yield (
        f"Conditions and actions are nodes of your own. A condition succeeds where its input is in one of the cells "
        f"that its port {CELLS} lists; one without that port, where it is 1. An action sets what its ports say: a "
        "number, or what you compute by the expression of the design. It may stay RUNNING: at each tick the highest "
        "layer is asked first, and halts it where it acts itself. Where nobody controls, a tick succeeds, and commands "
        "stay as they are."
    )
    yield from inputs_said(controller, leaves.inputs)
    for action, leaf in zip(controller.actions, leaves.actions, strict=True):
        yield f"  {leaf}: {action.name} of {action.behavior}, sets {sets_text(action)}"


def _comment(paragraphs: Sequence[str]) -> list[str]:
    """Return lines of a comment, in which no two hyphens may stand together."""
    lines = [line for text in paragraphs for line in wrapped(text, "  ", "      ")]
    return ["<!--", *(line.replace("--", "- -").replace("--", "- -") for line in lines), "-->"]


def _quoted(text: str) -> str:
    """Return an attribute's value in quotes; characters that XML does not know become visible escapes."""
    return quoteattr(escape(text)).replace("&gt;", ">")


def _element(
    exported: Exported, leaves: Leaves, node: Node, indent: str, *, is_custom: bool
) -> Iterator[str]:
    match node:
        case Group():
            element = ELEMENTS[node.kind]
            yield f"{indent}<{element} name={_quoted(node.text)}>"
            for child in node.children:
                yield from _element(exported, leaves, child, f"{indent}  ", is_custom=is_custom)
            yield f"{indent}</{element}>"
        case Condition() if is_custom:
            yield from _custom_condition(exported.controller, leaves, node, indent)
        case Condition():
            yield from _script_condition(exported.controller, leaves, node, indent)
        case Act() if is_custom:
            yield indent + _custom_action(exported, leaves, node)
        case Act():
            yield f'{indent}<Script name={_quoted(node.text)} code="action := {node.action}"/>'


def _script_condition(controller: Controller, leaves: Leaves, node: Condition, indent: str) -> Iterator[str]:
    entry, size = leaves.inputs[node.dimension], controller.dimensions[node.dimension].size
    codes = script_of(entry, node.cells, size)
    if len(codes) == 1:
        yield f"{indent}<ScriptCondition name={_quoted(node.text)} code={_quoted(codes[0])}/>"
        return
    yield f"{indent}<ReactiveFallback name={_quoted(node.text)}>"
    yield from (f"{indent}  <ScriptCondition code={_quoted(code)}/>" for code in codes)
    yield f"{indent}</ReactiveFallback>"


def script_of(entry: str, cells: Sequence[int], size: int) -> list[str]:
    """Return scripts, one of which holds where an entry is one of some cells, not all, given in ascending order.

    Alternatives with `&&` are in brackets: unlike in C, `&&` does not bind more tightly than `||` in these scripts.
    """
    if size - len(cells) == 1 < len(cells):
        (other,) = set(range(size)).difference(cells)
        return [f"{entry} != {other}"]
    starts = [
        0,
        *(index for index, (low, high) in enumerate(pairwise(cells), 1) if high != low + 1),
        len(cells),
    ]
    parts = [
        part for first, last in pairwise(starts) for part in _run(entry, cells[first], cells[last - 1], size)
    ]
    if len(parts) == 1:
        return [parts[0].strip("()")]
    return [" || ".join(parts[first : first + MOST_PARTS]) for first in range(0, len(parts), MOST_PARTS)]


def _run(entry: str, low: int, high: int, size: int) -> list[str]:
    """Return scripts, one of which holds where an entry is one of a run of neighboring cells."""
    if low == 0 < high:
        return [f"{entry} <= {high}"]
    if low < high == size - 1:
        return [f"{entry} >= {low}"]
    if high - low > 1:
        return [f"({entry} >= {low} && {entry} <= {high})"]
    return [f"{entry} == {cell}" for cell in range(low, high + 1)]


def _custom_condition(controller: Controller, leaves: Leaves, node: Condition, indent: str) -> Iterator[str]:
    leaf, name = leaves.inputs[node.dimension], _quoted(node.text)
    if not is_truth(controller.dimensions[node.dimension]):
        cells = ";".join(map(str, node.cells))
        yield f'{indent}<{leaf} name={name} {CELLS}="{cells}"/>'
    elif node.cells == (1,):
        yield f"{indent}<{leaf} name={name}/>"
    else:
        yield f"{indent}<Inverter name={name}>"
        yield f"{indent}  <{leaf}/>"
        yield f"{indent}</Inverter>"


def _custom_action(exported: Exported, leaves: Leaves, node: Act) -> str:
    if node.action == NOBODY:
        return f"<AlwaysSuccess name={_quoted(node.text)}/>"
    ports = "".join(f" {port.name}={_quoted(port.value)}" for port in _ports(exported, node.action))
    return f"<{leaves.actions[node.action - 1]} name={_quoted(node.text)}{ports}/>"


class Port(NamedTuple):
    """A port of an action: its name and type, and a number, a truth or an expression of the design."""

    name: str
    type: str
    value: str


def _ports(exported: Exported, action: int) -> list[Port]:
    """Return a port for each name that an action sets."""
    names, fixed = Names(RESERVED), exported.fixed[action - 1]
    return [
        Port(_identifier(names, name, "set"), *_typed(fixed.get(name), expression))
        for name, expression in exported.controller.actions[action - 1].sets.items()
    ]


def _typed(value: float | bool | None, expression: str) -> tuple[str, str]:
    if value is None:
        return "std::string", expression
    return "bool" if isinstance(value, bool) else "double", number_text(value)


def _model(exported: Exported, leaves: Leaves, tree: Tree) -> Iterator[str]:
    """Yield the model of the nodes that the tree uses, for Groot2."""
    nodes, dimensions = [*nodes_of(tree.root)], exported.controller.dimensions
    yield "  <TreeNodesModel>"
    for index in sorted({node.dimension for node in nodes if isinstance(node, Condition)}):
        yield from _condition_model(dimensions[index], leaves.inputs[index])
    for number in sorted({node.action for node in nodes if isinstance(node, Act) and node.action != NOBODY}):
        yield f'    <Action ID="{leaves.actions[number - 1]}">'
        for port in _ports(exported, number):
            yield f'      <input_port name="{port.name}" type="{port.type}" default={_quoted(port.value)}/>'
        yield "    </Action>"
    yield "  </TreeNodesModel>"


def _condition_model(dimension: Dimension, leaf: str) -> Iterator[str]:
    if is_truth(dimension):
        yield f'    <Condition ID="{leaf}"/>'
        return
    said = xml_escape(escape(numbered_cells(dimension)))
    yield f'    <Condition ID="{leaf}">'
    yield f'      <input_port name="{CELLS}" type="std::vector&lt;int&gt;">{said}</input_port>'
    yield "    </Condition>"
