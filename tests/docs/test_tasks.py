"""The page of tasks lists every task that is shipped, with its sizes and with the optimum that is computed."""

import re
from pathlib import Path

import pytest

from bbsd.language.loading import load
from bbsd.report.spec.size import size_text
from bbsd.text import Source
from experiments.optimum import optimum

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
SPECS = ROOT / "specs"
TEXT = (ROOT / "docs" / "tasks.md").read_text(encoding="utf-8")
COLUMNS = ("what", "robots", "steps", "holes", "random", "by_hand", "at_most")
ROWS = {
    spec: dict(zip(COLUMNS, re.split(r" *\| *", cells), strict=True))
    for spec, cells in re.findall(
        r"^\| \[`\w+`\]\(\.\./specs/([\w/]+)\.yaml\) \| (.*) \|$", TEXT, re.MULTILINE
    )
}
VARIANTS = {"mobile_robot_failing_sonar"}


def test_every_task_has_a_row():
    paths = [*SPECS.glob("*.yaml"), *SPECS.glob("tasks/*.yaml"), *SPECS.glob("everyday/*.yaml")]
    names = {path.relative_to(SPECS).with_suffix("").as_posix() for path in paths}
    assert {name for name in names if not name.endswith("_hand")} - VARIANTS == set(ROWS)


@pytest.mark.parametrize("name", ROWS)
def test_sizes_are_those_of_the_spec(name):
    loaded = load(Source.read(SPECS / f"{name}.yaml"))
    environment, row = loaded.spec.environment, ROWS[name]
    assert (row["robots"], row["steps"]) == (str(environment.robots), str(environment.steps))
    cells, size = re.search(r"(\d+) open cells.* (10\^\S+)", size_text(loaded.meaning)).groups()
    assert row["holes"].startswith(f"{cells} cells, ")
    assert row["holes"].endswith(size)


@pytest.mark.parametrize("name", ROWS)
def test_every_task_has_a_design_made_by_hand_or_a_bound(name):
    row = ROWS[name]
    assert row["by_hand"] or row["at_most"]
    assert bool(row["by_hand"]) == (SPECS / f"{name}_hand.yaml").exists()


@pytest.mark.parametrize(
    "name", [name for name in ROWS if name.startswith(("tasks/", "everyday/")) and ROWS[name]["by_hand"]]
)
def test_designs_made_by_hand_say_what_they_earn(name):
    text = (SPECS / f"{name}_hand.yaml").read_text(encoding="utf-8")
    assert float(re.search(r"^# It earns (\S+) on average", text, re.MULTILINE)[1]) == float(
        ROWS[name]["by_hand"]
    )


@pytest.mark.parametrize(
    "name",
    [name for name in ROWS if ROWS[name]["at_most"] and name not in {"tasks/cartpole", "everyday/vacuum"}],
)
def test_bounds_are_computed(name):
    written = ROWS[name]["at_most"]
    decimals = len(written.partition(".")[2])
    assert round(optimum(SPECS / f"{name}.yaml").best, decimals) == float(written)
