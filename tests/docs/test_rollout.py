"""The environment stepped in Python that the page shows can be designed for."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

PAGE = Path(__file__).parents[2] / "docs" / "rollout.md"


def blocks(kind):
    """The page's blocks of this kind, a language and a file's name if it has one."""
    return re.findall(
        rf"^```{re.escape(kind)}\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )


@pytest.mark.slow
def test_the_environments_stepped_in_python_are_solved(tmp_path, monkeypatch):
    for name in ("python corridor.py", "yaml corridor.yaml"):
        (tmp_path / name.split()[1]).write_text("".join(blocks(name)), encoding="utf-8")
    (tmp_path / "example.py").write_text("\n".join(blocks("python")), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    found = runpy.run_path("example.py")
    earned = found["design"].evaluation.returns
    assert earned.low < np.mean([15 - max(abs(place - 7) - 1, 0) for place in range(10)]) < earned.high
    assert found["means"][-1] > found["means"][0]
    problem, best, keys = found["problem"], found["best"], np.arange(50, dtype=np.uint64)
    pools = tuple(table[None] for table in best.tables)
    team = problem.assemble(pools, np.zeros((50, 3), np.int64), 1)
    outcome = team.episode(keys, np.tile(best.structure, (50, 1)))
    places = [key % 10 for key in range(50)]
    np.testing.assert_array_equal(outcome.returns, [15 - max(abs(place - 7) - 1, 0) for place in places])
