import pytest

from bbsd.language.loading import check, load
from tests.unit.language.specs import codes, meaning_of, source

TWO = "behaviors: {go: {inputs: {low: height < 2}, actions: {up: {speed: 1}}}}\n"


def method(part: str, *overrides: str) -> str:
    return load(source(part), overrides=overrides).spec.design.chosen_method


@pytest.mark.parametrize(
    "part", ["coevolution: {agents: 90}", "learning: {episodes: 9}", "culture: none", "sharing: value"]
)
def test_a_spec_with_settings_of_the_loop_and_no_method_means_the_paper_s(part: str) -> None:
    assert method(f"design: {{{part}}}") == "paper"
    assert method(f"design: {{{part}, method: auto}}") == "auto"
    assert method("design: {answer: {judged: 100}, layers: 1}") == "auto"


def test_an_override_is_a_setting_like_any_other() -> None:
    assert method("", "design.coevolution.generations=3") == "paper"
    assert method("design: {sharing: value}", "design.method=random") == "random"


def test_a_budget_may_be_grouped_and_is_no_small_number() -> None:
    assert meaning_of("design: {budget: 300_000}").spec.design.episodes == 300_000
    assert meaning_of("design: {budget: auto}").spec.design.episodes is None
    assert codes("design: {budget: 4999}") == ["BB023"]
    assert codes("design: {budget: some}") == ["BB023"]
    assert codes("design: {budget: [1]}") == ["BB022"]


def test_generations_of_the_paper_s_loop_follow_from_a_budget() -> None:
    given = meaning_of("design: {method: paper, budget: 100_000, coevolution: {agents: 100}}").spec.design
    assert given.coevolution.generations == 200  # lifetimes of five episodes: there is no structure to learn
    both = (
        TWO + "design: {method: paper, budget: 100_000, coevolution: {agents: 100}, learning: {episodes: 10}}"
    )
    assert meaning_of(both).spec.design.coevolution.generations == 100
    assert len(meaning_of(both).rates.hard_mutation) == 100


def test_sharing_by_differences_takes_the_last_episodes_again_for_each_behavior_that_evolves() -> None:
    loop = "method: paper, budget: 100_000, coevolution: {agents: 100}, learning: {episodes: 10, last: 5}"
    given = TWO.replace("speed: 1}}}", "speed: 1}}, rules: [otherwise: up]}")
    for text, episodes in ((TWO, 10 + 2 * 5), (given, 10 + 5)):
        design = meaning_of(f"{text}design: {{{loop}, sharing: difference}}").spec.design
        assert design.coevolution.generations == 100_000 // (100 * episodes)


def test_a_budget_beside_generations_is_a_mistake_of_the_paper_s_loop_alone() -> None:
    both = "budget: 100_000, coevolution: {generations: 5}"
    assert codes(f"design: {{{both}}}") == ["BB070"]
    assert codes(f"design: {{method: random, {both}}}") == []
    assert codes("design: {budget: auto, coevolution: {generations: 5}}") == []


def test_exploration_without_effect_is_a_mistake() -> None:
    learning = "learning: {episodes: 10, last: 4, exploration: 0.1}"
    assert codes(f"{TWO}design: {{{learning}}}") == []
    assert codes(f"design: {{{learning}}}") == ["BB071"]  # one behavior: no structure to learn
    assert codes(f"{TWO}design: {{method: random, {learning}}}") == ["BB071"]
    assert codes(f"{TWO}design: {{{learning.replace('4', '10')}}}") == ["BB071"]
    assert codes("design: {learning: {exploration: 0}}") == []


@pytest.mark.parametrize("setting", ["outside: decay", "explored: dropped, exploration: 0.1"])
def test_settings_of_a_lifetime_without_effect_are_mistakes(setting: str) -> None:
    design = f"learning: {{{setting}}}"
    number = setting.count(":")
    assert codes(f"{TWO}design: {{{design}}}") == []
    assert codes(f"design: {{{design}}}") == ["BB071"] * number  # one behavior: no structure to learn
    assert codes(f"{TWO}design: {{method: random, {design}}}") == ["BB071"] * number


