import sys
from types import ModuleType, SimpleNamespace

import pytest

from bbsd.exports.exported import Options
from bbsd.exports.ros2 import write
from tests.unit.exports.controllers import joint_cells
from tests.unit.exports.designs import ODD_NAME, ODD_WORDS, SHIPPED, drawn, hand_made, written


class Message:
    """A message of std_msgs: data of one type."""

    def __init__(self, data):
        assert type(data) is self.of
        self.data = data


class StandIn:
    """A node of rclpy, as far as exported nodes use it: what it publishes is kept, and time is set by hand."""

    def __init__(self, name):
        self.name, self.seconds = name, 0.0
        self.inputs, self.published, self.said, self.timers = {}, {}, [], []

    def declare_parameter(self, name, value):
        return SimpleNamespace(value=value)

    def create_subscription(self, kind, topic, call, depth):
        self.inputs[topic] = (kind, call)

    def create_publisher(self, kind, topic, depth):
        def publish(message):
            assert type(message) is kind
            self.published[topic] = message.data

        return SimpleNamespace(publish=publish)

    def create_timer(self, period, call):
        self.timers.append((period, call))

    def get_clock(self):
        return SimpleNamespace(now=lambda: Moment(self.seconds))

    def get_logger(self):
        def keep(text, throttle_duration_sec):
            self.said.append(text)

        return SimpleNamespace(warning=keep, error=keep)

    def destroy_node(self):
        self.said.append("destroyed")


class Moment:
    def __init__(self, seconds):
        self.seconds = seconds

    def __sub__(self, other):
        return SimpleNamespace(nanoseconds=round((self.seconds - other.seconds) * 1e9))


def module_of(**names):
    made = ModuleType("made")
    vars(made).update(names)
    return made


@pytest.fixture
def node_of(monkeypatch):
    """What runs an exported node with stand-ins for rclpy and std_msgs, and returns it."""

    def spin(node):
        raise KeyboardInterrupt

    types = {"Bool": bool, "Float64": float, "Int32": int, "String": str}
    messages = {name: type(name, (Message,), {"of": of}) for name, of in types.items()}
    stand_ins = {
        "rclpy": module_of(init=lambda: None, spin=spin, try_shutdown=lambda: None),
        "rclpy.node": module_of(Node=StandIn),
        "std_msgs": module_of(),
        "std_msgs.msg": module_of(**messages),
    }
    for name, stand_in in stand_ins.items():
        monkeypatch.setitem(sys.modules, name, stand_in)

    def made(exported):
        (text,) = write(exported, Options()).values()
        names = {"__name__": "exported"}
        exec(compile(text, "node.py", "exec"), names)
        return SimpleNamespace(node=names["Controller"](), main=names["main"])

    return made


def decide(node, cells):
    """What a node publishes when these cells came in and its timer ran."""
    for cell, (kind, call) in zip(cells, node.inputs.values(), strict=True):
        call(kind(data=kind.of(cell)))
    node.published.clear()
    ((period, call),) = node.timers
    assert period == 0.1
    call()
    return dict(node.published)


@pytest.mark.parametrize("name", ["mobile_robot", *SHIPPED])
def test_a_node_publishes_the_actions_of_the_design_and_what_they_set(node_of, name):
    exported = hand_made(name) if name in SHIPPED else drawn(name, 1)
    node = node_of(exported).node
    for cells, number in zip(*joint_cells(exported.controller), strict=True):
        published = decide(node, cells)
        assert published.pop("~/action") == number
        action = exported.controller.actions[number - 1] if number else None
        assert published.pop("~/action_name") == (f"{action.behavior}: {action.name}" if action else "nobody")
        fixed = exported.fixed[number - 1] if number else {}
        assert published == {f"~/set/{name}": value for name, value in fixed.items()}


def test_whatever_things_are_called_it_is_a_node(node_of):
    exported = written(ODD_WORDS, name=ODD_NAME)
    node = node_of(exported).node
    for cells, number in zip(*joint_cells(exported.controller), strict=True):
        assert decide(node, cells)["~/action"] == number


def test_nothing_is_published_where_an_input_is_missing_or_late_or_impossible(node_of):
    node = node_of(hand_made("mobile_robot_hand")).node
    node.decide()
    assert "nothing came from brightest, near_left" in node.said.pop()
    assert decide(node, (0, 0, 0, 0, 1, 0)) != {}
    node.seconds += 0.9
    assert decide(node, (0, 0, 0, 0, 1, 0)) != {}
    node.seconds += 1.1
    node.published.clear()
    node.decide()
    assert node.published == {}
    assert decide(node, (7, 0, 0, 0, 1, 0)) == {}
    assert node.said.pop() == "no action: there is no cell 7 of 5"
    node.timeout = 0.0
    assert decide(node, (0, 0, 0, 0, 1, 0)) != {}
    node.seconds += 1e6
    node.published.clear()
    node.decide()
    assert node.published["~/action"] == 3


def test_what_the_design_computes_is_said_to_be_missing(node_of):
    node = node_of(hand_made("mobile_robot_hand")).node
    published = decide(node, (0, 0, 0, 0, 0, 0))
    assert published == {"~/action": 1, "~/action_name": "wander: stroll", "~/set/forward": 0.5}
    assert node.said == ["turn is not set: this node does not compute whim"]


def test_its_program_ends_when_it_is_interrupted(node_of):
    assert node_of(hand_made("mobile_robot_hand")).main() is None


def test_it_says_that_it_was_not_run():
    (text,) = write(hand_made("object_lifting_hand"), Options()).values()
    assert text.startswith("# A node of ROS 2. bbsd has not run it: there was no ROS 2.\n")
