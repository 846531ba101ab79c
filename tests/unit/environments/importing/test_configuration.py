import os
import sys
from pathlib import Path

import pytest

from bbsd.environments.importing.configuration import allowed_by_configuration, configuration_file
from bbsd.errors import SpecError


@pytest.fixture
def allowed(tmp_path):
    def of(text):
        path = tmp_path / "config.yaml"
        path.write_text(text, encoding="utf-8")
        return allowed_by_configuration(path)

    return of


def told(refused):
    return [(each.code, each.place.line, each.place.column, each.message) for each in refused.value.diagnoses]


def test_modules_are_listed(allowed):
    assert allowed("allow_import: [gymnasium, mpe2.simple_spread_v3]\n") == (
        "gymnasium",
        "mpe2.simple_spread_v3",
    )


@pytest.mark.parametrize("text", ["allow_import: []\n", "allow_import:\n", "{}\n"])
def test_none_may_be_listed(allowed, text):
    assert allowed(text) == ()


def test_no_file_allows_nothing(tmp_path):
    assert allowed_by_configuration(tmp_path / "config.yaml") == ()
    assert allowed_by_configuration(None) == ()


def test_another_key_is_a_mistake(allowed):
    with pytest.raises(SpecError) as refused:
        allowed("allow_import: [gymnasium]\nallow_imports: [mpe2]\n")
    assert told(refused) == [
        ("BB123", 2, 1, "there is no setting 'allow_imports'; did you mean \"allow_import\"?")
    ]


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("allow_import: gymnasium\n", 15, "allow_import is a list of modules, not text"),
        ("allow_import: [gymnasium, 7]\n", 27, "a number is not the name of a module"),
        ("allow_import: ['*']\n", 16, "'*' is not the name of a module"),
        ("allow_import: [a.b, a/b]\n", 21, "'a/b' is not the name of a module"),
    ],
)
def test_so_is_what_is_not_a_list_of_modules(allowed, text, column, message):
    with pytest.raises(SpecError) as refused:
        allowed(text)
    assert told(refused) == [("BB123", 1, column, message)]


def test_so_is_what_is_not_yaml(allowed):
    with pytest.raises(SpecError):
        allowed("allow_import: [gymnasium\n")


@pytest.mark.skipif(os.name != "posix", reason="rights of files")
@pytest.mark.parametrize("mode", [0o620, 0o602, 0o666])
def test_others_must_not_write_it(allowed, tmp_path, mode):
    path = tmp_path / "config.yaml"
    path.write_text("allow_import: [gymnasium]\n", encoding="utf-8")
    path.chmod(mode)
    with pytest.raises(SpecError) as refused:
        allowed_by_configuration(path)
    assert "others than its owner may write" in str(refused.value)


@pytest.mark.skipif(os.name != "posix", reason="rights of files")
def test_nor_its_folder(tmp_path):
    path = tmp_path / "bbsd" / "config.yaml"
    path.parent.mkdir()
    path.write_text("allow_import: [gymnasium]\n", encoding="utf-8")
    path.parent.chmod(0o777)
    with pytest.raises(SpecError):
        allowed_by_configuration(path)


@pytest.mark.skipif(os.name != "posix", reason="where POSIX keeps users")
def test_no_variable_says_where_it_is(monkeypatch, tmp_path):
    import pwd

    for name in ("HOME", "XDG_CONFIG_HOME", "APPDATA"):
        monkeypatch.setenv(name, str(tmp_path))
    home = Path(pwd.getpwuid(os.getuid()).pw_dir)
    middle = "Library/Application Support" if sys.platform == "darwin" else ".config"
    assert configuration_file() == home / middle / "bbsd" / "config.yaml"


@pytest.mark.skipif(os.name != "posix", reason="where POSIX keeps users")
def test_a_user_without_a_home_has_none(monkeypatch):
    import pwd

    def unknown(_number):
        raise KeyError("no such user")

    monkeypatch.setattr(pwd, "getpwuid", unknown)
    assert configuration_file() is None
