"""Compile a spec, and point at the place in it where a kernel found something wrong."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from bbsd.api.given.arguments import Assignments, checked
from bbsd.api.specs import AnySpec, load
from bbsd.compiler import Detail, compile_meaning, kernel_source
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.errors import Diagnosis
from bbsd.evaluation import RewardNotFinite

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.language.loading import Loaded


@checked()
def compile(spec: AnySpec, *, lanes: int = DEFAULT_LANES, set: Assignments = ()) -> str:  # noqa: A001 - the verb
    """Return the Python source of a spec's kernel: a rollout for the solver and one for evaluation.

    Where an environment is stepped in Python, between the phases of a step, there are functions for these.

    Args:
        spec: A spec, with holes or without.
        lanes: Episodes that the kernel runs side by side.
        set: Values that replace those of the spec.

    Raises:
        SpecError: with all mistakes of the spec.
    """
    problem = compile_meaning(load(spec, set=set).meaning)
    details = (Detail.CREDIT, Detail.TERMS)
    return kernel_source(problem.meaning, problem.tables, lanes, details, in_phases=problem.is_stepped)


@contextmanager
def located_reward_errors(loaded: Loaded) -> Iterator[None]:
    """Turn a RewardNotFinite into a SpecError at the place of the reward term in the spec."""
    try:
        yield
    except RewardNotFinite as error:
        place = loaded.lineage.place(("reward", error.term))
        raise loaded.lineage.error([Diagnosis("BB045", str(error), place)]) from None
