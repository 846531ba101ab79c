"""The language as a JSON Schema (draft 7), made from the spec's models: editors complete and check specs by it.

It describes the form of a spec; only `bbsd check` checks expressions and the use of names.
"""

from __future__ import annotations

from types import NoneType, UnionType
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias, Union, get_args, get_origin

from annotated_types import Ge, Le, MaxLen, MinLen

from bbsd.expression.reserved import RESERVED, Use
from bbsd.language import design, field_types, models, outside, view
from bbsd.language.base import FREE, Part
from bbsd.language.field_types import Expression
from bbsd.text.core_schema import meaning

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from pydantic.fields import FieldInfo

Schema: TypeAlias = dict[str, Any]

SCHEMA_FILE = "bbsd.schema.json"
"""The name of a file with the schema."""

SCALAR: Schema = {"type": ["string", "number", "boolean"]}
"""An expression or the name of a cell; no $ref, for which editors would show another description than the key's."""
LETTERS = "[a-z][a-z0-9_]*"
PARAMETERS = rf"(?:\s*\(\s*{LETTERS}\s*(?:,\s*{LETTERS}\s*)*\))?\s*"
NAME_ADVICE = (
    "names are small letters, digits and _, a letter first, and no word that means something else there"
)


def language_schema() -> Schema:
    """Return the schema of a spec: nested blocks, with a description and a default for each key.

    A spec that extends another may omit any key, and may set any to null, which removes it.
    """
    whole = {**_part(models.Spec), "title": "A bbsd spec"}
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "$id": "urn:bbsd:language:1",
        "title": "A bbsd spec",
        "if": {"required": ["extends"], "properties": {"extends": {"type": "string"}}},
        "then": _ref("part"),
        "else": _ref("whole"),
        "definitions": {"whole": whole, "part": _partial(whole), **_definitions()},
    }


def _partial(schema: Schema) -> Schema:
    """Return the schema of a block in which any key may be missing or null."""
    partial = {key: value for key, value in schema.items() if key not in ("required", "minProperties")}
    if "properties" in schema:
        partial["properties"] = {key: _nullable(value) for key, value in schema["properties"].items()}
    if isinstance(values := schema.get("additionalProperties"), dict):
        partial["additionalProperties"] = _nullable(values)
    if "anyOf" in schema:
        partial["anyOf"] = [_partial(option) for option in schema["anyOf"]]
    return partial


def _nullable(schema: Schema) -> Schema:
    partial = _partial(schema)
    if "type" in partial:
        kinds = partial["type"] if isinstance(partial["type"], list) else [partial["type"]]
        partial["type"] = [*dict.fromkeys([*kinds, "null"])]
    if "enum" in partial:
        partial["enum"] = [*partial["enum"], None]
    if "anyOf" in partial:
        partial["anyOf"] = [*partial["anyOf"], {"type": "null"}]
    return {"anyOf": [partial, {"type": "null"}]} if "$ref" in partial else partial


def _definitions() -> Schema:
    """Return the schemas that others refer to: names, and constants, whose lists contain constants."""
    table = {"type": "array", "items": _ref("constant")}
    return {
        "constant": {"description": "An expression, or a nested list of numbers.", "anyOf": [SCALAR, table]},
        "name": _name(RESERVED[Use.ANY]),
        "behavior_name": _name(RESERVED[Use.BEHAVIOR]),
        "action_name": _name(RESERVED[Use.ACTION]),
        "value_name": _name(RESERVED[Use.VALUE]),
        "definition": _definition_name(),
    }


def _ref(definition: str) -> Schema:
    return {"$ref": f"#/definitions/{definition}"}


def _name(reserved: Iterable[str]) -> Schema:
    pattern = f"^(?!(?:{'|'.join(sorted(reserved))})$){LETTERS}$|^{FREE}"
    return {"type": "string", "pattern": pattern, "patternErrorMessage": NAME_ADVICE}


