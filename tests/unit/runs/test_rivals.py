import pytest

from bbsd.compiler import compile_meaning
from bbsd.language.loading import load
from bbsd.runs.command import Command
from bbsd.runs.rival_command import paper_episodes, rival_command
from bbsd.runs.rivals import all_rivals, each_run, rival
from bbsd.runs.storage.folder import Folder
from bbsd.runs.storage.identity import identity
from bbsd.solver.paper.settings import settings_of
from bbsd.text import Source
from tests.unit.solver.problems import GUESS


@pytest.fixture
def loaded():
    text = GUESS.format(structure="", sharing="uniform", search="sampled", culture="{size: 3}")
    return load(Source("guess.yaml", text), overrides=["design.method=random", "design.budget=6000"])


@pytest.fixture
def command(loaded, tmp_path):
    problem = compile_meaning(loaded.meaning, lanes=5)
    return Command(
        problem, settings_of(loaded.meaning), 3, 2, Folder(tmp_path), identity(loaded, 3, 2), (6000,)
    )


def test_a_rival_spends_no_more_than_the_same_budget(command, loaded):
    told = []
    found = rival(command, "hill", loaded, 1, told.append)
    assert found.method == "hill"
    assert 9000 < found.episodes <= 12_000
    assert {line["method"] for line in told} == {"hill"}
    assert found.returns.count == 100
    assert sorted(found.structure) == ["even", "odd", "reckless"]


def test_the_paper_s_loop_gets_generations_for_the_search_s_part_of_the_budget(command, loaded):
    other = rival_command(command, "paper", loaded)
    assert other.settings.method == "paper"
    assert 4500 < paper_episodes(other.settings) <= 5000
    assert len(other.settings.rates.hard_mutation) == other.settings.coevolution.generations
    found = rival(command, "paper", loaded, 1, None)
    assert found.episodes == 2 * paper_episodes(other.settings)


def test_a_rival_is_another_run_in_a_folder_of_its_own(command, loaded):
    other = rival_command(command, "hill", loaded)
    assert other.folder.path == command.folder.path / "rival-hill"
    assert other.who != command.who


def test_every_run_has_its_figures(command):
    answers = [command.complete(run) for run in (0, 1)]
    assert [returns.count for returns, _ in each_run(command, answers)] == [100, 100]


def test_all_methods_but_one_are_rivals():
    assert "random" not in all_rivals("random")
    assert {"paper", "hill", "societies"} <= set(all_rivals("random"))
