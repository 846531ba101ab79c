"""No way to let a spec import a module that nobody allowed: each plants one whose import leaves a mark on the disk."""

import json
import subprocess
import sys
from itertools import count

import pytest

import bbsd as verbs
from tests.end_to_end.commands import bbsd

NUMBERS = count(1)
CODE = """\
from pathlib import Path

Path({mark!r}).write_text("imported", encoding="utf-8")


class Arena:
    def reset(self, *, seed=None):
        return [0.0], {{}}

    def step(self, action):
        return [0.0], 1.0, False, False, {{}}


def parallel_env():
    return Arena()
"""
SPEC = """\
bbsd: 1
name: planted
{further}
environment:
  {kind}: {target}
  with: {arguments}
  steps: 3
  observation: [x]
  action: push
  state: {{push: 0}}
behaviors:
  go:
    inputs: {{side: x > 0}}
    actions: {{left: {{push: 0}}, right: {{push: 1}}}}
    {rules}
{structure}
reward: {{earned: earned}}
design: {{budget: 5000}}
"""
GIVEN = "rules: [{otherwise: left}]"


class Planted:
    """A folder with a stranger's module, of a name that nothing else has, and stranger's specs."""

    def __init__(self, folder):
        self.folder = folder
        self.module = f"planted_{next(NUMBERS)}"
        self.mark = folder / "mark"
        self.plant(f"{self.module}.py")

    def plant(self, name):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(CODE.format(mark=str(self.mark)), encoding="utf-8")

    def spec(self, kind="python", target=None, *, arguments="{}", further="", given=True, name="spec.yaml"):
        text = SPEC.format(
            kind=kind,
            target=target or f"{self.module}:Arena",
            arguments=arguments,
            further=further,
            rules=GIVEN if given else "",
            structure="structure: [go]" if given else "",
        )
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def refuses(self, *words, code=2):
        """Run a command in the folder; it ends with this code, and nothing was imported."""
        found, _, err = bbsd(*words, cwd=self.folder)
        assert not self.mark.exists(), words
        assert found == code, err
        return err


@pytest.fixture
def planted(tmp_path, monkeypatch):
    """What is searched for modules is as bad as it can be: the folder of the spec first, as `python -m` has it."""
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.syspath_prepend("")
    monkeypatch.setenv("BBSD_ALLOW_IMPORT", "*")
    monkeypatch.setattr("bbsd.api.given.environments.configuration_file", lambda: None)
    return Planted(tmp_path)


def test_a_module_that_is_allowed_leaves_its_mark(planted):
    """Otherwise none of the other tests could fail."""
    words = ("evaluate", planted.spec(), "--episodes", "2")
    code, out, err = bbsd(
        *words, "--allow-import", planted.module, "--import-from", planted.folder, cwd=planted.folder
    )
    assert code == 0, err
    assert planted.mark.exists()
    assert f"importing {planted.module} from {planted.folder / planted.module}.py" in err
    assert "3.00" in out


COMMANDS_THAT_READ = [
    ("check", 0),
    ("config", 0),
    ("compile", 0),
    ("explain", 0),
    ("fmt", 0),
    ("tidy", 0),
]


@pytest.mark.parametrize(("command", "code"), COMMANDS_THAT_READ)
def test_1_what_only_reads_a_spec_imports_nothing(planted, command, code):
    planted.refuses(command, planted.spec(), code=code)


COMMANDS_OF_EPISODES = [
    ("evaluate",),
    ("evaluate", "--fault", "all"),
    ("spaces",),
    ("design",),
    ("design", "--dry-run"),
    ("worth",),
    ("why", "--step", "1"),
    ("report", "-o", "page.html"),
    ("explain", "--worth"),
    ("explain", "--episodes", "5"),
]


@pytest.mark.parametrize("words", COMMANDS_OF_EPISODES, ids=lambda words: " ".join(words[:2]))
def test_2_without_the_option_no_command_imports(planted, words):
    command, *options = words
    err = planted.refuses(command, planted.spec(given=command != "design"), *options)
    assert f"--allow-import {planted.module}" in err
    assert "Traceback" not in err


