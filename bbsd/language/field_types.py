"""Types of the models' fields: expressions, names and cells as a designer writes them, checked by pydantic."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import AfterValidator, BeforeValidator, GetPydanticSchema, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError, core_schema

from bbsd.expression.reserved import RESERVED, Use, another_name
from bbsd.expression.syntax.mistakes import ExpressionError
from bbsd.expression.syntax.parsing import NAME, parse
from bbsd.expression.syntax.text import number_text

if TYPE_CHECKING:
    from bbsd.expression.syntax.tree import Expr

ELEMENT = re.compile(r"\s*[a-z][a-z0-9_]*\s*\[.*\]\s*", re.DOTALL)
OF_ACTIONS = "is an element of a list, and only actions set single elements"
GROUPED = re.compile(r"[1-9][0-9]{0,2}(?:_[0-9]{3})+")
SIGNATURE = re.compile(r"\s*(?P<name>\w+)\s*(?:\((?P<parameters>[^()]*)\)\s*)?")


@dataclass(frozen=True, slots=True)
class Expression:
    """An expression as written, and its tree; equal to another of the same text."""

    text: str
    tree: Expr

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Expression) and self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)


def expression(value: object) -> Expression:
    """Read a scalar of a spec as an expression; raise PydanticCustomError with the mistake in it."""
    if isinstance(value, Expression):
        return value
    text = scalar_text(value)
    if text is None:
        message = "an expression is needed here, not {what}"
        raise PydanticCustomError("not_an_expression", message, {"what": kind_of(value)})
    try:
        return Expression(text, parse(text))
    except ExpressionError as error:
        context = {"message": str(error), "mistake": error.mistake}
        raise PydanticCustomError("expression", "{message}", context) from None


Nested = Expression | tuple["Nested", ...]
"""An expression, or a nested list of expressions."""


def nested(value: object) -> Nested:
    """Read a scalar or a list of a spec as expressions; raise ValidationError with all mistakes in it."""
    errors: list[InitErrorDetails] = []
    expressions = _read_nested(value, (), errors)
    if errors:
        raise ValidationError.from_exception_data("list", errors)
    return expressions


def _read_nested(value: object, at: tuple[int, ...], errors: list[InitErrorDetails]) -> Nested:
    """Return an expression or a nested list of them; append mistakes with their position in it to `errors`."""
    if isinstance(value, list | tuple):
        return tuple(_read_nested(item, (*at, index), errors) for index, item in enumerate(value))
    try:
        return expression(value)
    except PydanticCustomError as error:
        errors.append(InitErrorDetails(type=error, loc=at, input=value))
        return ()


def expressions_in(value: Nested) -> list[Expression]:
    """Return all expressions of a value, in order."""
    if isinstance(value, tuple):
        return [expression for item in value for expression in expressions_in(item)]
    return [value]


def scalar_text(value: object) -> str | None:
    """Return a YAML scalar as the text of an expression or a cell; None for anything else."""
    match value:
        case str():
            return value
        case bool():
            return "true" if value else "false"
        case int() | float() if isfinite(value):
            return number_text(value)
    return None


def kind_of(value: object) -> str:
    """Return what a plain value is, in the words of a message."""
    match value:
        case None:
            return "nothing"
        case dict():
            return "a mapping"
        case list():
            return "a list"
        case str():
            return "text"
        case bool():
            return "a truth"
        case float() if not isfinite(value):
            return "infinity or NaN"
    return "a number"


def is_value_name(text: str) -> bool:
    """Return whether a text can name something that expressions use without brackets."""
    return NAME.match(text) is not None and text not in RESERVED[Use.VALUE]


def shape(value: object) -> str:
    """Return a tag for a value as a mapping or in another form; no key of a spec looks like a tag."""
    return "<other>" if isinstance(value, str | int | float | list) or value is None else "<mapping>"


def grouped(value: object) -> object:
    """Return the whole number that a text such as 300_000 is; any other value as it is."""
    return int(value) if isinstance(value, str) and GROUPED.fullmatch(value) else value


def word_or_number(value: object) -> str:
    """Return a tag for a value as a word or as a number."""
    return "<word>" if isinstance(value, str) else "<number>"


def word_list_or_number(value: object) -> str:
    """Return a tag for a value as a word, as a list or as a number."""
    return "<list>" if isinstance(value, list) else word_or_number(value)


def name(value: str) -> str:
    """Return a name that no expression uses; raise PydanticCustomError for a text that cannot be one."""
    return _checked_name(value, Use.ANY)


def behavior_name(value: str) -> str:
    """Return a behavior's name; raise PydanticCustomError for a text that cannot be one."""
    return _checked_name(value, Use.BEHAVIOR)


