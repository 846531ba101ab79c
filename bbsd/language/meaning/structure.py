"""The structure that a spec gives: a behavior for each layer, or an open one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.errors import nearest
from bbsd.expression.syntax.mistakes import WHOLE, Rewriting
from bbsd.language.models import OPEN, Spec

if TYPE_CHECKING:
    from bbsd.expression.scope import Findings, Path

OPEN_LAYER = -1


@dataclass(frozen=True, slots=True)
class Structure:
    """Layers from the lowest up (2), a behavior's index or -1 for open; and the behaviors that may fill open ones."""

    layers: tuple[int, ...]
    candidates: tuple[int, ...]

    @property
    def is_open(self) -> bool:
        """Whether there is a structure to learn: more than one way to fill the open layers."""
        return OPEN_LAYER in self.layers and len(self.candidates) > 1

    def may_hold(self, behavior: int) -> bool:
        """Return whether a behavior has a layer or may get one; open cells of any other are no holes."""
        return OPEN_LAYER in self.layers or behavior in self.layers


def elaborate_structure(spec: Spec, findings: Findings, broken: frozenset[str] = frozenset()) -> Structure:
    """Return the layers as given, or as many open ones as `design.layers` says."""
    behaviors = list(spec.behaviors)
    all_behaviors = tuple(range(len(behaviors)))
    if spec.structure is None:
        layers = spec.design.layers or len(behaviors)
        if layers > len(behaviors) and not broken:
            message = f"{layers} layers, but only {len(behaviors)} behaviors, each of which can stand once"
            findings.report(("design", "layers"), "BB042", message)
        return _without_forced_layer((OPEN_LAYER,) * min(layers, len(behaviors)), all_behaviors)
    if not spec.structure:
        findings.report(
            ("structure",), "BB042", "a structure without layers; leave the key out to have it learned"
        )
    if _reported_actions(spec, findings):
        return _without_forced_layer((OPEN_LAYER,) * len(behaviors), all_behaviors)
    given = [_layer(word, index, spec, findings, broken) for index, word in enumerate(spec.structure)]
    candidates = tuple(behavior for behavior in all_behaviors if behavior not in given)
    if given.count(OPEN_LAYER) > len(candidates) and not broken:
        message = f"{given.count(OPEN_LAYER)} open layers, but {len(candidates)} behaviors to fill them"
        findings.report(("structure",), "BB042", message)
    return _without_forced_layer(tuple(layer for layer in reversed(given) if layer is not None), candidates)


def _reported_actions(spec: Spec, findings: Findings) -> bool:
    """Report a structure that names actions for their behaviors; return whether it does."""
    owners = {
        action: name for name, behavior in reversed(spec.behaviors.items()) for action in behavior.actions
    }
    known = {*spec.behaviors, OPEN}
    words = spec.structure or []
    wrong = next((at for at, word in enumerate(words) if word not in known and word in owners), None)
    if wrong is None:
        return False
    word = words[wrong]
    meant = list(dict.fromkeys(word if word in known else owners.get(word, word) for word in words))
    listed = f"[{', '.join(meant)}]"
    message = f'"{word}" is an action of {owners[word]}; structure lists behaviors'
    correction = Rewriting(listed, is_certain=False, at=("structure",))
    findings.report(("structure", wrong), "BB042", message, WHOLE, f"write structure: {listed}", correction)
    return True


def _without_forced_layer(layers: tuple[int, ...], candidates: tuple[int, ...]) -> Structure:
    """Return the structure, with one open layer filled where only one behavior is left for it."""
    if layers.count(OPEN_LAYER) == 1 and len(candidates) == 1:
        return Structure(tuple(candidates[0] if layer == OPEN_LAYER else layer for layer in layers), ())
    return Structure(layers, candidates)


def _report_unknown(word: str, path: Path, known: list[str], findings: Findings) -> None:
    parts = word.split()
    if len(parts) > 1 and set(parts) <= set(known):
        message = f'"{word}" is not a behavior: between {parts[0]} and {parts[1]} a comma is missing'
        findings.report(path, "BB042", message, correction=Rewriting(", ".join(parts)))
        return
    near = nearest(word, known)
    hint = f'; did you mean "{near}"?' if near else ""
    correction = Rewriting(near, is_certain=False) if near else None
    findings.report(path, "BB042", f'"{word}" is not a behavior{hint}', correction=correction)


def _layer(word: str, index: int, spec: Spec, findings: Findings, broken: frozenset[str]) -> int | None:
    """Return the behavior of a layer; None after a mistake."""
    behaviors, path = list(spec.behaviors), ("structure", index)
    if word == OPEN:
        return OPEN_LAYER
    if word not in behaviors:
        if word not in broken:
            _report_unknown(word, path, [*behaviors, OPEN], findings)
        return None
    if word in (spec.structure or ())[:index]:
        findings.report(path, "BB042", f"{word} stands in the structure twice")
        return None
    return behaviors.index(word)
