import pytest

from bbsd.errors import SpecError
from bbsd.language.loading import Loaded, load
from bbsd.language.overrides import read_overrides
from tests.unit.language.specs import source

RULES = "behaviors: {stop: {rules: [{when: {reached: true}, do: halt}, {otherwise: no action}]}}\nstructure: [stop]\n"


def loaded(*overrides: str) -> Loaded:
    return load(source(RULES), overrides=overrides)


def refused(*overrides: str) -> list[tuple[str, int, int]]:
    """The code, line and column of each mistake, all of which must be at the overrides."""
    with pytest.raises(SpecError) as caught:
        loaded(*overrides)
    error = caught.value
    assert {diagnosis.place.file for diagnosis in error.diagnoses} == {"--set"}
    assert all(
        error.source.line(diagnosis.place.line) == overrides[diagnosis.place.line - 1]
        for diagnosis in error.diagnoses
    )
    return [(diagnosis.code, diagnosis.place.line, diagnosis.place.column) for diagnosis in error.diagnoses]


def test_values_are_set_in_order() -> None:
    spec = loaded("environment.steps=7", "environment.steps=8", "reward.near=height").spec
    assert spec.environment.steps == 8
    assert spec.reward["near"].text == "height"


def test_keys_that_the_file_has_not_but_the_language_has() -> None:
    spec = loaded(
        "design.coevolution.generations=7", "environment.ends=step == 3", "design.culture=none"
    ).spec
    assert spec.design.coevolution.generations == 7
    assert spec.design.culture == "none"
    assert spec.environment.ends is not None


def test_items_of_lists() -> None:
    spec = loaded("structure[0]=open", "behaviors.stop.rules[1].otherwise=halt").spec
    assert spec.structure == ["open"]
    assert loaded("behaviors.stop.rules[0]=null").data["behaviors"]["stop"]["rules"] == [
        {"otherwise": "no action"}
    ]


def test_null_takes_away() -> None:
    spec = loaded("structure=null", "behaviors.stop.rules=null", "environment.ends=null").spec
    assert spec.structure is None
    assert spec.behaviors["stop"].rules is None


def test_the_right_side_is_yaml() -> None:
    assert loaded("structure=[stop]").spec.structure == ["stop"]
    assert loaded("reward={near: height, far: 1 - height}").spec.reward.keys() == {"near", "far"}
    assert loaded('name="a=b"').spec.name == "a=b"
    assert loaded("summary='a: b'").spec.summary == "a: b"


@pytest.mark.parametrize("argument", ["", "steps", "=3", ".a=3", "a..b=3", "a[x]=3", "a.=3", "[0]=1", "a b"])
def test_what_is_no_path_and_value(argument: str) -> None:
    assert refused(argument) == [("BB028", 1, 1)]


@pytest.mark.parametrize(
    ("argument", "column"),
    [("enviroment.steps=3", 1), ("environment.step=3", 13), ("design.coevolution.generation=3", 20),
     ("reward.neer=3", 8),
     ("structure[1]=stop", 11), ("behaviors.stop.rules[0].wen=3", 25),
     ("environment.steps.x=3", 19), ("name[0]=x", 6),
     ("reward[0]=3", 8), ("behaviors.go.rules=null", 11)],
)  # fmt: skip
def test_paths_that_lead_nowhere(argument: str, column: int) -> None:
    assert refused(argument) == [("BB028", 1, column)]


def test_a_path_that_leads_nowhere_gets_a_suggestion() -> None:
    with pytest.raises(
        SpecError, match='there is no "generation" in coevolution; did you mean "generations"'
    ):
        loaded("design.coevolution.generation=3")


def test_all_wrong_arguments_are_told_each_on_its_line() -> None:
    assert refused("a.b=1", "environment.steps=3", "c=1") == [("BB028", 1, 1), ("BB028", 3, 1)]
    assert refused("environment.steps=few", "name=x", "reward.near=1 + hight") == [
        ("BB022", 1, 19),
        ("BB052", 3, 17),
    ]


@pytest.mark.parametrize(
    ("argument", "code", "column"),
    [("environment.robots=three", "BB022", 20), ("environment.robots=99", "BB023", 20),
     ("structure[0]=stpo", "BB042", 14),
     ("reward.near=height +", "BB050", 13), ("reward.near='height + hight'", "BB052", 23),
     ("reward={near: hight}", "BB052", 15),
     ("design.learning={rat: 3}", "BB020", 18), ("reward={a: 1, near: [1]}", "BB022", 21),
     ("reward={a: ", "BB004", 12),
     ("behaviors.stop.rules[0].when={reached: yes}", "BB035", 40)],
)  # fmt: skip
def test_mistakes_in_a_value_are_told_at_the_override(argument: str, code: str, column: int) -> None:
    assert refused(argument) == [(code, 1, column)]


def test_mistakes_of_the_file_are_told_in_the_file() -> None:
    with pytest.raises(SpecError) as caught:
        load(source("reward: {near: hight}"), overrides=["environment.steps=3"])
    assert [diagnosis.place.file for diagnosis in caught.value.diagnoses] == ["spec.yaml"]


def test_what_an_override_takes_away_is_missed_in_the_file() -> None:
    with pytest.raises(SpecError) as caught:
        loaded("environment.steps=null")
    (diagnosis,) = caught.value.diagnoses
    assert (diagnosis.code, diagnosis.place.file) == ("BB021", "spec.yaml")


def test_an_argument_of_several_lines_keeps_its_places() -> None:
    with pytest.raises(SpecError) as caught:
        loaded("reward=\n  near: hight\n  far: 1", "environment.steps=few")
    assert [(diagnosis.code, diagnosis.place.line, diagnosis.place.column) for diagnosis in caught.value.diagnoses] == [
        ("BB052", 2, 9), ("BB022", 4, 19),
    ]  # fmt: skip
    assert caught.value.source.line(2) == "  near: hight"


def test_an_argument_sets_one_value() -> None:
    with pytest.raises(SpecError) as error:
        read_overrides(["constants.a=3\nconstants.b: 5"])
    (found,) = error.value.diagnoses
    assert (found.code, found.place.line, found.advice) == ("BB028", 2, "give each PATH=VALUE its own --set")
    assert [each.value for each in read_overrides(['a="two\n\n  lines"', "b=3"])] == ["two\nlines", 3]
