"""Values as a designer writes them: expressions, names and cells, checked as pydantic reads them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, GetPydanticSchema
from pydantic_core import PydanticCustomError, core_schema

from bbsd.expression.mistakes import ExpressionError
from bbsd.expression.parsing import NAME, parse
from bbsd.expression.text import number_text
from bbsd.expression.tree import Expr
from bbsd.expression.vocabulary import RESERVED


@dataclass(frozen=True, slots=True)
class Expression:
    """An expression as written, and its tree. Equal when the text is."""

    text: str
    tree: Expr

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Expression) and self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)


def expression(value: object) -> Expression:
    """Read a scalar of a spec as an expression; mistakes carry their code and span to the diagnosis."""
    if isinstance(value, Expression):
        return value
    text = scalar_text(value)
    if text is None:
        raise PydanticCustomError("not_an_expression", "an expression is needed here, not {what}", {"what": kind_of(value)})
    try:
        return Expression(text, parse(text))
    except ExpressionError as error:
        raise PydanticCustomError("expression", "{message}", {"message": str(error), "mistake": error.mistake}) from None


def scalar_text(value: object) -> str | None:
    """The text of a YAML scalar as an expression or a cell would write it; None for anything else."""
    match value:
        case str():
            return value
        case bool():
            return "true" if value else "false"
        case int() | float():
            return number_text(value)
    return None


def kind_of(value: object) -> str:
    """What a plain value is, in the words of a message."""
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
    return "a number"


def name(value: str) -> str:
    """A name of the spec's own."""
    if value in RESERVED:
        raise PydanticCustomError("reserved_name", '"{name}" is a word of the language and cannot be a name', {"name": value})
    if not NAME.match(value):
        raise PydanticCustomError(
            "bad_name", '"{name}" cannot be a name; names are small letters, digits and _, a letter first', {"name": value}
        )
    return value


def cell(value: object) -> str:
    """The label of a cell, as written or as YAML made of it."""
    text = scalar_text(value)
    if text is None:
        raise PydanticCustomError("not_a_cell", "a cell's name is needed here, not {what}", {"what": kind_of(value)})
    return " ".join(text.split())


def _from_python(function: Any) -> Any:  # noqa: ANN401 - pydantic's own types
    return GetPydanticSchema(lambda _source, _handler: core_schema.no_info_plain_validator_function(function))


ExpressionText = Annotated[Expression, _from_python(expression)]
"""A number, a truth or a text that parses."""

NameText = Annotated[str, AfterValidator(name)]
"""A name that is not a word of the language."""

CellText = Annotated[str, BeforeValidator(cell)]
"""A cell's label."""