def _definition_name() -> Schema:
    """Return the schema of a definition's name; with parameters some more words are taken."""
    of_value, of_function = RESERVED[Use.VALUE], RESERVED[Use.FUNCTION].keys() - RESERVED[Use.VALUE].keys()
    taken = rf"(?:{'|'.join(sorted(of_value))})\s*(?:\(|$)|(?:{'|'.join(sorted(of_function))})\s*\("
    pattern = f"^(?!{taken}){LETTERS}{PARAMETERS}$|^{FREE}"
    return {"type": "string", "pattern": pattern, "patternErrorMessage": NAME_ADVICE}


def _word_or_name(*words: str) -> Schema:
    """Return the schema of a text for which editors propose some words."""
    return {"type": "string", "anyOf": [{"enum": [*words]}, {"type": "string"}]}


def _part(part: type[Part]) -> Schema:
    """Return the schema of a block with the keys of a model."""
    fields = part.fields_by_key()
    return {
        "title": part.__name__.lower(),
        "description": " ".join((part.__doc__ or "").split()),
        "type": "object",
        "properties": {key: _field(part, key, field) for key, field in fields.items()},
        "patternProperties": {f"^{FREE}": True},
        "additionalProperties": False,
        "required": [key for key, field in fields.items() if field.is_required()],
    }


def _field(part: type[Part], key: str, field: FieldInfo) -> Schema:
    schema = _with_bounds(KEY_SCHEMAS.get((part, key)) or _kind(field.annotation), field.metadata)
    if not field.is_required():
        schema = {**_or_nothing(schema), **_default(field.default)}
    default = f" Default: {schema['default']}" if "default" in schema else ""  # editors show no other
    return {**schema, "description": f"{field.description or ''}{default}"}


def _or_nothing(schema: Schema) -> Schema:
    """Return the schema of an optional key, which may be empty if its value is a block or a list."""
    if "anyOf" in schema:
        first, *others = schema["anyOf"]
        return {**schema, "anyOf": [_or_nothing(first), *others]}
    if schema.get("type") in ("object", "array"):
        return {**schema, "type": [schema["type"], "null"]}
    return schema


def _default(value: object) -> Schema:
    match value:
        case Expression(text=text):
            return {"default": meaning(text)}
        case int() | float() | str() if value != "":
            return {"default": value}
    return {}


def _with_bounds(schema: Schema, rules: Iterable[object]) -> Schema:
    """Return a schema with the bounds that the model sets."""
    for rule in rules:
        match rule:
            case Ge(low):
                schema = {**schema, "minimum": low}
            case Le(high):
                schema = {**schema, "maximum": high}
            case MaxLen(longest):
                schema = {**schema, "maxLength": longest}
            case MinLen(shortest) if schema["type"] == "string":
                schema = {**schema, "minLength": shortest}
            case MinLen(fewest):
                schema = {**schema, "type": "object", "minProperties": fewest}
    return schema


def _kind(annotation: Any) -> Schema:  # noqa: ANN401 - a type, of any kind
    """Return the schema of a type that a model has."""
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _read_by(arguments[1:], READER_SCHEMAS) or _kind(arguments[0])
    if origin is Literal:
        return {"enum": [*arguments]}
    if origin is dict:
        return _mapping(*arguments)
    if origin is list:
        return {"type": "array", "items": _kind(arguments[0])}
    if origin in (Union, UnionType):
        return {"anyOf": [_kind(argument) for argument in arguments]}
    if isinstance(annotation, type) and issubclass(annotation, Part):
        return _part(annotation)
    return TYPE_SCHEMAS[annotation]


def _mapping(key: Any, value: Any) -> Schema:  # noqa: ANN401 - types, of any kind
    """Return the schema of a mapping whose keys are names that the spec defines; it may be left empty."""
    name = _read_by(get_args(key)[1:], NAME_SCHEMAS)
    return {
        "type": ["object", "null"],
        **({"propertyNames": name} if name else {}),
        "patternProperties": {f"^{FREE}": True},
        "additionalProperties": _kind(value),
    }


