"""Specs that Hypothesis makes up: every block of the language, small, and without mistakes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hypothesis import strategies as st

from tests.interpreter.made_up_behaviors import Senses, behavior, structure
from tests.interpreter.made_up_expressions import Draw, Reach, a_list, number, truth, whole
from tests.interpreter.made_up_partitions import TRUTHS, partition

SHOWN = {
    "shown_x": "x",
    "shown_y": "y",
    "shown_place": "place",
    "shown_flag": "1 if flag else 2",
    "shown_amount": "amount",
    "shown_alarm": "1 if alarm else 2",
    "shown_calls": "sum(calls)",
    "shown_bins": "bins[0] - bins[1] * bins[2]",
    "shown_marks": "sum(sum(1 if mark else 3 for mark in row) for row in marks)",
    "shown_bins_before": "mean(before(bins))",
    "shown_level": "level",
    "shown_eyes": "sum(eyes)",
    "shown_before": "before(level - x)",
    "shown_constants": "chosen + changing + mean(mixed) + max(left - 2 * right for left, right in grid)",
}
"""Terms that show every value of an episode."""

Block = dict[str, Any]
Definitions = tuple[tuple[str, int], ...]


@st.composite
def specs(draw: Draw, most_robots: int = 6) -> Block:
    """A spec as plain data."""
    constants, known = some_constants(draw, robots=draw(st.integers(1, most_robots)))
    starts, team, own = some_values(draw, known)
    definitions, own_defined, all_defined = some_definitions(draw, own, everything(team, own))
    own = replace(own, definitions=own_defined)
    every = replace(everything(team, own), definitions=own_defined + all_defined)
    every = replace(every, numbers_of_robots=(*every.numbers_of_robots, "mine"))
    sensors, senses = some_sensors(draw, replace(every, draws=True, before=True), own)
    rewarded = everything(every, senses.reach)
    return {
        "bbsd": 1,
        "name": "made-up",
        "constants": shuffled(draw, constants),
        "environment": {
            "robots": known.robots,
            "steps": draw(st.integers(1, 4)),
            **starts,
            "definitions": shuffled(draw, definitions),
            "dynamics": some_dynamics(draw, starts, team, rewarded),
            "sensors": shuffled(draw, sensors),
            **some_end(draw, team),
        },
        **some_behaviors(draw, senses, starts["state"]),
        "reward": some_reward(draw, replace(rewarded, before=True)),
    }


def shuffled(draw: Draw, block: Block) -> Block:
    """The same block in another order, which must not matter."""
    return {name: block[name] for name in draw(st.permutations(list(block)))}


def everything(team: Reach, own: Reach) -> Reach:
    """What can be used where one robot's values and the team's are in reach."""
    return replace(
        own,
        numbers=tuple(dict.fromkeys(own.numbers + team.numbers)),
        truths=tuple(dict.fromkeys(own.truths + team.truths)),
        lists=tuple(dict.fromkeys(own.lists + team.lists)),
        lists_of_robots=team.lists_of_robots,
        numbers_of_robots=team.numbers_of_robots,
        truths_of_robots=team.truths_of_robots,
        team=True,
        others=own.robots > 1,
        definitions=tuple(dict.fromkeys(own.definitions + team.definitions)),
    )


def some_constants(draw: Draw, robots: int) -> tuple[Block, Reach]:
    """Numbers, lists and tables, drawn and of the generation."""
    row = st.lists(st.integers(-3, 9), min_size=2, max_size=2)
    constants: Block = {
        "plain": draw(st.floats(-10, 10).map(lambda x: round(x, 3))),
        "count": draw(st.integers(0, 4)),
        "items": draw(st.lists(st.integers(-3, 9), min_size=1, max_size=3)),
        "rows": draw(st.lists(row, min_size=1, max_size=3)),
    }
    known = Reach(
        robots,
        numbers=("plain",),
        wholes=("count",),
        lists=(("items", len(constants["items"])),),
        tables=(("rows", len(constants["rows"]), 2),),
    )
    drawing = replace(known, draws=True)
    constants["chosen"] = number(draw, drawing)
    constants["mixed"] = [number(draw, drawing, 2), draw(st.integers(0, 3)), number(draw, drawing, 1)]
    inner, (each,) = drawing.binding(wholes=1)
    constants["grid"] = f"list(list({number(draw, inner, 2)} for k in range(2)) for {each} in range(3))"
    constants["changing"] = number(draw, replace(known, wholes=(*known.wholes, "generation")))
    return constants, replace(
        known,
        numbers=("plain", "chosen", "changing"),
        lists=(*known.lists, ("mixed", 3)),
        tables=(*known.tables, ("grid", 3, 2)),
    )


def some_values(draw: Draw, known: Reach) -> tuple[Block, Reach, Reach]:
    """World and state; what the team's expressions can use of them, and what one robot's."""
    starting = replace(known, draws=True)
    world = {
        "amount": number(draw, starting, 2),
        "alarm": truth(draw, starting, 2),
        "calls": a_list(draw, starting, 2),
    }
    late = replace(starting, numbers=(*known.numbers, "amount"))
    own_late = replace(late, numbers=(*late.numbers, "x"), wholes=(*known.wholes, "robot"))
    state = {
        "x": number(draw, late, 2),
        "y": number(draw, replace(own_late, team=True, numbers_of_robots=("x",)), 2),
        "place": whole(draw, replace(own_late, draws=True), 2),
        "flag": truth(draw, own_late, 2),
        "bins": a_list(draw, own_late, 3),
        "marks": a_list(draw, own_late, 2, 2),
    }
    team = replace(
        known,
        numbers=(*known.numbers, "amount"),
        truths=("alarm",),
        wholes=(*known.wholes, "robots", "steps"),
        numbers_of_robots=("x", "y", "place"),
        truths_of_robots=("flag",),
        lists=(*known.lists, ("calls", 2)),
        lists_of_robots=(("bins", 3),),
        team=True,
    )
    own = replace(
        known,
        numbers=(*known.numbers, "x", "y"),
        truths=("flag",),
        wholes=(*known.wholes, "place", "robot"),
        lists=(*known.lists, ("bins", 3)),
        truth_tables=(("marks", 2, 2),),
    )
    return {"world": shuffled(draw, world), "state": shuffled(draw, state)}, team, own


def some_definitions(draw: Draw, own: Reach, every: Reach) -> tuple[Block, Definitions, Definitions]:
    """Definitions with and without parameters, of one robot's values and of all values."""
    with_one = replace(own, numbers=(*own.numbers, "p"))
    block = {"mine": number(draw, own, 2), "bent(p)": number(draw, with_one, 2)}
    own_defined = (("mine", 0), ("bent", 1))
    with_two = replace(every, numbers=(*every.numbers, "p", "q"), definitions=own_defined)
    block["between(p, q)"] = number(draw, with_two, 2)
    return block, own_defined, (("between", 2),)


