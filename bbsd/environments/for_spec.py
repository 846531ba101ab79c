"""The environment of a loaded spec: opened by consent, and compared with what the spec says of it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.environments.opening import Recipe, open_environment
from bbsd.environments.spaces.matching import Setting, misfits
from bbsd.environments.spaces.misfits import UnfitError
from bbsd.errors import Diagnosis
from bbsd.expression.graph import value_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from typing import Any

    from bbsd.environments.importing.consent import Consent
    from bbsd.environments.importing.modules import Announce
    from bbsd.environments.opening import Opened
    from bbsd.environments.spaces.misfits import Misfit
    from bbsd.errors import SpecError
    from bbsd.expression.graph import Node
    from bbsd.language.lineage import Lineage
    from bbsd.language.loading import Loaded
    from bbsd.language.meaning import Meaning


def opened_for(
    loaded: Loaded,
    consent: Consent,
    seconds: float,
    *,
    given: Callable[..., Any] | None = None,
    announce: Announce | None = None,
) -> Opened | None:
    """Open the environment of a spec that fits it; None where the spec's world is its own.

    Args:
        loaded: the spec.
        consent: what may be imported.
        seconds: how long a call of the environment may take.
        given: a class that the caller has in hand, instead of what the spec names.
        announce: called with each module and its file before it is imported.

    Raises:
        SpecError: the spec does not fit the environment; with all the places in it.
        ImportNotAllowed, NoSuchModule, EnvironmentFailed, EnvironmentHangs: as `open_environment`.
    """
    outside = loaded.spec.environment.outside
    if outside is None:
        return None
    closed = closed_folders(loaded.lineage)
    recipe = Recipe(outside, loaded.spec.environment.robots, consent, closed, seconds, given)
    try:
        opened = open_environment(recipe, announce)
    except UnfitError as error:
        raise located(error.misfits, loaded.lineage) from None
    found = misfits(outside, opened.observed, opened.taken, settings(loaded.meaning), opened.making.label)
    if found:
        raise located(found, loaded.lineage)
    return opened


def closed_folders(lineage: Lineage) -> tuple[str, ...]:
    """Return the folders of a spec's files, from which nothing is imported by itself."""
    folders = (Path(document.source.file).resolve().parent for document in lineage.documents)
    return tuple(dict.fromkeys(map(str, folders)))


def located(found: Sequence[Misfit], lineage: Lineage) -> SpecError:
    """Return misfits as mistakes of a spec, in the order of its text."""
    diagnoses = [
        Diagnosis(misfit.code, misfit.message, lineage.place(misfit.path), misfit.advice) for misfit in found
    ]
    return lineage.error(sorted(dict.fromkeys(diagnoses), key=lambda diagnosis: diagnosis.place))


def settings(meaning: Meaning) -> Iterator[Setting]:
    """Yield the literal values that a spec gives to its state: at the start, and by actions."""
    for slot, node in meaning.episode.start.items():
        if slot.name in meaning.spec.environment.state:
            yield from _literal(slot.name, (node,), ("environment", "state", slot.name))
    for module in meaning.episode.modules:
        for action, sets in module.actions.items():
            for (name, _), nodes in sets.items():
                yield from _literal(name, nodes, ("behaviors", module.name, "actions", action, name))


def _literal(name: str, nodes: Sequence[Node], path: tuple[str | int, ...]) -> Iterator[Setting]:
    for value in {float(value_of(node)): None for node in nodes if node.literal}:
        yield Setting(name, value, path)
