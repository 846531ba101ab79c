"""What all parts of a spec have in common."""

from __future__ import annotations

from typing import Annotated, Any, TypeVar, get_args, get_origin

from pydantic import BaseModel, BeforeValidator, ConfigDict, model_validator

FREE = "x-"
"""What the keys begin with that are kept and ignored."""


def without_free_keys(value: object) -> object:
    """A mapping without its free keys; nothing under a key is an empty mapping."""
    if value is None:
        return {}
    if not isinstance(value, dict):
        return value
    return {key: item for key, item in value.items() if not str(key).startswith(FREE)}


K = TypeVar("K")
V = TypeVar("V")
Entries = Annotated[dict[K, V], BeforeValidator(without_free_keys)]
"""A mapping from names of the spec's own."""


class Part(BaseModel):
    """A part of a spec: frozen, strict, every unknown key an error but those beginning with `x-`.

    Nothing under a key that holds a mapping or a list is an empty one.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    @model_validator(mode="before")
    @classmethod
    def _without_free_keys(cls, data: Any) -> Any:  # noqa: ANN401 - whatever the file holds
        found = without_free_keys(data)
        if not isinstance(found, dict):
            return found
        return {key: value for key, value in found.items() if value is not None or not cls._holds_block(key)}

    @classmethod
    def _holds_block(cls, key: str) -> bool:
        field = cls.model_fields.get(key)
        return field is not None and not field.is_required() and _is_block(field.annotation)


def _is_block(annotation: object) -> bool:
    """Whether a key holds a mapping, a list or a part, in one of its ways to be written."""
    if isinstance(annotation, type) and not get_args(annotation):
        return issubclass(annotation, Part)
    return get_origin(annotation) in (dict, list) or any(map(_is_block, get_args(annotation)))
