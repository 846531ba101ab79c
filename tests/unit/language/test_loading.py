from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.errors import SpecError
from bbsd.language.loading import MAX_DIAGNOSES, MAX_EXAMINED_TWICE, check, load
from bbsd.text import Source, read
from tests.unit.language.specs import BASE, codes, messages, source

SHIPPED = sorted((Path(__file__).parents[3] / "specs").rglob("*.yaml"))


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_the_shipped_specs_load(path: Path) -> None:
    loaded = load(Source.read(path), seed=3)
    assert loaded.spec.name
    assert loaded.meaning.spec is loaded.spec
    assert loaded.meaning.seed == 3


def test_what_was_loaded_is_all_there() -> None:
    given_source = Source("spec.yaml", BASE)
    loaded = load(given_source, overrides=["environment.steps=7"])
    assert loaded.source is given_source
    assert loaded.lineage.data["environment"]["steps"] == 10
    assert loaded.data["environment"]["steps"] == loaded.spec.environment.steps == 7


def test_mistakes_are_raised_together_in_the_order_of_the_file() -> None:
    with pytest.raises(SpecError) as caught:
        load(
            source(
                "reward: {near: hight}\nenvironment: {robots: many}\nbehaviors: {stop: {actions: {halt: {sped: 0}}}}"
            )
        )
    assert [diagnosis.code for diagnosis in caught.value.diagnoses] == ["BB022", "BB033", "BB052"]
    assert caught.value.source.line(1) == "bbsd: 1"


def test_a_mistake_in_an_aliased_value_is_told_where_it_is_written() -> None:
    text = BASE.replace("speed: 0\nreward:", "speed: &s slow\n      push:\n        speed: *s\nreward:")
    assert [(diagnosis.code, diagnosis.place.line) for diagnosis in check(Source("spec.yaml", text))] == [
        ("BB052", 21)
    ]


def test_only_so_many_mistakes_are_shown() -> None:
    terms = ", ".join(f"t{place}: unknown{place}" for place in range(MAX_DIAGNOSES + 3))
    diagnoses = check(source(f"reward: {{{terms}}}"))
    assert len(diagnoses) == MAX_DIAGNOSES
    assert diagnoses[-1].advice == "3 more mistakes are not shown"
    assert diagnoses[0].advice == ""


def test_what_yaml_stumbled_over_is_told_once() -> None:
    assert codes("x-note: 1") == []
    for text, code in (("speed:0", "BB017"), ("1: 0", "BB008"), ("<<: {}", "BB007"), ("speed: *x", "BB010")):
        diagnoses = check(
            Source("spec.yaml", BASE.replace("    speed: 0\n  dynamics:", f"    {text}\n  dynamics:"))
        )
        assert code in {diagnosis.code for diagnosis in diagnoses}
        assert all(
            diagnosis.place.line == 9 or diagnosis.code == "BB052"
            for diagnosis in diagnoses
            if diagnosis.code != "BB033"
        ), diagnoses


@pytest.mark.parametrize("text", ["", "# nothing", "- 1", "3", "a: [", "\t", "a: b: c", "? x\n: y"])
def test_what_is_no_spec_at_all_has_a_diagnosis(text: str) -> None:
    assert check(Source("spec.yaml", text))


LEAVES = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-3, 400),
    st.floats(),
    st.sampled_from(["height", "open", "x +", "halt", "Halt"]),
)
DATA = st.recursive(
    LEAVES,
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text("abx-(", max_size=3), inner, max_size=3)
    ),
)
PLACES = [
    ("bbsd",), ("name",), ("constants",), ("environment",), ("environment", "robots"), ("environment", "steps"),
    ("environment", "state"), ("environment", "state", "speed"), ("environment", "sensors", "tilted"),
    ("environment", "dynamics"), ("environment", "definitions"), ("environment", "ends"), ("environment", "world"),
    ("behaviors",), ("behaviors", "stop"), ("behaviors", "stop", "inputs"), ("behaviors", "stop", "inputs", "reached"),
    ("behaviors", "stop", "actions"), ("behaviors", "stop", "actions", "halt"), ("behaviors", "stop", "rules"),
    ("behaviors", "stop", "excited"), ("structure",), ("reward",), ("reward", "near"), ("design",),
    ("design", "culture"), ("design", "learning"), ("x-own",), ("zork",),
]  # fmt: skip


@given(st.sampled_from(PLACES), DATA)
def test_no_data_are_more_than_wrong(place: tuple[str, ...], value: object) -> None:
    data = read(Source("base", BASE)).data
    parent = data
    for key in place[:-1]:
        parent = parent.setdefault(key, {})
    parent[place[-1]] = value
    from bbsd.language.lineage import read_lineage
    from bbsd.language.loading import _examine

    examined = _examine(data, read_lineage(Source("base", BASE)), 0, is_small=True)
    assert examined.found or examined.meaning
    for _, mistake in examined.found:
        assert not any(
            word in mistake.message for word in ("Input", "valid ", "union", "pydantic", "dict", "<")
        )


