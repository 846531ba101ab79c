import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.compiler.writing.blocks import Block, Blocks
from bbsd.compiler.writing.emission import Emitter, usage_of
from bbsd.compiler.writing.looping import Loops
from bbsd.compiler.writing.naming import Namer
from bbsd.compiler.writing.precedence import Text, name_text
from bbsd.expression.graph import Graph, Level, evaluate
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.kernel import functions
from tests.unit.problems import episode_of, problem_of

VALUES = {"a": 1.5, "b": -2.25, "c": 0.0}
NUMBERS = ("+", "-", "*", "minimum", "divide", "floor_divide", "modulo")


def emitter(outputs, hints=None):
    """An emitter of one loop over lanes, in which nothing crosses to another one."""
    blocks = Blocks(Block(Level.CALL), looped=False)
    loops, texts = Loops(function=None), (Text("key"), Text("step"))
    usage = usage_of(outputs)
    return Emitter(
        Namer(), loops, lambda node: name_text(node.slot.name), *texts, hints or {}, blocks, set(), usage
    )


def slot(graph, name, level=Level.LANE):
    return graph.leaf("slot", Slot(name), Kind.NUMBER, level)


def written(outputs, hints=None):
    """The lines and the final expressions that some values become."""
    made = emitter(outputs, hints)
    texts = [made.text(node, made.blocks.stage(0)).source for node in outputs]
    return [line for lines in lines_of(made) for line in lines], texts


def lines_of(made):
    """The lines once a call, once a step, once a lane."""
    return made.blocks.call.lines, made.blocks.step.lines, made.blocks.stage(0).lines


def run(outputs):
    lines, texts = written(outputs)
    scope = {**vars(functions), **VALUES, "np": np}
    exec("\n".join(lines), scope)
    return [eval(text, scope) for text in texts]


def same(first, second):
    return first == second or (math.isnan(first) and math.isnan(second))


@st.composite
def values(draw):
    """Some values of a graph, with much in common."""
    graph = Graph()
    numbers = [
        slot(graph, name, level)
        for name, level in zip(VALUES, (Level.LANE, Level.STEP, Level.CALL), strict=True)
    ]
    numbers += [graph.number(value) for value in (-3.0, 0.5, -0.0)]
    truths = [graph.truth(value=True)]
    for _ in range(draw(st.integers(1, 30))):
        operation = draw(st.sampled_from([*NUMBERS, "negate", "select", "<", "&", "not"]))
        number = st.sampled_from(numbers)
        truth = st.sampled_from(truths)
        if operation == "negate":
            numbers.append(graph.apply(operation, draw(number)))
        elif operation == "select":
            numbers.append(graph.apply(operation, draw(truth), draw(number), draw(number)))
        elif operation == "<":
            truths.append(graph.apply(operation, draw(number), draw(number)))
        elif operation == "&":
            truths.append(graph.apply(draw(st.sampled_from("&|")), draw(truth), draw(truth)))
        elif operation == "not":
            truths.append(graph.apply(operation, draw(truth)))
        else:
            numbers.append(graph.apply(operation, draw(number), draw(number)))
    return [*numbers[-3:], *truths[-2:]]


@given(values())
def test_source_means_what_the_graph_means(outputs):
    expected = evaluate(outputs, lambda node, _: VALUES[node.slot.name])
    assert all(map(same, run(outputs), expected))


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda g, a, b: g.apply("-", a, g.apply("-", b, a)), "a - (b - a)"),
        (lambda g, a, b: g.apply("-", g.apply("-", a, b), a), "a - b - a"),
        (lambda g, a, b: g.apply("*", g.apply("+", a, b), a), "(a + b) * a"),
        (lambda g, a, b: g.apply("-", a, g.number(-1)), "a - -1.0"),
        (lambda g, a, b: g.apply("negate", g.apply("*", a, b)), "-(a * b)"),
        (lambda g, a, b: g.apply("not", g.apply("<", a, b)), "not a < b"),
        (lambda g, a, b: g.apply("+", a, g.number(math.inf)), "a + np.inf"),
        (lambda g, a, b: g.apply("*", a, g.number(-math.inf)), "a * -np.inf"),
        (lambda g, a, b: g.apply("+", a, g.number(math.nan)), "a + np.nan"),
        (lambda g, a, b: g.apply("&", g.apply("<", a, b), g.apply("<", b, a)), "(a < b) & (b < a)"),
    ],
)  # fmt: skip
def test_only_needed_parentheses_are_written(make, text):
    graph = Graph()
    assert written([make(graph, slot(graph, "a"), slot(graph, "b"))]) == ([], [text])


