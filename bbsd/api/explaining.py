"""Explain a design: what it does, from its tables and what its run has kept, without a compiler."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.api.specs import AnySpec, load
from bbsd.architecture import architecture_of
from bbsd.explanation import Explanation, explain_architecture
from bbsd.language.loading import Loaded
from bbsd.runs.storage.finished import ARCHITECTURE
from bbsd.runs.storage.visits import read_visits

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.architecture import Architecture
    from bbsd.architecture.visits import Visits


def explain(spec: AnySpec, *, seed: int = 0, episodes: int = 0, overrides: Sequence[str] = ()) -> Explanation:
    """Describe in words what the design of a spec does, layer by layer.

    Of a run, it uses what the run has kept of how often each cell was asked.

    Args:
        spec: A design: a spec without holes.
        seed: Seed of the draws in constants, and of the episodes.
        episodes: Count anew, in so many episodes, how often each cell is asked.
        overrides: Values that replace those of the spec.

    Raises:
        SpecError: with all mistakes of the spec.
        HolesLeft: the spec has holes.
    """
    loaded = load(spec, seed=seed, overrides=overrides)
    architecture = architecture_of(loaded.meaning)
    visits = _visits(spec, loaded, architecture, seed, episodes, is_changed=bool(overrides))
    return explain_architecture(loaded.meaning, architecture, visits)


def _visits(
    spec: AnySpec, loaded: Loaded, architecture: Architecture, seed: int, episodes: int, *, is_changed: bool
) -> Visits | None:
    """Return the visits that are wanted, or those that a run has kept; None where there are none."""
    if episodes:
        from bbsd.api.compiling import located_reward_errors
        from bbsd.evaluation.visits import visits_of

        with located_reward_errors(loaded):
            return visits_of(loaded.meaning, architecture, seed, episodes)
    if is_changed or isinstance(spec, Loaded):
        return None
    path = Path(spec)
    folder = path if path.is_dir() else path.parent
    if path.is_dir() or path.name == ARCHITECTURE:
        return read_visits(folder, [*loaded.spec.behaviors])
    return None
