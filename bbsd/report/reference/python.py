"""The parts of the Python reference that are generated: signatures, arguments, errors, and the fields of results.

`docs/api.md` holds them between marks; a test compares them, and updates them with --update-golden.
"""

from __future__ import annotations

import ast
import inspect
import re
from dataclasses import dataclass
from textwrap import dedent
from typing import TYPE_CHECKING, Any

from bbsd import api

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

WIDTH = 100
"""Letters of a line of a signature, at most."""

MARKED = re.compile(r"(<!-- generated: ([\w.]+) -->\n).*?(<!-- end -->)", re.DOTALL)
SECTION = re.compile(r"^(Args|Returns|Yields|Raises):\n", re.MULTILINE)
ENTRY = re.compile(r"^(?P<names>\w+(?:, \w+)*): (?P<text>.*(?:\n +.*)*)", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Documented:
    """A docstring, taken apart."""

    text: str
    """What stands before its sections."""
    arguments: dict[str, str]
    returned: str
    errors: dict[str, str]
    """By the names of the errors, as they are written."""


def regenerate(document: str) -> str:
    """Return a document with the text between its marks generated again.

    A mark names a verb, a method as `Agent.act`, or what a verb returns; AttributeError for any other.
    """
    return MARKED.sub(lambda match: f"{match[1]}\n{part_text(match[2])}\n{match[3]}", document)


def part_text(name: str) -> str:
    """Return what is generated of a function, of a class that is made by its name, or of a result."""
    found: Any = api
    for part in name.split("."):
        found = getattr(found, part)
    if not inspect.isclass(found):
        return function_text(name, found)
    return function_text(name, found.__init__, found) if name == "Agent" else fields_text(found)


def function_text(name: str, function: Callable[..., Any], made: type[Any] | None = None) -> str:
    """Return the signature of a function with what its docstring says; of a class, with what that says before."""
    found = documented(function)
    parts = [f"```python\n{signature_text(name, function, made)}\n```\n"]
    parts += [f"{inspect.getdoc(made)}\n"] if made else [f"{found.text}\n"]
    if found.arguments:
        rows = "".join(f"| `{argument}` | {_cell(text)} |\n" for argument, text in found.arguments.items())
        parts.append(f"| argument | meaning |\n| --- | --- |\n{rows}")
    if found.returned:
        parts.append(f"It returns {_uncapitalized(found.returned)}\n")
    if found.errors:
        rows = "".join(f"| {_codes(names)} | {_cell(text)} |\n" for names, text in found.errors.items())
        parts.append(f"| error | when |\n| --- | --- |\n{rows}")
    return "\n".join(parts)


def signature_text(name: str, function: Callable[..., Any], made: type[Any] | None = None) -> str:
    """Return how a function is called, in one line or, where that is too long, a line for each argument."""
    signature = inspect.signature(function)
    parameters = [each for each in signature.parameters.values() if each.name not in ("self", "cls")]
    returned = f" -> {name if made else _annotation(signature.return_annotation)}"
    texts = list(_parameters(parameters))
    line = f"{name}({', '.join(texts)}){returned}"
    if len(line) <= WIDTH:
        return line
    return f"{name}(\n" + "".join(f"    {text},\n" for text in texts) + f"){returned}"


def fields_text(result: type[Any]) -> str:
    """Return a class's docstring, and a table of its public fields, properties and methods."""
    rows = "".join(
        f"| `{name}` | {f'`{_cell(kind)}`' if kind else ''} | {_cell(text)} |\n"
        for name, kind, text in _members(result)
    )
    table = f"| name | type | meaning |\n| --- | --- | --- |\n{rows}" if rows else ""
    return "\n".join(part for part in (f"{inspect.getdoc(result)}\n", table) if part)


def documented(function: Callable[..., Any]) -> Documented:
    """Take the docstring of a function apart."""
    text, *sections = SECTION.split(inspect.getdoc(function) or "")
    bodies = {name: dedent(body) for name, body in zip(sections[::2], sections[1::2], strict=True)}
    returned = bodies.get("Returns") or bodies.get("Yields") or ""
    return Documented(
        text.strip(), _entries(bodies.get("Args", "")), _joined(returned), _entries(bodies.get("Raises", ""))
    )


def _entries(body: str) -> dict[str, str]:
    return {found["names"]: _sentence(found["text"]) for found in ENTRY.finditer(body)}


def _parameters(parameters: list[inspect.Parameter]) -> Iterator[str]:
    """Yield parameters as they are written, with a * before those that are named only."""
    for previous, each in zip([None, *parameters], parameters, strict=False):
        begins = each.kind is each.KEYWORD_ONLY and (
            previous is None or previous.kind is not each.KEYWORD_ONLY
        )
        if begins and (previous is None or previous.kind is not each.VAR_POSITIONAL):
            yield "*"
        star = "*" if each.kind is each.VAR_POSITIONAL else ""
        yield f"{star}{each.name}: {_annotation(each.annotation)}{_default(each.default)}"


def _default(value: object) -> str:
    if value is inspect.Parameter.empty:
        return ""
    return f' = "{value}"' if isinstance(value, str) else f" = {value!r}"


def _annotation(annotation: object) -> str:
    """Return a type as it is written in the source."""
    return annotation if isinstance(annotation, str) else getattr(annotation, "__name__", str(annotation))


def _members(result: type[Any]) -> Iterator[tuple[str, str, str]]:
    """Yield the name, type and meaning of each public field, property and method, in the order of the source."""
    (definition,) = ast.parse(dedent(inspect.getsource(result))).body
    body = definition.body if isinstance(definition, ast.ClassDef) else []
    for node, following in zip(body, [*body[1:], None], strict=True):
        match node:
            case ast.AnnAssign(target=ast.Name(id=name)) if not name.startswith("_"):
                yield name, ast.unparse(node.annotation), _text_of(following)
            case ast.FunctionDef(name=name) if not name.startswith("_"):
                text, *_ = (ast.get_docstring(node) or "").split("\n\n")
                if any(isinstance(each, ast.Name) and each.id == "property" for each in node.decorator_list):
                    yield name, ast.unparse(node.returns) if node.returns else "", _joined(text)
                else:
                    yield f"{name}()", "", _joined(text)


def _text_of(node: ast.stmt | None) -> str:
    """Return the text that stands as a statement below a field, its first paragraph, or nothing."""
    match node:
        case ast.Expr(value=ast.Constant(value=str() as text)):
            return _joined(inspect.cleandoc(text))
    return ""


def _codes(names: str) -> str:
    return ", ".join(f"`{name}`" for name in names.split(", "))


def _joined(text: str) -> str:
    return " ".join(text.split())


def _sentence(text: str) -> str:
    joined = _joined(text)
    return joined[:1].upper() + joined[1:]


def _uncapitalized(text: str) -> str:
    return text[:1].lower() + text[1:]


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
