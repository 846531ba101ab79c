"""Rollouts for practice: robots stray, and what they were asked and earned is recorded."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import bbsd
from bbsd.compiler import compile_meaning, kernels
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.compiler.robots import moving, with_loops
from tests.unit.problems import RICH, problem_of

SPECS = sorted((Path(__file__).parents[4] / "specs").glob("*.yaml"))
N_AGENTS = 5

LARGE = """
bbsd: 1
name: large
environment: {steps: 90, state: {x: "integers(0, 89)"}, dynamics: {x: (x + 7) % 90}, ends: x == 13}
behaviors:
  small:
    inputs: {odd: "x % 2 == 1"}
    actions: {a: {x: x}, b: {x: x + 1}}
    rules: [{when: {odd: "true"}, do: b}]
  large:
    excited: x > 5
    inputs: {x: "values(x, 0, 89)"}
    actions: {a: {x: x}, b: {x: x}}
    rules: [{when: {x: "20"}, do: a}, {when: {x: "70"}, do: b}]
  given: {inputs: {odd: "x % 2 == 1"}, actions: {a: {x: x}}, rules: [{when: {}, do: no action}]}
reward: {each: x}
"""
"""Given cells in a table that fits into a word and in one that does not, and an end."""


def practiced(problem, rate, n_agents=N_AGENTS, agents=None):
    """Returns, and each agent's steps one after the other: (agent, asked, joint cells, gains) of what it took."""
    agents = agents or random_agents(problem, 5, n_agents)
    team = problem.assemble(agents.pools, agents.members, 1)
    open_cells = np.concatenate([shape.given == 255 for shape in problem.tables]).astype(np.uint8)
    taken = []

    def learn(steps, steps_taken):
        for lane, count in enumerate(steps_taken.astype(int)):
            taken.append([record[:count, ..., lane].copy() for record in steps[1:]])

    rates = np.full(len(agents), float(rate))
    returns = team.practice(keys(9, 0, len(agents)), agents.structures, rates, open_cells, learn)
    return agents, returns, taken


def plain(problem, agents):
    team = problem.assemble(agents.pools, agents.members, 1)
    return team.detailed_episode(keys(9, 0, len(agents)), agents.structures)


def shortened(path):
    steps = min(bbsd.load(path).spec.environment.steps, 12)
    return compile_meaning(bbsd.load(path, set=[f"environment.steps={steps}"]).meaning, compiled=False)


PROBLEMS = {
    "rich": lambda: problem_of(RICH),
    "lanes": lambda: problem_of(RICH, lanes=3),
    "large tables": lambda: problem_of(LARGE),
    "loops over robots": lambda: moving(robots=5),
    "loops and an end": lambda: with_loops(problem_of(RICH)),
    **{path.stem: (lambda path=path: shortened(path)) for path in SPECS},
}


@pytest.mark.parametrize("make", PROBLEMS.values(), ids=PROBLEMS)
def test_without_straying_it_gives_the_bits_of_the_plain_rollout(make):
    problem = make()
    agents, returns, taken = practiced(problem, 0)
    outcome = plain(problem, agents)
    assert returns.tobytes() == outcome.returns.tobytes()
    assert [len(asked) for asked, *_ in taken] == outcome.steps_taken.tolist()
    for agent, (asked, _, gains) in enumerate(taken):
        assert np.isclose(gains.sum() / gains.shape[1], returns[agent])
        assert not (asked[asked >= 0] % 2).any()


def test_compiled_it_gives_the_same_bits(rich_compiled):
    _, expected, steps = practiced(problem_of(RICH), 0.3, 20)
    _, returns, compiled = practiced(rich_compiled, 0.3, 20)
    assert returns.tobytes() == expected.tobytes()
    for records, others in zip(steps, compiled, strict=True):
        assert [record.tobytes() for record in records] == [record.tobytes() for record in others]


@pytest.mark.parametrize("make", [lambda **more: problem_of(RICH, **more), lambda **more: moving(robots=5)])
def test_it_is_the_same_for_any_lanes_and_jobs_and_with_loops(make, monkeypatch):
    monkeypatch.setattr(kernels, "WORTH_A_THREAD", 1)
    _, expected, steps = practiced(make(), 0.5, 11)
    for other in (make(lanes=4), replace(make(lanes=3), jobs=2), with_loops(make())):
        _, returns, records = practiced(other, 0.5, 11)
        assert returns.tobytes() == expected.tobytes()
        for one, another in zip(steps, records, strict=True):
            assert all(np.array_equal(a, b) for a, b in zip(one, another, strict=True))


