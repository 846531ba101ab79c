import builtins
from pathlib import Path

import pytest

from bbsd.api import Designed
from bbsd.evaluation import Evaluation, Interval, trace
from bbsd.evaluation.frames import NoPandas, frame, metrics_frame
from bbsd.runs.storage.watching import Watched, WatchedRun
from tests.unit.explanation.comparison.designs import WALK, design_of

LINES = [
    {
        "run": 1,
        "generation": generation,
        "mean": mean,
        "best": 2.0,
        "sd": 0.25,
        "lifetime": 0.5,
        "diversity": {"rise": diversity},
        "structure": structure,
    }
    for generation, mean, diversity, structure in [
        (1, 0.5, 0.75, ["rise", "fall"]),
        (2, 1.5, 0.5, ["fall", "rise"]),
    ]
]


@pytest.fixture
def pandas():
    return pytest.importorskip("pandas")


def test_without_pandas_it_is_said_what_to_install(monkeypatch):
    real = builtins.__import__

    def without(name, *arguments, **named):
        if name.partition(".")[0] == "pandas":
            raise ImportError(name)
        return real(name, *arguments, **named)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(NoPandas, match="not installed") as caught:
        frame({"a": [1]})
    assert "pip install pandas" in caught.value.advice


def test_metrics_have_a_column_for_each_number(pandas):
    made = metrics_frame(LINES)
    assert made.columns.tolist() == [
        "run",
        "generation",
        "mean",
        "best",
        "sd",
        "lifetime",
        "diversity/rise",
        "structure",
    ]
    assert made["mean"].tolist() == [0.5, 1.5]
    assert made["structure"].tolist() == ["rise fall", "fall rise"]
    assert len(metrics_frame([])) == 0


def test_a_trace_has_a_row_for_each_step_and_the_start(pandas):
    design = design_of(WALK)
    traced = trace(design.problem, design.architecture, 3, 1)
    made = traced.to_frame()
    assert made.index.tolist() == list(range(7))
    assert made["controlling_0"].tolist()[1:] == traced.controlling[0]
    assert made["reward_here_1"].tolist()[1:] == traced.rewards["here"][1].tolist()


def test_an_evaluation_has_a_row_for_each_thing_measured(pandas):
    spread = Interval(2.0, 1.0, 1.5, 2.5, 9)
    made = Evaluation(
        spread, 9, 1, {"near": 2.0}, {"go": 1.0, "nobody": 0.0}, 5.0, {}, {"go": 0.5}
    ).to_frame()
    rows = [tuple(row) for row in made.itertuples(index=False)]
    assert rows == [
        ("return", "mean", 2.0), ("return", "sd", 1.0), ("return", "low", 1.5), ("return", "high", 2.5),
        ("reward term", "near", 2.0), ("in control", "go", 1.0), ("in control", "nobody", 0.0),
        ("expectation", "go", 0.5),
    ]  # fmt: skip


def test_runs_have_their_metrics(pandas):
    designed = object.__new__(Designed)
    object.__setattr__(designed, "metrics", tuple(LINES))
    assert designed.to_frame()["generation"].tolist() == [1, 2]
    watched = Watched(Path("x"), "running", 1, 0, (WatchedRun(1, "hill", tuple(LINES)),), {})
    assert watched.to_frame()["rival"].tolist() == ["hill", "hill"]
