"""The glossary of an explanation: its inputs and actions, with their definitions in the spec."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bbsd.architecture.sayings import input_texts, mapping_text, start_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.language.models import Spec


class GlossaryEntry(NamedTuple):
    """A word, and its meaning."""

    word: str
    meaning: str


def inputs_of(spec: Spec, behaviors: Iterable[str]) -> tuple[GlossaryEntry, ...]:
    """Return the inputs of some behaviors, each once, in order of first use."""
    return _entries(
        (behavior, name, _origin(spec, name) if text == name else text)
        for behavior in behaviors
        for name, text in input_texts(spec, spec.behaviors[behavior]).items()
    )


def _origin(spec: Spec, name: str) -> str:
    """Return where an input comes from that is what it reads: the state or an observation; else its name."""
    state, outside = spec.environment.state, spec.environment.outside
    if name in state:
        return f"state, {start_text(state[name])}"
    return "observed" if outside is not None and any(field.name == name for field in outside.fields) else name


def actions_of(spec: Spec, behaviors: Iterable[str]) -> tuple[GlossaryEntry, ...]:
    """Return the actions of some behaviors, each once, in order of first use."""
    return _entries(
        (behavior, name, mapping_text(sets))
        for behavior in behaviors
        for name, sets in spec.behaviors[behavior].actions.items()
    )


def _entries(uses: Iterable[tuple[str, str, str]]) -> tuple[GlossaryEntry, ...]:
    """Return words with their meanings, from uses (behavior, word, meaning); one with several names its behaviors."""
    by_word: dict[str, dict[str, list[str]]] = {}
    for behavior, word, meaning in uses:
        by_word.setdefault(word, {}).setdefault(meaning, []).append(behavior)
    return tuple(
        GlossaryEntry(_word_with_owners(word, behaviors, meanings), meaning)
        for word, meanings in by_word.items()
        for meaning, behaviors in meanings.items()
    )


def _word_with_owners(word: str, behaviors: Sequence[str], meanings: dict[str, list[str]]) -> str:
    return word if len(meanings) == 1 else f"{word} of {', '.join(behaviors)}"