def test_what_becomes_of_explored_structures_matters_only_where_there_is_exploration() -> None:
    assert codes(f"{TWO}design: {{learning: {{explored: dropped}}}}") == ["BB071"]


def test_counters_do_not_decay() -> None:
    assert codes(f"{TWO}design: {{learning: {{outside: decay, estimate: counters}}}}") == ["BB071"]


@pytest.mark.parametrize(
    ("design", "key", "message"),
    [
        ("coevolution: {population: 6, elites: 6}", "elites", "nothing is bred"),
        ("coevolution: {population: 1}", "population", "nothing is bred"),
        ("coevolution: {agents: 3}", "agents", "3 agents cannot try 20 individuals"),
        ("coevolution: {population: 201}", "population", "200 agents cannot try 201 individuals"),
        ("learning: {last: 26}", "last", "a lifetime of 25 episodes"),
        ("learning: {episodes: 4}", "episodes", "does not have 5 last ones"),
        ("coevolution: {generations: 3}, record: 4", "record", "nothing would be recorded in 3 generations"),
        ("coevolution: {generations: 3}, record: [5, 9]", "record", "nothing would be recorded"),
    ],
)
def test_settings_that_contradict_are_told_at_the_key_that_is_written(
    design: str, key: str, message: str
) -> None:
    text = source(f"{TWO}design: {{{design}}}")
    (found,) = check(text)
    assert (found.code, message in found.message) == ("BB126", True)
    assert text.line(found.place.line)[found.place.column - 1 :].startswith(key)
    assert not check(source(f"{TWO}design: {{method: random, {design}}}"))


@pytest.mark.parametrize(
    ("design", "episodes"),
    [
        ("budget: 50_000, stop: {unimproved: 50_000}", "50,000"),
        (
            "coevolution: {generations: 4, agents: 100}, learning: {episodes: 20}, stop: {unimproved: 9_000}",
            "8,000",
        ),
        ("method: paper, budget: 50_000, stop: {unimproved: 60_000}", "50,000"),
    ],
)
def test_a_reason_to_stop_that_never_comes_is_a_mistake(design: str, episodes: str) -> None:
    text = source(f"{TWO}design: {{{design}}}")
    (found,) = check(text)
    assert (found.code, f"a run has {episodes} episodes" in found.message) == ("BB171", True)
    assert text.line(found.place.line)[found.place.column - 1 :].startswith("unimproved")


@pytest.mark.parametrize(
    "design",
    [
        "stop: {unimproved: 5_000_000}",  # the budget is found when the design begins
        "budget: 50_000, stop: {unimproved: 49_999}",
        "sharing: difference, coevolution: {generations: 1}, stop: {unimproved: 5_000_000}",
        "stop: {return: -3}",
        "stop: {}",
    ],
)
def test_other_reasons_to_stop_are_none(design: str) -> None:
    assert codes(f"{TWO}design: {{{design}}}") == []


@pytest.mark.parametrize(
    "stop", ["{unimproved: 999}", "{unimproved: 0.5}", "{return: .inf}", "{return: high}", "300"]
)
def test_a_reason_to_stop_is_a_number(stop: str) -> None:
    (found,) = check(source(f"{TWO}design: {{stop: {stop}}}"))
    assert found.code in ("BB022", "BB023", "BB024")


def test_what_follows_from_a_rate_is_told_at_that_rate() -> None:
    text = source(f"{TWO}design: {{coevolution: {{hard_mutation: 0.6}}}}")
    (found,) = check(text)
    assert (found.code, "soft_mutation, 2 * hard_mutation" in found.message) == ("BB043", True)
    assert text.line(found.place.line)[found.place.column - 1 :].startswith("0.6")
