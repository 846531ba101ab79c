"""Text to tree: the part of Python's expressions that the language allows, read with `ast`, never run."""

from __future__ import annotations

import ast
import math
import re
import warnings

from bbsd.errors import character_name
from bbsd.expression.reserved import RESERVED, Use
from bbsd.expression.syntax.mistakes import ExpressionError, Mistake
from bbsd.expression.syntax.one_of import is_one_of, read_one_of
from bbsd.expression.syntax.tree import (
    Binary,
    Call,
    Comparison,
    Conditional,
    Expr,
    Generator,
    Index,
    Logical,
    Name,
    Number,
    Span,
    Truth,
    Unary,
)
from bbsd.expression.syntax.unreadable import EQUALITY, find_culprit

MAX_LENGTH = 4000
MAX_DEPTH = 40
MAX_COMPARED = 6
"""Items of a list with which an advice compares one by one."""

NAME = re.compile(r"[a-z][a-z0-9_]*\Z")
MEANINGLESS = re.compile(r"#|[^\n\t -~]")

UNARY: dict[type[ast.unaryop], str] = {ast.USub: "-", ast.UAdd: "+", ast.Not: "not"}
BINARY: dict[type[ast.operator], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.FloorDiv: "//",
    ast.Mod: "%",
    ast.Pow: "**",
}
COMPARE: dict[type[ast.cmpop], str] = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}
REFUSED: dict[type[ast.AST], str] = {
    ast.Attribute: "attributes (a.b)",
    ast.Lambda: "lambda",
    ast.List: "lists in brackets; write a list as a constant, or list(...)",
    ast.ListComp: "comprehensions in brackets; write list(... for ...)",
    ast.Tuple: "tuples; two expressions joined by a comma",
    ast.Dict: "braces",
    ast.Set: "braces",
    ast.SetComp: "braces",
    ast.DictComp: "braces",
    ast.Slice: "slices",
    ast.Starred: "the star",
    ast.NamedExpr: "assignment (:=)",
    ast.JoinedStr: "text",
    ast.Await: "await",
    ast.Yield: "yield",
    ast.YieldFrom: "yield",
}


WRITTEN: dict[type[ast.operator | ast.unaryop], str] = {
    ast.BitAnd: "&",
    ast.BitOr: "|",
    ast.BitXor: "^",
    ast.LShift: "<<",
    ast.RShift: ">>",
    ast.MatMult: "@",
    ast.Invert: "~",
}
INSTEAD = {"&": "write and", "|": "write or", "~": "write not", "^": "a power is written **"}


def parse(text: str) -> Expr:
    """Return the tree of an expression; spans count characters of `text`.

    Raises ExpressionError for the first part that is not in the grammar.
    """
    if len(text) > MAX_LENGTH:
        raise _error(
            "BB060", f"an expression of {len(text)} characters; at most {MAX_LENGTH} are allowed", 0, 1
        )
    if not text.strip():
        raise _error("BB050", "an expression is missing here", 0, 1)
    if match := MEANINGLESS.search(text):
        what = repr(match[0]) if match[0].isascii() and match[0].isprintable() else character_name(match[0])
        raise _error("BB050", f"the character {what} has no meaning in an expression", match.start(), 1)
    if is_one_of(text):
        return read_one_of(text, parse)
    flat = re.sub(r"[\n\t]", " ", text)
    stripped = flat.lstrip(" ")
    shift = len(flat) - len(stripped)
    return _Builder(stripped, shift)(_python(stripped, shift), 0)


def _python(text: str, shift: int) -> ast.expr:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what Python would warn of (1if x) is legal, if ugly
            return ast.parse(text, mode="eval").body
    except SyntaxError as error:
        raise _syntax_error(text, shift, error) from None
    except (MemoryError, RecursionError, ValueError):
        raise _error("BB060", "this expression is nested too deeply", shift, 1) from None


def _syntax_error(text: str, shift: int, error: SyntaxError) -> ExpressionError:
    failed_at = min(max((error.offset or 1) - 1, 0), max(len(text) - 1, 0))
    start, length, advice = find_culprit(text, failed_at)
    what = text[start : start + 12].strip()
    message = "this cannot be read as an expression" + (f" from {what!r} on" if start and what else "")
    return _error("BB050", message, shift + start, length or len(what), advice)


def _error(code: str, message: str, start: int, length: int, advice: str = "") -> ExpressionError:
    return ExpressionError(Mistake(code, message, Span(start, max(length, 1)), advice))


def _instead_of_in(node: ast.expr) -> str:
    """Return the advice to compare with each item of a list of names or numbers."""
    match node:
        case ast.Compare(
            left=ast.Name(id=name), ops=[ast.In()], comparators=[ast.List(elts) | ast.Tuple(elts)]
        ):
            items = [ast.unparse(item) for item in elts if isinstance(item, ast.Name | ast.Constant)]
            if 0 < len(items) == len(elts) <= MAX_COMPARED:
                return f"write {' or '.join(f'{name} == {item}' for item in items)}"
    return "compare with == or !="


def _is_free(name: str) -> bool:
    return NAME.match(name) is not None and name not in RESERVED[Use.VALUE]


