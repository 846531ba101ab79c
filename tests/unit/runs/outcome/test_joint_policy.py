"""What Q-learning learned, beside the design that behaviors make of it."""

import numpy as np
import pytest

from bbsd.architecture.policy import joint_space
from bbsd.compiler import compile_meaning
from bbsd.language.loading import load
from bbsd.runs.command import Command
from bbsd.runs.outcome.joint_policy import joint_policy_returns
from bbsd.runs.rivals import rival
from bbsd.runs.storage.folder import Folder
from bbsd.runs.storage.identity import identity
from bbsd.solver.paper.settings import settings_of
from bbsd.text import Source

# The best action needs both inputs, and each behavior has one of them.
SPLIT = """
bbsd: 1
name: split
environment:
  steps: 1
  state: {a: chance(0.5), b: chance(0.5), answer: 0}
behaviors:
  by_a:
    inputs: [a]
    actions: {one: {answer: 1}, two: {answer: 2}}
  by_b:
    inputs: [b]
    actions: {one: {answer: 1}, two: {answer: 2}}
reward:
  right: 1 if answer == (1 if a == b else 2) else 0
design: {answer: {judged: 400}}
"""


def command(folder, method):
    loaded = load(Source("split.yaml", SPLIT), overrides=[f"design.method={method}", "design.budget=6000"])
    problem = compile_meaning(loaded.meaning, lanes=5)
    who = identity(loaded, 1, 1)
    return Command(problem, settings_of(loaded.meaning), 1, 1, Folder(folder), who, (6000,)), loaded


def test_a_joint_policy_earns_what_no_two_behaviors_can(tmp_path):
    learned, _ = command(tmp_path, "q")
    assert joint_space(learned.problem.meaning).joint_size == 4
    learned.complete(0)
    found = joint_policy_returns(learned)
    assert found.mean == 1.0
    assert found.count == 400


def test_other_methods_have_no_joint_policy(tmp_path):
    searched, loaded = command(tmp_path, "random")
    searched.complete(0)
    assert joint_policy_returns(searched) is None
    beside = rival(searched, "q", loaded, 1, None)
    assert beside.joint.mean == 1.0
    assert beside.returns.mean == pytest.approx(0.75, abs=0.06)
    assert not np.isnan(beside.joint.low)
