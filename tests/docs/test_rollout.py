"""The environment stepped in Python that the page shows can be designed for."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

PAGE = Path(__file__).parents[2] / "docs" / "rollout.md"


def blocks(kind):
    return re.findall(
        rf"^```{kind}[^\n]*\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )


@pytest.mark.slow
def test_the_environment_stepped_in_python_is_solved(tmp_path, monkeypatch):
    (tmp_path / "corridor.yaml").write_text("".join(blocks("yaml")), encoding="utf-8")
    (tmp_path / "example.py").write_text("\n".join(blocks("python")), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    found = runpy.run_path("example.py")
    assert found["means"][-1] > found["means"][0]
    problem, best, keys = found["problem"], found["best"], np.arange(50, dtype=np.uint64)
    pools = tuple(table[None] for table in best.tables)
    team = problem.assemble(pools, np.zeros((50, 2), np.int64), 1)
    outcome = team.episode(keys, np.tile(best.structure, (50, 1)))
    np.testing.assert_array_equal(outcome.returns, [15 - max(distance(key) - 1, 0) for key in keys])


def distance(key):
    return abs(int(np.random.default_rng(int(key)).integers(10)) - 7)
