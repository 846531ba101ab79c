from bbsd.expression.graph import evaluate
from tests.unit.language.specs import codes, meaning_of

PART = """
environment:
  state:
    w: list(k for k in range(3))
    i: 0
    j: 0
behaviors:
  stop:
    actions:
      halt:
        w[i]: w[1] + 10
        w[j]: w[1] + 20
"""


def after(i, j):
    """What a robot's list is after the action, of a list 0, 1, 2."""
    sets = meaning_of(PART).episode.modules[0].actions["halt"]
    values = {"i": i, "j": j}

    def leaf(node, _):
        slot = node.slot
        return float(slot.place[0]) if slot.place else float(values[slot.name])

    return evaluate([sets["w", (place,)][0] for place in range(3)], leaf)


def test_elements_are_set_from_the_snapshot():
    assert after(1, 0) == [21, 11, 2]
    assert after(0, 2) == [11, 1, 21]


def test_of_two_keys_that_are_the_same_element_the_later_one_stays():
    assert after(1, 1) == [0, 21, 2]


def variables_set(key):
    part = "environment: {state: {w: 'list(0 for k in range(3))'}}\n"
    part += f"behaviors: {{stop: {{actions: {{halt: {{'{key}': 4}}}}}}}}"
    sets = meaning_of(part).episode.modules[0].actions["halt"]
    return [variable for variable in sets if variable[0] == "w"]


def test_only_elements_that_may_change_are_set():
    assert variables_set("w[1]") == [("w", (1,))]
    assert variables_set("w[robot]") == [("w", (0,)), ("w", (1,)), ("w", (2,))]


def test_another_robots_list_has_the_robot_as_its_first_index():
    lists = "environment: {state: {w: 'list(0 for k in range(2))'}, sensors: {%s}, ends: '%s'}"
    assert codes(lists % ("seen: 'sum(w[r][1] for r in others)'", "w[0][1] > 2")) == []
    assert codes(lists % ("seen: 'w[1]'", "any(sum(w[r]) > 3 for r in team)")) == []
    assert codes(lists % ("seen: 'w[1][0][0]'", "w[0][1] > 2")) == ["BB057"]
    assert codes(lists % ("seen: 'w[0]'", "sum(w) > 2")) == ["BB059"]
    assert codes("environment: {state: {w: 'list(0, 1)'}}\nbehaviors: {stop: {excited: 'w[1][0] > 1'}}") == [
        "BB066"
    ]


def test_an_input_is_cut_from_an_element():
    part = "environment: {state: {w: 'list(0, 1)'}}\nbehaviors: {stop: {inputs: %s}}"
    assert codes(part % "{one: 'values(w[1], 0, 2)'}") == []
    assert codes(part % "[w]") == ["BB030"]