def _read_by(validators: Iterable[object], readers: Mapping[object, Schema]) -> Schema | None:
    """Return the schema of the values that the first validator found in `readers` takes, or None."""
    functions = (getattr(validator, "func", None) for validator in validators)
    return next((readers[function] for function in functions if function in readers), None)


TYPE_SCHEMAS: Mapping[object, Schema] = {
    Any: _ref("constant"),
    Expression: SCALAR,
    float: {"type": "number"},
    int: {"type": "integer"},
    str: {"type": "string"},
    NoneType: {"type": "null"},
}
READER_SCHEMAS: Mapping[object, Schema] = {field_types.cell: SCALAR}
NAME_SCHEMAS: Mapping[object, Schema] = {
    field_types.name: _ref("name"),
    field_types.behavior_name: _ref("behavior_name"),
    field_types.action_name: _ref("action_name"),
    field_types.value_name: _ref("value_name"),
    field_types.definition_key: _ref("definition"),
}
PLACE_SCHEMA: Schema = {"anyOf": [{"type": "array", "items": SCALAR, "minItems": 2, "maxItems": 3}, SCALAR]}
CORNERS_SCHEMA: Schema = {"anyOf": [{"type": "array", "items": SCALAR, "minItems": 4, "maxItems": 4}, SCALAR]}
DECISION_SCHEMA = _word_or_name(models.NO_ACTION_TEXT, models.OPEN)
CELLS_SCHEMA: Schema = {"anyOf": [SCALAR, {"type": "array", "items": SCALAR, "minItems": 1}]}
BUDGET_SCHEMA: Schema = {
    "anyOf": [
        {"type": "integer", "minimum": design.LEAST_BUDGET},
        {"type": "string", "anyOf": [{"enum": ["auto"]}, {"pattern": f"^{field_types.GROUPED.pattern}$"}]},
    ]
}
UNIMPROVED_SCHEMA: Schema = {
    "anyOf": [
        {"type": "integer", "minimum": 1000},
        {"type": "string", "pattern": f"^{field_types.GROUPED.pattern}$"},
        {"type": "null"},
    ]
}
RECORD_SCHEMA: Schema = {
    "anyOf": [
        {"type": "integer", "minimum": 1},
        {"type": "array", "items": {"type": "integer", "minimum": 1}},
        {"enum": ["none"]},
    ]
}
ARGUMENTS_SCHEMA: Schema = {"type": ["object", "null"], "additionalProperties": True}
OBSERVED_SCHEMA: Schema = {
    "anyOf": [
        {"type": "array", "items": {"anyOf": [_ref("value_name"), {"enum": [outside.UNUSED]}]}},
        {
            **_mapping(field_types.ValueNameText, str),
            "additionalProperties": {"anyOf": [{"type": "integer", "minimum": 1}, {"type": "string"}]},
        },
    ]
}


def _target_schema(kind: outside.OutsideKind) -> Schema:
    return {"type": "string", "pattern": f"^{outside.TARGETS[kind]}$"}


KEY_SCHEMAS: Mapping[tuple[type[Part], str], Schema] = {
    (models.When, "when"): {**_mapping(str, str), "additionalProperties": CELLS_SCHEMA},
    (models.When, "do"): DECISION_SCHEMA,
    (models.Otherwise, "otherwise"): DECISION_SCHEMA,
    **{(models.Environment, kind): _target_schema(kind) for kind in outside.OUTSIDE_KINDS},
    (models.Environment, "with"): ARGUMENTS_SCHEMA,
    (models.Environment, "observation"): OBSERVED_SCHEMA,
    (models.Spec, "structure"): {"type": "array", "items": _word_or_name(models.OPEN)},
    (design.Design, "budget"): BUDGET_SCHEMA,
    (design.Stop, "unimproved"): UNIMPROVED_SCHEMA,
    (design.Design, "record"): RECORD_SCHEMA,
    (view.View, "at"): PLACE_SCHEMA,
    (view.View, "area"): CORNERS_SCHEMA,
    (view.View, "marks"): {**_mapping(field_types.NameText, str), "additionalProperties": PLACE_SCHEMA},
}
"""Keys that take more than their type says: the model accepts several ways to write their values."""
