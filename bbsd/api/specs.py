"""Load, check and compile a spec."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.compiler import Detail, compile_meaning, kernel_source
from bbsd.compiler.problem import DEFAULT_LANES
from bbsd.errors import Diagnosis, SpecError
from bbsd.evaluation import (
    RewardNotFinite,
)
from bbsd.language.loading import Loaded
from bbsd.language.loading import check as check_source
from bbsd.language.loading import load as load_source
from bbsd.text import Source

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence


AnySpec = str | Path | Loaded
"""The path of a spec's file, or a loaded spec."""


def load(spec: AnySpec, *, seed: int = 0, overrides: Sequence[str] = ()) -> Loaded:
    """Read and check a spec; random draws in its constants depend on the seed.

    Raises:
        SpecError: with all mistakes of the spec.
        OSError: its file cannot be read.
    """
    return (
        spec
        if isinstance(spec, Loaded)
        else load_source(Source.read(str(spec)), seed=seed, overrides=overrides)
    )


def check(spec: str | Path) -> tuple[Diagnosis, ...]:
    """Return all mistakes of a spec, none if it is correct.

    Raises:
        OSError: its file cannot be read.
    """
    try:
        return check_source(Source.read(str(spec)))
    except SpecError as error:
        return error.diagnoses


def compile(spec: AnySpec, *, lanes: int = DEFAULT_LANES, overrides: Sequence[str] = ()) -> str:  # noqa: A001 - the verb
    """Return the Python source of a spec's kernel: a rollout for the solver and one for evaluation.

    Raises:
        SpecError: with all mistakes of the spec.
    """
    problem = compile_meaning(load(spec, overrides=overrides).meaning)
    return kernel_source(problem.meaning, problem.tables, lanes, (Detail.CREDIT, Detail.TERMS))


@contextmanager
def located_reward_errors(loaded: Loaded) -> Iterator[None]:
    """Turn a RewardNotFinite into a SpecError at the place of the reward term in the spec."""
    try:
        yield
    except RewardNotFinite as error:
        place = loaded.lineage.place(("reward", error.term))
        raise loaded.lineage.error([Diagnosis("BB045", str(error), place)]) from None
