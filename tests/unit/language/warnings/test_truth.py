"""What warnings say of made-up specs is true of their episodes, and nothing in a spec makes looking for them fail."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bbsd.compiler import compile_meaning
from bbsd.compiler.details import traced_columns
from bbsd.language.meaning import elaborate
from bbsd.language.models import Spec
from bbsd.language.warnings.bounds import Bounds
from bbsd.language.warnings.finding import warnings_of
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_designs import random_agents

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler.details import Column
    from bbsd.language.meaning import Meaning

    Floats = NDArray[np.float64]

AGENTS = 4


@pytest.mark.slow
@given(specs(most_robots=3), st.integers(0, 100))
@settings(max_examples=25, deadline=None)
def test_what_is_said_of_a_spec_is_true_of_its_episodes(data: dict[str, object], seed: int) -> None:
    meaning, _ = elaborate(Spec.model_validate(data), 1)
    if meaning is None:
        return
    found = [(each.code, path) for path, each in warnings_of(meaning)]
    terms = {path[1] for code, path in found if code == "BB208"}
    never = {path[1] for code, path in found if code == "BB209" and path[0] == "behaviors"}
    are_alike = any(code == "BB206" for code, _ in found)
    problem = compile_meaning(meaning, compiled=False)
    agents = random_agents(problem, AGENTS, seed)
    team = problem.assemble(agents.pools, agents.members, 1)
    outcome = team.detailed_episode(np.repeat(agents.keys[:1], AGENTS), agents.structures)
    for index, term in enumerate(meaning.episode.reward):
        totals = outcome.terms[:, index]
        assert term not in terms or (np.isnan(totals) | (totals == totals[0])).all()
    for index, module in enumerate(meaning.episode.modules):
        assert module.name not in never or not outcome.control[:, index].any()
    columns = traced_columns(meaning)
    record = np.zeros((meaning.spec.environment.steps, len(columns)))
    taken = team.traced_episode(int(agents.keys[0]), agents.structures[0], record)
    assert_bounds_hold(meaning, columns, record[:taken])
    if are_alike:
        assert_robots_are_alike(columns, record)


def assert_bounds_hold(meaning: Meaning, columns: list[Column], record: Floats) -> None:
    bounds, graph = Bounds(meaning), meaning.graph.fork()
    for index, (content, slot) in enumerate(columns):
        if content == "slot":
            like = meaning.episode.after[slot]
            low, high = bounds.of(graph.leaf("slot", slot, like.kind, like.level))
            values = record[:, index][~np.isnan(record[:, index])]
            assert ((low <= values) & (values <= high)).all(), slot


def assert_robots_are_alike(columns: list[Column], record: Floats) -> None:
    of_robots: dict[object, list[int]] = {}
    for index, (content, slot) in enumerate(columns):
        if slot.robot is not None:
            of_robots.setdefault((content, slot.variable), []).append(index)
    for first, *others in of_robots.values():
        for other in others:
            np.testing.assert_array_equal(record[:, first], record[:, other])
