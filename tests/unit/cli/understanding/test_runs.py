import json

import pytest

import bbsd
from bbsd.api.watching import NoRun
from tests.end_to_end.commands import bbsd as command
from tests.unit.runs.storage.test_listing import GENERATION, RESULT, run, write

SPEC = """bbsd: 1
name: small
environment:
  steps: 2
  state: {x: 0}
behaviors:
  wait: {actions: {stay: {x: x}}}
reward: {nothing: x}
design: {coevolution: {generations: 9}}
"""


def test_without_a_folder_those_below_runs_are_listed(tmp_path):
    assert command("runs", cwd=tmp_path) == (0, "", "there are no runs in runs\n")
    assert command("runs", "--json", cwd=tmp_path)[1] == "[]\n"
    run(tmp_path / "runs" / "a-seed7")
    code, out, err = command("runs", cwd=tmp_path)
    assert (code, out.splitlines()[1].split()[:4]) == (0, ["runs/a-seed7", "stopped", "auto", "7"])
    assert "continue it: bbsd design runs/a-seed7/spec.yaml --resume --out runs/a-seed7 --seed 7" in err


def test_several_folders(tmp_path):
    for name in ("a", "b"):
        run(tmp_path / name, result=RESULT)
    code, out, err = command("runs", tmp_path / "a", tmp_path, "--json")
    names = [plain["folder"].rpartition("/")[2] for plain in json.loads(out)]
    assert (code, names, err) == (0, ["a", "a", "b"], "")


def test_a_folder_that_is_not_there_is_a_mistake_of_the_user(tmp_path):
    code, out, err = command("runs", tmp_path / "none")
    assert (code, out) == (2, "")
    assert "is no folder" in err
    with pytest.raises(NoRun):
        bbsd.runs_in(tmp_path / "none")


def test_how_many_generations_there_are_is_read_from_the_spec(tmp_path):
    write(run(tmp_path, [GENERATION], budgets=[]) / "spec.yaml", SPEC)
    assert "4 of 9 generations" in command("runs", tmp_path)[1]
    write(tmp_path / "spec.yaml", "nonsense: [")
    assert "  4 generations" in command("runs", tmp_path)[1]


def test_names_steer_no_terminal(tmp_path):
    run(tmp_path / "a\x1b[2Jb")
    _, out, err = command("runs", tmp_path)
    assert "\x1b" not in out + err
    assert "a\\x1b[2Jb" in out
