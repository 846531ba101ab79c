"""What the theory's page names exists, and the parts of the paper that no unit test has worked by hand."""

import ast
import re
from importlib import import_module
from math import sqrt
from pathlib import Path

import pytest

from bbsd.architecture import Architecture
from bbsd.compiler import compile_meaning
from bbsd.evaluation import trace
from bbsd.language.loading import load
from bbsd.text import Source

ROOT = Path(__file__).parents[2]
TEXT = "\n".join(
    path.read_text(encoding="utf-8")
    for path in sorted((ROOT / "docs").rglob("*.md"))
    if path.name != "tutorial.md"
)
CODE = sorted(set(re.findall(r"`(bbsd(?:\.\w+)+)`", TEXT)))
TESTS = sorted(set(re.findall(r"`(tests/[\w/]+\.py)::(\w+)`", TEXT)))
YAML = sorted(set(re.findall(r"`([\w.]+)` of `(specs/\w+\.yaml)`", TEXT)))


def found(dotted):
    """What a dotted name stands for: a module, or what is reached from one by attributes."""
    parts = dotted.split(".")
    for length in range(len(parts), 0, -1):
        try:
            value = import_module(".".join(parts[:length]))
        except ModuleNotFoundError:
            continue
        for part in parts[length:]:
            value = value.__dataclass_fields__[part] if not hasattr(value, part) else getattr(value, part)
        return value
    raise ModuleNotFoundError(dotted)


@pytest.mark.parametrize("dotted", CODE)
def test_the_code_that_is_named_exists(dotted):
    assert found(dotted) is not None


@pytest.mark.parametrize(("path", "name"), TESTS)
def test_the_tests_that_are_named_exist(path, name):
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    assert name in [node.name for node in tree.body if isinstance(node, ast.FunctionDef)]


@pytest.mark.parametrize(("key", "path"), YAML)
def test_the_parts_of_specs_that_are_named_exist(key, path):
    data = load(Source.read(ROOT / path)).data
    for part in key.split("."):
        data = data[part]
    assert data


def test_every_equation_of_the_paper_has_a_row():
    rows = re.findall(
        r"^\| \((\d+)\) \|", (ROOT / "docs" / "theory.md").read_text(encoding="utf-8"), re.MULTILINE
    )
    assert [int(row) for row in rows] == list(range(1, 35))


@pytest.mark.parametrize(
    ("heights", "speeds", "expected"),
    [
        # Level at 3.3 + 0.03, too high and too fast: (31) 1 / sqrt(1), (32) |0.33| < 0.5, (33), (34).
        ((3.3, 3.3, 3.3), (6, 6, 6), [-0.1, 1, 1, -1, -0.1]),
        # Robot 0 rises by 0.025: the tilt falls from atan(0.1 / 1.5) = 3.8 to atan(0.075 / 1.5) = 2.9 degrees.
        ((2.9, 3.0, 3.0), (5, 0, 0), [1, 1, 1, 0, 0]),
        # atan(0.5 / 1.5) = 18 degrees, and robot 0 is 1 below the goal; it goes down as fast as is too fast.
        ((2.0, 2.5, 2.5), (-6, 0, 0), [-0.1, -0.1, -0.1, 0, -0.1]),
    ],
)
def test_every_branch_of_the_lifting_reward(heights, speeds, expected):
    starts = [f"height=list{heights}[robot]", f"speed=list{speeds}[robot]"]
    assert last_rewards(starts, steps=1) == pytest.approx(expected)


def test_later_steps_weigh_a_tilt_more_and_a_level_less():
    # (31) in step 4: 1 / sqrt(4) where level, -0.1 sqrt(4) where tilted
    assert last_rewards(["height=3"], steps=4)[1] == pytest.approx(1 / sqrt(4))
    assert last_rewards(["height=2 + robot / 2"], steps=4)[1] == pytest.approx(-0.1 * sqrt(4))


def last_rewards(starts, steps):
    """The terms of robot 0 in the last of some steps of lifting, in which nobody does anything."""
    overrides = [f"environment.steps={steps}", *(f"environment.state.{start}" for start in starts)]
    loaded = load(Source.read(ROOT / "specs" / "object_lifting.yaml"), overrides=overrides)
    problem = compile_meaning(loaded.meaning, compiled=False)
    idle = Architecture(tuple(0 * table.given for table in problem.tables), problem.candidates)
    rewards = trace(problem, idle, key=1, generation=1).rewards
    return [float(robots[0][-1]) for robots in rewards.values()]
