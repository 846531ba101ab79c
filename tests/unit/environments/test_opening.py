import pickle

import pytest

from bbsd.environments.importing.consent import Consent, ImportNotAllowed
from bbsd.environments.opening import OtherEnvironment, Recipe, open_environment, opened_again, recipe_of
from bbsd.environments.origin import NotPortable, distribution_version, importable, source_digest
from bbsd.environments.spaces.misfits import UnfitError
from bbsd.language.outside import Outside
from tests.unit.environments.arenas import Box, Discrete, Duet, Field, Line, opened, outside


def refused(name, robots=1, **arguments):
    with pytest.raises(UnfitError) as error:
        opened(name, robots=robots, **arguments)
    return error.value.misfits[0]


def test_what_is_opened_says_what_it_is():
    plain = opened("Duet", robots=2).plain()
    assert plain["target"] == "tests.unit.environments.arenas:Duet"
    assert plain["agents"] == "left right"
    assert plain["action space"] == "Discrete(3)"
    assert len(plain["source"]) == 16
    assert all(isinstance(value, str) for value in plain.values())


def test_another_text_of_its_file_is_another_environment(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    digests = set()
    for index, text in enumerate(("class A: pass\n", "class A: x = 1\n", "class A: pass\n")):
        (tmp_path / f"text_{index}.py").write_text(text, encoding="utf-8")
        digests.add(source_digest(__import__(f"text_{index}").A()))
    assert len(digests) == 2


def test_versions_are_those_of_distributions():
    assert distribution_version("numpy")
    assert distribution_version("yaml") == distribution_version(
        "PyYAML"
    )  # PyYAML has another name than its module
    assert distribution_version("tests") is None


def test_so_are_those_of_what_it_inherits_from_and_imports():
    assert opened("Line").origin.keys() == {
        "numpy",
        "source",
    }  # the standard library and bbsd's tests have none
    pytest.importorskip("gymnasium")
    pytest.importorskip("Box2D")
    target = Outside("gymnasium", "LunarLander-v3", {}, (), ())
    lander = open_environment(Recipe(target, 1, Consent(("gymnasium",))))
    assert lander.origin.keys() == {"Box2D", "gymnasium", "numpy", "source"}


@pytest.mark.parametrize(
    ("name", "robots", "words"),
    [
        ("Line", 2, "has one robot, not 2"),
        ("Duet", 3, "has 2 agents, and robots is 3"),
        ("Duet", 1, "has 2 agents"),
    ],
)
def test_robots_are_as_many_as_there_are(name, robots, words):
    misfit = refused(name, robots)
    assert (misfit.code, misfit.path) == ("BB120", ("environment", "robots"))
    assert words in misfit.message


def test_any_number_is_as_many_as_there_are():
    assert opened("Duet", robots=0).agents == ("left", "right")


def test_arguments_that_it_refuses_are_told():
    misfit = refused("Line", wheels=4)
    assert (misfit.code, misfit.path) == ("BB122", ("environment", "with"))
    assert "unexpected keyword argument 'wheels'" in misfit.message


def test_agents_must_be_alike(monkeypatch):
    monkeypatch.setattr(Duet, "observation_space", lambda _self, agent: Box(len(agent)))
    misfit = refused("Duet", 2)
    assert misfit.code == "BB124"
    assert "one design cannot serve both" in misfit.message


def test_a_class_in_hand_needs_no_consent():
    recipe = Recipe(outside(), 1, given=Line)
    assert isinstance(open_environment(recipe).make(), Line)
    with pytest.raises(ImportNotAllowed):
        open_environment(Recipe(outside(), 1))


def test_recipes_are_plain_data_and_the_same_again():
    fields = (Field("a"), Field("b", 3), Field("c", path=("x", 1)))
    recipe = Recipe(outside("Duet", fields, ("go",)), 2, Consent(("tests",), ("/folder",)), ("/closed",), 5.0)
    assert recipe_of(recipe.plain()) == recipe


def test_consent_goes_with_what_is_sent_to_another_process():
    arena = opened()
    again = pickle.loads(pickle.dumps(arena.stepper.__self__))
    assert again.recipe.consent == arena.recipe.consent
    assert again.plain() == arena.plain()


def test_another_process_must_have_the_same_environment():
    arena = opened()
    other = {**arena.plain(), "gymnasium": "0.1", "source": "0" * 16}
    with pytest.raises(
        OtherEnvironment, match=r"source \(.*, not 0000.*\).*gymnasium \(none, not 0\.1\)|gymnasium"
    ):
        opened_again(arena.recipe.plain(), other)


def test_a_class_in_hand_is_imported_by_another_process_from_its_file():
    recipe = Recipe(outside("Nothing"), 1, given=Line)
    assert recipe.is_portable
    plain = recipe.plain()
    assert plain["target"] == "tests.unit.environments.arenas:Line"
    assert plain["modules"] == ["tests.unit.environments.arenas"]


def test_one_that_has_no_file_of_its_own_cannot_be():
    class Local(Line):
        pass

    assert not Recipe(outside(), 1, given=Local).is_portable
    with pytest.raises(NotPortable, match="Local"):
        importable(Local)


def test_what_it_earns_needs_no_space():
    assert opened("Line").taken is None
    assert str(opened("Line").observed) == "Box(-inf, inf, (2,), float64)"
    assert Discrete(2).n == 2
