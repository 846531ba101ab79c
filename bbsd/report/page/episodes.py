"""The episodes of a page as plain data: values, decisions, rewards and scene, step by step."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.report.figures.plane import limits_of
from bbsd.report.page.columns import packed, shortened

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.api.paging import Replay
    from bbsd.evaluation import Scene
    from bbsd.evaluation.tracing.traced import Value
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning
    from bbsd.report.plain import Plain


def episode_plain(replay: Replay, meaning: Meaning, most_steps: int) -> dict[str, Plain]:
    """Return an episode's first steps, at most so many; values have one entry more, the start."""
    trace = replay.trace
    shown = min(len(trace.steps), most_steps)
    decisions = trace.decisions
    behaviors = range(decisions.cells.shape[2])

    def of_each(array: NDArray[np.int64] | NDArray[np.bool_]) -> list[Plain]:
        robots = range(array.shape[1])
        return [[packed(array[:shown, robot, each].tolist()) for each in behaviors] for robot in robots]

    return {
        "label": replay.rank,
        "number": replay.number,
        "total": shortened(replay.total),
        "steps": len(trace.steps),
        "shown": shown,
        "values": [
            _value_plain(slot, [trace.start[slot], *column[:shown]], meaning)
            for slot, column in trace.values.items()
        ],
        "controlling": [packed(robot.tolist()) for robot in decisions.controlling[:shown].T],
        "actions": [packed(actions[:shown]) for actions in trace.actions],
        "excited": of_each(decisions.excited.astype(np.int64)),
        "cells": of_each(decisions.cells),
        "wishes": of_each(decisions.wishes),
        "expectations": [packed(outcomes[:shown]) for outcomes in trace.expectations],
        "rewards": [
            {"name": term, "robots": [packed(values[:shown].tolist()) for values in robots]}
            for term, robots in trace.rewards.items()
        ],
        "scene": None if trace.scene is None else _scene_plain(trace.scene, shown + 1),
    }


def _value_plain(slot: Slot, column: Sequence[Value], meaning: Meaning) -> dict[str, Plain]:
    robots = meaning.spec.environment.robots
    robot = "" if slot.robot is None or robots == 1 else f"robot {slot.robot}"
    places = "".join(f"[{place}]" for place in slot.place)
    return {
        "name": slot.name,
        "label": f"{robot}{places}" or slot.name,
        "text": f"{slot.name}{places}" + (f", {robot}" if robot else ""),
        "sensed": slot.name in meaning.spec.environment.sensors,
        "column": packed(column),
    }


def _scene_plain(scene: Scene, moments: int) -> dict[str, Plain]:
    limits = limits_of(scene)
    return {
        "limits": [shortened(value) for value in (limits.x[0], limits.y[0], limits.x[1], limits.y[1])],
        "places": [_rows(track[:moments]) for track in scene.places],
        "headings": None if scene.headings is None else _rows(scene.headings[:, :moments]),
        "area": None if scene.area is None else [shortened(value) for value in scene.area.tolist()],
        "circles": _rows(scene.circles),
        "lines": [_rows(path) for path in scene.paths.values()],
        "walls": [] if scene.grid is None else np.argwhere(scene.grid != 0)[:, ::-1].tolist(),
        "marks": [{"name": name, "track": _rows(track[:moments])} for name, track in scene.marks.items()],
    }


def _rows(array: NDArray[np.float64]) -> list[Plain]:
    return [[shortened(value) for value in row] for row in array.tolist()]
