"""Statements of programming languages where expressions stand, and expressions where cells do."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from pydantic_core import PydanticCustomError

from bbsd.errors import nearest
from bbsd.expression.foreign.tokens import reads
from bbsd.expression.mistaken.cells import draws_again
from bbsd.expression.syntax.mistakes import WHOLE, ExpressionError, Rewriting
from bbsd.expression.syntax.one_of import is_one_of
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.text import number_text, render
from bbsd.expression.syntax.tree import Call, Comparison, Expr, Logical, Name, Number, Span, Truth, Unary
from bbsd.language.field_types import expression, scalar_text
from bbsd.language.meaning.partitions import conditions_of_cells
from bbsd.language.meant.edits.layout import correction
from bbsd.language.meant.forms import named_blocks
from bbsd.text.nodes import Mapping

if TYPE_CHECKING:
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

IF = re.compile(r"(?P<word>if|elif|else if|else)\b\s*(?P<condition>.*)", re.DOTALL)
OPPOSITE = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "=="}


def if_statements(reading: Reading) -> None:
    """Read `if c: a` and `else: b` below a key as the conditional that they are."""
    for path in _places_of_expressions(reading):
        value = reading.at(path)
        if isinstance(value, dict) and value and all(IF.fullmatch(key) for key in value):
            text = _conditional(value)
            if text is not None:
                _tell_statement(reading, path, value, text)


def _places_of_expressions(reading: Reading) -> list[Path]:
    places = [(*path, key) for path in named_blocks(reading) for key in reading.mapping(path)]
    for name in [*reading.mapping(("behaviors",))]:
        actions: Path = ("behaviors", name, "actions")
        places += [
            (*actions, action, effect)
            for action in reading.mapping(actions)
            for effect in reading.mapping((*actions, action))
        ]
        places += [("behaviors", name, key) for key in ("excited", "expects")]
    return [*places, ("environment", "ends")]


def _conditional(statement: dict[str, Data]) -> str | None:
    """Return a statement as a conditional, with 0 for the cases that it leaves out; None where it is none."""
    text, otherwise = "", ""
    for key, value in statement.items():
        match, part = IF.fullmatch(key), scalar_text(value)
        if match is None or part is None or not reads(part):
            return None
        condition = match["condition"].strip().strip(":").strip()
        if match["word"] == "else":
            otherwise = part
        elif reads(condition):
            text += f"{part} if {condition} else "
        else:
            return None
    return f"{text}{otherwise or '0'}" if text else None


def _tell_statement(reading: Reading, path: Path, statement: dict[str, Data], text: str) -> None:
    document, node, key = reading.document(path), reading.node(path), reading.key(path)
    edits = None
    if key is not None and isinstance(node, Mapping) and not node.flow:
        end = [*node.entries.values()][-1].value.end
        edits = [document.source.edit(key.end, end, f": {text}")]
    first = next(iter(statement))
    is_certain = any(
        key.strip().startswith("else") and not key.strip().startswith("else if") for key in statement
    )
    message = f"{path[-1]} must be an expression, not a statement: a conditional is written x if ... else y"
    written = correction(document, edits, is_certain=is_certain)
    reading.tell((*path, first), "BB022", message, f"write {path[-1]}: {text}", written)
    reading.replace(path, text)


def conditions_as_expressions(reading: Reading) -> None:
    """Read `when: contact == true` as the mapping from inputs to cells that it should be."""
    for name in [*reading.mapping(("behaviors",))]:
        rules = reading.at(("behaviors", name, "rules"))
        for at in range(len(rules) if isinstance(rules, list) else 0):
            path: Path = ("behaviors", name, "rules", at, "when")
            text = reading.at(path)
            if not isinstance(text, str):
                continue
            cells = cells_asked(text, inputs_of(reading, name))
            message = "when is no expression but a mapping: for each input its cell"
            example = (
                "{" + ", ".join(f"{key}: {cell}" for key, cell in (cells or {"input": "cell"}).items()) + "}"
            )
            written = Rewriting(example, WHOLE) if cells else None
            reading.tell(path, "BB022", message, f"write when: {example}", written, WHOLE)
            if cells:
                reading.replace(path, {**cells})
            else:
                reading.remove((*path[:-2], at))
                reading.set(path[:-1], {"otherwise": "open"})


def inputs_of(reading: Reading, behavior: str) -> dict[str, Data]:
    """Return what a behavior's inputs are cut from, by their names."""
    inputs = reading.at(("behaviors", behavior, "inputs"))
    if isinstance(inputs, list):
        sensors = reading.mapping(("environment", "sensors"))
        return {str(name): sensors.get(str(name)) for name in inputs}
    return dict(inputs) if isinstance(inputs, dict) else {}


def cells_asked(text: str, inputs: dict[str, Data]) -> dict[str, str] | None:
    """Return the cells that a condition asks for, by input; None where it asks for something else."""
    try:
        tree = parse(re.sub(r"(?<![<>=!])=(?!=)", "==", text).replace("&&", " and "))
    except ExpressionError:
        return None
    cells: dict[str, str] = {}
    for part in tree.operands if isinstance(tree, Logical) and tree.operator == "and" else (tree,):
        found = _cell(part, inputs)
        if found is None or found[0] in cells:
            return None
        cells[found[0]] = found[1]
    return cells


