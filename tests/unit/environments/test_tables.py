"""Tables of transitions: how they are copied, and what is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

from bbsd.environments.tables import NoTable, Transition, copied_table, has_table, table_of

SPACE = {"observation_space": SimpleNamespace(n=2), "action_space": SimpleNamespace(n=1)}
ENDS = (1.0, 1, 5.0, True)


def environment(first=((1.0, 1, -1.0, False),), starts=(1.0, 0.0), **others):
    return SimpleNamespace(
        **(
            SPACE
            | {"P": {0: {0: list(first)}, 1: {0: [ENDS]}}, "initial_state_distrib": list(starts)}
            | others
        )
    )


def test_copies_what_follows_and_where_episodes_start():
    table = copied_table(environment([(0.25, 0, 2.0, False), (0.75, 1, -1, True)], starts=[0.5, 0.5]))

    assert (table.n_states, table.n_actions, table.n_outcomes) == (2, 1, 2)
    assert table.transitions(0, 0) == {Transition(0, 2.0, False): 0.25, Transition(1, -1.0, True): 0.75}
    assert table.transitions(1, 0) == {Transition(1, 5.0, True): 1.0}
    assert table.starts.tolist() == [0.5, 0.5]


def test_merges_equal_outcomes_but_not_such_that_differ_in_reward_or_end():
    third = 1 / 3
    outcomes = [(third, 0, 0.0, False), (third, 0, 0.0, False), (third, 0, 0.0, True), (0.0, 1, 9.0, False)]
    table = copied_table(environment(outcomes))

    assert table.transitions(0, 0) == {Transition(0, 0.0, False): 2 * third, Transition(0, 0.0, True): third}


def test_cumulative_probabilities_are_1_from_the_last_possible_outcome_on():
    tenths = [(0.1, state, float(reward), False) for state in range(2) for reward in range(5)]
    table = copied_table(environment(tenths))

    assert np.cumsum(table.probabilities[0, 0])[-1] != 1.0, "else the test shows nothing"
    assert table.cumulative[0, 0, -1] == 1.0
    assert table.cumulative[0, 0, :3].tolist() == np.cumsum([0.1] * 3).tolist()
    assert table.cumulative[1, 0].tolist() == [1.0] * 10


def test_the_digest_tells_every_number():
    same, *others = (
        environment(),
        environment(first=[(1.0, 1, -2.0, False)]),
        environment(first=[(1.0, 1, -1.0, True)]),
        environment(first=[(1.0, 0, -1.0, False)]),
        environment(starts=[0.5, 0.5]),
    )
    digests = {copied_table(each).digest for each in others}

    assert copied_table(same).digest == copied_table(environment()).digest
    assert copied_table(same).digest not in digests
    assert len(digests) == len(others)


def test_a_table_of_transitions_by_hand_is_the_one_that_is_copied():
    rows = [[{Transition(1, -1.0, False): 1.0}], [{Transition(1, 5.0, True): 1.0}]]

    assert table_of(rows, [1.0, 0.0]).digest == copied_table(environment()).digest


@pytest.mark.parametrize(
    ("environment", "words"),
    [
        (environment(observation_space=SimpleNamespace()), "its observations are not the whole numbers"),
        (environment(action_space=SimpleNamespace(n=3, start=1)), "its actions do not begin with 0"),
        (environment(action_space=SimpleNamespace(n=2)), "no action 1 in state 0"),
        (environment(first=[]), "no outcomes of action 0 in state 0"),
        (environment(first=[(1.0, 1, -1.0)]), r"is not \(probability, next state, reward, ended\)"),
        (environment(first=[(1.0, 2, -1.0, False)]), "none of the 2 states"),
        (environment(first=[(1.0, 0.5, -1.0, False)]), "none of the 2 states"),
        (environment(first=[(1.0, 1, float("nan"), False)]), "a reward of action 0 in state 0 is not finite"),
        (environment(first=[(0.5, 1, -1.0, False)]), "add up to 0.5"),
        (environment(first=[(1.5, 1, 0.0, False), (-0.5, 0, 0.0, False)]), "a probability of action 0"),
        (environment(starts=[1.0]), "not a list of 2 probabilities"),
        (environment(starts=[0.5, 0.4]), "its first states add up to 0.9"),
        (environment(initial_state_distrib="here"), "is not a list of probabilities"),
        (SimpleNamespace(**SPACE, P={0: {0: [ENDS]}, 1: {0: [ENDS]}}), "does not tell the states"),
    ],
)
def test_what_is_no_table_is_refused_with_words(environment, words):
    with pytest.raises(NoTable, match=words):
        copied_table(environment)


def test_an_environment_has_a_table_where_it_has_a_p():
    assert has_table(environment())
    assert not has_table(SimpleNamespace(**SPACE))
    assert not has_table(environment(P=None))


def test_a_table_that_is_too_large_is_refused(monkeypatch):
    monkeypatch.setattr("bbsd.environments.tables.MOST_ENTRIES", 3)
    with pytest.raises(NoTable, match="2 states, 1 actions and up to 2 outcomes of each: too many"):
        copied_table(environment([(0.5, 0, 0.0, False), (0.5, 1, 0.0, False)]))
    monkeypatch.setattr("bbsd.environments.tables.MOST_ENTRIES", 1)
    with pytest.raises(NoTable, match="2 states and 1 actions: too many"):
        copied_table(environment())


def test_a_table_may_be_of_lists_and_arrays():
    rows = [[np.array([[0.5, 0, 1.0, 0], [0.5, 1, -1.0, 1]])], [(ENDS,)]]
    table = copied_table(environment(P=rows))

    assert table.transitions(0, 0) == {Transition(0, 1.0, False): 0.5, Transition(1, -1.0, True): 0.5}
