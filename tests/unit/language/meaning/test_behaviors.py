import pytest

from bbsd.expression.graph import value_of
from tests.unit.language.specs import codes, meaning_of, messages


def test_a_module_has_its_nodes_for_each_robot() -> None:
    (module,) = meaning_of().episode.modules
    assert module.inputs == {"reached": ("false", "true")}
    assert len(module.cells) == len(module.excited) == 3
    assert [value_of(node) for node in module.excited] == [True] * 3
    assert len(module.actions["halt"]["speed", ()]) == 3
    assert module.n_cells == 2
    assert module.table.is_open


def test_inputs_keep_their_order_and_multiply() -> None:
    (module,) = meaning_of("""
environment: {sensors: {zone: {low: height < 1, middle: height < 2, high: otherwise}}}
behaviors: {stop: {inputs: [zone, tilted]}}
""").episode.modules
    assert list(module.inputs) == ["zone", "tilted"]
    assert module.n_cells == 6


def test_an_own_input_may_name_a_sensor() -> None:
    part = "environment: {sensors: {zone: {low: height < 1, high: otherwise}}}\n"
    part += "behaviors: {stop: {inputs: {reached: zone}}}"
    assert meaning_of(part).episode.modules[0].inputs == {"reached": ("low", "high")}


def test_without_inputs_a_table_has_one_cell() -> None:
    (module,) = meaning_of("behaviors: {stop: {inputs: {}}}").episode.modules
    assert module.n_cells == 1


def test_truths_can_be_set_where_the_state_is_one() -> None:
    part = "environment: {state: {lit: false}}\nbehaviors: {stop: {actions: {halt: {lit: %s}}}}"
    assert codes(part % "not lit") == []
    assert codes(part % "1") == ["BB055"]


@pytest.mark.parametrize(
    ("target", "what"),
    [("tilt", "tilt is a sensor"), ("wind", "wind is a value of the world"), ("goal", "goal is a constant"),
     ("lead", "lead is a definition"), ("sped", '"sped" is not state; did you mean "speed"?')],
)  # fmt: skip
def test_only_a_robots_own_state_can_be_set(target: str, what: str) -> None:
    part = "constants: {goal: 3}\nenvironment: {world: {wind: 0}, definitions: {lead: height - 1}}\n"
    (message,) = messages(part + f"behaviors: {{stop: {{actions: {{halt: {{{target}: 0}}}}}}}}")
    assert message.startswith(what)


@pytest.mark.parametrize(
    ("behavior", "code"),
    [("{excited: height}", "BB055"), ("{excited: before(tilted)}", "BB065"), ("{excited: chance(0.5)}", "BB058"),
     ("{inputs: [tilt]}", "BB030"), ("{inputs: [height]}", "BB030"), ("{inputs: [tilted, tilted]}", "BB040"),
     ("{expects: tilt}", "BB055"), ("{expects: chance(0.5)}", "BB058"), ("{expects: 'before(height[1]) > 2'}", "BB066"),
     ("{inputs: [tillted]}", "BB041"), ("{inputs: {reached: tilt}}", "BB030"), ("{actions: {}}", "BB038")],
)  # fmt: skip
def test_mistakes(behavior: str, code: str) -> None:
    assert codes(f"behaviors: {{stop: {behavior}}}") == [code]


def test_a_behavior_has_only_so_many_actions() -> None:
    many = ", ".join(f"a{place}: {{}}" for place in range(201))
    assert codes(f"behaviors: {{stop: {{actions: {{{many}}}}}}}") == ["BB038"]


def test_rules_are_looked_through_though_an_input_is_not_understood() -> None:
    rules = "[{when: {a: yes, b: below 1}, do: Halt}]"
    part = f"behaviors: {{stop: {{inputs: {{a: height > 1, b: hight}}, rules: {rules}}}}}"
    assert codes(part) == ["BB052", "BB035", "BB036"]


def test_a_truth_of_the_state_is_an_input_with_two_cells() -> None:
    (module,) = meaning_of("""
environment: {state: {lit: height > 2}}
behaviors: {stop: {inputs: [tilted, lit]}}
""").episode.modules
    assert module.inputs == {"tilted": ("false", "true"), "lit": ("false", "true")}
    (read,) = module.cells[2][1].operands
    assert (read.operation, read.data) == ("slot", ("lit", 2, ()))


@pytest.mark.parametrize(
    ("listed", "message"),
    [("height", "an input has cells, and height is a number without any"),
     ("wind", "stop uses wind of the world; a behavior knows only its own robot's state and sensors"),
     ("lead", "lead is a definition; inputs lists sensors, and truths of the robot's state"),
     ("goal", "goal is a constant; inputs lists sensors, and truths of the robot's state"),
     ("heihgt", '"heihgt" is neither sensor nor state; did you mean "height"?')],
)  # fmt: skip
def test_what_inputs_cannot_list_is_told_by_what_it_is(listed: str, message: str) -> None:
    part = "constants: {goal: 3}\nenvironment: {world: {wind: 0}, definitions: {lead: height > 1}}\n"
    assert messages(part + f"behaviors: {{stop: {{inputs: [{listed}]}}}}") == [message]


@pytest.mark.parametrize(
    ("condition", "used"),
    [("height[0] > 2", "height of another robot"), ("wind > 2", "wind of the world"),
     ("all(height[r] > 2 for r in others)", "the other robots"), ("any(r > 1 for r in team)", "the whole team"),
     ("lead > 1", "lead, which reads wind of the world"), ("ahead(1)", "ahead, which reads wind of the world"),
     ("step > least", "least, which reads the whole team")],
)  # fmt: skip
def test_what_a_behavior_cannot_know_is_told_with_its_name(condition: str, used: str) -> None:
    part = """
environment:
  world: {wind: 0}
  definitions: {lead: height - wind, "ahead(a)": lead > a, least: "min(height[r] for r in team)"}
"""
    rest = "; a behavior knows only its own robot's state and sensors"
    for key in ("excited", "expects"):
        assert messages(part + f"behaviors: {{stop: {{{key}: '{condition}'}}}}") == [
            f"stop uses {used}{rest}"
        ]


def test_each_use_of_a_definition_that_a_behavior_cannot_know_is_told() -> None:
    part = "environment: {world: {wind: 0}, definitions: {lead: height - wind}}\n"
    part += "behaviors: {stop: {excited: lead > 1, expects: lead > before(lead)}}"
    assert codes(part) == ["BB066"] * 3


def test_the_cells_of_all_tables_are_bounded() -> None:
    one = "  go{}: {{inputs: {{fine: 'values(floor(speed), 0, 999999)'}}, actions: {{go: {{speed: 0}}}}}}\n"
    assert codes("behaviors:\n" + "".join(map(one.format, range(9)))) == []
    assert codes("behaviors:\n" + "".join(map(one.format, range(20)))) == ["BB039"]