def _cell(part: Expr, inputs: dict[str, Data]) -> tuple[str, str] | None:
    match part:
        case Name(name=name) if name in inputs:
            return name, "true"
        case Unary(operator="not", operand=Name(name=name)) if name in inputs:
            return name, "false"
        case Comparison(operators=("==",), operands=(Name(name=name), Truth(value=value))) if name in inputs:
            return name, str(value).lower()
        case Comparison(operators=("==",), operands=(Name(name=name), Name(name=cell))) if name in inputs:
            return name, cell
        case Comparison(operators=("==",), operands=(Name(name=name), Number(value=value))) if name in inputs:
            return name, number_text(value)
        case Comparison(operators=(operator,), operands=(left, Number(value=value))):
            cut = _input_of(left, inputs)
            return None if cut is None else _side(cut, operator, number_text(value))
    return None


def _input_of(number: Expr, inputs: dict[str, Data]) -> str | None:
    """Return the input that a number is, or that is cut from it."""
    if isinstance(number, Name) and number.name in inputs:
        return number.name
    for name, partition in inputs.items():
        try:
            tree = parse(partition) if isinstance(partition, str) else None
        except ExpressionError:
            continue
        if isinstance(tree, Call) and tree.function == "cut" and render(tree.arguments[0]) == render(number):
            return name
    return None


def _side(name: str, operator: str, bound: str) -> tuple[str, str] | None:
    if operator == "<":
        return name, f"below {bound}"
    return (name, f"from {bound}") if operator == ">=" else None


COMPARED = re.compile(
    r"""(?P<name>[a-z]\w*)\s*(?P<operator>==|!=)\s*(?P<quote>['"])(?P<text>[^'"]*)(?P=quote)"""
)


def cells_as_texts(reading: Reading) -> None:
    """Read `zone == 'below 0.2'` as the condition that makes that cell."""
    for path in _places_of_expressions(reading):
        text = reading.at(path)
        match = COMPARED.search(text) if isinstance(text, str) else None
        if not isinstance(text, str) or match is None:
            continue
        condition = _condition(reading, path, match["name"], match["text"])
        if condition is None:
            continue
        new = condition if match["operator"] == "==" else f"not ({condition})"
        if " and " in new or new.startswith("not "):
            new = f"({new})"
        span = Span(match.start(), match.end() - match.start())
        message = f'there is no text in expressions, and "{match["text"]}" is a cell of {match["name"]}'
        reading.tell(
            path,
            "BB051",
            message,
            f"write the condition that makes the cell: {new}",
            Rewriting(new, span, is_certain=not draws_again(new)),
            span,
        )
        reading.replace(path, text[: match.start()] + new + text[match.end() :])


QUOTED = re.compile(r"""(?P<quote>['"])(?P<name>[a-z]\w*)(?P=quote)""")


def values_in_quotes(reading: Reading) -> None:
    """Read `mode == 'clean'` without the quotes, where that is a name that the spec knows."""
    known = _names_of_values(reading)
    for path in _places_of_expressions(reading):
        text = reading.at(path)
        found = [*QUOTED.finditer(text)] if isinstance(text, str) else []
        meant = {match["name"]: nearest(match["name"], sorted(known)) for match in found}
        if not isinstance(text, str) or not all(meant.values()):
            continue
        new = text
        for name, right in meant.items():
            new = re.sub(rf"(['\"]){name}\1", right, new)
        if not found or not reads(new):
            continue
        start, end = found[0].start(), found[-1].end()
        written = new[start : len(new) - (len(text) - end)]
        span = Span(start, end - start)
        message = "there is no text in expressions: names of values stand without quotes"
        wrong = next((name for name in meant if name not in known), "")
        if wrong:
            message += f", and {wrong} is none: did you mean {meant[wrong]}?"
        advice = f"write {meant[found[0]['name']]}"
        code = "BB136" if is_one_of(text) else "BB051"
        reading.tell(path, code, message, advice, Rewriting(written, span, not wrong), span)
        reading.replace(path, new)


def _names_of_values(reading: Reading) -> set[str]:
    """Return the names that states and world can have as values."""
    found: set[str] = set()
    for block in ("state", "world"):
        for text in reading.mapping(("environment", block)).values():
            if isinstance(text, str) and is_one_of(text):
                found |= {*re.findall(r"\w+", text.partition("]")[0].partition("[")[2])}
    return found


def _condition(reading: Reading, path: Path, name: str, label: str) -> str | None:
    """Return what holds in a cell of an input or a sensor."""
    partition = reading.mapping(("environment", "sensors")).get(name)
    if partition is None and path[0] == "behaviors":
        partition = reading.mapping((*path[:2], "inputs")).get(name)
    try:
        if isinstance(partition, dict):
            cells = conditions_of_cells({str(key): expression(value) for key, value in partition.items()})
        else:
            cells = conditions_of_cells(expression(partition))
    except PydanticCustomError:
        return None
    return cells.get(label)