def action_name(value: str) -> str:
    """Return an action's name; raise PydanticCustomError for a text that cannot be one."""
    return _checked_name(value, Use.ACTION)


def value_name(value: str) -> str:
    """Return a name that expressions use without brackets; raise PydanticCustomError for another text."""
    return _checked_name(value, Use.VALUE)


def signature(key: str) -> tuple[str, ...]:
    """Return the names of a definition and of its parameters; none where its key is not written as one."""
    match = SIGNATURE.fullmatch(key)
    if match is None:
        return ()
    parameters = match["parameters"].split(",") if match["parameters"] else []
    return (match["name"], *(name.strip() for name in parameters))


def definition_key(value: str) -> str:
    """Return a definition's key, a name or a name with parameters; raise PydanticCustomError for another text."""
    names = signature(value)
    if ELEMENT.fullmatch(value):
        return _checked_name(value, Use.VALUE)
    if not names or not all(map(NAME.match, names)):
        raise _bad_name(value, "cannot be a definition's name; write name or name(a, b), in small letters")
    own, *parameters = names
    _checked_name(own, Use.FUNCTION if parameters else Use.VALUE)
    for parameter in parameters:
        _checked_name(parameter, Use.VALUE)
        if names.count(parameter) > 1:
            raise _bad_name(
                value, f"has {parameter} twice; the parameters' names differ from it and from each other"
            )
    return value


def _checked_name(value: str, use: Use) -> str:
    if ELEMENT.fullmatch(value):
        list_name = value.partition("[")[0].strip()
        raise _bad_name(value, OF_ACTIONS, f"set the list as a whole, {list_name}: list(...)", "BB134")
    if not NAME.match(value):
        raise _bad_name(value, "cannot be a name; names are small letters, digits and _, a letter first")
    if value in RESERVED[use]:
        raise _bad_name(
            value,
            f"cannot be {use.value}: {RESERVED[use][value]}",
            f"write another one, such as {another_name(value)}",
        )
    return value


def _bad_name(value: str, reason: str, advice: str = "", code: str = "BB024") -> PydanticCustomError:
    context = {"name": value, "reason": reason, "advice": advice, "code": code}
    return PydanticCustomError("bad_name", '"{name}" {reason}', context)


def cell(value: object) -> str:
    """Return the label of a cell from its text, or from the number or truth that YAML read."""
    text = scalar_text(value)
    if text is None:
        raise PydanticCustomError(
            "not_a_cell", "a cell's name is needed here, not {what}", {"what": kind_of(value)}
        )
    return " ".join(text.split())


def _whole(value: object) -> object:
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _from_python(function: Any) -> Any:  # noqa: ANN401 - pydantic's own types
    return GetPydanticSchema(lambda _source, _handler: core_schema.no_info_plain_validator_function(function))


ExpressionText = Annotated[Expression, _from_python(expression)]
"""A number, a truth or a text that parses."""

TableText = Annotated[Any, BeforeValidator(nested)]
"""An expression, or a nested list of expressions."""

NameText = Annotated[str, AfterValidator(name)]
"""A name that no expression uses."""

BehaviorNameText = Annotated[str, AfterValidator(behavior_name)]
"""A behavior's name."""

ActionNameText = Annotated[str, AfterValidator(action_name)]
"""An action's name."""

ValueNameText = Annotated[str, AfterValidator(value_name)]
"""A name that expressions use without brackets."""

DefinitionText = Annotated[str, AfterValidator(definition_key)]
"""A definition's name, perhaps with parameters."""

CellText = Annotated[str, BeforeValidator(cell)]
"""A cell's label."""

Whole = Annotated[int, BeforeValidator(_whole)]
"""A whole number, also one that is written 300.0."""
