"""The tasks of `specs/tasks` do in a step what the benchmarks do that they are named after."""

from __future__ import annotations

from math import cos, pi, radians, sin
from pathlib import Path

import numpy as np
import pytest

import bbsd
from bbsd.expression.node_data import Slot
from experiments.optimum import step_of

TASKS = Path(__file__).parents[2] / "specs" / "tasks"


def outcomes(task, state, action):
    """What an action leads to, as {(values of the state's names): probability}, and the rewards, in their order.

    Slots that `state` does not name have the value that they start with.
    """
    step = step_of(bbsd.load(TASKS / f"{task}.yaml").meaning)
    _, start = next(step.starts())
    values = dict(zip((slot.name for slot in step.slots), start, strict=True)) | state
    found, rewards = {}, set()
    for probability, reward, then in step.outcomes(tuple(values.values()), action):
        after = (
            "over"
            if then is None
            else tuple(value for slot, value in zip(step.slots, then, strict=True) if slot.name in state)
        )
        found[after] = found.get(after, 0) + probability
        rewards.add(reward)
    return found, sorted(rewards)


LEFT, RIGHT, DOWN, UP = 1, 2, 3, 4  # the lake's actions, behavior after behavior


@pytest.mark.parametrize(
    ("i", "j", "action", "expected", "rewards"),
    [
        (0, 0, LEFT, {(0, 0): 2 / 3, (1, 0): 1 / 3}, [0]),
        (0, 0, RIGHT, {(0, 1): 1 / 3, (1, 0): 1 / 3, (0, 0): 1 / 3}, [0]),
        (1, 0, DOWN, {(2, 0): 1 / 3, (1, 0): 1 / 3, "over": 1 / 3}, [0]),
        (3, 2, RIGHT, {(2, 2): 1 / 3, (3, 2): 1 / 3, "over": 1 / 3}, [0, 1]),
        (2, 1, UP, {(1, 1): 0, (2, 0): 1 / 3, (2, 2): 1 / 3, "over": 1 / 3}, [0]),
    ],
)
def test_two_of_three_steps_on_the_lake_slip_aside(i, j, action, expected, rewards):
    found, earned = outcomes("lake", {"i": i, "j": j}, action)
    assert found == pytest.approx({then: share for then, share in expected.items() if share})
    assert earned == rewards


@pytest.mark.parametrize(
    ("row", "column", "action", "expected", "reward"),
    [
        (3, 0, 1, (2, 0), -1),
        (3, 0, 2, (3, 0), -100),  # over the edge, and back to the start
        (2, 5, 3, (3, 0), -100),
        (2, 11, 3, "over", -1),
        (0, 0, 4, (0, 0), -1),
    ],
)
def test_whoever_falls_off_the_cliff_starts_again(row, column, action, expected, reward):
    assert outcomes("cliff_walking", {"row": row, "column": column}, action) == ({expected: 1}, [reward])


NORTH, SOUTH, WEST, EAST, PICK_UP, SET_DOWN = 1, 2, 3, 4, 5, 6
ABOARD = 4


@pytest.mark.parametrize(
    ("state", "action", "expected", "reward"),
    [
        ((0, 1, 0, 1), EAST, (0, 1, 0, 1), -1),  # a wall
        ((2, 1, 0, 1), EAST, (2, 2, 0, 1), -1),
        ((3, 1, 0, 1), WEST, (3, 1, 0, 1), -1),
        ((0, 0, 0, 1), WEST, (0, 0, 0, 1), -1),
        ((0, 0, 0, 1), NORTH, (0, 0, 0, 1), -1),
        ((0, 0, 0, 1), SOUTH, (1, 0, 0, 1), -1),
        ((0, 0, 0, 1), PICK_UP, (0, 0, ABOARD, 1), -1),
        ((0, 1, 0, 1), PICK_UP, (0, 1, 0, 1), -10),
        ((0, 4, ABOARD, 1), SET_DOWN, "over", 20),
        ((4, 3, ABOARD, 1), SET_DOWN, (4, 3, 3, 1), -1),  # another stand is allowed
        ((2, 2, ABOARD, 1), SET_DOWN, (2, 2, ABOARD, 1), -10),
    ],
)
def test_a_step_of_the_taxi(state, action, expected, reward):
    names = ("i", "j", "passenger", "destination")
    assert outcomes("taxi", dict(zip(names, state, strict=True)), action) == ({expected: 1}, [reward])


def test_a_step_in_the_four_rooms_goes_astray_in_one_of_three_cases():
    found, rewards = outcomes("four_rooms", {"i": 3, "j": 5}, 3)  # east, through the door
    assert found == pytest.approx({(3, 6): 2 / 3, (2, 5): 1 / 9, (4, 5): 1 / 9, (3, 4): 1 / 9})
    assert rewards == [-1]
    found, _ = outcomes("four_rooms", {"i": 2, "j": 5}, 3)  # a wall
    assert found == pytest.approx({(2, 5): 2 / 3, (1, 5): 1 / 9, (3, 5): 1 / 9, (2, 4): 1 / 9})


