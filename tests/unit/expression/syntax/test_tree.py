import sys

import pytest

from bbsd.expression.elaboration import elaboration
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.tree import functions_called, names_used, parts, stack_depth
from tests.unit.expression.scopes import scope


def test_parts_are_in_the_order_of_the_text() -> None:
    for text in ("a + b", "a if b else c", "f(a, b, c)", "a[b]", "a < b <= c", "a and b"):
        starts = [part.span.start for part in parts(parse(text))]
        assert starts == sorted(starts)


def test_names_used_are_those_that_are_not_bound() -> None:
    assert names_used(parse("sum(v * w + x for v, w in table) + v")) == {"x", "table", "v"}
    assert names_used(parse("f(a)[b] if c else d")) == {"a", "b", "c", "d"}
    assert names_used(parse("a + b"), frozenset({"a"})) == {"b"}


def test_functions_called_are_those_with_brackets() -> None:
    assert functions_called(parse("sum(floor(v) + floor for v in range(3))[g(1)]")) == {
        "sum",
        "floor",
        "range",
        "g",
    }


@pytest.mark.parametrize(
    "text",
    ["-" * 40 + "x", "1 + (" * 38 + "x" + ")" * 38, "sin(" * 38 + "x" + ")" * 38, "max(1, " * 38 + "x" + ")" * 38,
     "ok and (" * 38 + "ok" + ")" * 38, "x if ok else (" * 38 + "x" + ")" * 38,
     "sum(x for r in list(" * 12 + "1" + "))" * 12, "twice(" * 38 + "x" + ")" * 38, "table[0][" * 19 + "0" + "]" * 19,
     "sum(1 for r in range(" * 12 + "3" + "))" * 12],
)  # fmt: skip
def test_no_expression_takes_more_frames_than_it_is_said_to(text: str) -> None:
    tree, here = parse(text), scope()
    used = len(_stack())
    limit = sys.getrecursionlimit()
    try:
        # 30 frames for what any expression needs: the entry, the parts' checks, the graph's own functions.
        sys.setrecursionlimit(used + stack_depth(tree) + 30)
        elaboration.value(tree, here)
    finally:
        sys.setrecursionlimit(limit)
    assert not here.findings.mistakes


def _stack() -> list[object]:
    frame, found = sys._getframe(), []
    while frame:
        found.append(frame)
        frame = frame.f_back
    return found
