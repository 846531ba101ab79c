"""Load and check a spec."""

from __future__ import annotations

from bbsd.api.given.arguments import RULES, Assignments, assignments, checked, optional
from bbsd.api.given.sources import AnySpec, source_of
from bbsd.errors import Diagnosis, SpecError
from bbsd.language.loading import Loaded, loaded_again
from bbsd.language.loading import check as check_source
from bbsd.language.loading import load as load_source

__all__ = ["EPISODES_OF_DESIGN", "AnySpec", "check", "load", "require_own_world"]

EPISODES_OF_DESIGN = 1000
"""Episodes in which a design is measured, by default: of all verbs the same, so that their numbers agree."""


@checked(seed=optional(RULES["seed"]))
def load(spec: AnySpec, *, seed: int | None = None, set: Assignments = ()) -> Loaded:
    """Read and check a spec.

    Args:
        spec: The path of its file, the folder of a run, whose design is meant, its text (with line breaks), its data as
            a dict, what `design` returned, or a spec that is loaded already. What a text or a dict extends is looked
            for in the working folder.
        seed: Seed of the draws in its constants; by default 0, or as they were drawn in a spec that is loaded already.
        set: Values that replace those of the spec, also of one that is loaded already: texts such as
            "design.budget=300_000", or a dict such as {"design.budget": 300_000}.

    Raises:
        SpecError: with all mistakes of the spec, or if its file cannot be read.
        NoDesign: a folder that is no run, or a run without an answer.
        BadArgument: it is none of what a spec can be given as.
    """
    if isinstance(spec, Loaded):
        drawn = spec.meaning.seed if seed is None else seed
        return loaded_again(spec, seed=drawn, overrides=assignments(set))
    return load_source(source_of(spec), seed=seed or 0, overrides=assignments(set))


def loaded_from(spec: AnySpec, seed: int, set: Assignments = ()) -> Loaded:
    """Return a spec as a verb uses it: the draws in the constants of one that is loaded already stay as they are."""
    return load(spec, seed=None if isinstance(spec, Loaded) else seed, set=set)


def require_own_world(loaded: Loaded) -> None:
    """Raise EnvironmentNotImported for a spec whose world is stepped in Python, before its episodes are needed.

    Verbs that run episodes and import nothing call it, since others that they call would import what the user's
    configuration file allows.
    """
    outside = loaded.spec.environment.outside
    if outside is not None:
        from bbsd.environments.stepping import not_imported

        raise not_imported(outside)


@checked()
def check(spec: AnySpec) -> tuple[Diagnosis, ...]:
    """Return all mistakes of a spec, and after them all warnings; their `severity` tells which they are.

    A file that cannot be read is a mistake too.

    Args:
        spec: What `load` takes.

    Raises:
        NoDesign: a folder that is no run, or a run without an answer.
    """
    try:
        return check_source(source_of(spec), warnings=True)
    except SpecError as error:
        return error.diagnoses