def test_3_nor_does_a_comparison(planted):
    err = planted.refuses("compare", planted.spec(), planted.spec(name="other.yaml"))
    assert f"--allow-import {planted.module}" in err


@pytest.mark.parametrize("words", COMMANDS_OF_EPISODES, ids=lambda words: " ".join(words[:2]))
def test_4_consent_for_another_module_is_none(planted, words):
    command, *options = words
    spec = planted.spec(given=command != "design")
    planted.refuses(command, spec, *options, "--allow-import", "gymnasium", "--import-from", planted.folder)


def test_5_a_module_before_the_id_of_gymnasium_must_be_allowed_too(planted):
    spec = planted.spec("gymnasium", f"{planted.module}:CartPole-v1")
    planted.refuses("evaluate", spec, "--allow-import", "gymnasium")


def test_6_the_entry_point_of_a_registered_id_must_be_allowed_too(planted, monkeypatch):
    gymnasium = pytest.importorskip("gymnasium")
    entry = f"{planted.module}:Arena"
    registered = gymnasium.envs.registration.EnvSpec("Planted-v0", entry_point=entry)
    monkeypatch.setitem(gymnasium.registry, "Planted-v0", registered)
    planted.refuses("evaluate", planted.spec("gymnasium", "Planted-v0"), "--allow-import", "gymnasium")


@pytest.mark.parametrize("key", ["entry_point", "id", "vector_entry_point", "wrappers", "namespace"])
def test_7_arguments_are_given_to_the_environment_alone(planted, key):
    arguments = f"{{{key}: '{planted.module}:Arena'}}"
    spec = planted.spec("gymnasium", "CartPole-v1", arguments=arguments)
    planted.refuses("spaces", spec, "--allow-import", "gymnasium")


@pytest.mark.parametrize(
    ("target", "key", "value"),
    [
        ("gymnasium:make", "id", "{module}:CartPole-v1"),
        ("gymnasium:make_vec", "id", "{module}:CartPole-v1"),
        ("gymnasium.envs.registration:load_env_creator", "name", "{module}:Arena"),
        ("importlib:import_module", "name", "{module}"),
        ("builtins:exec", "source", "import {module}"),
        ("runpy:run_module", "mod_name", "{module}"),
        ("subprocess:Popen", "args", "[python, '-c', 'import {module}']"),
    ],
)
def test_8_a_function_of_an_allowed_module_is_not_called(planted, target, key, value):
    """A stranger chooses the arguments, so only a class with reset and step is made."""
    value = value.format(module=planted.module)
    spec = planted.spec(target=target, arguments=f"{{{key}: {value if value[0] == '[' else repr(value)}}}")
    err = planted.refuses("spaces", spec, "--allow-import", target.partition(".")[0].partition(":")[0])
    assert "is not a class" in err or "has no reset" in err


def test_9_a_spec_that_is_extended_cannot_allow_it(planted):
    (planted.folder / "base.yaml").write_text(f"allow_import: [{planted.module}]\n", encoding="utf-8")
    planted.refuses("evaluate", planted.spec(further="extends: base.yaml"))


@pytest.mark.parametrize("key", ["allow_import", "x-allow_import", "x-allow-import", "import_from"])
def test_10_nor_can_the_spec_itself(planted, key):
    planted.refuses("evaluate", planted.spec(further=f"{key}: [{planted.module}]"))


def test_11_nor_an_override(planted):
    spec = planted.spec()
    planted.refuses("evaluate", spec, "--set", f"allow_import={planted.module}")
    planted.refuses("evaluate", spec, "--set", f"environment.allow_import={planted.module}")
    planted.refuses("evaluate", spec, "--set", f"environment.with.allow_import={planted.module}")


def test_12_an_override_names_another_module_without_allowing_it(planted):
    spec = planted.spec(target="gymnasium:Env")
    planted.refuses(
        "evaluate",
        spec,
        "--set",
        f"environment.python={planted.module}:Arena",
        "--allow-import",
        "gymnasium",
    )


