"""The base class of all parts of a spec, and keys that are kept and ignored."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, TypeVar, get_args, get_origin

from pydantic import BaseModel, BeforeValidator, ConfigDict, model_validator

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

FREE = "x-"
"""The beginning of keys that are kept and ignored."""


def without_free_keys(value: object) -> object:
    """Return a mapping without its free keys, an empty one for nothing, and anything else as it is."""
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

    A key without a value holds an empty mapping or list, where it may hold one.
    """

    # Only a whole spec is validated, so that no part needs a validator of its own before one is asked for.
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False, defer_build=True)

    @classmethod
    def fields_by_key(cls) -> dict[str, FieldInfo]:
        """Return the fields by the keys that a spec has for them."""
        return {field.alias or name: field for name, field in cls.model_fields.items()}

    def values_by_key(self) -> dict[str, Any]:
        """Return the values by the keys that a spec has for them."""
        fields = type(self).model_fields
        return {field.alias or name: getattr(self, name) for name, field in fields.items()}

    @model_validator(mode="before")
    @classmethod
    def _without_free_keys(cls, data: Any) -> Any:  # noqa: ANN401 - whatever the file holds
        items = without_free_keys(data)
        if not isinstance(items, dict):
            return items
        return {key: value for key, value in items.items() if value is not None or not cls._holds_block(key)}

    @classmethod
    def _holds_block(cls, key: str) -> bool:
        field = cls.fields_by_key().get(key)
        return field is not None and not field.is_required() and holds_block(field.annotation)


def holds_block(annotation: object) -> bool:
    """Return whether one of the forms of a key's value is a mapping, a list or a part."""
    if isinstance(annotation, type) and not get_args(annotation):
        return issubclass(annotation, Part)
    return get_origin(annotation) in (dict, list) or any(map(holds_block, get_args(annotation)))
