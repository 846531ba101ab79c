"""How environments are found and made, and what is said of those that are not there."""

import pytest

from bbsd.environments.importing.consent import Consent, ImportNotAllowed
from bbsd.environments.importing.modules import NoSuchModule
from bbsd.environments.making import making_of
from bbsd.environments.spaces.misfits import UnfitError
from bbsd.language.outside import Outside
from tests.unit.environments.arenas import HERE

pytest.importorskip("gymnasium")


def making(kind, target, *modules, **arguments):
    return making_of(Outside(kind, target, arguments, (), ()), Consent(modules))


def refused(kind, target, *modules, **arguments):
    with pytest.raises(UnfitError) as error:
        making(kind, target, *modules, **arguments)
    (misfit,) = error.value.misfits
    assert misfit.path[0] == "environment"
    return misfit


def test_one_of_gymnasium_is_made_without_wrappers():
    made = making("gymnasium", "CartPole-v1", "gymnasium", sutton_barto_reward=True)
    assert type(made.make()).__name__ == "CartPoleEnv"
    assert (made.most_steps, made.label) == (500, "CartPole")
    assert made.modules == ("gymnasium", "gymnasium.envs.classic_control.cartpole")
    assert made.make() is not made.make()


def test_arguments_are_laid_over_those_of_the_registration():
    assert making("gymnasium", "FrozenLake-v1", "gymnasium").arguments == {"map_name": "4x4"}
    other = making("gymnasium", "FrozenLake-v1", "gymnasium", map_name="8x8", is_slippery=False)
    assert other.make().observation_space.n == 64


def test_each_environment_has_arguments_of_its_own():
    made = making("python", f"{HERE}:Line", "tests", length=[1])
    one, other = made.make(), made.make()
    one.length.append(2)
    assert other.length == [1]


@pytest.mark.parametrize(
    ("given", "limit"), [({}, 500), ({"max_episode_steps": 7}, 7), ({"max_episode_steps": -1}, None)]
)
def test_the_limit_of_steps_is_that_of_make(given, limit):
    made = making("gymnasium", "CartPole-v1", "gymnasium", **given)
    assert made.most_steps == limit
    assert "max_episode_steps" not in made.arguments


@pytest.mark.parametrize("wrong", [0, 1.5, "ten", True])
def test_a_limit_is_a_whole_number(wrong):
    assert refused("gymnasium", "CartPole-v1", "gymnasium", max_episode_steps=wrong).code == "BB122"


@pytest.mark.parametrize(
    ("name", "successor"),
    [("Taxi-v3", "Taxi-v4"), ("CliffWalking-v0", "CliffWalking-v1"), ("Acrobot-v0", "Acrobot-v1")],
)
def test_an_old_version_names_its_successor(name, successor):
    misfit = refused("gymnasium", name, "gymnasium")
    assert misfit.message == f"{name} is no longer there; its successor is {successor}"
    assert misfit.advice == f"write gymnasium: {successor}"
    assert misfit.path == ("environment", "gymnasium")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("CartPole-v7", "the newest version is CartPole-v1"),
        ("cartpole-v1", "the newest version is CartPole-v1"),
        ("CartPol-v1", 'did you mean "CartPole-v1"?'),
        ("Nothing-v0", "Gymnasium has no environment Nothing-v0"),
    ],
)
def test_an_id_that_is_not_there_says_what_is(name, words):
    misfit = refused("gymnasium", name, "gymnasium")
    assert misfit.code == "BB121"
    assert words in misfit.message


def test_an_id_of_another_package_is_written_with_its_module():
    misfit = refused("gymnasium", "MiniGrid-DoorKeyy-5x5-v0", "gymnasium")
    assert misfit.advice == "write gymnasium: minigrid:MiniGrid-DoorKeyy-5x5-v0"
    pytest.importorskip("minigrid")
    made = making("gymnasium", "minigrid:MiniGrid-DoorKey-5x5-v0", "gymnasium", "minigrid")
    assert made.modules == ("gymnasium", "minigrid", "minigrid.envs")
    misfit = refused("gymnasium", "minigrid:MiniGrid-DorKey-5x5-v0", "gymnasium", "minigrid")
    assert 'did you mean "MiniGrid-DoorKey-5x5-v0"' in misfit.message