def test_a_robot_with_the_key_opens_the_door_and_goes_to_the_goal():
    starts = {"wall_x": 2, "door_y": 3, "x": 1, "y": 1, "key": 1, "heading": 1}
    traced = episode("door_and_key", *(f"{name}={value}" for name, value in starts.items()))
    shown = [traced.values[Slot(name, 0)] for name in ("x", "y", "heading", "has_key", "open_door")]
    # It takes the key below it, goes down to the door on its left, turns, opens it and goes in, along the walls.
    assert list(zip(*shown, strict=True))[:6] == [
        (1, 1, 1, True, False), (1, 2, 1, True, False), (1, 3, 1, True, False),
        (1, 3, 0, True, False), (1, 3, 0, True, True), (2, 3, 0, True, True),
    ]  # fmt: skip
    assert (shown[0][-1], shown[1][-1]) == (4, 4)
    steps = len(traced.steps)
    assert traced.rewards["arrived"][0][-1] == pytest.approx(1 - 0.9 * steps / 360)


def episode(task, *starts):
    """An episode of the design made by hand."""
    return bbsd.trace(TASKS / f"{task}_hand.yaml", set=[f"environment.state.{start}" for start in starts])


def cart_pole(x, speed, angle, turning, push):
    temp = (10 * push + 0.05 * turning**2 * sin(angle)) / 1.1
    gain = (9.8 * sin(angle) - cos(angle) * temp) / (0.5 * (4 / 3 - 0.1 * cos(angle) ** 2 / 1.1))
    speed_gain = temp - 0.05 * gain * cos(angle) / 1.1
    return x + 0.02 * speed, speed + 0.02 * speed_gain, angle + 0.02 * turning, turning + 0.02 * gain


def mountain_car(x, speed, pedal):
    speed = np.clip(speed + 0.001 * pedal - 0.0025 * cos(3 * x), -0.07, 0.07)
    x = np.clip(x + speed, -1.2, 0.6)
    return x, 0 if x == -1.2 and speed < 0 else speed


def acrobot(angle_1, angle_2, turning_1, turning_2, torque):
    state, dt = np.array([angle_1, angle_2, turning_1, turning_2]), 0.2
    first = acrobot_slope(state, torque)
    second = acrobot_slope(state + dt / 2 * first, torque)
    third = acrobot_slope(state + dt / 2 * second, torque)
    last = acrobot_slope(state + dt * third, torque)
    state = state + dt / 6 * (first + 2 * second + 2 * third + last)
    angles = [(angle + pi) % (2 * pi) - pi for angle in state[:2]]
    return *angles, np.clip(state[2], -4 * pi, 4 * pi), np.clip(state[3], -9 * pi, 9 * pi)


def acrobot_slope(state, torque, m=1.0, length=1.0, center=0.5, inertia=1.0, g=9.8):
    """The equations of motion as Sutton and Barto's book gives them."""
    a, b, u, v = state
    d1 = m * center**2 + m * (length**2 + center**2 + 2 * length * center * cos(b)) + 2 * inertia
    d2 = m * (center**2 + length * center * cos(b)) + inertia
    phi2 = m * center * g * cos(a + b - pi / 2)
    phi1 = -m * length * center * v**2 * sin(b) - 2 * m * length * center * v * u * sin(b)
    phi1 += (m * center + m * length) * g * cos(a - pi / 2) + phi2
    gain_2 = torque + d2 / d1 * phi1 - m * length * center * u**2 * sin(b) - phi2
    gain_2 /= m * center**2 + inertia - d2**2 / d1
    return np.array([u, v, -(d2 * gain_2 + phi1) / d1, gain_2])


@pytest.mark.parametrize(
    ("task", "step", "names", "command"),
    [
        ("cartpole", cart_pole, ("x", "speed", "angle", "turning"), "push"),
        ("mountain_car", mountain_car, ("x", "speed"), "pedal"),
        ("acrobot", acrobot, ("angle_1", "angle_2", "turning_1", "turning_2"), "torque"),
    ],
)
def test_motion_follows_the_equations_of_the_benchmark(task, step, names, command):
    traced = episode(task)
    states = np.array([traced.values[Slot(name, 0)] for name in names], dtype=float).T
    commands = np.array(traced.values[Slot(command, 0)], dtype=float)
    assert len(states) > 50
    for now, then, given in zip(states, states[1:], commands[1:], strict=False):
        np.testing.assert_allclose(then, step(*now, given), rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize(
    ("task", "starts", "steps", "return_"),
    [
        ("cartpole", [], 500, 500),
        ("cartpole", [f"angle={radians(11.9)}", "turning=3"], 1, 1),
        ("mountain_car", ["x=0.49", "speed=0.05"], 1, -1),
        ("acrobot", ["angle_1=3", "angle_2=0", "turning_1=0", "turning_2=0"], 1, 0),
    ],
)
def test_episodes_end_and_earn_as_in_the_benchmark(task, starts, steps, return_):
    traced = episode(task, *starts)
    assert len(traced.steps) == steps
    assert sum(sum(robots[0]) for robots in traced.rewards.values()) == return_