def some_sensors(draw: Draw, every: Reach, own: Reach) -> tuple[Block, Senses]:
    """Sensors of all kinds; later ones use earlier ones."""
    block: Block = {"level": number(draw, every), "warm": truth(draw, every)}
    later = replace(
        every, numbers=(*every.numbers, "level"), numbers_of_robots=(*every.numbers_of_robots, "level")
    )
    inner, (each,) = later.binding(numbers=1)
    length = draw(st.integers(1, 3))
    block["eyes"] = f"list({number(draw, inner, 2)} for {each} in range({length}))"
    later = replace(later, lists=(*later.lists, ("eyes", length)), truths=(*later.truths, "warm"))
    shared = {name: partition(draw, later) for name in ("kind", "zone")}
    seen = replace(
        own,
        numbers=(*own.numbers, "level"),
        truths=(*own.truths, "warm"),
        lists=(*own.lists, ("eyes", length)),
    )
    cells = {name: part.cells for name, part in shared.items()} | {"warm": TRUTHS, "flag": TRUTHS}
    return block | {name: part.data for name, part in shared.items()}, Senses(seen, cells)


def some_dynamics(draw: Draw, starts: Block, team: Reach, own: Reach) -> Block:
    """Next values for some of world and state."""
    team, own = replace(team, draws=True), replace(own, draws=True)
    own = replace(own, wholes=(*own.wholes, "step"))
    ways = {
        "amount": lambda: number(draw, team),
        "alarm": lambda: truth(draw, team),
        "x": lambda: number(draw, own),
        "y": lambda: number(draw, own),
        "place": lambda: whole(draw, own),
        "flag": lambda: truth(draw, own),
        "calls": lambda: a_list(draw, team, 2),
        "bins": lambda: a_list(draw, own, 3),
        "marks": lambda: a_list(draw, own, 2, 2),
    }
    chosen = draw(st.lists(st.sampled_from(sorted(ways)), unique=True, max_size=4))
    return {name: ways[name]() for name in chosen}


def some_end(draw: Draw, team: Reach) -> Block:
    return {"ends": truth(draw, team)} if draw(st.booleans()) else {}


def some_behaviors(draw: Draw, senses: Senses, state: Block) -> Block:
    """Behaviors, and the structure if it is given."""
    behaviors = {f"b{k}": behavior(draw, senses) for k in range(draw(st.integers(1, 3)))}
    return {"behaviors": behaviors, **structure(draw, list(behaviors))}


def some_reward(draw: Draw, every: Reach) -> Block:
    reach = replace(every, wholes=(*every.wholes, "step"))
    made_up = {f"term_{k}": number(draw, reach) for k in range(draw(st.integers(0, 2)))}
    return shuffled(draw, {**made_up, **SHOWN})
