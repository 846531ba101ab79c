import json

import pytest

from bbsd.runs.storage.finished import NoDesign, design_file, is_of_run, run_content, spec_inside


@pytest.fixture
def run(tmp_path):
    """Make a folder of a run and return it."""

    def make(name="run", *, answer=True, best=False, **content):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "run.json").write_text(json.dumps({"seed": 3, "runs": 1, "set": [], **content}))
        if answer:
            (folder / "architecture.yaml").write_text("bbsd: 1\n")
        if best:
            (folder / "best.yaml").write_text("bbsd: 1\n")
        return folder

    return make


def test_a_run_stands_for_its_design(run):
    folder = run()
    assert design_file(folder) == folder / "architecture.yaml"


@pytest.mark.parametrize("name", ["there.yaml", "missing.yaml"])
def test_a_path_that_is_no_folder_stays(tmp_path, name):
    (tmp_path / "there.yaml").write_text("")
    assert design_file(tmp_path / name) == tmp_path / name


def test_a_run_without_an_answer_says_how_it_goes_on(run):
    folder = run("a run", answer=False, runs=2, set=["design.budget=1000"])
    with pytest.raises(NoDesign, match="no answer yet") as raised:
        design_file(folder)
    assert raised.value.advice == (
        f"continue it: bbsd design '{folder}/spec.yaml' --resume --out '{folder}' --seed 3 --runs 2 "
        "--set design.budget=1000"
    )


def test_the_best_so_far_of_a_stopped_run_is_named(run):
    folder = run(answer=False, best=True)
    with pytest.raises(NoDesign) as raised:
        design_file(folder)
    assert str(folder / "best.yaml") in raised.value.advice


def test_a_folder_that_is_no_run_says_what_a_run_has(tmp_path):
    with pytest.raises(NoDesign, match=r"a run has the files architecture\.yaml and run\.json") as raised:
        design_file(tmp_path)
    assert "the folder that bbsd design wrote" in raised.value.advice


def test_the_runs_in_a_folder_are_named(run, tmp_path):
    folders = [run(f"run{number}") for number in range(4)]
    with pytest.raises(NoDesign) as raised:
        design_file(tmp_path)
    assert raised.value.advice == f"give one of the runs in it: {', '.join(map(str, folders[:3]))} and 1 more"


@pytest.mark.parametrize("text", ["", "[1]", "{"])
def test_what_a_run_says_of_itself_may_be_damaged(tmp_path, text):
    (tmp_path / "run.json").write_text(text)
    assert run_content(tmp_path) == {}


def test_of_several_runs_the_best_is_named(run, tmp_path):
    for name, mean in (("seed-0", 3.5), ("seed-1", 4.25), ("seed-2", 1)):
        run(name, result={"return": {"mean": mean}})
    with pytest.raises(NoDesign) as raised:
        design_file(tmp_path)
    assert raised.value.advice.endswith(f"; {tmp_path / 'seed-1'} has the highest mean return, 4.25")


def test_a_part_of_a_design_names_the_design(run):
    folder = run()
    (folder / "run-2").mkdir()
    with pytest.raises(NoDesign) as raised:
        design_file(folder / "run-2")
    assert raised.value.advice.startswith(f"it is one of the runs of {folder}: give that folder")


def test_a_spec_is_found_in_a_folder_of_specs(tmp_path):
    (tmp_path / "a.yaml").write_text("other: 1\n", encoding="utf-8")
    assert spec_inside(tmp_path) is None
    (tmp_path / "b.yaml").write_text("# a task\nbbsd: 1\n", encoding="utf-8")
    assert spec_inside(tmp_path) == tmp_path / "b.yaml"
    assert not is_of_run(tmp_path)
    (tmp_path / "run.json").write_text("{}", encoding="utf-8")
    assert is_of_run(tmp_path)
