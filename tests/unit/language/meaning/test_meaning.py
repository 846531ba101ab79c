from bbsd.expression import graph, scope
from bbsd.language.meaning import elaborate, seed_key
from bbsd.language.models import Spec
from bbsd.text import read
from tests.unit.language.specs import codes, meant, source


def reached(environment: str, values: str) -> list[str]:
    return codes(f'environment: {environment}\nbehaviors: {{stop: {{inputs: {{reached: "{values}"}}}}}}')


def test_a_slot_is_whole_where_it_starts_so_and_every_step_keeps_it_so() -> None:
    assert reached("{state: {n: 0}, dynamics: {n: n + 1}}", "values(n, 0, 5)") == []
    assert reached("{state: {n: 0}, dynamics: {n: n + 0.5}}", "values(n, 0, 5)") == ["BB064"]
    assert reached("{state: {n: 0.5}}", "values(n, 0, 5)") == ["BB064"]
    assert (
        reached(
            "{state: {n: 'integers(0, 3)', m: n}, dynamics: {n: m, m: 'min(n, 4) % 3'}}", "values(m, 0, 5)"
        )
        == []
    )


def test_a_fraction_spreads_from_slot_to_slot() -> None:
    states = ", ".join(f"m{place}: 0" for place in range(20))
    dynamics = ", ".join(["m0: m0 + 0.5", *(f"m{place}: m{place - 1}" for place in range(1, 20))])
    assert reached(f"{{state: {{{states}}}, dynamics: {{{dynamics}}}}}", "values(m19, 0, 5)") == ["BB064"]


def test_what_an_action_sets_counts() -> None:
    part = 'behaviors: {stop: {inputs: {reached: "values(speed, 0, 5)"}, actions: {halt: {speed: %s}}}}'
    assert codes(part % "speed + 1") == []
    assert codes(part % "speed / 2") == ["BB064"]


def test_sensors_and_constants_are_whole_if_what_they_are_made_of_is() -> None:
    assert reached("{sensors: {pace: floor(height) + speed}}", "values(pace, 0, 5)") == []
    assert reached("{sensors: {pace: height}}", "values(pace, 0, 5)") == ["BB064"]
    part = 'constants: {table: %s}\nbehaviors: {stop: {inputs: {reached: "values(table[speed], 0, 5)"}}}'
    assert codes(part % "[1, 2, 3]") == []
    assert codes(part % "[1, 2.5, 3]") == ["BB064"]


def test_nothing_is_said_about_broken_names() -> None:
    spec = Spec.model_validate(read(source("reward: {near: lost + sum(1 for v in lost), far: hight}")).data)
    meaning, told = elaborate(spec, 0, frozenset({"lost"}))
    assert meaning is None
    assert [(path, mistake.code) for path, mistake in told] == [(("reward", "far"), "BB052")]


def test_seeds_have_keys_of_their_own() -> None:
    assert len({seed_key(seed) for seed in range(1000)}) == 1000


def test_a_spec_that_unrolls_too_far_is_told_where(monkeypatch) -> None:
    monkeypatch.setattr(graph, "MAX_NODES", 1000)
    spec = Spec.model_validate(read(source("reward: {near: sum(height * k for k in range(2000))}")).data)
    meaning, told = elaborate(spec, 0)
    assert meaning is None
    assert [(path, mistake.code) for path, mistake in told] == [(("reward", "near"), "BB068")]


def test_after_very_many_mistakes_no_more_are_looked_for(monkeypatch) -> None:
    monkeypatch.setattr(scope, "MAX_MISTAKES", 3)
    reward = ", ".join(f"r{place}: unknown{place}" for place in range(9))
    spec = Spec.model_validate(read(source(f"reward: {{{reward}}}")).data)
    assert len(elaborate(spec, 0)[1]) == 3


def test_the_meaning_says_for_which_seed_it_holds() -> None:
    assert meant(seed=7).seed == 7
