"""What a behavior cannot know, where a sensor measures it already, and what it cannot set: the world."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY, Rewriting
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import functions_called, names_used
from bbsd.expression.vocabulary import DRAWS
from bbsd.language.field_types import scalar_text
from bbsd.language.meant.declared.trees import parsed, trees_of_behaviors, within
from bbsd.language.meant.edits.layout import correction, stretch
from bbsd.text.nodes import Mapping

if TYPE_CHECKING:
    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading

MAX_LISTED = 8
"""Names of state that an advice lists."""
SENSORS: Path = ("environment", "sensors")


def what_is_sensed(reading: Reading) -> None:
    """Read `excited: wind > 0.2` as the sensor with that very expression, where wind is a value of the world."""
    world = frozenset(reading.mapping(("environment", "world")))
    sensed: dict[str, str] = {}
    for name, value in reading.mapping(SENSORS).items():
        tree = parsed(value)
        if (
            tree is None
            or not names_used(tree) & {*world, "others"}
            or functions_called(tree) & {*DRAWS, "before"}
        ):
            continue
        sensed.setdefault(render(tree), name)
    if not sensed:
        return
    for path, tree in [*trees_of_behaviors(reading)]:
        for part in within(tree) if names_used(tree) & {*world, "others"} else ():
            sensor = sensed.get(render(part))
            text = scalar_text(reading.at(path))
            if sensor is None or text is None:
                continue
            start, length = part.span
            what = next((name for name in sorted(names_used(part)) if name in world), "")
            uses = f"{what} of the world" if what else "other robots"
            message = f"{path[1]} uses {uses}, and a behavior knows only its own robot; {sensor} senses that already"
            written = Rewriting(sensor, part.span, is_certain=False)
            seen = (reading.origin((*SENSORS, sensor)),)
            reading.tell(path, "BB066", message, f"write {sensor}", written, part.span, seen)
            reading.set(path, text[:start] + sensor + text[start + length :])
            break


def what_the_world_has(reading: Reading) -> None:
    """Read actions that set a value of the world besides state without it."""
    world = reading.mapping(("environment", "world"))
    state = reading.mapping(("environment", "state"))
    if not world or not state:
        return
    for behavior in reading.mapping(("behaviors",)):
        actions: Path = ("behaviors", behavior, "actions")
        for action in reading.mapping(actions):
            sets = reading.mapping((*actions, action))
            for name in [each for each in sets if each in world and len(sets) > 1]:
                path = (*actions, action, name)
                message = f"{name} is a value of the world, and an action cannot set it"
                advice = f"actions set a robot's own state: {', '.join([*state][:MAX_LISTED])}; what becomes of {name} "
                advice += f"stands in dynamics, {name}: ..., and may read what actions set"
                written = correction(reading.document(path), _without(reading, path), is_certain=False)
                reading.tell(path, "BB033", message, advice, written, KEY)
                reading.remove(path)


def _without(reading: Reading, path: Path) -> list[Edit] | None:
    """Return the edit that takes an entry out of a mapping that has others."""
    mapping, source, name = reading.node(path[:-1]), reading.document(path).source, str(path[-1])
    if not isinstance(mapping, Mapping) or name not in mapping.entries:
        return None
    entries = [*mapping.entries.values()]
    place = [*mapping.entries].index(name)
    entry = entries[place]
    if mapping.flow:
        start, end = entry.key.start, entry.value.end
        if place:
            start = entries[place - 1].value.end
        else:
            end = entries[1].key.start
        return [source.edit(start, end, "")]
    own = stretch(reading, path)
    return None if own is None else [source.edit(own[0], min(own[1] + 1, len(source.text)), "")]