class _Builder:
    """Turns those nodes of Python's tree that the language allows into its own."""

    def __init__(self, text: str, shift: int) -> None:
        self.text = text
        self.shift = shift

    def span(self, node: ast.expr) -> Span:
        end = node.end_col_offset if node.end_col_offset is not None else node.col_offset + 1
        return Span(self.shift + node.col_offset, end - node.col_offset)

    def refuse(self, node: ast.expr, code: str, message: str, advice: str = "") -> ExpressionError:
        return ExpressionError(Mistake(code, message, self.span(node), advice))

    def __call__(self, node: ast.expr, depth: int) -> Expr:
        if depth > MAX_DEPTH:
            advice = "name a part of it as a definition"
            raise self.refuse(node, "BB060", f"nested more than {MAX_DEPTH} deep", advice)
        span, deeper = self.span(node), depth + 1
        match node:
            case ast.Constant(value=value):
                return self.constant(node, value)
            case ast.Name(id=name):
                return self.name(node, name)
            case ast.UnaryOp(op=operator, operand=operand) if type(operator) in UNARY:
                return Unary(UNARY[type(operator)], self(operand, deeper), span)
            case ast.BinOp(left=left, op=operator, right=right) if type(operator) in BINARY:
                return Binary(BINARY[type(operator)], self(left, deeper), self(right, deeper), span)
            case ast.Compare(left=left, ops=operators, comparators=rest):
                symbols = tuple(self.comparison(node, operator) for operator in operators)
                return Comparison(symbols, tuple(self(part, deeper) for part in (left, *rest)), span)
            case ast.BoolOp(op=operator, values=values):
                symbol = "and" if isinstance(operator, ast.And) else "or"
                return Logical(symbol, tuple(self(part, deeper) for part in values), span)
            case ast.IfExp(test=test, body=then, orelse=otherwise):
                return Conditional(self(test, deeper), self(then, deeper), self(otherwise, deeper), span)
            case ast.Call():
                return self.call(node, deeper)
            case ast.Subscript(value=of, slice=index):
                return Index(self(of, deeper), self(index, deeper), span)
            case _:
                raise self.refusal(node)

    def refusal(self, node: ast.expr) -> ExpressionError:
        if isinstance(node, ast.GeneratorExp):
            return self.refuse(node, "BB062", "a generator can only be the one argument of an aggregate")
        if isinstance(node, ast.BinOp | ast.UnaryOp):
            symbol = WRITTEN.get(type(node.op), "")
            message, advice = f"the language does not have the operator {symbol}", INSTEAD.get(symbol, "")
            return _error("BB051", message, self.shift + self.sign(node, symbol), len(symbol), advice)
        return self.refuse(node, "BB051", f"the language does not have {REFUSED.get(type(node), 'this')}")

    def sign(self, node: ast.BinOp | ast.UnaryOp, symbol: str) -> int:
        """Return the position of an operator's sign in the text."""
        left_end = node.left.end_col_offset if isinstance(node, ast.BinOp) else node.col_offset
        return self.text.index(symbol, left_end)

    def call(self, node: ast.Call, depth: int) -> Call:
        if not isinstance(node.func, ast.Name) or node.keywords:
            advice = EQUALITY if node.keywords else ""
            raise self.refuse(node, "BB051", "only functions can be called, with plain arguments", advice)
        return Call(node.func.id, tuple(self.argument(part, depth) for part in node.args), self.span(node))

    def constant(self, node: ast.expr, value: object) -> Expr:
        if isinstance(value, bool):
            advice = f"write {str(value).lower()}"
            raise self.refuse(node, "BB051", f"the language does not have {value}", advice)
        if not isinstance(value, int | float):
            what = "text" if isinstance(value, str | bytes) else repr(value)
            advice = "begin with a number or a truth, such as 0 or -1" if value is None else ""
            raise self.refuse(node, "BB051", f"the language does not have {what} here", advice)
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            raise self.refuse(node, "BB051", "this number is too large for binary64")
        if isinstance(value, int) and int(number) != value:
            advice = f"write {int(number)} if that is near enough"
            raise self.refuse(node, "BB125", "a whole number is kept exactly only up to 2 ** 53", advice)
        return Number(number, self.span(node))

    def name(self, node: ast.expr, name: str) -> Expr:
        if name in ("true", "false"):
            return Truth(name == "true", self.span(node))
        if not NAME.match(name):
            message = f'"{name}" cannot be a name; names are small letters, digits and _'
            raise self.refuse(node, "BB051", message)
        return Name(name, self.span(node))

    def comparison(self, node: ast.expr, operator: ast.cmpop) -> str:
        if type(operator) not in COMPARE:
            raise self.refuse(node, "BB051", "the language does not have in and is", _instead_of_in(node))
        return COMPARE[type(operator)]

    def argument(self, node: ast.expr, depth: int) -> Expr:
        if not isinstance(node, ast.GeneratorExp):
            return self(node, depth)
        (first, *more) = node.generators
        if more or first.ifs or first.is_async:
            raise self.refuse(node, "BB062", "one for, without if", "use a conditional: x if ... else ...")
        targets = first.target.elts if isinstance(first.target, ast.Tuple) else [first.target]
        names = tuple(target.id for target in targets if isinstance(target, ast.Name) and _is_free(target.id))
        if len(names) != len(targets) or len(set(names)) != len(names):
            raise self.refuse(first.target, "BB062", "after for stand different names, like x or x, y")
        return Generator(self(node.elt, depth + 1), names, self(first.iter, depth + 1), self.span(node))
