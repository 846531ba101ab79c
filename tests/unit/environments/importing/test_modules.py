import sys

import pytest

from bbsd.environments.failures import EnvironmentFailed
from bbsd.environments.importing.consent import ImportNotAllowed, consent
from bbsd.environments.importing.modules import NoSuchModule, imported, installed, searching


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Write a module into a folder; all that is imported is forgotten afterwards."""
    before = set(sys.modules)
    monkeypatch.setattr(sys, "path", list(sys.path))

    def write_module(name, text):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")

    yield write_module
    for name in set(sys.modules) - before:
        del sys.modules[name]


def brought(module, tmp_path, announce=None):
    allowed = consent([module.partition(".")[0]], [tmp_path])
    with searching(allowed, ()):
        return imported(module, allowed, "the environment", announce)


def test_a_module_comes_from_a_folder_that_was_named(write, tmp_path):
    write("mine_1.py", "VALUE = 3\n")
    assert brought("mine_1", tmp_path).VALUE == 3
    assert sys.path[-1] == str(tmp_path)  # it may import more, later


def test_its_file_is_announced_before_it_runs(write, tmp_path):
    write("mine_2/__init__.py", "raise ValueError('no')\n")
    told = []
    with pytest.raises(EnvironmentFailed, match="ValueError: no"):
        brought("mine_2", tmp_path, lambda *what: told.append(what))
    assert told == [("mine_2", str(tmp_path / "mine_2" / "__init__.py"))]


def test_what_was_imported_before_is_not_announced(tmp_path):
    brought("json", tmp_path, lambda *_: pytest.fail("announced"))


def test_only_allowed_modules_are_imported(tmp_path):
    with pytest.raises(ImportNotAllowed), searching(consent(["json"]), ()):
        imported("csv", consent(["json"]), "the environment")


def test_a_missing_module_is_told_with_how_to_install_it(tmp_path):
    with pytest.raises(NoSuchModule, match="needs the module nowhere, which is not installed"):
        brought("nowhere", tmp_path)


def test_so_is_what_a_module_needs(write, tmp_path):
    write("mine_3.py", "import pettingzoo_of_nobody\n")
    with pytest.raises(NoSuchModule, match="mine_3 imports pettingzoo_of_nobody") as refused:
        brought("mine_3", tmp_path)
    assert "pip install pettingzoo_of_nobody" in refused.value.advice


def test_so_is_a_submodule_that_is_not_there(tmp_path):
    with pytest.raises(NoSuchModule, match=r"needs the module json\.nothing"):
        brought("json.nothing", tmp_path)


def test_a_module_that_cannot_be_imported_says_why(write, tmp_path):
    write("mine_4.py", "from json import nothing\n")
    with pytest.raises(NoSuchModule, match="mine_4 cannot be imported: cannot import name 'nothing'"):
        brought("mine_4", tmp_path)


def test_a_dependency_of_gymnasium_is_not_a_failure(write, tmp_path):
    text = (
        "class DependencyNotInstalled(Exception): pass\nraise DependencyNotInstalled('pip install wheels')\n"
    )
    write("mine_5.py", text)
    with pytest.raises(NoSuchModule, match="mine_5 cannot be imported: pip install wheels"):
        brought("mine_5", tmp_path)


def test_a_failing_import_shows_its_own_lines_alone(write, tmp_path):
    write("mine_6.py", "x = 1\ny = x / 0\n")
    with pytest.raises(EnvironmentFailed) as failed:
        brought("mine_6", tmp_path)
    first, *lines = str(failed.value).split("\n")
    assert first == "the import of mine_6 raised ZeroDivisionError: division by zero"
    assert [line.strip() for line in lines] == [f"{tmp_path}/mine_6.py:2, in <module>: y = x / 0"]


def test_the_installed_environment_is_all_but_current_closed_and_named_folders(tmp_path, monkeypatch):
    here, spec, named, kept = (tmp_path / name for name in ("here", "spec", "named", "kept"))
    for folder in (here, spec, named, kept):
        folder.mkdir()
    (tmp_path / "link").symlink_to(spec)
    monkeypatch.chdir(here)
    monkeypatch.setenv("PYTHONPATH", f"{named}:")
    path = ["", ".", str(here), str(spec), str(tmp_path / "link"), str(named), str(kept), "/somewhere.zip"]
    assert installed(path, [str(spec)]) == [str(kept), "/somewhere.zip"]


def test_folders_come_last(tmp_path, monkeypatch):
    """So no file in one of them stands for an installed module."""
    monkeypatch.setattr(sys, "path", ["/one", "/two"])
    with searching(consent([], [tmp_path]), ()):
        assert sys.path == ["/one", "/two", str(tmp_path)]


def test_a_file_nearby_is_pointed_at(tmp_path, monkeypatch):
    (tmp_path / "mine_7.py").write_text("", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend("")
    with (
        pytest.raises(NoSuchModule, match=r"mine_7\.py is there, but") as refused,
        searching(consent(["mine_7"]), ()),
    ):
        imported("mine_7", consent(["mine_7"]), "it")
    assert refused.value.advice == f"if you trust it: --import-from {tmp_path}"
