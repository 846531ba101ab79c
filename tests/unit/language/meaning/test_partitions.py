import pytest

from bbsd.expression.graph import Node, evaluate
from bbsd.language.loading import check
from tests.unit.language.specs import codes, meaning_of, source


def cells(partition: str) -> tuple[str, ...]:
    meaning = meaning_of(f"behaviors: {{stop: {{inputs: {{reached: {partition}}}}}}}")
    return tuple(meaning.episode.modules[0].inputs["reached"])


@pytest.mark.parametrize(
    ("partition", "labels"),
    [("tilted", ("false", "true")), ('"cut(height, 2, 2.50)"', ("below 2", "2 to 2.5", "from 2.5")),
     ('"cut(height, 3)"', ("below 3", "from 3")), ('"values(speed, -1, 2)"', ("-1", "0", "1", "2")),
     ("{low: height < 1, high: otherwise}", ("low", "high")),
     ("{very  low: height < 1, high: height >= 1}", ("very low", "high"))],
)  # fmt: skip
def test_labels(partition: str, labels: tuple[str, ...]) -> None:
    assert cells(partition) == labels


def index_at(partition: str, height: float) -> int:
    module = meaning_of(f"behaviors: {{stop: {{inputs: {{reached: {partition}}}}}}}").episode.modules[0]
    return int(evaluate([module.cells[0][0]], lambda _node, _operands: height)[0])


@pytest.mark.parametrize(("height", "cell"), [(1.9, 0), (2.0, 1), (2.9, 1), (3.0, 2), (99.0, 2), (-1e300, 0)])
def test_cuts_are_half_open(height: float, cell: int) -> None:
    assert index_at('"cut(height, 2, 3)"', height) == cell


@pytest.mark.parametrize(("height", "cell"), [(-7.0, 0), (1.0, 0), (2.0, 1), (4.0, 3), (99.0, 3)])
def test_what_lies_beyond_the_values_goes_to_the_nearest(height: float, cell: int) -> None:
    assert index_at('"values(floor(height), 1, 4)"', height) == cell


@pytest.mark.parametrize(("height", "cell"), [(0.5, 0), (1.0, 1), (2.5, 2), (float("nan"), 2)])
def test_the_first_condition_that_holds_names_the_cell(height: float, cell: int) -> None:
    assert index_at("{a: height < 1, b: height < 2, c: height >= 2}", height) == cell


def test_a_partition_may_be_shared_as_a_sensor() -> None:
    meaning = meaning_of(
        "environment: {sensors: {zone: {low: height < 1, high: otherwise}}}\nbehaviors: {stop: {inputs: [zone]}}"
    )
    assert meaning.episode.modules[0].inputs == {"zone": ("low", "high")}


def test_bounds_may_be_constants_and_are_labelled_by_their_names() -> None:
    part = (
        'constants: {low: 1, high: low + 1}\nbehaviors: {stop: {inputs: {reached: "cut(height, low, high)"}}}'
    )
    assert meaning_of(part).episode.modules[0].inputs["reached"] == ("below low", "low to high", "from high")


@pytest.mark.parametrize(
    ("partition", "code"),
    [("height", "BB030"), ('"cut(height)"', "BB031"), ('"cut(height, 3, 3)"', "BB031"), ('"cut(tilted, 3)"', "BB055"),
     ('"values(speed, 0)"', "BB031"), ('"values(speed, 0, 0)"', "BB031"), ('"values(speed, 0, 0.5)"', "BB064"),
     ('"values(speed, 0, height)"', "BB064"), ('"values(speed, 0, uniform(1, 2))"', "BB058"),
     ('"values(height, 0, 3)"', "BB064"), ('"values(speed, 0, 2000000)"', "BB031"), ("{a: height < 1}", "BB032"),
     ("{a: height < 1, b: height > 1}", "BB032"), ("{a: height, b: otherwise}", "BB055"), ("{}", "BB032")],
)  # fmt: skip
def test_mistakes(partition: str, code: str) -> None:
    assert codes(f"behaviors: {{stop: {{inputs: {{reached: {partition}}}}}}}") == [code]


def test_a_bound_read_from_a_table_is_as_good_as_a_number() -> None:
    part = """
constants: {table: [1, 5, 9], k: 1}
behaviors:
  stop:
    inputs:
      reached: "values(speed, 0, table[k])"
"""
    module = meaning_of(part).episode.modules[0]
    assert len(module.inputs["reached"]) == 6
    assert isinstance(module.cells[0][0], Node)


@pytest.mark.parametrize(
    ("cells", "message", "written"),
    [
        ("{low: height < 2, high: height > 2}", "no cell where height == 2", "height >= 2"),
        ("{low: 2 > height, high: height > 2}", "no cell where height == 2", "height >= 2"),
        (
            "{low: height < 2, mid: 2 < height < 3, high: height >= 3}",
            "no cell where 2 == height",
            "2 <= height < 3",
        ),
        ("{low: height < 2, high: height > 2.5}", "no cell where none of low, high holds", "neither"),
        ("{low: height < 2, mid: 2 < height < 3, high: height > 3}", "no cell where none of", "rest"),
    ],
)
def test_a_border_that_no_cell_takes(cells: str, message: str, written: str) -> None:
    (mistake,) = check(source(f"behaviors: {{stop: {{inputs: {{at: {cells}}}}}}}"))
    assert message in mistake.message
    assert mistake.correction is None or written in mistake.correction.edits[0].text
