import pytest

from bbsd.architecture.drawn_constants import drawn_constants
from bbsd.text import Source, read
from bbsd.text.writing.writer import write
from tests.unit.architecture.designs import meaning_of, shipped

WITH = """
bbsd: 1
name: constants
constants:
{constants}
environment: {{steps: 1, state: {{x: 0}}}}
behaviors: {{one: {{actions: {{a: {{x: 1}}}}}}}}
reward: {{right: x}}
"""


def with_constants(**constants):
    return WITH.format(constants="".join(f"  {name}: {text}\n" for name, text in constants.items()))


def vector(meaning, generation=1):
    return meaning.constants.vector(generation)


def settled_again(text, seed=0):
    """The settled constants, and the meaning of a spec that has them, for another seed."""
    meaning = meaning_of(text, seed)
    changes = drawn_constants(meaning)
    data = read(Source("spec.yaml", text)).data
    data["constants"] |= {path[1]: value for path, value in changes.items()}
    return changes, meaning, meaning_of(write(data), seed + 1)


def test_constants_without_draws_are_not_touched():
    assert drawn_constants(meaning_of(shipped("object_lifting"))) == {}


def test_drawn_tables_become_tables_of_whole_numbers():
    changes, meaning, again = settled_again(shipped("abstract"))
    policy = changes["constants", "policy"]
    assert [len(row) for row in policy] == [5] * 5
    assert all(type(number) is int and 1 <= number <= 7 for row in policy for number in row)
    assert vector(again) == vector(meaning)


def test_what_is_computed_from_drawn_constants_stays_as_it_is():
    changes, meaning, again = settled_again(with_constants(a="uniform(1, 2)", b="2 * a"))
    assert list(changes) == [("constants", "a")]
    assert vector(again) == vector(meaning)


@pytest.mark.parametrize(
    "text",
    [
        "uniform(1, 2) + (1 if generation > 3 and not generation >= 7 else -2)",
        "list(uniform(1, 2) ** 2 * k for k in list(1, generation))",
        "max(generation, integers(1, 9), 4) // 3 - generation ** 2 % 3",
        "normal(0, 1) / sqrt(generation) - 1.5 ** generation",
        "[1, 'uniform(0, 1)', 2 * generation]",
        "list(uniform(0, 1), 2, 3)[floor(generation) - 1]",
        "atan2(uniform(0, 1), generation) + abs(-generation)",
        "1 if chance(0.5) or generation == 2 else 0",
    ],
)
@pytest.mark.parametrize("seed", [0, 1])
def test_with_a_generation_what_was_drawn_is_written_into_the_expression(text, seed):
    changes, meaning, again = settled_again(with_constants(a=text), seed)
    assert list(changes) == [("constants", "a")]
    assert drawn_constants(again) == {}
    for generation in range(1, 9):
        assert vector(again, generation) == vector(meaning, generation)