@pytest.mark.parametrize("name", ["HOME", "XDG_CONFIG_HOME", "APPDATA", "BBSD_CONFIG", "BBSD_CACHE_DIR"])
def test_13_an_environment_variable_leads_to_no_other_configuration(planted, monkeypatch, name):
    monkeypatch.undo()
    for folder in ("bbsd", ".config/bbsd", "Library/Application Support/bbsd"):
        path = planted.folder / folder / "config.yaml"
        path.parent.mkdir(parents=True)
        path.write_text(f"allow_import: [{planted.module}]\n", encoding="utf-8")
    monkeypatch.syspath_prepend(str(planted.folder))
    monkeypatch.setenv(name, str(planted.folder))
    planted.refuses("evaluate", planted.spec())


@pytest.mark.parametrize(
    "name", ["config.yaml", "bbsd.yaml", ".bbsd.yaml", "bbsd/config.yaml", "pyproject.toml"]
)
def test_14_a_configuration_beside_the_spec_is_not_read(planted, name):
    path = planted.folder / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(f"allow_import: [{planted.module}]\n", encoding="utf-8")
    planted.refuses("evaluate", planted.spec())


def test_15_a_configuration_that_others_may_write_allows_nothing(planted, monkeypatch):
    path = planted.folder / "config.yaml"
    path.write_text(f"allow_import: [{planted.module}]\n", encoding="utf-8")
    monkeypatch.setattr("bbsd.api.given.environments.configuration_file", lambda: path)
    path.chmod(0o666)
    err = planted.refuses("evaluate", planted.spec(), "--import-from", planted.folder)
    assert "others than its owner may write this file" in err


@pytest.mark.parametrize("further", [(), ("--allow-import", "json")])
def test_16_an_allowed_name_is_not_looked_for_beside_the_spec(planted, further):
    err = planted.refuses("evaluate", planted.spec(), "--allow-import", planted.module, *further)
    assert f"{planted.folder / planted.module}.py is there" in err
    assert f"--import-from {planted.folder}" in err


def test_17_pythonpath_does_not_say_where_to_look(planted, monkeypatch, tmp_path_factory):
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    monkeypatch.setenv("PYTHONPATH", str(planted.folder))
    spec = planted.spec().rename(elsewhere / "spec.yaml")
    monkeypatch.chdir(elsewhere)
    code, _, err = bbsd("evaluate", spec, "--allow-import", planted.module, cwd=elsewhere)
    assert (code, planted.mark.exists()) == (2, False)
    assert "--import-from" in err


@pytest.mark.parametrize("beside", ["gymnasium.py", "gymnasium/__init__.py", "mpe2/simple_spread_v3.py"])
def test_18_a_file_beside_the_spec_does_not_stand_for_an_installed_module(planted, beside):
    """In a process of its own, where nothing was imported before, with the current folder first in the path."""
    pytest.importorskip("gymnasium")
    planted.plant(beside)
    top = beside.partition("/")[0].removesuffix(".py")
    kind, target = (
        ("gymnasium", "CartPole-v1") if top == "gymnasium" else ("pettingzoo", "mpe2.simple_spread_v3")
    )
    planted.spec(kind, target)
    command = [sys.executable, "-m", "bbsd", "spaces", "spec.yaml", "--allow-import", top]
    done = subprocess.run(command, cwd=planted.folder, capture_output=True, text=True, check=False)
    assert not planted.mark.exists()
    assert done.returncode == 2  # it has other observations than the spec says
    assert "BB113" in done.stderr


