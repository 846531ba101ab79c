import numpy as np
import pytest

from bbsd.environments.importing.consent import Consent
from bbsd.environments.opening import Recipe, open_environment
from bbsd.environments.spaces.kinds import Box, Discrete, Mapping, Several, count
from bbsd.environments.spaces.matching import misfits
from bbsd.environments.spaces.naming import (
    KNOWN,
    SIZES,
    action_names,
    observation_text,
    proposals,
    range_text,
)
from bbsd.language.outside import Outside, read_fields
from bbsd.text import Source, read


def box(*shape):
    return Box(shape, (-np.inf,) * int(np.prod(shape)), (np.inf,) * int(np.prod(shape)), "float32")


SPACES = [
    box(3),
    box(1),
    box(2, 3),
    box(84, 84, 3),
    box(200),
    Discrete(7),
    Several((Discrete(2), Discrete(3))),
    Several((Discrete(2), box(2))),
    Mapping(
        (
            ("a b", Discrete(2)),
            ("A-B", box(4)),
            ("if", Discrete(3)),
            ("x", Several((Discrete(2), Discrete(2)))),
        )
    ),
]


@pytest.mark.parametrize("space", SPACES, ids=str)
def test_what_is_proposed_fits_and_can_be_read(space):
    text = observation_text(space)
    data = read(Source("proposal", f"observation: {text}\n")).data["observation"]
    assert misfits(Outside("python", "a:B", {}, read_fields(data), ("c",)), space, None, ()) == []


def test_well_known_environments_have_names_of_their_own():
    gymnasium = pytest.importorskip("gymnasium")
    newest = {spec.name: spec.id for spec in gymnasium.registry.values() if spec.namespace is None}
    for name in KNOWN.keys() | SIZES.keys():
        target = Outside("gymnasium", newest[name], {}, (), ())
        space = open_environment(Recipe(target, 1, Consent(("gymnasium",)))).observed
        found = proposals(space, name)
        assert [each.name for each in found] == list(KNOWN.get(name, SIZES.get(name)))
        assert name in SIZES or len(found) == count(space)


def test_sizes_that_do_not_fit_are_not_proposed():
    assert observation_text(Discrete(64), "FrozenLake") == "[place]"


def test_names_of_actions_are_none_of_those_observed():
    assert action_names(1) == ["command"]
    assert action_names(2, ["command"]) == ["sent_1", "sent_2"]


def test_ranges_in_words():
    bounds = Box((4,), (-np.inf, -np.inf, 0.0, 1.0), (np.inf, 2.0, np.inf, 3.5), "float32")
    assert [range_text(bounds, index) for index in range(4)] == [
        "any number",
        "at most 2",
        "0 or more",
        "1 to 3.5",
    ]
    assert range_text(Discrete(3, start=-1), 0) == "-1 to 1"