@pytest.mark.parametrize(
    ("part", "message"),
    [
        ("environment: {robots: three}", 'robots must be a whole number from 1 to 64, not text "three"'),
        ("environment: {robots: true}", "robots must be a whole number from 1 to 64, not the truth true"),
        ("environment: {steps: 0}", "steps must be a whole number from 1 to 10 000 000, not 0"),
        ("environment: {steps: 2.5}", "steps must be a whole number from 1 to 10 000 000, not 2.5"),
        ("design: {coevolution: {crossover: 2}}", "crossover must be a number from 0 to 1, not 2"),
        ("design: {coevolution: {elites: -1}}", "elites must be a whole number from 0 on, not -1"),
        (
            "design: {sharing: valu}",
            'sharing must be uniform or value or difference, not text "valu"; did you mean "value"?',
        ),
        ("design: {culture: 3}", "culture must be a mapping or none, not 3"),
        ("design: {record: 0}", "record must be a whole number from 1 on, a list of them, or none, not 0"),
        ("design: {record: [9, x]}", 'item 2 of record must be a whole number from 1 on, not text "x"'),
        ("structure: stop", "structure must be a list of behaviors, from the highest layer down"),
        ("structure: [stop, [stop]]", "item 2 of structure must be text, not a list"),
        (
            "behaviors: {stop: {rules: {otherwise: halt}}}",
            "rules must be a list of rules, not a mapping: each rule begins with a dash",
        ),
        (
            "behaviors: {stop: {rules: [{otherwise: 3}]}}",
            "otherwise must be an action, no action or open, not 3",
        ),
        (
            "behaviors: {stop: {actions: {halt: 3}}}",
            "an action says which state it sets, and to what: halt does not",
        ),
        ("constants: {a: [1, [2, {b: 3}]]}", "item 2.2 of a must be an expression, not a mapping"),
        ("environment: {ends: .nan}", "ends must be an expression, not nan"),
        ("environment: {step: 3}", 'unexpected key "step"; did you mean "steps"?'),
        ("bbsd: 2", "this is a spec in version 2 of the language; only 1 is known"),
        ("name: 12", "name must be text, not 12"),
        ("ends: step > 3", 'unexpected key "ends" here'),
        ("design: {coevolution: {children: 3}}", "children must be 1 or 2, not 3"),
        ("design: {coevolution: {children: two}}", 'children must be 1 or 2, not text "two"'),
        (
            "environment: {state: {step: 0}}",
            '"step" cannot be the name of a value: it is the number of the step',
        ),
        (
            "constants: {'true': 0}",
            '"true" cannot be the name of a value: it is a truth in YAML, not a text',
        ),
        (
            "constants: {with: 0}",
            '"with" cannot be the name of a value: it is a word of expressions',
        ),
        (
            "environment: {definitions: {'mean(a, b)': a + b}}",
            '"mean" cannot be the name of a definition with parameters: mean(...) is an aggregate, which takes lists',
        ),
        (
            "environment: {definitions: {'f(step)': step}}",
            '"step" cannot be the name of a value: it is the number of the step',
        ),
        (
            "environment: {definitions: {'f(a, a)': a}}",
            '"f(a, a)" has a twice; the parameters\' names differ from it and from each other',
        ),
        (
            "environment: {definitions: {'f(A)': 1}}",
            '"f(A)" cannot be a definition\'s name; write name or name(a, b), in small letters',
        ),
        (
            "behaviors: {open: {actions: {go: {}}}}",
            '"open" cannot be a behavior\'s name: in a structure it is a layer for any behavior',
        ),
        (
            "behaviors: {stop: {actions: {open: {}}}}",
            '"open" cannot be an action\'s name: in a rule it leaves a cell to be designed',
        ),
    ],
)
def test_messages_are_in_a_designers_words(part: str, message: str) -> None:
    assert messages(part) == [message]


def test_a_misspelled_block_is_one_mistake() -> None:
    for block in ("sensors", "state", "dynamics"):
        text = BASE.replace(f"  {block}:", f"  {block[:-1]}s_:")
        assert [diagnosis.code for diagnosis in check(Source("spec.yaml", text))] == ["BB020"], block
    for block in ("behaviors", "reward", "environment"):
        text = BASE.replace(f"\n{block}:", f"\n{block}_:")
        assert [diagnosis.code for diagnosis in check(Source("spec.yaml", text))] == ["BB020"], block


def test_a_wrong_number_of_robots_says_nothing_about_indices() -> None:
    assert codes("environment: {robots: many, sensors: {far: 'height[5] > 1'}, ends: height > 3}") == [
        "BB022"
    ]


@pytest.mark.parametrize(
    ("part", "advice"),
    [
        ("ends: step > 3", "it belongs into environment"),
        ("design: {candidates: 3}", "it belongs into design.learning or design.answer"),
        ("environment: {rules: []}", "it belongs into a behavior"),
        ("structure: stop", "a list is written in brackets: [stop]"),
    ],
)
def test_advice_names_the_block_or_the_form_that_was_meant(part: str, advice: str) -> None:
    (diagnosis,) = check(source(part))
    assert diagnosis.advice == advice


@pytest.mark.parametrize(
    ("part", "code"),
    [
        ("behaviors: {stop: {inputs: [hight], rules: [{when: {height: true}, do: halt}]}}", "BB041"),
        ("environment: {dynamics: {sped: 3}}", "BB033"),
    ],
)
def test_what_only_follows_from_a_mistake_is_not_told(part: str, code: str) -> None:
    assert codes(part) == [code]


def test_what_need_not_be_whole_is_told_beside_inputs_that_were_not_understood() -> None:
    codes_reported = codes("behaviors: {stop: {inputs: {a: tld > 1, b: 'values(speed / 2, 0, 3)'}}}")
    assert sorted({*codes_reported} & {"BB052", "BB064"}) == ["BB052", "BB064"]


def test_in_a_large_spec_mistakes_of_form_are_told_first() -> None:
    text = BASE.replace("robots: 3", "robots: many").replace("speed: 0\nreward", "speed: sped\nreward")
    large = text + "#" * MAX_EXAMINED_TWICE
    assert [diagnosis.code for diagnosis in check(Source("spec.yaml", text))] == ["BB022", "BB052"]
    assert [diagnosis.code for diagnosis in check(Source("spec.yaml", large))] == ["BB022"]
