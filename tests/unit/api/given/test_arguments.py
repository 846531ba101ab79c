"""Every argument of every public function is honored or refused: a new one without an entry here fails."""

import inspect

import numpy as np
import pytest

import bbsd
from bbsd import api
from bbsd.agent.inputs import BadInput
from bbsd.api.given.arguments import BadArgument, assignments
from tests.unit.architecture.designs import SPECS

SPEC = SPECS.parent / "tests" / "end_to_end" / "specs" / "thermostat.yaml"
HAND = SPECS / "object_lifting_hand.yaml"
OUTSIDE = SPECS / "gymnasium" / "cartpole.yaml"

NUMBER = ["1", None, True, 1.5, float("nan")]
TRUTHS = [(each, "is True or False, not") for each in (1, "yes", None)]
NAMES = [
    ("speed", r"is a list of texts, not one text"),
    (["speed", 3], "is a list of texts, and 3 is none"),
    (3, "is a list of texts, not 3"),
]
FUNCTION = [("print", "is a function, not 'print'")]


def whole(least, *, none=False):
    """Return what is no whole number of at least so much, and the words that say so."""
    words = f"is a whole number (of {least} or more|from {least} to)"
    return [(each, words) for each in (*NUMBER, least - 1) if not (none and each is None)]


def above_zero(*, none=False):
    bad = ["1", None, True, 0, -1.0, float("inf"), float("nan")]
    return [(each, "is a number above 0, not") for each in bad if not (none and each is None)]


BAD = {
    "agents": whole(1),
    "allow_import": NAMES,
    "announce": FUNCTION,
    "api": [("gym", "api is one of 'gymnasium', 'vector', 'pettingzoo', not 'gym'")],
    "at": [("tilt=1", "is a dict of values by name"), ({1: 2}, "is a dict of values by name")],
    "below": [(3, "is a path, not 3"), ("", "is a path, and '' is none")],
    "by_table": TRUTHS,
    "compiled": TRUTHS,
    "engine": [("dask", "is one of bbsd.engines, not 'dask'")],
    "environment": [("CartPole-v1", "is a function")],
    "episode": [
        *whole(0)[1:],
        ("1", "one of 'worst', 'median', 'best', not '1'"),
        ("bets", "not 'bets'; did you mean \"best\""),
    ],
    "episodes": whole(1),
    "exact": TRUTHS,
    "faults": [("behavior=stop:silent", "is a list of texts, not one text")],
    "fill": [("zeros", "fill is 'random', not 'zeros'"), (True, "fill is 'random', not True")],
    "finish": FUNCTION,
    "gymnasium": [(3, "is a text, not 3")],
    "import_from": [(".", "is a list of paths, not"), ([3], "is a path, not 3")],
    "interval": above_zero(),
    "jobs": whole(1),
    "keep_each": TRUTHS,
    "key": whole(0, none=True),
    "lanes": whole(1),
    "leaves": [("scripts", "not 'scripts'; did you mean \"script\"")],
    "measured": NAMES,
    "more": whole(5000, none=True),
    "not_finite": [("typo", "not_finite is one of 'refuse', 'count', not 'typo'")],
    "note": FUNCTION,
    "observe": [("sensor", "not 'sensor'; did you mean \"sensors\"")],
    "out": [(3, "is a path, not 3"), ("a\0b", "is none")],
    "overdue": FUNCTION,
    "pettingzoo": [(3, "is a text, not 3")],
    "places": [(3, "is a path, not 3")],
    "progress": FUNCTION,
    "python": [(3, "is a text, not 3")],
    "relearn": TRUTHS,
    "remembered": NAMES,
    "resume": TRUTHS,
    "rivals": NAMES,
    "robot": whole(0),
    "run": [(3, "is a path, not 3")],
    "runs": whole(1),
    "seed": [*whole(0), (2**64, "from 0 to")],
    "sensing": TRUTHS,
    "set": [
        ("design.budget=5000", "set is a list of texts, not one text"),
        ([("design.budget", 5000)], "set is a list of texts, and"),
        ({"design.budget": object()}, "set: design.budget cannot be set to"),
        ({"design.budget": float("nan")}, "set: design.budget cannot be set to nan"),
        ({1: 2}, "set: the path of a value is text, not 1"),
        (5, "set is a list of texts, not 5"),
    ],
    "start": [(3, "start is a design or a list of designs, not 3"), ([None], "not None")],
    "starting": [("1", "is a number of 0 or more"), (-1, "is a number of 0 or more")],
    "step": whole(1, none=True),
    "step_limit": above_zero(),
    "time_limit": above_zero(none=True),
    "to": [(3, "is a text, not 3")],
    "unwanted": NAMES,
    "verify": TRUTHS,
    "wanted": NAMES,
    "within": above_zero(none=True),
    "worth": TRUTHS,
}
"""What an argument of that name cannot be, and the words of the refusal."""
OWN = {
    ("Agent.of", "design"): [("hand.yaml", "design is a Design, not 'hand.yaml'")],
    ("compare", "episodes"): whole(2),
    ("evaluate", "episodes"): whole(1, none=True),
    ("explain", "episodes"): whole(0),
    ("faults", "episodes"): whole(2),
    ("load", "seed"): whole(0, none=True),
    ("trace", "episodes"): whole(1, none=True),
    ("worth", "episodes"): whole(2),
}
"""Those that a function refuses in another way than the others."""
NEEDED = {"export": {"to": "c"}, "faults": {"faults": []}, "compare": {"b": HAND}, "why": {"step": 1}}
"""What must be given too."""
SPEC_ARGUMENTS = ("spec", "design", "other", "a", "b")
NOT_CHECKED = {
    "Agent.act": "looks at each value itself, a million times a second",
    "Agent.act_many": "looks at arrays itself",
    "Agent.reset_many": "looks at arrays itself",
}
METHODS = ("team", "of", "reset", "act", "act_many", "reset_many", "answer")