def test_what_is_used_twice_is_computed_once():
    graph = Graph()
    both = graph.apply("+", slot(graph, "a"), slot(graph, "b"))
    assert written([graph.apply("*", both, both)]) == (["part_1 = a + b"], ["part_1 * part_1"])


def test_a_value_is_called_as_the_designer_calls_it():
    graph = Graph()
    both = graph.apply("+", slot(graph, "a"), slot(graph, "b"))
    lines, texts = written([graph.apply("*", both, slot(graph, "a"))], {both.number: "reach"})
    assert (lines, texts) == (["reach = a + b"], ["reach * a"])


def test_a_value_is_computed_where_it_changes():
    graph = Graph()
    fixed = graph.apply("*", slot(graph, "a", Level.CALL), graph.number(2))
    now = graph.apply("-", slot(graph, "b", Level.STEP), graph.number(1))
    value = graph.apply("+", graph.apply("+", fixed, now), slot(graph, "c"))
    made = emitter([value])
    assert made.text(value, made.blocks.stage(0)).source == "now_1 + c"
    assert lines_of(made) == (["fixed_1 = a * 2.0"], ["now_1 = fixed_1 + (b - 1.0)"], [])


def test_draws_are_named_by_their_word_and_the_step_once_for_all_lanes():
    graph = Graph()
    value = graph.draw("uniform", 255, (graph.number(0), slot(graph, "a")))
    made = emitter([value])
    assert made.text(value, made.blocks.stage(0)).source == "uniform(key, draw_1, 0.0, a)"
    assert made.blocks.step.lines == ["draw_1 = fold(0x80000000000000ff, word_of(step))"]
    assert made.used == {"uniform", "fold", "word_of"}


def test_long_expressions_are_broken_up():
    graph = Graph()
    value = slot(graph, "a")
    for number in range(60):
        value = graph.apply("+", graph.apply("*", value, slot(graph, "b")), graph.number(number))
    lines, [text] = written([value])
    assert max(map(len, [*lines, text])) < 120
    assert run([value]) == evaluate([value], lambda node, _: VALUES[node.slot.name])


@pytest.mark.parametrize("depth", [49, 50, 51, 99, 100, 101, 5000])
def test_values_may_be_any_number_of_operations_deep(depth):
    graph = Graph()
    value = slot(graph, "a")
    for _ in range(depth):
        value = graph.apply("negate", value)
    assert run([value, graph.apply("abs", value)]) == [1.5 * (-1) ** depth, 1.5]


def test_hundreds_of_actions_may_set_the_same_state():
    many = ", ".join(f"do_{action}: {{x: x + {action}}}" for action in range(1, 201))
    behaviors = "\n".join(f"  b_{behavior}: {{actions: {{{many}}}}}" for behavior in range(4))
    text = f"bbsd: 1\nname: many\nenvironment: {{steps: 1, state: {{x: 0}}}}\nbehaviors:\n{behaviors}\nreward: {{x: x}}"
    assert episode_of(problem_of(text), [[200], [0], [150], [0]], [0, 1, 2, 3]).returns == 150


def test_a_sum_may_have_a_thousand_elements():
    text = """
    bbsd: 1
    name: long
    environment: {steps: 1, state: {x: 0}, dynamics: {x: "sum(k + x for k in range(1000))"}}
    behaviors: {b: {actions: {a: {x: 1}}}}
    reward: {x: x}
    """
    assert episode_of(problem_of(text), [[1]], [0]).returns == 999 * 1000 / 2 + 1000
