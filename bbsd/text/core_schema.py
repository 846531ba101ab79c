"""The types of plain scalars: in YAML 1.2's core schema, which specs are read by, and in YAML 1.1."""

from __future__ import annotations

from typing import TYPE_CHECKING

from yaml import ScalarNode
from yaml.resolver import Resolver
from yamlcore import CCoreLoader

if TYPE_CHECKING:
    from collections.abc import Callable

TEXT = "tag:yaml.org,2002:str"
PLAIN = (True, False)  # PyYAML's mark of a scalar without quotes and tag

_CORE = CCoreLoader("")
_core_tag: Callable[[type[ScalarNode], str, tuple[bool, bool]], str] = _CORE.resolve
_old_tag: Callable[[type[ScalarNode], str, tuple[bool, bool]], str] = Resolver().resolve


def meaning(text: str) -> str | int | float | bool | None:
    """Return the number, truth, null or text that a plain scalar means; raises ValueError for 4300 digits."""
    tag = _core_tag(ScalarNode, text, PLAIN)
    value: str | int | float | bool | None = _CORE.yaml_constructors[tag](_CORE, ScalarNode(tag, text))
    return value


def is_text(text: str) -> bool:
    """Say whether a plain scalar is a text in YAML 1.2."""
    return _core_tag(ScalarNode, text, PLAIN) == TEXT


def is_text_everywhere(text: str) -> bool:
    """Say whether a plain scalar is a text in YAML 1.1 too, where `no`, `12:30` and `<<` are none."""
    return is_text(text) and _old_tag(ScalarNode, text, PLAIN) == TEXT
