"""The comparison of methods: figures worked by hand, results that survive a crash, and cells that are real designs."""

from __future__ import annotations

import numpy as np
import pytest

import bbsd
from bbsd.architecture import given_architecture
from bbsd.compiler import compile_meaning
from bbsd.solver.methods import auto
from experiments.methods.__main__ import arguments, cells_of, main
from experiments.methods.carrying import CellsLost, carried_out
from experiments.methods.cells import Cell, Result, ResultsFile, missing
from experiments.methods.comparison import better, improvement, quantiles
from experiments.methods.contestants import ABLATIONS, method_of
from experiments.methods.tables import page, quantile_table
from experiments.methods.tasks import IN_ORDER, Task
from experiments.methods.trial import run
from tests.unit.engines.engines import ThreadsEngine


def result(task="lake", method="auto", budget=300, seed=0, mean=1.0, **others):
    return Result(task=task, method=method, budget=budget, seed=seed, of="now", mean=mean, **others)


def test_better_counts_pairs_and_half_of_ties():
    assert better(np.array([1.0, 3.0]), np.array([2.0, 3.0])) == pytest.approx((0 + 0 + 1 + 0.5) / 4)
    assert better(np.array([7.93]), np.array([7.93 + 1e-12])) == 0.5
    assert better(np.array([307.4]), np.array([307.5])) == 0


def test_improvement_is_the_mean_over_tasks_and_names_the_worst():
    ones, others = np.array([1.0, 3.0]), np.array([2.0, 3.0])
    found = improvement({"lake": (ones, others), "taxi": (others + 2, ones)})
    assert found.mean == pytest.approx((0.375 + 1) / 2)
    assert (found.worst, found.worst_task, found.n_tasks) == (0.375, "lake", 2)
    assert found.low < found.mean < found.high <= 1


def test_quantiles_are_those_of_all_values():
    assert quantiles(np.array([5.0, 1.0, 2.0, 4.0, 3.0])) == [1, 2, 3, 4, 5]


def test_a_result_is_read_as_it_was_written_and_the_last_of_a_cell_counts(tmp_path):
    file = ResultsFile(tmp_path / "results" / "methods.jsonl")
    assert file.read() == {}
    file.begin()
    last = result(mean=0.7, structure=("a", "b"), curve=((100, 0.5), (200, 0.6)), exact=True)
    for one in (result(mean=0.1), result(method="q", mean=None, reason="too fine"), last):
        file.add(one)
    assert file.read() == {
        last.cell: last,
        Cell("lake", "q", 300, 0): result("lake", "q", mean=None, reason="too fine"),
    }


def test_a_line_that_a_crash_cut_short_is_no_result_and_spoils_none(tmp_path):
    file = ResultsFile(tmp_path / "methods.jsonl")
    file.begin()
    file.add(result(seed=1))
    file.path.write_bytes(file.path.read_bytes() + b'{"task": "lake", "meth')
    file.begin()
    file.add(result(seed=2))
    assert [cell.seed for cell in file.read()] == [1, 2]


def test_what_is_missing_has_no_result_or_one_of_another_state_of_the_task():
    cells = [Cell("lake", "auto", 300, seed) for seed in range(3)]
    old = Result(task="lake", method="auto", budget=300, seed=1, of="before", mean=1.0)
    results = {cells[0]: result(), cells[1]: old}
    assert missing(cells, results, {("lake", "auto"): "now"}) == cells[1:]


def test_options_choose_cells():
    options = arguments(
        ["--tasks", "lake", "abstract", "--methods", "q", "paper", "--budgets", "9000", "--seeds", "2"]
    )
    assert cells_of(options) == [
        Cell("lake", "q", 9000, 0), Cell("lake", "q", 9000, 1), Cell("abstract", "q", 9000, 0),
        Cell("abstract", "paper", 9000, 0), Cell("abstract", "q", 9000, 1), Cell("abstract", "paper", 9000, 1),
    ]  # fmt: skip
    every = arguments([])
    assert (len(every.tasks), every.seeds, every.budgets) == (len(IN_ORDER), 20, (30_000, 300_000))
    assert {"auto", "practice", "paper"} <= set(every.methods)
    assert not set(every.methods) & set(ABLATIONS)
    assert set(arguments(["--small", "--ablations"]).methods) >= set(ABLATIONS)


def test_all_tasks_that_are_shipped_are_compared():
    hand = {
        path.stem
        for path in (*Task("lake").path.parent.glob("*.yaml"), *Task("abstract").path.parent.glob("*.yaml"))
    }
    shipped = {name for name in hand if not name.endswith("_hand")} - {"mobile_robot_failing_sonar"}
    assert set(IN_ORDER) == shipped


def test_a_variant_lacks_its_ingredient_and_leaves_the_method_as_it_was():
    whole = auto.OPENINGS, auto.FEW_OPENINGS, auto.BRED_UNTIL, auto.FEW_BRED_UNTIL
    for name in ABLATIONS:
        with method_of(name) as method:
            assert method == "auto"
            lacking = name.removeprefix("auto_without_")
            expected = {"finishing": 0.97, "breeding": 0.0}.get(lacking, whole[2])
            assert expected == auto.BRED_UNTIL
            assert lacking not in {part[0].name for part in auto.OPENINGS + auto.FEW_OPENINGS}
        assert whole == (auto.OPENINGS, auto.FEW_OPENINGS, auto.BRED_UNTIL, auto.FEW_BRED_UNTIL)