def decoded(problem, code):
    """The behavior, cell, choice and straying that a code stands for."""
    pair, strayed = divmod(int(code), 2)
    for behavior, shape in enumerate(problem.tables):
        n_pairs = shape.n_cells * (shape.n_actions + 1)
        if pair < n_pairs:
            return behavior, *divmod(pair, shape.n_actions + 1), bool(strayed)
        pair -= n_pairs
    raise AssertionError(code)


@pytest.mark.parametrize("rate", [0, 0.4])
@pytest.mark.parametrize("text", [RICH, LARGE], ids=["rich", "large"])
def test_codes_tell_who_was_asked_from_the_top_layer_down_to_who_controls(text, rate):
    problem = problem_of(text)
    agents, _, taken = practiced(problem, rate, 8)
    n_strayed = 0
    for agent, (asked, _, _) in enumerate(taken):
        structure = agents.structures[agent][::-1].tolist()
        for codes in asked.reshape(-1, problem.n_behaviors):
            assert all(behavior in structure for behavior, code in enumerate(codes) if code >= 0)
            choices = [decoded(problem, codes[behavior]) for behavior in structure if codes[behavior] >= 0]
            assert all(choice == 0 for _, _, choice, _ in choices[:-1])  # what acts is asked last
            for behavior, cell, choice, strayed in choices:
                table = agents.pools[behavior][agents.members[agent, behavior]]
                assert strayed == (choice != table[cell])
                n_strayed += strayed
    assert (n_strayed > 0) == (rate > 0)


def test_given_cells_and_behaviors_are_never_strayed_from():
    problem = problem_of(LARGE)
    _, _, taken = practiced(problem, 1, 40)
    strayed = [
        decoded(problem, code) for asked, *_ in taken for code in asked[asked >= 0].ravel() if code % 2
    ]
    cells = {(behavior, cell) for behavior, cell, _, _ in strayed}
    assert len(cells) > 50
    assert all(problem.tables[behavior].given[cell] == 255 for behavior, cell in cells)
    assert {choice for behavior, _, choice, _ in strayed if behavior == 1} == {0, 1, 2}


def test_robots_stray_as_often_as_the_rate_says():
    text = """
    bbsd: 1
    name: often
    environment: {robots: 2, steps: 200, state: {x: 0}}
    behaviors:
      one: {actions: {a: {x: 1}, b: {x: 2}, c: {x: 3}}}
      other: {actions: {a: {x: 1}}}
    reward: {none: 0}
    """
    problem = problem_of(text)
    agents, _, taken = practiced(problem, 0.4, 40)
    strayed = np.array([(asked % 2 == 1) & (asked >= 0) for asked, *_ in taken])
    # Half of the strays are those of a behavior; of them 3 in 4 and 1 in 2 differ from the table.
    for behavior, rate in enumerate((0.4 / 2 * 3 / 4, 0.4 / 2 / 2)):
        on_top = agents.structures[:, -1] == behavior
        assert abs(strayed[on_top, ..., behavior].mean() - rate) < 0.01
    assert not np.array_equal(strayed[:, :, 0], strayed[:, :, 1])  # each robot by itself


def test_joint_cells_tell_apart_what_behaviors_see_together():
    problem = problem_of(LARGE)
    assert problem.kernels.joint.n_cells == 2 * 90 * 2  # odd, x, and whether large is excited
    _, _, taken = practiced(problem, 0, 20)
    joint = np.concatenate([cells.ravel() for _, cells, _ in taken])
    assert 0 <= joint.min() <= joint.max() < 360
    seen = {}
    for asked, cells, _ in taken:
        for codes, cell in zip(asked.reshape(-1, 3), cells.ravel(), strict=True):
            if codes[1] >= 0:
                assert (
                    seen.setdefault(int(cell), decoded(problem, codes[1])[1]) == decoded(problem, codes[1])[1]
                )


def test_joint_cells_of_a_fine_partition_are_hashed():
    inputs = ", ".join(f"x{n}: 'values((x + {n}) * {n + 1} % 100, 0, 99)'" for n in range(2))
    text = f"""
    bbsd: 1
    name: fine
    environment: {{steps: 60, state: {{x: "integers(0, 99)"}}, dynamics: {{x: (x + 1) % 100}}}}
    behaviors:
      one: {{inputs: {{{inputs}}}, actions: {{a: {{x: x}}}}}}
      other: {{inputs: {{y: "values((x * 7) % 90, 0, 89)"}}, actions: {{a: {{x: x}}}}}}
    reward: {{none: 0}}
    """
    problem = problem_of(text)
    assert not problem.kernels.joint.is_exact
    _, _, taken = practiced(problem, 0, 8)
    joint = np.concatenate([cells.ravel() for _, cells, _ in taken])
    assert 0 <= joint.min() <= joint.max() < problem.kernels.joint.n_cells == 1 << 16
    assert len(set(joint.tolist())) == 100
