"""Counterfactuals of 1,000 random states, held against a brute force that shares nothing with what it tests.

A situation is a cell of each sensor; a brute force decides by looking up tables itself, and goes through every joint
cell, and through every single change and every pair of changes of every cell of every table and of the order.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, product
from random import Random

import numpy as np
import pytest

from bbsd.architecture import Architecture, joint_space
from bbsd.explanation.why.otherwise import AsItWas, otherwise
from bbsd.explanation.why.situation import Situation
from tests.unit.architecture.designs import meaning_of

SPEC = """
bbsd: 1
name: made-up
environment:
  steps: 3
  state: {x: 0, y: 0, z: 0, command: 0}
  sensors:
    a: values(x, 0, 2)
    b: values(y, 0, 3)
    alarm: z > 0
behaviors:
  low: {inputs: [a], actions: {go: {command: 1}, stop: {command: 2}}}
  middle: {excited: alarm, inputs: [a, b], actions: {turn: {command: 3}}}
  high: {inputs: [alarm], excited: x + y > 2, actions: {stop: {command: 4}}}
  spare: {excited: not alarm, inputs: [b], actions: {go: {command: 5}, rest: {command: 6}, back: {command: 7}}}
reward: {right: x}
design: {layers: 3}
"""
SENSORS = {"a": 3, "b": 4, "alarm": 2, "high": 2}
"""Cells of what is perceived; `high` stands for whether that behavior is excited."""
INPUTS = {"low": "a", "middle": "ab", "high": ("alarm",), "spare": "b"}
EXCITED = {
    "low": lambda seen: True,
    "middle": lambda seen: seen["alarm"] == 1,
    "high": lambda seen: seen["high"] == 1,
    "spare": lambda seen: seen["alarm"] == 0,
}
ACTIONS = {"low": ["go", "stop"], "middle": ["turn"], "high": ["stop"], "spare": ["go", "rest", "back"]}
NAMES = [*INPUTS]
ASKED = ["go", "stop", "turn", "low", "spare", "high.stop", "spare.back", "middle", "nobody"]


@dataclass
class Design:
    """Tables as lists by behavior, and the names of the layers, lowest first."""

    tables: dict[str, list[int]]
    structure: list[str]

    def act(self, seen):
        for name in reversed(self.structure):
            wish = self.tables[name][cell_of(name, seen)]
            if EXCITED[name](seen) and wish:
                return f"{name}.{ACTIONS[name][wish - 1]}"
        return "nobody"

    def neighbors(self):
        """Every design that one change makes of this one."""
        for name, table in self.tables.items():
            for place, other in product(range(len(table)), range(len(ACTIONS[name]) + 1)):
                if other != table[place]:
                    new = [*table[:place], other, *table[place + 1 :]]
                    yield Design({**self.tables, name: new}, self.structure)
        for one, two in combinations(range(len(self.structure)), 2):
            order = [*self.structure]
            order[one], order[two] = order[two], order[one]
            yield Design(self.tables, order)
        for layer, name in product(range(len(self.structure)), set(NAMES) - {*self.structure}):
            yield Design(self.tables, [*self.structure[:layer], name, *self.structure[layer + 1 :]])

    @property
    def architecture(self):
        tables = tuple(np.array(self.tables[name], np.uint8) for name in NAMES)
        return Architecture(tables, np.array([NAMES.index(name) for name in self.structure]))


def cell_of(name, seen):
    cell = 0
    for sensor in INPUTS[name]:
        cell = cell * SENSORS[sensor] + seen[sensor]
    return cell


def stands_for(name, act):
    behavior, _, action = act.partition(".")
    return name in {act, behavior} or (name == action)


def situation_of(seen):
    return Situation(
        tuple(EXCITED[name](seen) for name in NAMES), tuple(cell_of(name, seen) for name in NAMES), {}
    )


def random_design(random):
    tables = {
        name: [
            random.choice([0, 0, *range(1, len(ACTIONS[name]) + 1)])
            for _ in range(int(np.prod([SENSORS[each] for each in INPUTS[name]])))
        ]
        for name in NAMES
    }
    return Design(tables, random.sample(NAMES, 3))


def changed_by(design, way, seen):
    """A design after the changes that a way tells in words."""
    tables, structure = {name: [*table] for name, table in design.tables.items()}, [*design.structure]
    for change in way.changes:
        name = change.behavior
        if change.kind == "cell":
            assert change.cell == {sensor: label(sensor, seen[sensor]) for sensor in INPUTS[name]}
            words = ["no action", *ACTIONS[name]]
            assert words[tables[name][cell_of(name, seen)]] == change.was
            tables[name][cell_of(name, seen)] = words.index(change.becomes)
        elif change.kind == "exchange":
            one, two = structure.index(name), structure.index(change.other)
            structure[one], structure[two] = structure[two], structure[one]
            assert structure[change.layer - 1] == name
        else:
            structure[structure.index(change.other)] = name
            assert structure[change.layer - 1] == name
    return Design(tables, structure)


def label(sensor, cell):
    return str(bool(cell)).lower() if sensor == "alarm" else str(cell)


def nearest(design, seen, is_right, possible):
    """The fewest sensors whose change makes the act right, the least distance of these, and how many do with as few."""
    found = []
    for cells in product(*map(range, SENSORS.values())):
        if possible is not None and not possible[cells]:
            continue
        other = dict(zip(SENSORS, cells, strict=True))
        if is_right(design.act(other)):
            steps = [abs(other[sensor] - seen[sensor]) for sensor in SENSORS]
            found.append((sum(step > 0 for step in steps), sum(steps)))
    fewest = min(found, default=(0, 0))[0]
    return min(found, default=None), sum(count == fewest for count, _ in found)


def fewest_changes(design, seen, is_right, most):
    """The fewest changes of the design that make the act right; None if more than `most` are needed."""
    designs = [design]
    for n_changes in range(1, most + 1):
        designs = [neighbor for each in designs for neighbor in each.neighbors()]
        if any(is_right(each.act(seen)) for each in designs):
            return n_changes
    return None


@pytest.fixture(scope="module")
def made_up():
    meaning = meaning_of(SPEC)
    return meaning.episode.modules, joint_space(meaning)


@pytest.mark.parametrize("seed", range(20))
def test_the_smallest_changes_of_random_states_are_the_smallest(made_up, seed):
    modules, space = made_up
    random, asked = Random(seed), 0
    while asked < 50:
        design = random_design(random)
        seen = {sensor: random.randrange(size) for sensor, size in SENSORS.items()}
        name, act = random.choice(ASKED), design.act(seen)
        wanted = not stands_for(name, act)
        asked += 1

        def is_right(act, name=name, wanted=wanted):
            return stands_for(name, act) is wanted

        possible = possible_with(seen, random) if asked % 2 else None
        situation = situation_of(seen)
        found = otherwise(
            modules, design.architecture, space, situation, name, wanted=wanted, possible=possible
        )
        assert_inputs(found, design, seen, is_right, possible)
        assert_ways(found, design, seen, is_right, possible)


def possible_with(seen, random):
    """Some of the joint cells, that of the situation among them."""
    possible = np.array([random.random() < 0.6 for _ in range(np.prod([*SENSORS.values()]))])
    possible = possible.reshape([*SENSORS.values()])
    possible[tuple(seen.values())] = True
    return possible


def assert_inputs(found, design, seen, is_right, possible):
    expected, equally_small = nearest(design, seen, is_right, possible)
    if expected is None:
        assert found.inputs == ()
        return
    other = dict(seen)
    for change in found.inputs:
        sensor = change.input
        labels = (
            ["not excited", "excited"]
            if sensor == "high"
            else [label(sensor, c) for c in range(SENSORS[sensor])]
        )
        assert labels.index(change.was) == seen[sensor]
        other[sensor] = labels.index(change.becomes)
    assert is_right(design.act(other))
    assert design.act(other) == found.then
    assert (len(found.inputs), sum(change.distance for change in found.inputs)) == expected
    assert found.equally_small == equally_small


def assert_ways(found, design, seen, is_right, possible):
    if not found.ways:
        assert fewest_changes(design, seen, is_right, 2) is None
        return
    size = len(found.ways[0].changes)
    assert fewest_changes(design, seen, is_right, min(size, 2)) == (size if size < 3 else None)
    for way in found.ways:
        after = changed_by(design, way, seen)
        assert len(way.changes) == size
        assert is_right(after.act(seen))
        assert after.act(seen) == way.then
        joint = [
            dict(zip(SENSORS, cells, strict=True))
            for cells in product(*map(range, SENSORS.values()))
            if possible is None or possible[cells]
        ]
        assert way.elsewhere == sum(after.act(each) != design.act(each) for each in joint)
    if size == 1:
        assert found.ways_in_all == sum(is_right(each.act(seen)) for each in design.neighbors())


def test_what_was_so_is_not_asked_for(made_up):
    modules, space = made_up
    design = Design({"low": [1, 1, 1], "middle": [0] * 12, "high": [0, 0], "spare": [0] * 4}, ["low"])
    seen = dict.fromkeys(SENSORS, 0)
    with pytest.raises(AsItWas, match=r"go did control: low\.go"):
        otherwise(modules, design.architecture, space, situation_of(seen), "go", wanted=True)
    with pytest.raises(AsItWas, match=r"middle did not control: low\.go did"):
        otherwise(modules, design.architecture, space, situation_of(seen), "middle", wanted=False)


def test_a_large_joint_space_is_searched_by_single_inputs_and_pairs_of_them():
    inputs = "\n".join(f"    i{n}: values(x{n}, 0, 9)" for n in range(6))
    state = ", ".join(f"x{n}: 0" for n in range(6))
    far = "{when: {i0: 9, i1: 9, i2: 9}, do: stop}"
    rules = f"rules: [{{when: {{i1: [7, 8], i4: 5}}, do: go}}, {far}, {{otherwise: no action}}]"
    meaning = meaning_of(f"""
bbsd: 1
name: large
environment: {{steps: 1, state: {{{state}, c: 0}}}}
behaviors:
  b:
    inputs:
{inputs.replace("    i", "      i")}
    actions: {{go: {{c: 1}}, stop: {{c: 2}}}}
    {rules}
structure: [b]
reward: {{right: c}}
""")
    (module,) = meaning.episode.modules
    space = joint_space(meaning)
    assert not space.is_small
    architecture = Architecture((np.frombuffer(module.table.given, np.uint8),), np.array([0]))
    situation = Situation((True,), (0,), {})
    found = otherwise([module], architecture, space, situation, "go", wanted=True)
    assert found.tried == "pairs"
    assert [(each.input, each.was, each.becomes) for each in found.inputs] == [
        ("i1", "0", "7"),
        ("i4", "0", "5"),
    ]
    assert (found.equally_small, found.ways[0].elsewhere) == (2, None)
    assert otherwise([module], architecture, space, situation, "stop", wanted=True).inputs == ()
