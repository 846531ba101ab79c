"""A program that a user would write with DEAP: individuals are lists, `evaluate` runs an episode in plain Python."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from deap import base, creator

from benchmarks.workloads.lifting import (
    BEHAVIORS,
    DT,
    GOAL,
    RADIUS,
    ROBOTS,
    SMALL_TILT,
    SPEED_STEP,
    STEPS,
    TOP_SPEED,
    Earnings,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.workloads.lifting import Workload


class Robot:
    def __init__(self, height: float) -> None:
        self.height = height
        self.speed = 0.0


class Team:
    """The robots and what they sense."""

    def __init__(self, heights: list[float]) -> None:
        self.robots = [Robot(height) for height in heights]
        self.tilt = self.sense_tilt()

    def sense_tilt(self) -> float:
        first, second, third = (robot.height for robot in self.robots)
        sideways = (third - second) / (math.sqrt(3) * RADIUS)
        forward = (first - (second + third) / 2) / (1.5 * RADIUS)
        return math.degrees(math.atan(math.sqrt(sideways * sideways + forward * forward)))

    def place(self, robot: Robot) -> int:
        heights = [other.height for other in self.robots]
        if robot.height == min(heights):
            return 0
        return 1 if robot.height == max(heights) else 2


def sees_nothing(_team: Team, _robot: Robot) -> int:
    return 0


def sees_pace(_team: Team, robot: Robot) -> int:
    return int(max(0, min(5, robot.speed)))


def sees_goal(_team: Team, robot: Robot) -> int:
    return int(robot.height >= GOAL)


def sees_place(team: Team, robot: Robot) -> int:
    return team.place(robot) * 2 + int(team.tilt > SMALL_TILT)


SENSES = (sees_nothing, sees_pace, sees_goal, sees_place, sees_place)
ACTIONS = (
    lambda speed: speed + SPEED_STEP,
    lambda speed: min(speed, TOP_SPEED),
    lambda _speed: 0.0,
    lambda speed: min(speed + SPEED_STEP, TOP_SPEED),
    lambda speed: max(speed - SPEED_STEP, 0.0),
)


def controlling(team: Team, robot: Robot, individual: creator.Agent) -> int | None:
    for behavior in reversed(individual.structure):
        if individual[behavior][SENSES[behavior](team, robot)]:
            return behavior
    return None


def reward(team: Team, robot: Robot, before: float, step: int) -> float:
    earned = 1.0 if team.tilt - before < -0.5 else -0.1
    earned += 1 / math.sqrt(step) if team.tilt < SMALL_TILT else -0.1 * math.sqrt(step)
    earned += 1.0 if abs(robot.height - GOAL) < 0.5 else -0.1
    earned += -1.0 if robot.height > GOAL + 0.2 else 0.0
    return earned + (-0.1 if abs(robot.speed) > TOP_SPEED else 0.0)


def evaluate(individual: creator.Agent) -> tuple[float]:
    team = Team(individual.heights)
    credit = dict.fromkeys((*range(BEHAVIORS), None), 0.0)
    total = 0.0
    for step in range(1, STEPS + 1):
        who = [controlling(team, robot, individual) for robot in team.robots]
        for robot, behavior in zip(team.robots, who, strict=True):
            if behavior is not None:
                robot.speed = ACTIONS[behavior](robot.speed)
            robot.height += robot.speed * DT
        before, team.tilt = team.tilt, team.sense_tilt()
        earned = [reward(team, robot, before, step) for robot in team.robots]
        for behavior, amount in zip(who, earned, strict=True):
            credit[behavior] += amount
        total += sum(earned)
    individual.credit = [amount / ROBOTS for amount in credit.values()]
    return (total / ROBOTS,)


def prepare(workload: Workload) -> Callable[[], Earnings]:
    """Prepare each agent as an individual of DEAP, evaluated through its toolbox."""
    if not hasattr(creator, "Agent"):
        creator.create("Return", base.Fitness, weights=(1.0,))
        creator.create("Agent", list, fitness=creator.Return, structure=None, heights=None, credit=None)
    toolbox = base.Toolbox()
    toolbox.register("evaluate", evaluate)
    population = []
    for heights, tables, structure in zip(
        workload.heights, workload.tables, workload.structures, strict=True
    ):
        individual = creator.Agent(tables.tolist())
        individual.heights, individual.structure = heights.tolist(), structure.tolist()
        population.append(individual)

    def run() -> Earnings:
        for individual, fitness in zip(population, toolbox.map(toolbox.evaluate, population), strict=True):
            individual.fitness.values = fitness
        returns = [individual.fitness.values[0] for individual in population]
        return Earnings(np.array(returns), np.array([individual.credit for individual in population]))

    return run
