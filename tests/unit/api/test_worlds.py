"""The verb that gives a spec's world to other libraries."""

import sys

import pytest

import bbsd
from bbsd.adapters.exchange import NotOurWorld
from bbsd.api import BadArgument
from bbsd.api.worlds import LibraryMissing
from tests.unit.architecture.designs import SPECS

CARTPOLE = SPECS / "tasks" / "cartpole.yaml"


def test_it_is_one_of_three_kinds():
    kinds = {
        api: type(bbsd.env(CARTPOLE, api=api)).__mro__[1].__name__
        for api in ("gymnasium", "vector", "pettingzoo")
    }
    assert kinds == {"gymnasium": "Env", "vector": "VectorEnv", "pettingzoo": "ParallelEnv"}


def test_holes_do_not_matter_but_overrides_do():
    world = bbsd.env(CARTPOLE, compiled=False, set=["environment.steps=2"])
    world.reset(seed=0)
    assert not world.step(0)[3]
    assert world.step(0)[3]


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"api": "gym"}, "api is one of 'gymnasium', 'vector', 'pettingzoo', not 'gym'"),
        ({"observe": "state"}, "observe is one of 'sensors', 'cells', not 'state'"),
        ({"api": "vector", "lanes": 0}, "lanes is a whole number of 1 or more, not 0"),
        ({"lanes": 5}, 'lanes has no effect without api="vector"'),
    ],
)
def test_what_there_is_not_is_told(settings, words):
    with pytest.raises(BadArgument, match=words):
        bbsd.env(CARTPOLE, **settings)


def test_somebody_else_s_environment_is_refused():
    with pytest.raises(NotOurWorld):
        bbsd.env(SPECS / "gymnasium" / "cartpole.yaml")


@pytest.mark.parametrize(("api", "library"), [("vector", "gymnasium"), ("pettingzoo", "pettingzoo")])
def test_a_missing_library_is_told(api, library, monkeypatch):
    for name in list(sys.modules):
        if name.startswith("bbsd.adapters.") or name.partition(".")[0] == library:
            monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(LibraryMissing, match=f"{library} is not installed"):
        bbsd.env(CARTPOLE, api=api)
