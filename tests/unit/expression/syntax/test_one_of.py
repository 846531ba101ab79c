import pytest

from bbsd.expression.syntax.mistakes import ExpressionError
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Comparison, Conditional, Name, OneOf, parts


def test_names_and_how_it_starts_are_read() -> None:
    tree = parse(" one of [ idle ,search,\n home ] ")
    assert isinstance(tree, OneOf)
    assert (tree.names, tree.start, tree.at_random) == (("idle", "search", "home"), None, False)
    drawn = parse("one of [on, off], starting at random")
    assert isinstance(drawn, OneOf)
    assert (drawn.names, drawn.start, drawn.at_random) == (("on", "off"), None, True)


def test_what_it_starts_with_stands_where_it_is_written() -> None:
    text = "one of [idle, search] starting search if robot == 0 else idle"
    tree = parse(text)
    assert isinstance(tree, OneOf)
    (start,) = parts(tree)
    assert isinstance(start, Conditional)
    condition = start.condition
    assert isinstance(condition, Comparison)
    assert text[condition.span.start :][: condition.span.length] == "robot == 0"


@pytest.mark.parametrize(
    "text",
    [
        "one of [idle, search]",
        "one of [idle, search] starting at random",
        "one of [idle, search] starting idle if a and b else search",
    ],
)
def test_its_text_reads_as_the_same(text: str) -> None:
    assert render(parse(text)) == text


@pytest.mark.parametrize(
    ("text", "message", "part"),
    [
        ("one of idle, search", "names in brackets come after one of", "one of idle, search"),
        ("one of [idle]", "a state is one of two values or more", "idle"),
        ("one of []", "a name is missing here", ""),
        ("one of [idle, , home]", "a name is missing here", ""),
        ("one of [idle, home, idle]", "idle is listed twice", "idle"),
        ("one of [idle, 2]", "values have names, and 2 is a number", "2"),
        ("one of [idle, 'home']", "values are written without quotes", "'home'"),
        ("one of [idle, team]", '"team" cannot be a value: after in it is all robots', "team"),
        ("one of [idle, Home]", '"Home" cannot be a value\'s name', "Home"),
        ("one of [idle, home] starting", "what it is at first is missing after starting", ""),
        ("one of [idle, home] starting home +", "this cannot be read as an expression", ""),
        ("one of [idle, home] from home", "names in brackets come after one of", ""),
    ],
)
def test_mistakes_are_told_where_they_are(text: str, message: str, part: str) -> None:
    with pytest.raises(ExpressionError) as caught:
        parse(text)
    mistake = caught.value.mistake
    assert mistake.message.startswith(message)
    if part:
        start = mistake.span.start
        assert text[start : start + mistake.span.length] == part


def test_a_mistake_in_what_it_starts_with_is_where_it_is_written() -> None:
    text = "one of [idle, home] starting home if x === 1 else idle"
    with pytest.raises(ExpressionError) as caught:
        parse(text)
    assert caught.value.mistake.span.start > text.index("starting")


def test_a_name_that_begins_so_is_a_name() -> None:
    assert isinstance(parse("one"), Name)
    assert isinstance(parse("one_of"), Name)
