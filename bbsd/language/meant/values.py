"""Values that are no numbers where numbers are needed, or that are not there, and blocks of costs."""

from __future__ import annotations

import math
import operator
import re
from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import reads
from bbsd.expression.syntax.mistakes import WHOLE, ExpressionError, Rewriting
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.tree import Binary, Call, Expr, Name, Number, names_used
from bbsd.language.field_types import grouped
from bbsd.language.goals import SMALL, goal_mistake, is_goal
from bbsd.language.keys import fields_at
from bbsd.language.meant.edits.layout import correction
from bbsd.text.nodes import Scalar

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

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
    if not math.isfinite(number):
        return
    steps = max(1, round(number))
    message = f'steps must be a whole number of steps, not a time: "{value}"'
    written = Rewriting(str(steps), WHOLE, is_certain=unit.startswith("step"))
    reading.tell(STEPS, "BB022", message, advice, written, WHOLE)
    reading.set(STEPS, steps)


def end_of_one_robot(reading: Reading) -> None:
    """Read `ends: height > 3`, with several robots, as what must hold for all of them."""
    path: Path = ("environment", "ends")
    text, robots = reading.at(path), reading.at(("environment", "robots"))
    own = {*reading.mapping(("environment", "state")), *reading.mapping(("environment", "sensors"))}
    if not isinstance(text, str) or not isinstance(robots, int) or robots < 2 or not reads(text):
        return
    used = own & names_used(parse(text))
    if not used or re.search(r"\[|\bfor\b", text):
        return
    inner = re.sub(rf"\b({'|'.join(sorted(used))})\b", r"\1[r]", text)
    new, name = f"all({inner} for r in team)", min(used, key=text.index)
    message = f"{name} is one value for each robot; here the team is meant"
    advice = f"write {new}, or any(...) where one robot is enough"
    reading.tell(path, "BB059", message, advice, Rewriting(new, WHOLE, is_certain=False), WHOLE)
    reading.set(path, new)


BLOCKS_OF_COUNTS: tuple[Path, ...] = (
    ("environment",),
    ("design",),
    *(("design", block) for block in ("stop", "coevolution", "learning", "culture", "answer")),
)
MULTIPLES = {"": 1, "k": 1_000, "m": 1_000_000, "thousand": 1_000, "million": 1_000_000}
COUNT = re.compile(
    r"(?P<number>\d+(?:[_,' ]\d{3})+|\d+(?:\.\d+)?(?:e\d+)?) ?(?P<unit>k|m|thousand|million|)"
    r"(?: (?:episodes|steps|robots|agents|generations))?",
    re.IGNORECASE,
)


def whole_numbers(reading: Reading) -> None:
    """Read `100k`, `1,000` and `10 / dt` as the whole numbers that they are."""
    for block in BLOCKS_OF_COUNTS:
        fields = fields_at(block) or {}
        for key, value in reading.mapping(block).items():
            field = fields.get(key)
            if field is None or not isinstance(value, str) or not _takes_whole(field.annotation):
                continue
            if grouped.__name__ in repr(field) and grouped(value) is not value:
                continue
            if (number := _whole_of(value, reading.mapping(("constants",)))) is None:
                continue
            path, is_counted = (*block, key), COUNT.fullmatch(value.strip()) is not None
            message = f"{key} must be a whole number"
            message += "" if is_counted else ", not an expression: it is the same whatever constants are"
            written = Rewriting(str(number), WHOLE, is_certain=is_counted)
            reading.tell(path, "BB022", message, f"write {key}: {number}", written, WHOLE)
            reading.set(path, number)


def _takes_whole(annotation: object) -> bool:
    """Return whether a key takes a whole number, perhaps besides other things, but no expression."""
    text = str(annotation)
    return annotation is int or ("int" in text and "Expression" not in text)


def _whole_of(text: str, constants: dict[str, Data]) -> int | None:
    """Return the whole number that a text means, None for other texts."""
    if match := COUNT.fullmatch(text.strip()):
        number = float(re.sub("[_,' ]", "", match["number"])) * MULTIPLES[match["unit"].lower()]
        return int(number) if number.is_integer() else None
    try:
        value = _calculated(parse(text), constants)
    except (ExpressionError, ZeroDivisionError, OverflowError, TypeError):
        return None
    if value is None or not math.isfinite(value):
        return None
    whole = round(value)
    return whole if abs(whole - value) < 1e-9 * abs(value) else None


def _calculated(tree: Expr, constants: dict[str, Data]) -> float | None:
    """Return what arithmetic of numbers and constants gives; None for anything else."""
    match tree:
        case Number(value=value):
            return value
        case Name(name=name) if isinstance(constant := constants.get(name), int | float):
            return float(constant)
        case Call(function="round" | "int" | "floor" | "ceil", arguments=(argument,)):
            inner = _calculated(argument, constants)
            return None if inner is None else float(round(inner))
        case Binary(operator=operator, left=left, right=right) if operator in ARITHMETIC:
            first, second = _calculated(left, constants), _calculated(right, constants)
            return None if first is None or second is None else ARITHMETIC[operator](first, second)
    return None


ARITHMETIC: dict[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "//": operator.floordiv,
}


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
