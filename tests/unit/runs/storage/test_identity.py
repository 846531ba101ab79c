import pytest

from bbsd.language.loading import load
from bbsd.runs.storage.identity import identity
from bbsd.text import Source
from tests.unit.solver.problems import GUESS

TEXT = GUESS.format(structure="", sharing="uniform", search="sampled", culture="{size: 3}")


def who(text=TEXT, *overrides, seed=3, runs=2):
    return identity(load(Source("a.yaml", text), overrides=overrides), seed, runs)


@pytest.mark.parametrize(
    "text",
    [
        TEXT + "# a comment\n",
        TEXT.replace("\n", "\r\n"),
        TEXT.replace("name: guess", "name: another\nsummary: of no meaning\nx-notes: 3"),
        TEXT.replace("{at:", "{ at:"),
    ],
    ids=["comment", "line ends", "words", "layout"],
)
def test_what_changes_no_episode_changes_no_identity(text):
    assert who(text) == who()


def test_what_differs_is_named():
    assert who().differences(who().plain()) == []
    other = who(TEXT, "environment.steps=3", "design.layers=2", seed=4).plain()
    assert who().differences(other) == ["the spec's environment, design", "the seed (4, not 3)"] or (
        who().differences(other) == ["the spec's design, environment", "the seed (4, not 3)"]
    )
    assert who(runs=1).differences(who().plain()) == ["the number of runs (2, not 1)"]
    assert who().differences({})


def test_a_value_of_an_override_is_a_value_of_the_spec():
    assert who(TEXT.replace("steps: 2", "steps: 3")) == who(TEXT, "environment.steps=3")


def test_the_budget_of_a_search_is_no_part_of_it_but_that_of_the_paper_s_loop_is():
    search = ("design.method=random",)
    assert who(TEXT, *search, "design.budget=6000") == who(TEXT, *search, "design.budget=9000")
    short = TEXT.replace("generations: 4, ", "")
    assert who(short, "design.budget=6000") != who(short, "design.budget=9000")
