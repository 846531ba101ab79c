"""A design as a node of ROS 2 around its Python module: one file, which needs rclpy and std_msgs.

It is not run by any tool here; tests run it with a stand-in of rclpy.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.explanation.lines import wrapped
from bbsd.exports import python
from bbsd.exports.described import input_text, inputs_said, is_truth
from bbsd.exports.names import Names, words_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from bbsd.architecture.controller import Controller
    from bbsd.exports.exported import Exported, Files, Options

IMPORTS = """
from functools import partial

import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool, Float64, Int32, String
"""

NODE = '''SELDOM = {"throttle_duration_sec": 5.0}


class Controller(Node):
    """Decides once a period by the cells that came last, and publishes the action and what it sets."""

    def __init__(self):
        super().__init__(NODE_NAME)
        period = self.declare_parameter("period", 0.1).value
        self.timeout = self.declare_parameter("timeout", 1.0).value
        self.cell_of, self.came_at = {}, {}
        for topic, kind in INPUTS.items():
            self.create_subscription(kind, "~/input/" + topic, partial(self.receive, topic), 10)
        self.number_publisher = self.create_publisher(Int32, "~/action", 10)
        self.name_publisher = self.create_publisher(String, "~/action_name", 10)
        self.set_publishers = {
            topic: self.create_publisher(kind, "~/set/" + topic, 10) for topic, kind in OUTPUTS.items()
        }
        self.create_timer(period, self.decide)

    def receive(self, topic, message):
        """Keep the cell of an input."""
        self.cell_of[topic] = int(message.data)
        self.came_at[topic] = self.get_clock().now()

    def decide(self):
        """Act by the present cells; where an input is missing or late, or out of its cells, do nothing but say so."""
        missing = [topic for topic in INPUTS if self.is_late(topic)]
        if missing:
            self.get_logger().warning("no action, since nothing came from " + ", ".join(missing), **SELDOM)
            return
        try:
            number = command(*(self.cell_of[topic] for topic in INPUTS))
        except ValueError as error:
            self.get_logger().error(f"no action: {error}", **SELDOM)
            return
        self.act(number)

    def is_late(self, topic):
        """Return whether the cell of an input never came, or so long ago that it may have changed unseen."""
        if topic not in self.came_at:
            return True
        age = (self.get_clock().now() - self.came_at[topic]).nanoseconds / 1e9
        return 0 < self.timeout < age

    def act(self, number):
        """Publish the action, and the numbers and truths that it sets."""
        behavior, action, _ = ACTIONS[number]
        self.number_publisher.publish(Int32(data=number))
        self.name_publisher.publish(String(data=f"{behavior}: {action}" if number else "nobody"))
        for topic, value in CONSTANTS.get(number, {}).items():
            self.set_publishers[topic].publish(OUTPUTS[topic](data=value))
        if number in EXPRESSIONS:
            self.compute(EXPRESSIONS[number])

    def compute(self, expressions):
        """Set what the design computes, an expression for each name: that is yours to write."""
        for name, expression in expressions.items():
            self.get_logger().warning(f"{name} is not set: this node does not compute {expression}", **SELDOM)


def main():
    """Run the node until it is interrupted."""
    rclpy.init()
    node = Controller()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
'''


def write(exported: Exported, options: Options) -> Files:
    """Return the node's text by its file's name."""
    controller = exported.controller
    (module,) = python.write(exported, options).values()
    topics, states = Names(()), Names(())
    inputs = [_token(topics, input_text(each), "cell") for each in controller.dimensions]
    outputs = {name: _token(states, name, "set") for name in _names_set(controller)}
    lines = [
        *_comment(*_said(controller, inputs)),
        *IMPORTS.splitlines(),
        "",
        *module.splitlines(),
        "",
        "",
        f'NODE_NAME = "{_token(Names(()), controller.name, "node")}"',
        "# What cells come as, by topic, in the order of command().",
        *_table(
            "INPUTS",
            [(name, _kind(is_truth(each))) for name, each in zip(inputs, controller.dimensions, strict=True)],
        ),
        "# What is published, by topic.",
        *_table("OUTPUTS", _kinds(exported, outputs)),
        "# What actions set by topic, and what they set by expressions of the design.",
        *_table("CONSTANTS", _constants(exported, outputs)),
        *_table("EXPRESSIONS", _expressions(exported)),
        *NODE.splitlines(),
    ]
    return {f"{words_of(controller.name).lower() or 'design'}_node.py": "\n".join(lines) + "\n"}


def _said(controller: Controller, inputs: Sequence[str]) -> Iterator[str]:
    yield "A node of ROS 2. bbsd has not run it: there was no ROS 2."
    yield ""
    yield (
        "Once a period it decides by the cells that came last, and publishes the number and the name of the action, "
        "and what it sets, where that is a number or a truth; what the design computes is yours to write, in "
        "compute(). Where an input is missing, late or not one of its cells, nothing is published: see to it that the "
        "robot stops where no commands come. Parameters: period, in seconds; timeout, the seconds after which a cell "
        "is late, 0 for never."
    )
    yield ""
    yield "~/input/NAME, of the type Bool where it is 1 or 0, else Int32:"
    yield from inputs_said(controller, inputs)
    yield "~/action, Int32, 0 where nobody controls; ~/action_name, String; ~/set/NAME, Float64 or Bool."


def _comment(*paragraphs: str) -> list[str]:
    return [line.rstrip() for text in paragraphs for line in wrapped(text, "# ", "#     ") or ["#"]]


def _token(names: Names, text: str, kind: str) -> str:
    """Return a part of a topic's name, or a node's: small letters, digits and single underscores, a letter first."""
    words = words_of(text).lower()
    return names.new(words if words[:1].isalpha() else f"{kind} {words}", lower=True)


def _kind(is_bool: bool) -> str:
    return "Bool" if is_bool else "Int32"


def _names_set(controller: Controller) -> list[str]:
    """Return the names of state that actions set, each once."""
    return [*dict.fromkeys(name for action in controller.actions for name in action.sets)]


def _kinds(exported: Exported, outputs: Mapping[str, str]) -> list[tuple[str, str]]:
    """Return the type of each topic on which a value can be published."""
    is_truth_of = {
        name: isinstance(value, bool) for values in exported.fixed for name, value in values.items()
    }
    return [
        (topic, "Bool" if is_truth_of[name] else "Float64")
        for name, topic in outputs.items()
        if name in is_truth_of
    ]


def _constants(exported: Exported, outputs: Mapping[str, str]) -> list[tuple[int, str]]:
    return [
        (
            number,
            "{" + ", ".join(f"{_quoted(outputs[name])}: {value!r}" for name, value in values.items()) + "}",
        )
        for number, values in enumerate(exported.fixed, 1)
        if values
    ]


def _expressions(exported: Exported) -> list[tuple[int, str]]:
    rows = []
    for number, (action, fixed) in enumerate(
        zip(exported.controller.actions, exported.fixed, strict=True), 1
    ):
        others = {name: text for name, text in action.sets.items() if name not in fixed}
        if others:
            inner = ", ".join(f"{_quoted(name)}: {_quoted(text)}" for name, text in others.items())
            rows.append((number, "{" + inner + "}"))
    return rows


def _table(name: str, rows: Sequence[tuple[str | int, str]]) -> list[str]:
    """Return the lines of a dictionary, its values as they are written."""
    if not rows:
        return [f"{name} = {{}}"]
    written = [f"    {_quoted(key) if isinstance(key, str) else key}: {value}," for key, value in rows]
    return [f"{name} = {{", *written, "}"]


def _quoted(text: str) -> str:
    return json.dumps(escape(text), ensure_ascii=True)
