"""Explain a design: what it does, from its tables and what its run has kept, without a compiler."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.api.given.arguments import Assignments, checked, whole
from bbsd.api.given.sources import run_of
from bbsd.api.results import Designed
from bbsd.api.specs import EPISODES_OF_DESIGN, AnySpec, loaded_from
from bbsd.architecture import HolesLeft, architecture_of, holes_of
from bbsd.explanation import Explanation, explain_architecture
from bbsd.runs.storage.visits import read_visits

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.architecture.visits import Visits
    from bbsd.language.loading import Loaded


class NothingToExplain(HolesLeft):
    """A spec with holes, of which nothing is decided yet."""

    advice = "have it designed: bbsd design, then bbsd explain FOLDER"


@checked(episodes=whole(0))
def explain(
    spec: AnySpec, *, seed: int = 0, episodes: int = 0, worth: bool = False, set: Assignments = ()
) -> Explanation:
    """Describe in words what the design of a spec does, layer by layer.

    Of a run, it uses what the run has kept of how often each cell was asked.

    Args:
        spec: A design: a spec without holes.
        seed: Seed of the draws in constants, and of the episodes.
        episodes: Count anew, in so many episodes, how often each cell is asked.
        worth: Also measure, in 1,000 or so many episodes, what the design would earn without what seems useless.
        set: Values that replace those of the spec.

    Raises:
        SpecError: with all mistakes of the spec, or if a reward is not finite.
        HolesLeft: the spec has holes.
    """
    loaded = loaded_from(spec, seed, set)
    if holes := holes_of(loaded.meaning):
        raise NothingToExplain(f"there is nothing to explain yet: the spec has holes ({'; '.join(holes)})")
    architecture = architecture_of(loaded.meaning)
    visits = _visits(spec, loaded, architecture, seed, episodes, is_changed=bool(set))
    if worth and visits is None:
        visits = _counted(loaded, architecture, seed, EPISODES_OF_DESIGN)
    explanation = explain_architecture(loaded.meaning, architecture, visits)
    if not worth:
        return explanation
    return _with_worth(loaded, architecture, explanation, seed, episodes or EPISODES_OF_DESIGN)


def _with_worth(
    loaded: Loaded, architecture: Architecture, explanation: Explanation, seed: int, episodes: int
) -> Explanation:
    """Return the explanation with what the design would earn without what seems useless."""
    from bbsd.api.compiling import located_reward_errors
    from bbsd.compiler import compile_meaning
    from bbsd.evaluation import evaluation_keys
    from bbsd.explanation.worth.without import with_worth

    generation = loaded.spec.design.coevolution.generations
    problem, keys = compile_meaning(loaded.meaning), evaluation_keys(seed, episodes)
    with located_reward_errors(loaded):
        useless = with_worth(problem, architecture, explanation.useless, keys, generation)
    return replace(explanation, useless=useless)


def _visits(
    spec: AnySpec, loaded: Loaded, architecture: Architecture, seed: int, episodes: int, *, is_changed: bool
) -> Visits | None:
    """Return the visits that are wanted, or those that a run has kept; None where there are none."""
    if episodes:
        return _counted(loaded, architecture, seed, episodes)
    if is_changed:
        return None
    if isinstance(spec, Designed):
        return spec.visits
    folder = run_of(spec)
    if folder is None:
        return None
    cells = [len(table) for table in architecture.tables]
    return read_visits(folder, dict(zip(loaded.spec.behaviors, cells, strict=True)))


def _counted(loaded: Loaded, architecture: Architecture, seed: int, episodes: int) -> Visits:
    from bbsd.api.compiling import located_reward_errors
    from bbsd.evaluation.visits import visits_of

    with located_reward_errors(loaded):
        return visits_of(loaded.meaning, architecture, seed, episodes)
