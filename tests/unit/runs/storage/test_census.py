"""Tables of a run's agents, as other programs read them."""

import csv
from dataclasses import replace

import numpy as np
import pytest

from bbsd.runs.command import Command
from bbsd.runs.run import generations, start
from bbsd.runs.storage import records as records_module
from bbsd.runs.storage.census import CENSUS, CHAMPIONS, CULTURE, MOST_CHAMPIONS, TABLES, Table
from bbsd.runs.storage.folder import Folder
from bbsd.solver.paper.settings import settings_of
from tests.unit.problems import problem_of
from tests.unit.runs.commands import WHO
from tests.unit.solver.problems import GUESS

FILLED = GUESS.format(structure="", sharing="uniform", search="sampled", culture="{size: 3}")
SEED, GENERATIONS, AGENTS = 11, 4, 12


def command_of(path, record, n_runs=1, method="paper", lanes=5):
    problem = problem_of(f"{FILLED}  record: {record}\n", lanes=lanes)
    settings = replace(settings_of(problem.meaning), method=method)
    budgets = () if method == "paper" else (5000,)
    return Command(problem, settings, SEED, n_runs, Folder(path), WHO, budgets)


def rows(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def contents(path):
    return {name: (path / name).read_bytes() for name in ("metrics.jsonl", *TABLES) if (path / name).exists()}


def test_without_record_there_are_no_tables(tmp_path):
    command_of(tmp_path, "none").complete(0)
    assert not any((tmp_path / name).exists() for name in TABLES)


@pytest.mark.parametrize(("record", "numbers"), [("2", [2, 4]), ("[1, 4, 9]", [1, 4]), ("1", [1, 2, 3, 4])])
def test_the_census_has_the_agents_of_the_generations_that_are_recorded(tmp_path, record, numbers):
    command = command_of(tmp_path, record)
    command.complete(0)
    census = rows(tmp_path / CENSUS)
    assert [(int(row["generation"]), int(row["agent"])) for row in census] == [
        (number, agent) for number in numbers for agent in range(AGENTS)
    ]
    steps = generations(
        start(command.problem, command.settings, SEED, 0), command.problem, command.settings, SEED
    )
    lived = {reached.state.generation: reached.census for reached, line in steps if line}
    names = command.problem.names
    for row in census:
        agents, agent = lived[int(row["generation"])], int(row["agent"])
        assert float(row["fitness"]) == agents.fitness[agent]  # to the last bit
        assert float(row["lifetime_fitness"]) == agents.lifetime_fitness[agent]
        assert row["structure"].split() == [names[behavior] for behavior in agents.structures[agent][::-1]]
        assert row["run"] == "1"


def test_the_culture_is_that_of_every_generation(tmp_path):
    command = command_of(tmp_path, "[2]")
    command.complete(0)
    steps = generations(
        start(command.problem, command.settings, SEED, 0), command.problem, command.settings, SEED
    )
    expected = [
        (reached.state.generation, meme, fitness)
        for reached, line in steps
        if line
        for meme, fitness in enumerate(reached.state.culture.fitness.tolist())
    ]
    culture = rows(tmp_path / CULTURE)
    assert [(int(row["generation"]), int(row["meme"]), float(row["fitness"])) for row in culture] == expected
    assert {len(set(row["structure"].split())) for row in culture} == {3}


def test_other_methods_write_their_champions_at_each_record(tmp_path):
    command = command_of(tmp_path, "2", method="random")
    command.complete(0)
    champions = rows(tmp_path / CHAMPIONS)
    metrics = command.records(0).lines()
    recorded = [line["episodes"] for line in metrics[1::2]]
    assert list(dict.fromkeys(int(row["episodes"]) for row in champions)) == recorded
    means = [float(row["mean"]) for row in champions if int(row["episodes"]) == recorded[-1]]
    assert means == sorted(means, reverse=True)
    assert [int(row["rank"]) for row in champions[: len(means)]] == list(range(1, len(means) + 1))
    assert len(means) <= MOST_CHAMPIONS
    assert not (tmp_path / CENSUS).exists()


def test_tables_are_the_same_bytes_with_other_lanes_and_after_an_interrupt(tmp_path, monkeypatch):
    monkeypatch.setattr(records_module, "INTERVAL", 0.0)
    for method in ("paper", "random"):
        whole, other, stopped = (tmp_path / method / name for name in ("whole", "other", "stopped"))
        whole.parent.mkdir()
        command_of(whole, "1", method=method).complete(0)
        command_of(other, "1", method=method, lanes=7).complete(0)
        for _ in range(2):
            with pytest.raises(KeyboardInterrupt):
                command_of(stopped, "1", method=method).complete(0, interrupt)
        command_of(stopped, "1", method=method).complete(0)
        assert contents(whole) == contents(other) == contents(stopped)


def interrupt(_line):
    raise KeyboardInterrupt


def test_rows_that_were_written_after_the_last_state_are_cut_off(tmp_path):
    command_of(tmp_path, "1").complete(0)
    before = contents(tmp_path)
    with (tmp_path / CENSUS).open("a") as file:  # as if killed before the state was saved
        file.write("1,5,0,1.5,1.5,odd even reckless\n1,5,1,")
    command_of(tmp_path, "1").complete(0)
    assert contents(tmp_path) == before


def test_tables_without_a_state_are_begun_anew(tmp_path):
    command_of(tmp_path / "whole", "1").complete(0)
    (tmp_path / "begun").mkdir()
    (tmp_path / "begun" / CENSUS).write_text("run,generation\n1,1\n")
    command_of(tmp_path / "begun", "1").complete(0)
    assert contents(tmp_path / "begun") == contents(tmp_path / "whole")


def test_a_table_that_lost_rows_is_never_a_silent_gap(tmp_path):
    command_of(tmp_path, "1").complete(0)
    (tmp_path / CENSUS).write_text("run,generation\n")
    with pytest.raises(records_module.FolderError, match=r"census.csv is not what it was when"):
        command_of(tmp_path, "1").complete(0)


def test_the_tables_of_several_runs_are_gathered_below_one_line_of_names(tmp_path):
    command = command_of(tmp_path, "2", n_runs=2)
    for run in range(2):
        command.complete(run)
    command.folder.gather(2)
    census = rows(tmp_path / CENSUS)
    assert [row["run"] for row in census] == ["1"] * 2 * AGENTS + ["2"] * 2 * AGENTS
    assert census == rows(tmp_path / "run-1" / CENSUS) + rows(tmp_path / "run-2" / CENSUS)
    assert not (tmp_path / CHAMPIONS).exists()


def test_numbers_are_written_so_that_they_are_read_as_the_same_numbers():
    values = [0.1, 1 / 3, -2.5e-300, float(np.float64(305.4000000000001))]
    content = Table("some.csv", ("value", "text"), ((value, "a b") for value in values)).content(
        with_columns=True
    )
    lines = content.decode().splitlines()
    assert lines[0] == "value,text"
    assert [float(line.split(",")[0]) for line in lines[1:]] == values
