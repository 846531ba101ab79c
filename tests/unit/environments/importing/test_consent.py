import pytest

from bbsd.environments.importing.consent import ImportNotAllowed, NotAModule, consent


def test_a_name_covers_itself_and_what_is_below():
    allowed = consent(["gymnasium", "mpe2.simple"])
    assert allowed.covers("gymnasium")
    assert allowed.covers("gymnasium.envs.toy_text")
    assert allowed.covers("mpe2.simple")
    assert not any(map(allowed.covers, ("gymnasium_robotics", "gym", "mpe2", "mpe2.simple_spread_v3", "")))


def test_what_is_not_covered_is_refused_with_what_to_do():
    with pytest.raises(ImportNotAllowed, match="CartPole-v1 needs the module gymnasium") as refused:
        consent(["mpe2"]).require("gymnasium", "CartPole-v1")
    assert "--allow-import gymnasium" in refused.value.advice


def test_of_what_lies_below_the_top_is_offered():
    with pytest.raises(ImportNotAllowed, match=r"the module minigrid\.envs") as refused:
        consent([]).require("minigrid.envs", "it")
    assert "--allow-import minigrid " in refused.value.advice


@pytest.mark.parametrize("name", ["", "*", "a b", "a.", ".a", "1a", "a-b", "a,b", "a/b", "é", "a\n"])
def test_what_is_no_module_is_no_consent(name):
    with pytest.raises(NotAModule):
        consent([name])


def test_folders_are_absolute(tmp_path, monkeypatch):
    (tmp_path / "own").mkdir()
    monkeypatch.chdir(tmp_path)
    assert consent([], ["own"]).folders == (str(tmp_path / "own"),)


def test_a_folder_must_be_there(tmp_path):
    with pytest.raises(NotADirectoryError, match="missing"):
        consent([], [tmp_path / "missing"])
