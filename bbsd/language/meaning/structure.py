"""The structure a spec gives: layers of behaviors, and which of them are open."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.errors import did_you_mean
from bbsd.language.models import OPEN, Spec

if TYPE_CHECKING:
    from bbsd.expression.scope import Findings

OPEN_LAYER = -1


@dataclass(frozen=True, slots=True)
class Structure:
    """Layers from the lowest up (2): a behavior's index or -1 for open, and who may fill the open ones."""

    layers: tuple[int, ...]
    candidates: tuple[int, ...]

    @property
    def is_open(self) -> bool:
        """Whether there is anything to learn: with one way to fill the layers there is not."""
        return OPEN_LAYER in self.layers and len(self.candidates) > 1

    def may_hold(self, behavior: int) -> bool:
        """Whether a behavior has a layer or may get one; what is open in any other is no hole."""
        return OPEN_LAYER in self.layers or behavior in self.layers


def elaborate_structure(spec: Spec, findings: Findings, broken: frozenset[str] = frozenset()) -> Structure:
    """The layers as given, or as many open ones as `design.layers` says."""
    behaviors = list(spec.behaviors)
    everyone = tuple(range(len(behaviors)))
    if spec.structure is None:
        layers = spec.design.layers or len(behaviors)
        if layers > len(behaviors) and not broken:
            message = f"{layers} layers, but only {len(behaviors)} behaviors, each of which can stand once"
            findings.tell(("design", "layers"), "BB042", message)
        return _settled((OPEN_LAYER,) * min(layers, len(behaviors)), everyone)
    if not spec.structure:
        findings.tell(
            ("structure",), "BB042", "a structure without layers; leave the key out to have it learned"
        )
    given = [_layer(word, place, spec, findings, broken) for place, word in enumerate(spec.structure)]
    candidates = tuple(behavior for behavior in everyone if behavior not in given)
    if given.count(OPEN_LAYER) > len(candidates) and not broken:
        message = f"{given.count(OPEN_LAYER)} open layers, but {len(candidates)} behaviors to fill them"
        findings.tell(("structure",), "BB042", message)
    return _settled(tuple(layer for layer in reversed(given) if layer is not None), candidates)


def _settled(layers: tuple[int, ...], candidates: tuple[int, ...]) -> Structure:
    """One open layer for one behavior is no choice."""
    if layers.count(OPEN_LAYER) == 1 and len(candidates) == 1:
        return Structure(tuple(candidates[0] if layer == OPEN_LAYER else layer for layer in layers), ())
    return Structure(layers, candidates)


def _layer(word: str, place: int, spec: Spec, findings: Findings, broken: frozenset[str]) -> int | None:
    """The behavior of a layer; None after a mistake."""
    behaviors, path = list(spec.behaviors), ("structure", place)
    if word == OPEN:
        return OPEN_LAYER
    if word not in behaviors:
        if word not in broken:
            message = f'"{word}" is not a behavior{did_you_mean(word, [*behaviors, OPEN])}'
            findings.tell(path, "BB042", message)
        return None
    if word in (spec.structure or ())[:place]:
        findings.tell(path, "BB042", f"{word} stands in the structure twice")
        return None
    return behaviors.index(word)
