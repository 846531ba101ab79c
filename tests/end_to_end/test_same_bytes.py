"""Guards of changes that must change nothing: digests of designs' bytes and of kernels' syntax trees.

A change that changes the digests of designs on purpose must also let `REVISION` in `bbsd/version.py` go up by one, so
that newer code resumes no older folder.
"""

from __future__ import annotations

import ast
from hashlib import sha256
from pathlib import Path

import pytest

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from bbsd.errors import SpecError

TOP = Path(__file__).parents[2]
FROZEN = Path(__file__).parent / "specs" / "same_bytes"
"""The shipped specs as they were when the golden digests were written: those that are shipped may change."""
SPECS = sorted(FROZEN.glob("*.yaml"))
VALID = sorted((TOP / "tests" / "specs" / "valid").glob("**/*.yaml"))
TASKS = [path for path in SPECS if not path.stem.endswith("_hand")]
SEEDS = (0, 1, 2)
SHORT = (
    "coevolution.generations=3", "coevolution.population=6", "coevolution.agents=12",
    "learning.episodes=4", "learning.last=2", "answer.episodes=100", "answer.candidates=10", "answer.judged=100",
)  # fmt: skip
UNUSUAL = (
    "learning.estimate=counters", "learning.search=exact", "learning.exploration=0.3",
    "coevolution.pairing=proportional", "coevolution.children=2", "sharing=value",
)  # fmt: skip
"""Settings that no shipped spec has."""
LANES = 8
DETAILS = (Detail.CREDIT, Detail.TERMS, Detail.TRACE)
OTHER_BYTES = "designs have other bytes: if that is meant, REVISION in bbsd/version.py must go up by one"

RENAMED: dict[str, str] = {}
"""Names of kernels that were changed on purpose, and what they were when the golden digests were written."""


def short(path: Path) -> str:
    """Return a spec's name in the golden files, where the frozen ones have the folder that they were shipped in."""
    return f"specs/{path.name}" if path.parent == FROZEN else path.relative_to(TOP).as_posix()


def digest(content: bytes) -> str:
    return sha256(content).hexdigest()[:16]


@pytest.mark.parametrize("path", TASKS, ids=lambda path: path.stem)
def test_designs_have_the_bytes_that_they_had(path, tmp_path, golden):
    golden(f"designs/{path.stem}.txt", designed(path, tmp_path, SHORT), OTHER_BYTES)


def test_designs_with_unusual_settings_have_the_bytes_that_they_had(tmp_path, golden):
    golden(
        "designs/unusual_settings.txt",
        designed(FROZEN / "object_lifting.yaml", tmp_path, SHORT + UNUSUAL),
        OTHER_BYTES,
    )


def designed(path: Path, folder: Path, settings: tuple[str, ...]) -> str:
    """A line for each file of the designs of all seeds."""
    lines = []
    for seed in SEEDS:
        out = folder / str(seed)
        bbsd.design(path, seed=seed, out=out, set=[f"design.{each}" for each in settings])
        written = (out / "architecture.yaml", out / "metrics.jsonl")
        lines += [f"{seed} {path.name} {digest(path.read_bytes())}\n" for path in written]
    return "".join(lines)


def test_kernels_have_the_syntax_trees_that_they_had(golden):
    lines = [
        f"{short(path)} {detail.value} {digest(tree_of(source).encode())}\n"
        for path in (*SPECS, *VALID)
        for detail, source in sources_of(path)
    ]
    golden("compiler/kernels.txt", "".join(lines))


def test_kernels_of_many_robots_have_the_syntax_trees_that_they_had(golden):
    lines = [
        f"{short(path)} {detail.value} {digest(tree_of(source).encode())}\n"
        for path in (*SPECS, *(path for path in VALID if not path.stem.startswith("BB")))
        for detail, source in sources_of(path, "environment.robots=12")
        if detail is not Detail.TRACE
    ]
    assert len(lines) > 20
    golden("compiler/kernels_of_many_robots.txt", "".join(lines))


def sources_of(path: Path, *overrides: str) -> list[tuple[Detail, str]]:
    """The printed kernel of a spec at each detail; none of a spec that cannot be loaded by itself, or so.

    Nor of one whose world is stepped in Python.
    """
    try:
        problem = compile_meaning(bbsd.load(path, set=overrides).meaning)
    except SpecError:
        return []
    if problem.meaning.episode.outside:
        return []
    return [(detail, kernel_source(problem.meaning, problem.tables, LANES, (detail,))) for detail in DETAILS]


def tree_of(source: str) -> str:
    """A module's syntax tree without its title, the names of all that it assigns replaced by their order."""
    module = ast.parse(source)
    del module.body[0]
    order: dict[str, str] = {}
    assigned = {
        node.id for node in ast.walk(module) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    assigned |= {node.arg for node in ast.walk(module) if isinstance(node, ast.arg)}
    for node in ast.walk(module):
        if isinstance(node, ast.Name):
            node.id = renamed(node.id, assigned, order)
        elif isinstance(node, ast.arg):
            node.arg = renamed(node.arg, assigned, order)
        elif isinstance(node, ast.alias | ast.FunctionDef):
            node.name = RENAMED.get(node.name, node.name)
    return ast.dump(module)


def renamed(name: str, assigned: set[str], order: dict[str, str]) -> str:
    if name in assigned:
        return order.setdefault(name, f"local_{len(order)}")
    return RENAMED.get(name, name)


def test_kernels_are_told_apart_by_what_they_compute_and_not_by_their_names():
    one, other = "'t'\nMEMORY = 1\ndef f(a):\n    b = a + 1\n", "'u'\nMEMORY = 1\ndef f(x):\n    y = x + 1\n"
    assert tree_of(one) == tree_of(other)
    assert tree_of(one) != tree_of(other.replace("+", "-"))
    assert tree_of(one) != tree_of(other.replace("x + 1", "y + 1"))