def test_all_that_is_needed_must_be_allowed():
    with pytest.raises(ImportNotAllowed, match="module gymnasium,"):
        making("gymnasium", "minigrid:MiniGrid-DoorKey-5x5-v0", "minigrid")
    with pytest.raises(ImportNotAllowed, match="module minigrid,"):
        making("gymnasium", "minigrid:MiniGrid-DoorKey-5x5-v0", "gymnasium")


def test_registered_wrappers_are_refused_rather_than_left_out(monkeypatch):
    import gymnasium

    wrapper = gymnasium.envs.registration.WrapperSpec("Flatten", "gymnasium.wrappers:FlattenObservation", {})
    spec = gymnasium.envs.registration.EnvSpec(
        "Wrapped-v0", "gymnasium.envs.classic_control:CartPoleEnv", additional_wrappers=(wrapper,)
    )
    monkeypatch.setitem(gymnasium.registry, "Wrapped-v0", spec)
    assert "registered with wrappers (Flatten)" in refused("gymnasium", "Wrapped-v0", "gymnasium").message


def test_a_missing_dependency_of_one_is_told():
    with pytest.raises(NoSuchModule, match=r"jax, which is not installed"):
        making("gymnasium", "phys2d/CartPole-v1", "gymnasium")


def test_one_of_pettingzoo_is_its_parallel_environment():
    pytest.importorskip("mpe2")
    made = making("pettingzoo", "mpe2.simple_spread_v3", "mpe2", N=2)
    assert made.make().possible_agents == ["agent_0", "agent_1"]
    assert made.label == "simple_spread"


@pytest.mark.parametrize(
    ("target", "module", "words"),
    [
        ("pettingzoo.sisl.pursuit_v4", "pettingzoo", "its successor is pettingzoo.sisl.pursuit_v5"),
        ("pettingzoo.mpe.simple_spread_v3", "pettingzoo", "its successor is mpe2.simple_spread_v3"),
        ("mpe2.simple_spred_v3", "mpe2", 'did you mean "simple_spread_v3"?'),
        ("mpe2.simple_spread_v9", "mpe2", "its successor is mpe2.simple_spread_v3"),
        ("mpe2.simple_spread_v9", "mpe2.simple_spread_v9", "there is no mpe2.simple_spread_v9"),
    ],
)
def test_one_that_is_not_there_says_what_is(target, module, words):
    pytest.importorskip("mpe2")
    assert words in refused("pettingzoo", target, module).message


def test_agents_that_take_turns_cannot_be_used(monkeypatch):
    module = pytest.importorskip("mpe2.simple_v3")
    monkeypatch.delattr(module, "parallel_env")
    assert "has no parallel_env" in refused("pettingzoo", "mpe2.simple_v3", "mpe2").message


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("Lin", 'has no class Lin; did you mean "Line"?'),
        ("opened", "is not a class"),
        ("Box", "has no reset and no step"),
        ("Field", "has no reset and no step"),
    ],
)
def test_a_class_of_ones_own_has_reset_and_step(name, words):
    misfit = refused("python", f"{HERE}:{name}", "tests")
    assert misfit.path == ("environment", "python")
    assert words in misfit.message


def test_a_class_must_be_from_a_module_that_is_allowed(monkeypatch):
    import gymnasium

    import tests.unit.environments.arenas as module

    monkeypatch.setattr(module, "Cart", gymnasium.make("CartPole-v1").unwrapped.__class__, raising=False)
    with pytest.raises(ImportNotAllowed, match=r"gymnasium\.envs\.classic_control\.cartpole"):
        making("python", f"{HERE}:Cart", "tests")
