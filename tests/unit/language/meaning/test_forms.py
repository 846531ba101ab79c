from bbsd.expression.graph import Graph
from bbsd.expression.kinds import Kind
from bbsd.language.meaning.forms import Form, form_of
from tests.unit.language.specs import codes, meaning_of

GRAPH = Graph()
ZERO, TRUE = GRAPH.number(0), GRAPH.truth(value=True)


def test_forms_have_a_kind_and_the_lengths_from_the_outermost_list_on():
    assert form_of(TRUE) == Form(Kind.TRUTH)
    assert form_of(((ZERO, ZERO), (ZERO, ZERO), (ZERO, ZERO))) == Form(Kind.NUMBER, (3, 2))
    assert form_of((ZERO, TRUE)) is None
    assert form_of(((ZERO,), (ZERO, ZERO))) is None
    assert form_of((ZERO, (ZERO,))) is None
    assert form_of(()) is None


def test_forms_are_told_in_words():
    assert Form(Kind.NUMBER).text == "a number"
    assert Form(Kind.NUMBER, (1,)).text == "a list of 1 number"
    assert Form(Kind.TRUTH, (9, 4)).text == "a list of 9 lists of 4 truths"
    assert Form(Kind.TRUTH, (9, 4)).example == "list(list(false for j in range(4)) for i in range(9))"


def test_starting_lists_have_a_form():
    for start in ("list()", "list(1, 2 > 1)", "list(list(1), list(1, 2))", "list(1, list(2))"):
        found = codes(f"environment: {{state: {{w: '{start}'}}}}")
        assert found in (["BB133"], ["BB056"]), start


def test_lengths_are_the_same_for_all_robots_and_known():
    assert codes("environment: {state: {w: list(0 for k in range(robot + 1))}}") == ["BB127"]
    assert codes("environment: {state: {w: 'list(0 for k in range(integers(1, 3)))'}}") == ["BB064"]


def test_what_could_not_be_understood_is_told_once():
    part = "environment: {state: {w: 'list(hight, 1)'}, dynamics: {w: 'list(w[1], w[0])'}}"
    assert codes(part) == ["BB052"]


def test_each_element_of_each_robot_draws_its_own_start():
    start = meaning_of("environment: {state: {w: 'list(uniform(0, 1) for k in range(4))'}}").episode.start
    words = {node.draw.word for slot, node in start.items() if slot.name == "w"}
    assert len(words) == 3 * 4