def test_19_what_an_environment_imports_later_is_not_looked_for_there_either(planted, tmp_path_factory):
    mine = tmp_path_factory.mktemp("mine")
    (mine / "later.py").write_text(
        f"""
class Arena:
    def reset(self, *, seed=None):
        return [0.0], {{}}

    def step(self, action):
        import {planted.module}
""",
        encoding="utf-8",
    )
    planted.spec(target="later:Arena")
    command = [sys.executable, "-m", "bbsd", "evaluate", "spec.yaml", "--allow-import", "later"]
    done = subprocess.run(
        [*command, "--import-from", mine], cwd=planted.folder, capture_output=True, text=True, check=False
    )
    assert not planted.mark.exists()
    assert done.returncode == 2
    assert f"ModuleNotFoundError: No module named '{planted.module}'" in done.stderr


def test_20_a_folder_of_a_run_does_not_bring_consent(planted):
    run = planted.folder / "run"
    run.mkdir()
    planted.spec(given=False).rename(run / "spec.yaml")
    content = {
        "format": 3,
        "seed": 0,
        "runs": 1,
        "set": [],
        "allow_import": [planted.module],
        "import_from": ["."],
    }
    content["environment"] = {"target": f"{planted.module}:Arena", "modules": [planted.module]}
    (run / "run.json").write_text(json.dumps(content), encoding="utf-8")
    planted.refuses("design", run, "--resume")
    planted.refuses("design", run)


@pytest.mark.parametrize(
    "name", ["", "*", "planted_*", ".", "a.b.", "-x", "{module}/", "{module}.py", "a,{module}"]
)
def test_21_only_names_of_modules_are_taken_for_consent(planted, name):
    name = name.format(module=planted.module)
    planted.refuses("evaluate", planted.spec(), f"--allow-import={name}", "--import-from", planted.folder)


def test_22_a_name_does_not_stand_for_those_that_begin_like_it(planted):
    for name in (planted.module[:-1] or "p", f"{planted.module}.arena", f"{planted.module}_"):
        planted.refuses("evaluate", planted.spec(), "--allow-import", name, "--import-from", planted.folder)


@pytest.mark.parametrize(
    "target", ["../{m}:Arena", "{m}.py:Arena", ".{m}:Arena", "{m}", "{m}:__init__.x", "os;{m}:A"]
)
def test_23_what_is_not_a_module_and_a_class_is_refused(planted, target):
    spec = planted.spec(target=f'"{target.format(m=planted.module)}"')
    planted.refuses("evaluate", spec, "--allow-import", "os", "--import-from", planted.folder)


@pytest.mark.parametrize(
    "tag", ["!!python/module:{m}", "!!python/object/apply:importlib.import_module [{m}]"]
)
def test_24_a_tag_of_yaml_runs_nothing(planted, tag):
    planted.refuses("check", planted.spec(arguments=f"{{a: {tag.format(m=planted.module)}}}"))


def test_25_the_verbs_import_no_more_than_the_commands(planted, monkeypatch):
    monkeypatch.chdir(planted.folder)
    spec = planted.spec()
    for verb in (verbs.evaluate, verbs.trace, verbs.spaces, verbs.worth, verbs.explain, verbs.check):
        if verb not in (verbs.explain, verbs.check):
            with pytest.raises(ValueError, match="was not imported"):
                verb(spec)
        else:
            verb(spec)
    assert not planted.mark.exists()


def test_26_a_file_that_is_named_by_a_link_is_beside_the_spec_too(planted, tmp_path_factory, monkeypatch):
    link = tmp_path_factory.mktemp("links") / "link"
    link.symlink_to(planted.folder, target_is_directory=True)
    monkeypatch.syspath_prepend(str(link))
    planted.refuses("evaluate", planted.spec(), "--allow-import", planted.module)


@pytest.mark.parametrize("name", ["typer.py", "pydantic.py", "pathlib.py", "numpy/__init__.py"])
def test_27_nor_is_what_bbsd_itself_needs_looked_for_in_the_current_folder(planted, name):
    """Where it is run by `python -m`, which would have it so."""
    planted.plant(name)
    planted.spec()
    command = [sys.executable, "-m", "bbsd", "check", "spec.yaml"]
    done = subprocess.run(command, cwd=planted.folder, capture_output=True, text=True, check=False)
    assert (done.returncode, planted.mark.exists()) == (0, False), done.stderr