@pytest.fixture(scope="module")
def agent():
    return bbsd.Agent(HAND)


def functions():
    """Yield all public functions by name, those of an agent among them."""
    for name in sorted({*bbsd.__all__, *api.__all__}):
        value = getattr(api, name, None)
        if inspect.isfunction(value):
            yield name, value
    yield "Agent", bbsd.Agent.__init__
    for name, value in inspect.getmembers(bbsd.Agent, callable):
        if not name.startswith("_"):
            yield f"Agent.{name}", value


def arguments():
    for name, function in functions():
        if name in NOT_CHECKED:
            continue
        for argument in inspect.signature(function).parameters:
            if argument != "self" and ((name, argument) in OWN or argument not in SPEC_ARGUMENTS):
                yield name, argument


def test_all_functions_are_looked_at():
    assert {name for name, _ in functions()} >= {*bbsd.__all__} - {"Agent", "__version__"} | {"price"}
    assert {name.removeprefix("Agent.") for name, _ in functions() if "." in name} == set(METHODS)


@pytest.mark.parametrize(("name", "argument"), [*arguments()])
def test_what_an_argument_cannot_be_is_refused(name, argument, agent, tmp_path):
    bad = OWN.get((name, argument)) or BAD[argument]
    for value, words in bad:
        with pytest.raises(BadArgument, match=words):
            called(name, argument, value, agent, tmp_path)


def called(name, argument, value, agent, folder):
    if argument == "places":
        return api.runs_in(value)
    if name == "Agent.of":
        return bbsd.Agent.of(**{"design": agent._design, argument: value})
    if name in ("Agent.reset", "Agent.answer"):
        return getattr(agent, name.removeprefix("Agent."))(**{argument: value})
    if name == "watch":
        return next(iter(api.watch(**{"run": folder, argument: value})))
    function = bbsd.Agent.team if name == "Agent.team" else getattr(api, name)
    given = [] if name == "spaces" else [HAND]
    return function(*given, **{**NEEDED.get(name, {}), argument: value})


@pytest.mark.parametrize(
    ("name", "given", "words"),
    [
        ("evaluate", {"agents": 5}, 'agents has no effect without fill="random"'),
        ("evaluate", {"exact": True, "episodes": 5}, "episodes has no effect beside exact"),
        ("evaluate", {"exact": True, "fill": "random"}, "exact has no effect beside fill"),
        ("evaluate", {"environment": dict}, "environment has no effect where the spec's world is its own"),
        ("trace", {"episode": 3, "episodes": 5}, "episodes has no effect beside the number of an episode"),
        ("export", {"to": "c", "episodes": 5}, "episodes has no effect without verify and sensing"),
        ("env", {"lanes": 5}, 'lanes has no effect without api="vector"'),
        ("why", {"at": {"x": 1}, "episode": 3}, "episode has no effect without a step of it"),
        ("spaces", {"gymnasium": "CartPole-v1"}, "gymnasium has no effect beside a spec"),
        ("design", {"out": "a", "below": "b"}, "below has no effect beside out"),
        ("design", {"more": 5000, "within": 3.0}, "more has no effect beside within"),
    ],
)
def test_what_has_no_effect_is_refused(name, given, words):
    with pytest.raises(BadArgument, match=words):
        getattr(api, name)(HAND, **given)


def test_a_rival_is_another_method_once():
    quick = {"set": {"design.method": "random"}, "out": None}
    for rivals, words in (
        (["hil"], 'no method; did you mean "hill"'),
        (["hill", "hill"], "hill is named twice"),
        (["random"], "random is the method of the design itself"),
    ):
        with pytest.raises(BadArgument, match=words):
            bbsd.design(SPEC, rivals=rivals, **quick)


def test_a_call_with_an_unknown_argument_says_which():
    with pytest.raises(TypeError, match=r"evaluate\(\) got an unexpected keyword argument 'overrides'"):
        bbsd.evaluate(HAND, overrides=["environment.steps=3"])


def test_numbers_of_other_libraries_are_numbers():
    one, other = (
        bbsd.evaluate(HAND, episodes=count, seed=seed) for count, seed in ((5, 3), (np.int64(5), np.uint8(3)))
    )
    assert one == other


def test_values_to_set_are_texts():
    assert assignments({"a.b": 3, "c": "x + 1", "d": None, "e": [1, True]}) == (
        "a.b=3",
        'c="x + 1"',
        "d=null",
        "e=[1, true]",
    )
    assert assignments(iter(["a=1"])) == ("a=1",)


def test_robots_that_are_none_cannot_be_reset(agent):
    fresh = bbsd.Agent(HAND)
    fresh.act_many(
        {name: "lowest" if each.kind == "cell" else 0.5 for name, each in fresh.inputs.items()}, n=3
    )
    for where in ([3], [True, False], "all"):
        with pytest.raises(BadInput, match="are truths of 3 robots, or their indices"):
            fresh.reset_many(where)
