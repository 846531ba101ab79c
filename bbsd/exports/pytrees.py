"""A design as a Python module that builds a tree of py_trees, with its blackboard."""

from __future__ import annotations

import json
import keyword
from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.explanation.lines import wrapped
from bbsd.exports.described import actions_said, head_lines, input_names, inputs_said
from bbsd.exports.names import Names, words_of
from bbsd.exports.tree import Act, Condition, Group, silent_said, tree_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.exports.exported import Exported, Files, Options
    from bbsd.exports.tree import Node

CLIENT = (
    "absolute_name exclusive exists get id is_registered name namespace namespaces read register_key remappings "
    "required set unique_identifier unregister unregister_all_keys unregister_key unset "
    "verify_required_keys_exist write"
)
"""What a client of the blackboard has besides keys."""
RESERVED = frozenset({*keyword.kwlist, *keyword.softkwlist, *CLIENT.split(), "self", "action"})
COMPOSITES = {"sequence": "Sequence", "fallback": "Selector"}

HEAD = """
from py_trees.behaviour import Behaviour
from py_trees.blackboard import Client
from py_trees.common import Access, Status
from py_trees.composites import Selector, Sequence
from py_trees.display import ascii_tree
from py_trees.trees import BehaviourTree
"""

LEAVES = '''

class CellIs(Behaviour):
    """Succeeds where an input has one of some cells."""

    def __init__(self, name, namespace, key, *cells):
        super().__init__(name)
        self.key, self.cells = key, frozenset(cells)
        self.blackboard = self.attach_blackboard_client(name=name, namespace=namespace)
        self.blackboard.register_key(key=key, access=Access.READ)

    def update(self):
        return Status.SUCCESS if self.blackboard.get(self.key) in self.cells else Status.FAILURE


class Act(Behaviour):
    """Sets the number of the action, and succeeds."""

    def __init__(self, name, namespace, number):
        super().__init__(name)
        self.number = number
        self.blackboard = self.attach_blackboard_client(name=name, namespace=namespace)
        self.blackboard.register_key(key="action", access=Access.WRITE)

    def update(self):
        self.blackboard.action = self.number
        return Status.SUCCESS
'''

CONTROLLER = '''

class Controller:
    """The tree with its blackboard; each robot has one, with a namespace of its own."""

    def __init__(self, namespace=NAMESPACE):
        self.tree = BehaviourTree(create_root(namespace))
        self.blackboard = Client(name="controller", namespace=namespace)
        for key in INPUTS:
            self.blackboard.register_key(key=key, access=Access.WRITE)
        self.blackboard.register_key(key="action", access=Access.READ)
'''

MAIN = """

if __name__ == "__main__":
    print(ascii_tree(create_root()))
"""


def write(exported: Exported, options: Options) -> Files:  # noqa: ARG001 - all targets are written alike
    """Return the module's text by its file's name."""
    controller, tree = exported.controller, tree_of(exported.controller)
    keys = input_names(controller, Names(RESERVED))
    stem = words_of(controller.name).lower() or "design"
    lines = [
        *_comment(
            *head_lines(controller),
            "",
            "Set the cells of the inputs on the blackboard, and tick the tree once a step: it succeeds, and sets "
            "action. Or let Controller do so: command() returns the number of the controlling action, 0 for nobody's, "
            "by which commands stay as they are. Groups have no memory: at each tick the highest layer is asked "
            "first. Run as a program, it draws the tree.",
            "",
            *inputs_said(controller, keys),
            *actions_said(controller),
            *silent_said(tree),
        ),
        *HEAD.splitlines(),
        "",
        f"DESIGN = {_quoted(controller.name)}",
        f"DIGEST = {_quoted(controller.digest)}",
        f"NAMESPACE = {_quoted(stem)}",
        *_tuple("INPUTS", keys),
        *LEAVES.splitlines(),
        "",
        "",
        "def create_root(namespace=NAMESPACE):",
        '    """Return the root of the tree, a selector over the layers, with its keys in a namespace."""',
        *_expression(keys, tree.root, "    return ", "    ", ""),
        *CONTROLLER.splitlines(),
        "",
        *_command(keys),
        *MAIN.splitlines(),
    ]
    return {f"{stem}_tree.py": "\n".join(lines) + "\n"}


def _comment(*paragraphs: str) -> list[str]:
    return [line.rstrip() for text in paragraphs for line in wrapped(text, "# ", "#     ") or ["#"]]


def _quoted(text: str) -> str:
    """Return a text as Python writes it between double quotes, hidden characters as visible escapes."""
    return json.dumps(escape(text), ensure_ascii=False)


def _tuple(name: str, keys: Sequence[str]) -> list[str]:
    return [f"{name} = (", *(f"    {_quoted(key)}," for key in keys), ")"] if keys else [f"{name} = ()"]


def _expression(keys: Sequence[str], node: Node, start: str, indent: str, end: str) -> Iterator[str]:
    """Yield the lines of the expression that builds a node, with what stands before and behind it."""
    match node:
        case Group():
            yield f"{start}{COMPOSITES[node.kind]}({_quoted(node.text)}, memory=False, children=["
            for child in node.children:
                yield from _expression(keys, child, f"{indent}    ", f"{indent}    ", ",")
            yield f"{indent}]){end}"
        case Condition():
            cells = ", ".join(map(str, node.cells))
            yield f"{start}CellIs({_quoted(node.text)}, namespace, {_quoted(keys[node.dimension])}, {cells}){end}"
        case Act():
            yield f"{start}Act({_quoted(node.text)}, namespace, {node.action}){end}"


def _command(keys: Sequence[str]) -> Iterator[str]:
    yield f"    def command({', '.join(['self', *keys])}):"
    yield '        """Return the number of the controlling action, 0 for nobody\'s."""'
    yield from (f"        self.blackboard.set({_quoted(key)}, {key})" for key in keys)
    yield "        self.tree.tick()"
    yield "        return self.blackboard.action"