@pytest.mark.slow
def test_variants_of_auto_search_otherwise():
    cells = [Cell("lake", name, 80_000, 0) for name in ("auto", *ABLATIONS)]
    assert len({run(cell).curve for cell in cells}) == len(cells)


@pytest.mark.slow
def test_a_cell_is_the_design_of_the_command(tmp_path):
    found = run(Cell("object_lifting", "random", 5_000, 3))
    designed = bbsd.design(
        Task("object_lifting").path,
        seed=3,
        out=tmp_path / "run",
        set=["design.method=random", "design.budget=5000"],
    )
    assert found.structure == designed.structure
    problem = compile_meaning(bbsd.load(designed.architecture).meaning)
    where = Task("object_lifting")
    design = where.arena.space.designs([given_architecture(problem)])
    assert where.earned(design).mean == pytest.approx(found.mean, abs=1e-9)
    assert 4_000 < found.spent <= 5_000


@pytest.mark.slow
def test_means_are_exact_where_all_starts_can_be_run():
    found = run(Cell("taxi", "random", 5_000, 0))
    assert (found.exact, found.episodes) == (True, 300)


@pytest.mark.slow
def test_the_loop_of_the_paper_has_as_many_generations_as_the_budget_allows():
    found = run(Cell("object_lifting", "paper", 30_000, 0))
    assert 20_000 < found.spent <= 30_000  # four generations of 5,000, and the race
    assert found.mean > 250
    assert (
        run(Cell("lake", "paper", 30_000, 0)).reason
        == "no spec has settings of the paper's loop for this task"
    )
    assert (
        run(Cell("object_lifting", "paper", 5_000, 0)).reason
        == "a generation of the paper's loop takes 5,000 episodes"
    )


@pytest.mark.slow
def test_a_comparison_is_resumed_and_shown(tmp_path, capsys):
    options = [
        "--tasks",
        "abstract",
        "--methods",
        "random",
        "auto",
        "--budgets",
        "5000",
        "--results",
        str(tmp_path / "r"),
    ]
    curves = tmp_path / "curves.csv"
    assert main([*options, "--seeds", "1"]) == 0
    first = capsys.readouterr()
    assert main([*options, "--seeds", "2", "--quantiles", "--curves", str(curves)]) == 0
    second = capsys.readouterr()
    assert (len(first.err.splitlines()), len(second.err.splitlines())) == (2, 2)
    assert "| `abstract` | 5,000 | `random` | 2 |" in second.out
    assert "all 25 starts" in second.out
    assert main([*options, "--seeds", "2", "--tables-only"]) == 0
    third = capsys.readouterr()
    assert third.err == ""
    assert third.out.strip() == second.out.split("\n| task | budget |")[0].strip()
    lines = curves.read_text().splitlines()
    assert lines[0] == "task,method,budget,seed,episodes,mean"
    assert {line.split(",")[1] for line in lines[1:]} == {"auto", "random"}


def test_tables_show_medians_and_who_does_better():
    results = [result(seed=seed, mean=float(seed)) for seed in range(3)]
    results += [result(method="q", seed=seed, mean=-1.0) for seed in range(3)]
    text = page(results, ["lake"], ["auto", "q"])
    assert "| `lake` | 1.0000 (0.0000) | -1.0000 (-1.0000) |" in text
    assert "| `q` | 1.000 | 1.000 to 1.000 | 1.00 | `lake` | 1 |" in text
    assert "| `lake` | 300 | `auto` | 3 | 0.0000 | 0.5000 | 1.0000 | 1.5000 | 2.0000 |" in quantile_table(
        results, ["lake"], ["auto"]
    )


def test_a_task_that_a_method_cannot_design_leaves_its_place_empty():
    results = [result(), result(method="q", mean=None, reason="too fine")]
    assert "| `lake` | 1.0000 (1.0000) |  |" in page(results, ["lake"], ["auto", "q"])


def test_cells_are_run_by_an_engine_as_without(monkeypatch):
    cells = [Cell("abstract", method, 5_000, 0) for method in ("random", "hill")]
    found = {result.cell: result for result in carried_out(cells, ThreadsEngine(2))}
    for cell in cells:
        alone = run(cell)
        there = found[cell]
        assert (there.mean, there.structure, there.curve) == (alone.mean, alone.structure, alone.curve)


def test_a_cell_that_kills_its_workers_is_told_after_the_others():
    engine = ThreadsEngine(1, lambda unit: unit.order["method"] == "hill")
    cells = [Cell("abstract", method, 5_000, 0) for method in ("hill", "random")]
    results = carried_out(cells, engine)
    assert next(results).method == "random"
    with pytest.raises(CellsLost, match="abstract hill 5000 0"):
        next(results)
