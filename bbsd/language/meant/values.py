"""Values that are no numbers where numbers are needed, or that are not there, and blocks of costs."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import WHOLE, Rewriting
from bbsd.language.goals import SMALL, goal_mistake, is_goal
from bbsd.language.meant.layout import correction
from bbsd.text.nodes import Scalar

if TYPE_CHECKING:
    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading

STEPS: Path = ("environment", "steps")
TIME = re.compile(
    r"(?P<number>\d+(?:\.\d+)?)\s*(?P<unit>s|sec|secs|seconds?|steps?|min|minutes?|h|hours?|ms)"
)
SECONDS = {"m": 60.0, "h": 3600.0}


def numbers_of_robots(reading: Reading) -> None:
    """Read a list of robots as how many they are."""
    path: Path = ("environment", "robots")
    value = reading.at(path)
    if isinstance(value, list | dict) and value:
        message = "robots must be a whole number from 1 to 64: how many there are"
        reading.tell(
            path,
            "BB022",
            message,
            f"write robots: {len(value)}; a robot's number is robot, from 0 on",
            Rewriting(str(len(value)), WHOLE, is_certain=False),
            WHOLE,
        )
        reading.replace(path, len(value))


def steps_in_time(reading: Reading) -> None:
    """Read steps that are given as a time as how many there are."""
    value = reading.at(STEPS)
    match = TIME.fullmatch(value.strip()) if isinstance(value, str) else None
    if match is None:
        return
    number, unit = float(match["number"]), match["unit"]
    dt = reading.mapping(("constants",)).get("dt")
    advice = "an episode is so many steps long, whatever time each takes"
    if not unit.startswith("step") and isinstance(dt, int | float) and dt > 0:
        seconds = number * (0.001 if unit == "ms" else SECONDS.get(unit[0], 1.0))
        number, advice = seconds / dt, f"with steps of {dt:g} seconds, write steps: {seconds / dt:g}"
    steps = max(1, round(number))
    message = f'steps must be a whole number of steps, not a time: "{value}"'
    written = Rewriting(str(steps), WHOLE, is_certain=unit.startswith("step"))
    reading.tell(STEPS, "BB022", message, advice, written, WHOLE)
    reading.set(STEPS, steps)


def values_at_the_start(reading: Reading) -> None:
    """Give state and world without a value the value 0."""
    for block in ("state", "world"):
        path: Path = ("environment", block)
        for name, value in reading.mapping(path).items():
            if value is not None:
                continue
            own = (*path, name)
            node, key, document = reading.node(own), reading.key(own), reading.document(own)
            edits: list[Edit] = []
            if isinstance(node, Scalar) and node.is_unwritten and key is not None:
                colon = document.source.text.index(":", key.end) + 1
                edits = [document.source.edit(colon, colon, " 0")]
            message = f"{name} has no value; it must be an expression, its value at the start"
            written = correction(document, edits, is_certain=False)
            reading.tell(own, "BB022", message, f"write {name}: 0, or what it is at first", written)
            reading.set(own, 0)


def blocks_of_costs(reading: Reading) -> None:
    """Read a block of what is good or bad, where there is no reward, as the reward."""
    goals = [key for key in reading.data if is_goal((key,))]
    if "reward" in reading.data or len(goals) != 1:
        return
    path: Path = (goals[0],)
    value, key, document = reading.at(path), reading.key(path), reading.document(path)
    if not isinstance(value, dict) or not value or key is None:
        return
    edits = [document.source.edit(key.start, key.end, "reward")]
    for term in value if goals[0] in SMALL else ():
        node = reading.node((*path, term))
        if not isinstance(node, Scalar) or not node.is_plain:
            edits = []
            break
        new = f"-{node.text}" if re.fullmatch(r"[\w.]+", node.text) else f"-({node.text})"
        edits.append(document.source.edit(node.start, node.end, new))
    mistake = goal_mistake(path, value)
    written = correction(document, edits, is_certain=False)
    reading.told.append((reading.origin(path), mistake._replace(correction=written)))
    reading.rename(path, "reward")
